#include "tests/gl/measured_devices.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#define GL_GLEXT_PROTOTYPES  // for the functions' types only
#include <GL/glcorearb.h>

#include "host_stub/headless.h"

// Functions that the library is to find in this program.
#define SEAGLARE_EXPORTED __attribute__((visibility("default")))

// A sanitizer has its own malloc.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
#define SEAGLARE_COUNTS_MALLOC
extern "C" {
void* __libc_malloc(std::size_t size);  // NOLINT(bugprone-reserved-identifier): glibc's name
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
}
#endif

namespace seaglare::test {

namespace {

std::atomic<std::uint64_t> heap_allocations{0};
std::atomic<std::uint64_t> heap_bytes{0};
std::atomic<int> heap_traces{0};
thread_local std::uint64_t thread_allocations = 0;
thread_local std::uint64_t thread_cl_makings = 0;
// Where the code of the library lies whose calls of malloc count.
std::atomic<std::uintptr_t> watched_begin{0};
std::atomic<std::uintptr_t> watched_end{0};

void count_allocation(std::size_t size) {
    heap_allocations.fetch_add(1, std::memory_order_relaxed);
    heap_bytes.fetch_add(size, std::memory_order_relaxed);
    ++thread_allocations;
    if (heap_traces.load(std::memory_order_relaxed) > 0 && heap_traces.fetch_sub(1) > 0) {
        void* frames[24];
        backtrace_symbols_fd(frames, backtrace(frames, 24), 2);
    }
}

#ifdef SEAGLARE_COUNTS_MALLOC
void count_call(const void* caller, std::size_t size) {
    const auto at = reinterpret_cast<std::uintptr_t>(caller);
    if (at >= watched_begin.load(std::memory_order_relaxed) &&
        at < watched_end.load(std::memory_order_relaxed))
        count_allocation(size);
}
#endif

void* allocate(std::size_t size, std::size_t alignment) {
    count_allocation(size);
    void* const memory = alignment > alignof(std::max_align_t)
                             ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                             : std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

// A function of the GL that the host has.
template <typename Function>
Function real(const char* name) {
    return reinterpret_cast<Function>(host::HeadlessContext::get_proc(nullptr, name));
}

struct GlLedger {
    GLenum unit = GL_TEXTURE0;
    std::map<std::pair<GLenum, GLenum>, GLuint> textures;  // by unit and target
    std::map<GLenum, GLuint> buffers;                      // by target
    std::map<GLuint, double> texture_bytes;
    std::map<GLuint, double> buffer_bytes;
    std::uint64_t makings = 0;
    const char* last = "";
    void made(const char* what) {
        ++makings;
        last = what;
    }
};
GlLedger& gl() {
    static GlLedger ledger;
    return ledger;
}

double bytes_per_texel(GLint format) {
    switch (format) {
        case GL_R8:
            return 1;
        case GL_R16F:
            return 2;
        case GL_R32F:
        case GL_RGBA8:
        case GL_SRGB8_ALPHA8:
        case GL_RGB10_A2:
        case GL_DEPTH24_STENCIL8:
        case GL_DEPTH_COMPONENT24:
        case GL_DEPTH_COMPONENT32:
        case GL_DEPTH_COMPONENT32F:
            return 4;
        case GL_RG32F:
        case GL_RGBA16:
        case GL_RGBA16F:
        case GL_DEPTH32F_STENCIL8:
            return 8;
        case GL_RGBA32F:
            return 16;
        default:
            throw std::logic_error("a texture format that the ledger does not know: " +
                                   std::to_string(format));
    }
}

double& bound_texture_bytes(GLenum target) {
    return gl().texture_bytes[gl().textures[{gl().unit, target}]];
}

void active_texture(GLenum unit) {
    gl().unit = unit;
    real<decltype(&glActiveTexture)>("glActiveTexture")(unit);
}
void bind_texture(GLenum target, GLuint name) {
    gl().textures[{gl().unit, target}] = name;
    real<decltype(&glBindTexture)>("glBindTexture")(target, name);
}
void bind_buffer(GLenum target, GLuint name) {
    gl().buffers[target] = name;
    real<decltype(&glBindBuffer)>("glBindBuffer")(target, name);
}
void tex_image_2d(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLint border,
                  GLenum pixel_format, GLenum type, const void* pixels) {
    bound_texture_bytes(target) = bytes_per_texel(format) * width * height;
    gl().made("glTexImage2D");
    real<decltype(&glTexImage2D)>("glTexImage2D")(target, level, format, width, height, border, pixel_format,
                                                  type, pixels);
}
void tex_image_3d(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height, GLsizei depth,
                  GLint border, GLenum pixel_format, GLenum type, const void* pixels) {
    bound_texture_bytes(target) = bytes_per_texel(format) * width * height * depth;
    gl().made("glTexImage3D");
    real<decltype(&glTexImage3D)>("glTexImage3D")(target, level, format, width, height, depth, border,
                                                  pixel_format, type, pixels);
}
void buffer_data(GLenum target, GLsizeiptr size, const void* data, GLenum usage) {
    double& bytes = gl().buffer_bytes[gl().buffers[target]];
    if (static_cast<double>(size) > bytes) gl().made("glBufferData");
    bytes = static_cast<double>(size);
    real<decltype(&glBufferData)>("glBufferData")(target, size, data, usage);
}
void delete_textures(GLsizei count, const GLuint* names) {
    for (GLsizei i = 0; i < count; ++i)
        gl().texture_bytes.erase(names[i]);
    real<decltype(&glDeleteTextures)>("glDeleteTextures")(count, names);
}
void delete_buffers(GLsizei count, const GLuint* names) {
    for (GLsizei i = 0; i < count; ++i)
        gl().buffer_bytes.erase(names[i]);
    real<decltype(&glDeleteBuffers)>("glDeleteBuffers")(count, names);
}
void compile_shader(GLuint shader) {
    gl().made("glCompileShader");
    real<decltype(&glCompileShader)>("glCompileShader")(shader);
}
void link_program(GLuint program) {
    gl().made("glLinkProgram");
    real<decltype(&glLinkProgram)>("glLinkProgram")(program);
}
void gen_textures(GLsizei count, GLuint* names) {
    gl().made("glGenTextures");
    real<decltype(&glGenTextures)>("glGenTextures")(count, names);
}
void gen_buffers(GLsizei count, GLuint* names) {
    gl().made("glGenBuffers");
    real<decltype(&glGenBuffers)>("glGenBuffers")(count, names);
}
void gen_framebuffers(GLsizei count, GLuint* names) {
    gl().made("glGenFramebuffers");
    real<decltype(&glGenFramebuffers)>("glGenFramebuffers")(count, names);
}
void gen_queries(GLsizei count, GLuint* names) {
    gl().made("glGenQueries");
    real<decltype(&glGenQueries)>("glGenQueries")(count, names);
}

struct ClLedger {
    std::mutex mutex;
    std::map<cl_mem, double> bytes;
    std::uint64_t makings = 0;
    std::uint64_t launches = 0;
    const char* last = "";
};
ClLedger& cl() {
    static ClLedger ledger;
    return ledger;
}
void cl_made(const char* what) {
    const std::lock_guard lock(cl().mutex);
    ++cl().makings;
    cl().last = what;
    ++thread_cl_makings;
}
template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

void* MeasuredGl::get_proc(void* user, const char* name) {
    static const std::map<std::string, void*> measured = {
        {"glActiveTexture", reinterpret_cast<void*>(&active_texture)},
        {"glBindTexture", reinterpret_cast<void*>(&bind_texture)},
        {"glBindBuffer", reinterpret_cast<void*>(&bind_buffer)},
        {"glTexImage2D", reinterpret_cast<void*>(&tex_image_2d)},
        {"glTexImage3D", reinterpret_cast<void*>(&tex_image_3d)},
        {"glBufferData", reinterpret_cast<void*>(&buffer_data)},
        {"glDeleteTextures", reinterpret_cast<void*>(&delete_textures)},
        {"glDeleteBuffers", reinterpret_cast<void*>(&delete_buffers)},
        {"glCompileShader", reinterpret_cast<void*>(&compile_shader)},
        {"glLinkProgram", reinterpret_cast<void*>(&link_program)},
        {"glGenTextures", reinterpret_cast<void*>(&gen_textures)},
        {"glGenBuffers", reinterpret_cast<void*>(&gen_buffers)},
        {"glGenFramebuffers", reinterpret_cast<void*>(&gen_framebuffers)},
        {"glGenQueries", reinterpret_cast<void*>(&gen_queries)},
    };
    const auto found = measured.find(name);
    return found != measured.end() ? found->second : host::HeadlessContext::get_proc(user, name);
}

double MeasuredGl::bytes() {
    double sum = 0;
    for (const auto& [name, bytes] : gl().texture_bytes)
        sum += bytes;
    for (const auto& [name, bytes] : gl().buffer_bytes)
        sum += bytes;
    return sum;
}
std::uint64_t MeasuredGl::makings() {
    return gl().makings;
}
const char* MeasuredGl::last_making() {
    return gl().last;
}
void MeasuredGl::reset() {
    gl().makings = 0;
    gl().last = "";
}

double MeasuredCl::bytes() {
    const std::lock_guard lock(cl().mutex);
    double sum = 0;
    for (const auto& [name, bytes] : cl().bytes)
        sum += bytes;
    return sum;
}
std::uint64_t MeasuredCl::makings() {
    const std::lock_guard lock(cl().mutex);
    return cl().makings;
}
std::uint64_t MeasuredCl::makings_of_this_thread() {
    return thread_cl_makings;
}
std::uint64_t MeasuredCl::launches() {
    const std::lock_guard lock(cl().mutex);
    return cl().launches;
}
const char* MeasuredCl::last_making() {
    const std::lock_guard lock(cl().mutex);
    return cl().last;
}
void MeasuredCl::reset() {
    const std::lock_guard lock(cl().mutex);
    cl().makings = 0;
    cl().launches = 0;
    cl().last = "";
    thread_cl_makings = 0;
}

std::uint64_t CountedHeap::allocations() {
    return heap_allocations.load();
}
std::uint64_t CountedHeap::allocations_of_this_thread() {
    return thread_allocations;
}
std::uint64_t CountedHeap::bytes() {
    return heap_bytes.load();
}
void CountedHeap::reset() {
    heap_allocations = 0;
    heap_bytes = 0;
    thread_allocations = 0;
}
void CountedHeap::trace_next(int count) {
    heap_traces = count;
}

#ifdef SEAGLARE_COUNTS_MALLOC
bool CountedHeap::watch(const char* library) {
    const auto look = [](dl_phdr_info* info, std::size_t /*size*/, void* wanted) {
        if (std::strstr(info->dlpi_name, static_cast<const char*>(wanted)) == nullptr) return 0;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
            const auto& part = info->dlpi_phdr[i];
            if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
            watched_begin = info->dlpi_addr + part.p_vaddr;
            watched_end = info->dlpi_addr + part.p_vaddr + part.p_memsz;
        }
        return 1;
    };
    std::string name(library);
    return dl_iterate_phdr(look, name.data()) == 1;
}
#else
bool CountedHeap::watch(const char* /*library*/) {
    return false;
}
#endif

}  // namespace seaglare::test

using seaglare::test::cl_made;

extern "C" {

SEAGLARE_EXPORTED cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host,
                                        cl_int* code) {
    static const auto create = seaglare::test::next<decltype(&clCreateBuffer)>("clCreateBuffer");
    const cl_mem memory = create(context, flags, size, host, code);
    cl_made("clCreateBuffer");
    const std::lock_guard lock(seaglare::test::cl().mutex);
    if (memory != nullptr) seaglare::test::cl().bytes[memory] = static_cast<double>(size);
    return memory;
}

SEAGLARE_EXPORTED cl_int clReleaseMemObject(cl_mem memory) {
    static const auto release = seaglare::test::next<decltype(&clReleaseMemObject)>("clReleaseMemObject");
    cl_uint count = 0;
    clGetMemObjectInfo(memory, CL_MEM_REFERENCE_COUNT, sizeof count, &count, nullptr);
    if (count == 1) {
        const std::lock_guard lock(seaglare::test::cl().mutex);
        seaglare::test::cl().bytes.erase(memory);
    }
    return release(memory);
}

SEAGLARE_EXPORTED cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                                                const size_t* offset, const size_t* global,
                                                const size_t* local, cl_uint wait_count,
                                                const cl_event* waits, cl_event* event) {
    static const auto launch =
        seaglare::test::next<decltype(&clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
    {
        const std::lock_guard lock(seaglare::test::cl().mutex);
        ++seaglare::test::cl().launches;
    }
    return launch(queue, kernel, dimensions, offset, global, local, wait_count, waits, event);
}

SEAGLARE_EXPORTED cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices,
                                        const char* options, void (*done)(cl_program, void*), void* user) {
    static const auto build = seaglare::test::next<decltype(&clBuildProgram)>("clBuildProgram");
    cl_made("clBuildProgram");
    return build(program, count, devices, options, done, user);
}

