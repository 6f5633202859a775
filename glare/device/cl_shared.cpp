#include "glare/device/cl_shared.h"

#include <CL/cl_gl.h>

#include <array>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include "glare/device/cl_device.h"
#include "shaders/embedded.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t smallest_group_size = 64;

template <typename Value>
Value device_value(cl_device_id device, cl_device_info what) {
    Value value{};
    check_cl(clGetDeviceInfo(device, what, sizeof(value), &value, nullptr), "clGetDeviceInfo");
    return value;
}

bool usable(cl_device_id device) {
    return device_value<cl_bool>(device, CL_DEVICE_AVAILABLE) == CL_TRUE &&
           device_value<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE) == CL_TRUE &&
           device_value<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE) >= smallest_group_size;
}

// Null when the platform has none of this type.
cl_device_id first_usable(cl_platform_id platform, cl_device_type type) {
    cl_uint count = 0;
    const cl_int code = clGetDeviceIDs(platform, type, 0, nullptr, &count);
    if (code == CL_DEVICE_NOT_FOUND || count == 0) return nullptr;
    check_cl(code, "clGetDeviceIDs");
    std::vector<cl_device_id> devices(count);
    check_cl(clGetDeviceIDs(platform, type, count, devices.data(), nullptr), "clGetDeviceIDs");
    for (cl_device_id device : devices)
        if (usable(device)) return device;
    return nullptr;
}

// What a file defines for itself is not there for the file after it.
void append_file(std::string& text, std::string_view name) {
    const std::string_view source = shaders::source(name);
    text += source;
    constexpr std::string_view directive = "#define ";
    for (std::size_t at = source.find(directive); at != std::string_view::npos;
         at = source.find(directive, at + 1)) {
        if (at > 0 && source[at - 1] != '\n') continue;
        const std::size_t begin = at + directive.size();
        const std::size_t end = source.find_first_of(" (\n", begin);
        text += "#undef " + std::string(source.substr(begin, end - begin)) + "\n";
    }
}

std::string text_of(KernelSet set, bool all) {
    // Of the common file everything stays.
    std::string text(shaders::source("transpose.cl"));
    const auto append = [&](std::initializer_list<std::string_view> names) {
        for (const std::string_view name : names)
            append_file(text, name);
    };
    if (all || set == KernelSet::pattern)
        append({"aperture.cl", "energy_table.cl", "two_scale.cl", "spread.cl", "pattern.cl"});
    if (all || set == KernelSet::strips) append({"fft_strips.cl"});
    if (all) append({"wide_strips.cl"});  // of both sets
    if (all || set == KernelSet::gather) {
        text += "#define ROWS " + std::to_string(all ? gather_rows_on_cpu : gather_rows) + "\n";
        append({"gather.cl"});
    }
    return text;
}

std::string extensions_of(cl_device_id device) {
    std::size_t size = 0;
    check_cl(clGetDeviceInfo(device, CL_DEVICE_EXTENSIONS, 0, nullptr, &size), "clGetDeviceInfo");
    std::string text(size, '\0');
    check_cl(clGetDeviceInfo(device, CL_DEVICE_EXTENSIONS, size, text.data(), nullptr), "clGetDeviceInfo");
    while (!text.empty() && text.back() == '\0')
        text.pop_back();
    return text;
}

std::array<cl_context_properties, 7> properties_of(cl_platform_id platform, const GlContext& gl) {
    const bool egl = gl.binding == GlBinding::egl;
    return {CL_GL_CONTEXT_KHR,
            reinterpret_cast<cl_context_properties>(gl.context),
            egl ? CL_EGL_DISPLAY_KHR : CL_GLX_DISPLAY_KHR,
            reinterpret_cast<cl_context_properties>(gl.display),
            CL_CONTEXT_PLATFORM,
            reinterpret_cast<cl_context_properties>(platform),
            0};
}

// Null where the driver does not say.
cl_device_id device_of(cl_platform_id platform, const GlContext& gl) {
    void* const address = clGetExtensionFunctionAddressForPlatform(platform, "clGetGLContextInfoKHR");
    if (address == nullptr) return nullptr;
    const auto get_info = reinterpret_cast<clGetGLContextInfoKHR_fn>(address);
    const auto properties = properties_of(platform, gl);
    std::array<cl_device_id, 1> device{};
    constexpr std::size_t device_bytes = sizeof(device);
    std::size_t size = 0;
    const cl_int code =
        get_info(properties.data(), CL_CURRENT_DEVICE_FOR_GL_CONTEXT_KHR, device_bytes, device.data(), &size);
    return code == CL_SUCCESS && size == device_bytes ? device[0] : nullptr;
}

}  // namespace

