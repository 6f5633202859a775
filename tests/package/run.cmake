# Installs the build BUILD_DIR into WORK_DIR/prefix, then configures, builds and runs tests/package/outside against it, and
# asks pkg-config for the same.
function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
    message("${said}")
    if(failed)
        message(FATAL_ERROR "failed: ${ARGN}")
    endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/outside -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
    -DCMAKE_C_COMPILER=${C_COMPILER} "-DCMAKE_C_FLAGS=${C_FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/outside)

foreach(installed include/seaglare.h share/seaglare/config/quality/default.json share/doc/seaglare/CONTRACT.md)
    if(NOT EXISTS ${WORK_DIR}/prefix/${installed})
        message(FATAL_ERROR "${installed} was not installed")
    endif()
endforeach()

file(GLOB_RECURSE pkg_config_file ${WORK_DIR}/prefix/seaglare.pc)
get_filename_component(folder ${pkg_config_file} DIRECTORY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} pkg-config --cflags --libs seaglare
                OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(NOT flags MATCHES "-I[^ ]*/include" OR NOT flags MATCHES "-lseaglare")
    message(FATAL_ERROR "pkg-config says: ${flags}")
endif()