SEAGLARE_EXPORTED cl_kernel clCreateKernel(cl_program program, const char* name, cl_int* code) {
    static const auto create = seaglare::test::next<decltype(&clCreateKernel)>("clCreateKernel");
    cl_made("clCreateKernel");
    return create(program, name, code);
}

SEAGLARE_EXPORTED cl_context clCreateContext(const cl_context_properties* properties, cl_uint count,
                                             const cl_device_id* devices,
                                             void (*notify)(const char*, const void*, size_t, void*),
                                             void* user, cl_int* code) {
    static const auto create = seaglare::test::next<decltype(&clCreateContext)>("clCreateContext");
    cl_made("clCreateContext");
    return create(properties, count, devices, notify, user, code);
}

SEAGLARE_EXPORTED cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device,
                                                        cl_command_queue_properties properties,
                                                        cl_int* code) {
    static const auto create = seaglare::test::next<decltype(&clCreateCommandQueue)>("clCreateCommandQueue");
    cl_made("clCreateCommandQueue");
    return create(context, device, properties, code);
}

}  // extern "C"

#ifdef SEAGLARE_COUNTS_MALLOC
extern "C" {
SEAGLARE_EXPORTED void* malloc(std::size_t size) {
    seaglare::test::count_call(__builtin_return_address(0), size);
    return __libc_malloc(size);
}
SEAGLARE_EXPORTED void* calloc(std::size_t count, std::size_t size) {
    seaglare::test::count_call(__builtin_return_address(0), count * size);
    return __libc_calloc(count, size);
}
SEAGLARE_EXPORTED void* realloc(void* memory, std::size_t size) {
    seaglare::test::count_call(__builtin_return_address(0), size);
    return __libc_realloc(memory, size);
}
SEAGLARE_EXPORTED void* aligned_alloc(std::size_t alignment, std::size_t size) {
    seaglare::test::count_call(__builtin_return_address(0), size);
    return __libc_memalign(alignment, size);
}
}
#endif

SEAGLARE_EXPORTED void* operator new(std::size_t size) {
    return seaglare::test::allocate(size, 0);
}
SEAGLARE_EXPORTED void* operator new[](std::size_t size) {
    return seaglare::test::allocate(size, 0);
}
SEAGLARE_EXPORTED void* operator new(std::size_t size, std::align_val_t alignment) {
    return seaglare::test::allocate(size, static_cast<std::size_t>(alignment));
}
SEAGLARE_EXPORTED void* operator new[](std::size_t size, std::align_val_t alignment) {
    return seaglare::test::allocate(size, static_cast<std::size_t>(alignment));
}
// Without these the library's own would serve, and what they gave be freed by ours.
SEAGLARE_EXPORTED void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
    try {
        return seaglare::test::allocate(size, 0);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
SEAGLARE_EXPORTED void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
    return operator new(size, tag);
}
SEAGLARE_EXPORTED void operator delete(void* memory) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete[](void* memory) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
SEAGLARE_EXPORTED void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
