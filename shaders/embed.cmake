# Writes OUT, a C++ file with every file of SOURCES as a string; embedded.h says how it is read.
file(WRITE "${OUT}" "#include \"shaders/embedded.h\"\n\nnamespace seaglare::shaders {\n\n"
     "std::string_view source(std::string_view name) {\n")
foreach(path IN LISTS SOURCES)
    get_filename_component(name "${path}" NAME)
    file(READ "${path}" body)
    file(APPEND "${OUT}" "    if (name == \"${name}\") return R\"shader(")
    file(APPEND "${OUT}" "${body}")
    file(APPEND "${OUT}" ")shader\";\n")
endforeach()
file(APPEND "${OUT}" "    return {};\n}\n\n}  // namespace seaglare::shaders\n")
