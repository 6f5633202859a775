#include "glare/device/cl_device.h"

#include <array>
#include <utility>

#include "glare/device/cl_signal_guard.h"
#include "glare/device/cl_turns.h"

namespace seaglare::glare {

namespace {

constexpr std::array<std::pair<cl_int, const char*>, 26> code_names = {{
    {CL_DEVICE_NOT_FOUND, "CL_DEVICE_NOT_FOUND"},
    {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
    {CL_COMPILER_NOT_AVAILABLE, "CL_COMPILER_NOT_AVAILABLE"},
    {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
    {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
    {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
    {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
    {CL_INVALID_VALUE, "CL_INVALID_VALUE"},
    {CL_INVALID_PLATFORM, "CL_INVALID_PLATFORM"},
    {CL_INVALID_DEVICE, "CL_INVALID_DEVICE"},
    {CL_INVALID_CONTEXT, "CL_INVALID_CONTEXT"},
    {CL_INVALID_COMMAND_QUEUE, "CL_INVALID_COMMAND_QUEUE"},
    {CL_INVALID_MEM_OBJECT, "CL_INVALID_MEM_OBJECT"},
    {CL_INVALID_BINARY, "CL_INVALID_BINARY"},
    {CL_INVALID_BUILD_OPTIONS, "CL_INVALID_BUILD_OPTIONS"},
    {CL_INVALID_PROGRAM_EXECUTABLE, "CL_INVALID_PROGRAM_EXECUTABLE"},
    {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME"},
    {CL_INVALID_KERNEL, "CL_INVALID_KERNEL"},
    {CL_INVALID_ARG_INDEX, "CL_INVALID_ARG_INDEX"},
    {CL_INVALID_ARG_VALUE, "CL_INVALID_ARG_VALUE"},
    {CL_INVALID_ARG_SIZE, "CL_INVALID_ARG_SIZE"},
    {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
    {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
    {CL_INVALID_WORK_ITEM_SIZE, "CL_INVALID_WORK_ITEM_SIZE"},
    {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
    {-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
}};

std::string device_text(cl_device_id device, cl_device_info what) {
    std::size_t size = 0;
    check_cl(clGetDeviceInfo(device, what, 0, nullptr, &size), "clGetDeviceInfo");
    std::string text(size, '\0');
    check_cl(clGetDeviceInfo(device, what, size, text.data(), nullptr), "clGetDeviceInfo");
    while (!text.empty() && text.back() == '\0')
        text.pop_back();
    return text;
}

}  // namespace

std::string cl_code_name(cl_int code) {
    for (const auto& [value, name] : code_names)
        if (value == code) return name;
    return std::to_string(code);
}

ClError::ClError(std::string_view call, cl_int code)
    : std::runtime_error("OpenCL: " + std::string(call) + " failed with " + cl_code_name(code)),
      code_(code) {}

void check_cl(cl_int code, std::string_view call) {
    if (code != CL_SUCCESS) throw ClError(call, code);
}

ClKernel::ClKernel(cl_program program, const char* name) : name_(name) {
    cl_int code = CL_SUCCESS;
    kernel_.reset(clCreateKernel(program, name, &code));
    check_cl(code, "clCreateKernel(" + name_ + ")");
}

void ClKernel::set_argument(cl_uint index, std::size_t size, const void* value) {
    const cl_int code = clSetKernelArg(kernel_.get(), index, size, value);
    if (code != CL_SUCCESS)
        throw ClError("clSetKernelArg(" + name_ + ", " + std::to_string(index) + ")", code);
}

void ClKernel::launch(cl_command_queue queue, std::size_t items, std::size_t group) const {
    const std::size_t global = (items + group - 1) / group * group;
    enqueue(queue, 1, &global, &group);
}

void ClKernel::launch(cl_command_queue queue, std::size_t columns, std::size_t rows,
                      std::size_t group_columns, std::size_t group_rows) const {
    const std::array<std::size_t, 2> local = {group_columns, group_rows};
    const std::array<std::size_t, 2> global = {(columns + group_columns - 1) / group_columns * group_columns,
                                               (rows + group_rows - 1) / group_rows * group_rows};
    enqueue(queue, 2, global.data(), local.data());
}

void ClKernel::enqueue(cl_command_queue queue, cl_uint dimensions, const std::size_t* global,
                       const std::size_t* local) const {
    const auto launch = [&](cl_event* event) {
        return clEnqueueNDRangeKernel(queue, kernel_.get(), dimensions, nullptr, global, local, 0, nullptr,
                                      event);
    };
    ClBehindFrames* const behind_frames = ClBehindFrames::of_this_thread();
    const cl_int code = behind_frames != nullptr ? behind_frames->launch(queue, launch) : launch(nullptr);
    if (code != CL_SUCCESS) throw ClError("clEnqueueNDRangeKernel(" + name_ + ")", code);
}

void ClBuffer::reserve(cl_context context, cl_command_queue queue, std::size_t bytes, std::string_view what,
                       bool zeroed) {
    if (bytes <= bytes_) return;
    memory_.reset();
    bytes_ = 0;
    cl_int code = CL_SUCCESS;
    memory_.reset(clCreateBuffer(context, CL_MEM_READ_WRITE, bytes, nullptr, &code));
    if (code != CL_SUCCESS)
        throw ClError("clCreateBuffer(" + std::string(what) + ", " + std::to_string(bytes) + " bytes)", code);
    if (zeroed) {
        const cl_float zero = 0;
        check_cl(clEnqueueFillBuffer(queue, memory_.get(), &zero, sizeof(zero), 0,
                                     bytes / sizeof(zero) * sizeof(zero), 0, nullptr, nullptr),
                 "clEnqueueFillBuffer");
    }
    bytes_ = bytes;
}

void ClBuffer::write(cl_command_queue queue, std::size_t bytes, const void* data) {
    if (bytes == 0) return;
    check_cl(clEnqueueWriteBuffer(queue, memory_.get(), CL_FALSE, 0, bytes, data, 0, nullptr, nullptr),
             "clEnqueueWriteBuffer");
}

ClDevice::ClDevice() {
    const SignalGuard guard;
    shared_ = ClShared::acquire();
    open();
}

ClDevice::ClDevice(std::shared_ptr<ClShared> shared) : shared_(std::move(shared)) {
    open();
}

void ClDevice::open() {
    name_ = device_text(id(), CL_DEVICE_NAME);
    check_cl(clGetDeviceInfo(id(), CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof(max_group_size_), &max_group_size_,
                             nullptr),
             "clGetDeviceInfo");
    cl_int code = CL_SUCCESS;
    queue_.reset(clCreateCommandQueue(context(), id(), 0, &code));
    check_cl(code, "clCreateCommandQueue");
}

void ClDevice::finish() const {
    check_cl(clFinish(queue_.get()), "clFinish");
}

}  // namespace seaglare::glare