std::shared_ptr<ClShared> ClShared::acquire(const GlContext& gl, SharingDecision& decision) {
    static std::mutex mutex;
    static std::vector<std::weak_ptr<ClShared>> living;
    std::shared_ptr<ClShared> plain = acquire();
    const std::string extensions = extensions_of(plain->device());
    SharingFacts facts = {extensions, gl.binding, true};
    decision = decide_sharing(facts);
    if (!decision.shares) return plain;  // nothing is asked of a driver that does not have it
    facts.same_device = device_of(plain->platform(), gl) == plain->device();
    decision = decide_sharing(facts);
    if (!decision.shares) return plain;
    const std::lock_guard lock(mutex);
    std::erase_if(living, [](const auto& other) { return other.expired(); });
    for (const auto& other : living)
        if (std::shared_ptr<ClShared> shared = other.lock(); shared && shared->gl_ == gl) return shared;
    try {
        std::shared_ptr<ClShared> shared(new ClShared(*plain, gl));  // its constructor is for nobody else
        living.push_back(shared);
        return shared;
    } catch (const ClError& error) {
        decision = {false, error.what()};
        return plain;
    }
}

std::shared_ptr<ClShared> ClShared::acquire() {
    static std::mutex mutex;
    static std::weak_ptr<ClShared> living;
    const std::lock_guard lock(mutex);
    std::shared_ptr<ClShared> shared = living.lock();
    if (!shared) {
        shared.reset(new ClShared);  // its constructor is for nobody else
        living = shared;
    }
    return shared;
}

ClShared::ClShared() {
    cl_uint count = 0;
    const cl_int found = clGetPlatformIDs(0, nullptr, &count);
    if (found != CL_SUCCESS || count == 0)
        throw std::runtime_error("OpenCL: no platform is installed (clGetPlatformIDs: " +
                                 cl_code_name(found) + "); an ICD such as pocl-opencl-icd provides one");
    std::vector<cl_platform_id> platforms(count);
    check_cl(clGetPlatformIDs(count, platforms.data(), nullptr), "clGetPlatformIDs");
    for (cl_device_type type :
         {static_cast<cl_device_type>(CL_DEVICE_TYPE_GPU), static_cast<cl_device_type>(CL_DEVICE_TYPE_ALL)}) {
        for (cl_platform_id platform : platforms) {
            if (device_ != nullptr) break;
            device_ = first_usable(platform, type);
            platform_ = platform;
        }
    }
    if (device_ == nullptr)
        throw std::runtime_error("OpenCL: no device with a compiler and groups of 64 work-items");
    is_cpu_ = (device_value<cl_device_type>(device_, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) != 0;
    cl_int code = CL_SUCCESS;
    const std::array<cl_context_properties, 3> properties = {
        CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(platform_), 0};
    context_.reset(clCreateContext(properties.data(), 1, &device_, nullptr, nullptr, &code));
    check_cl(code, "clCreateContext");
}

ClShared::ClShared(const ClShared& plain, const GlContext& gl)
    : platform_(plain.platform_), device_(plain.device_), is_cpu_(plain.is_cpu_), gl_(gl) {
    cl_int code = CL_SUCCESS;
    const auto properties = properties_of(platform_, gl);
    context_.reset(clCreateContext(properties.data(), 1, &device_, nullptr, nullptr, &code));
    check_cl(code, "clCreateContext(shared with GL)");
}

ClOwned<cl_program> ClShared::build_text(std::string_view what, const std::string& text,
                                         std::string_view options) const {
    const char* begin = text.data();
    const std::size_t size = text.size();
    cl_int code = CL_SUCCESS;
    ClOwned<cl_program> program(clCreateProgramWithSource(context_.get(), 1, &begin, &size, &code));
    check_cl(code, "clCreateProgramWithSource(" + std::string(what) + ")");
    const std::string all_options = "-cl-std=CL1.2 " + std::string(options);
    code = clBuildProgram(program.get(), 1, &device_, all_options.c_str(), nullptr, nullptr);
    if (code == CL_SUCCESS) return program;
    std::size_t log_size = 0;
    clGetProgramBuildInfo(program.get(), device_, CL_PROGRAM_BUILD_LOG, 0, nullptr, &log_size);
    std::string log(log_size, '\0');
    clGetProgramBuildInfo(program.get(), device_, CL_PROGRAM_BUILD_LOG, log_size, log.data(), nullptr);
    throw std::runtime_error("OpenCL: clBuildProgram(" + std::string(what) + ") failed with " +
                             cl_code_name(code) + ":\n" + log);
}

cl_program ClShared::program(KernelSet set) {
    const std::size_t at = is_cpu_ ? 0 : static_cast<std::size_t>(set);
    const std::lock_guard lock(mutex_);
    if (!programs_[at]) programs_[at] = build_text("kernels", text_of(set, is_cpu_), {});
    return programs_[at].get();
}

ClOwned<cl_program> ClShared::build(std::string_view name, std::string_view options) const {
    return build_text(name, std::string(shaders::source(name)), options);
}

}  // namespace seaglare::glare
