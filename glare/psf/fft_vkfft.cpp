// The one translation unit that sees VkFFT. It is planned with the C locale of this thread, because it prints numbers
// into kernels and reads some back.
#include <clocale>

// VkFFT 1.2.26 calls setlocale(LC_ALL, ...) while it plans, for the whole process: in a plug-in that is a race with the
// host. Inside its header the call changes nothing; CLocale below does what it was meant to do.
namespace seaglare::glare {
inline char* vkfft_setlocale(int /*category*/, const char* /*locale*/) {
    static char name[] = "C";
    return name;
}
}  // namespace seaglare::glare

#define VKFFT_BACKEND 3
#define CL_TARGET_OPENCL_VERSION 120
#include <locale.h>
#define setlocale(category, name) ::seaglare::glare::vkfft_setlocale(category, name)
#include <vkFFT.h>
#undef setlocale

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "glare/psf/fft.h"

namespace seaglare::glare {

namespace {

// The C locale on this thread only.
class CLocale {
  public:
    CLocale() : c_(newlocale(LC_ALL_MASK, "C", nullptr)) {
        if (c_ == nullptr) throw std::bad_alloc();
        before_ = uselocale(c_);
    }
    ~CLocale() {
        uselocale(before_);
        freelocale(c_);
    }
    CLocale(const CLocale&) = delete;
    CLocale& operator=(const CLocale&) = delete;

  private:
    locale_t c_;
    locale_t before_ = nullptr;
};

// Memory that a plan holds besides the data: its work space and its tables of roots.
std::size_t bytes_of(const VkFFTApplication& application) {
    const auto& configuration = application.configuration;
    std::uint64_t bytes = 0;
    if (configuration.allocateTempBuffer != 0 && configuration.tempBufferSize != nullptr)
        bytes += configuration.tempBufferSize[0];
    const VkFFTPlan* const plan = application.localFFTPlan;
    if (plan == nullptr) return static_cast<std::size_t>(bytes);
    for (std::uint64_t dimension = 0; dimension < configuration.FFTdim; ++dimension) {
        for (std::uint64_t upload = 0; upload < plan->numAxisUploads[dimension]; ++upload) {
            const VkFFTAxis& axis = plan->axes[dimension][upload];
            if (axis.bufferLUT != nullptr && axis.referenceLUT == 0) bytes += axis.bufferLUTSize;
        }
    }
    return static_cast<std::size_t>(bytes);
}

// A plan and what it points to.
struct Application {
    cl_device_id device = nullptr;
    cl_context context = nullptr;
    std::uint64_t buffer_bytes = 0;
    VkFFTApplication application = {};
    bool planned = false;
    std::string what;  // is transformed, for messages

    Application() = default;
    ~Application() {
        if (planned) deleteVkFFT(&application);
    }
    Application(const Application&) = delete;
    Application& operator=(const Application&) = delete;

    // The configuration has the transform's shape. Throws std::runtime_error.
    void plan(const ClDevice& on, std::uint64_t bytes, VkFFTConfiguration configuration, std::string name) {
        what = std::move(name);
        device = on.id();
        context = on.context();
        buffer_bytes = bytes;
        const CLocale locale;
        configuration.makeForwardPlanOnly = 1;
        configuration.device = &device;
        configuration.context = &context;
        configuration.bufferSize = &buffer_bytes;
        check(initializeVkFFT(&application, configuration), "initializeVkFFT");
        planned = true;
    }
    void forward(cl_command_queue queue, cl_mem data) {
        VkFFTLaunchParams parameters = {};
        parameters.commandQueue = &queue;
        parameters.buffer = &data;
        check(VkFFTAppend(&application, -1, &parameters), "VkFFTAppend");
    }

  private:
    void check(VkFFTResult result, const char* call) const {
        if (result != VKFFT_SUCCESS)
            throw std::runtime_error(std::string("VkFFT: ") + call + " for " + what + " failed with " +
                                     std::to_string(static_cast<int>(result)));
    }
};

}  // namespace

struct RealFft2d::Impl : Application {};

RealFft2d::RealFft2d(const ClDevice& device, int n) : impl_(std::make_unique<Impl>()) {
    VkFFTConfiguration configuration = {};
    configuration.FFTdim = 2;
    configuration.size[0] = static_cast<std::uint64_t>(n);
    configuration.size[1] = static_cast<std::uint64_t>(n);
    configuration.performR2C = 1;
    impl_->plan(device, bytes(n), configuration, std::to_string(n) + " x " + std::to_string(n));
}

RealFft2d::~RealFft2d() = default;

void RealFft2d::forward(cl_command_queue queue, cl_mem data) {
    impl_->forward(queue, data);
}

std::size_t RealFft2d::own_bytes() const {
    return bytes_of(impl_->application);
}

int RealFft2d::launches() const {
    const VkFFTPlan* const plan = impl_->application.localFFTPlan;
    if (plan == nullptr) return 0;
    int count = 0;
    for (int axis = 0; axis < 2; ++axis)
        count += static_cast<int>(plan->numAxisUploads[axis]);
    return count;
}

struct BatchFft::Impl : Application {};

BatchFft::BatchFft(const ClDevice& device, int n, int rows, Kind kind) : impl_(std::make_unique<Impl>()) {
    const auto samples = static_cast<std::uint64_t>(n);
    VkFFTConfiguration configuration = {};
    configuration.FFTdim = 1;
    configuration.size[0] = samples;
    configuration.numberBatches = static_cast<std::uint64_t>(rows);
    configuration.performR2C = kind == Kind::real ? 1 : 0;
    impl_->plan(
        device,
        static_cast<std::uint64_t>(rows) * sizeof(float) * (kind == Kind::real ? samples + 2 : 2 * samples),
        configuration, std::to_string(rows) + " rows of " + std::to_string(n));
}

BatchFft::~BatchFft() = default;

std::size_t BatchFft::own_bytes() const {
    return bytes_of(impl_->application);
}

void BatchFft::forward(cl_command_queue queue, cl_mem data) {
    impl_->forward(queue, data);
}

}  // namespace seaglare::glare
