// The glare pattern of a context: one eye, shared by every view. Works on OpenCL; without it, or when it fails later,
// on the CPU, and says so.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "glare/eye/eye_model.h"
#include "glare/psf/pattern.h"

namespace seaglare::plugin {

class PatternStore {
  public:
    // Compiles kernels where there is OpenCL. Never fails for want of a device.
    PatternStore(const glare::EyeModel& eye, const glare::PatternSettings& settings, std::uint64_t seed,
                 bool use_opencl);

    // Held while a pattern is made and as long as it is read: the next make() may overwrite it.
    [[nodiscard]] std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

    // The rest needs the lock.

    // The pattern for this instant; channels that ask for the same pitch and the same instant share one.
    const glare::Pattern& pattern(const glare::PatternRequest& request);
    // Samples the spectra of a list now instead of with the first pattern that has them.
    void prepare(const glare::LampList& lamps);
    // Pays once for what the first pattern of this pitch would.
    void warm_up(double pitch);
    // Every lamp is drawn as the white one.
    bool filters() const { return settings_.spectra == glare::SpectraMode::filter; }
    bool reused() const { return reused_; }  // the last pattern() made nothing
    bool degraded() const { return !reason_.empty(); }
    const std::string& reason() const { return reason_; }  // why there is no OpenCL; empty: there is
    std::uint32_t layers_configured() const {
        return static_cast<std::uint32_t>(settings_.layer_radii_px.size());
    }
    std::string device_name() const { return source_->device_name(); }
    double device_memory_bytes() const { return source_->device_memory_bytes(); }

  private:
    struct Made {
        glare::PatternRequest request;
        const glare::Pattern* pattern = nullptr;
        std::uint64_t generation = 0;
        std::uint64_t lamp_list = 0;  // the version of request.lamp_list, which may be gone
    };
    void fall_back(const std::string& reason);

    glare::EyeModel eye_;
    glare::PatternSettings settings_;
    std::uint64_t seed_;
    std::mutex mutex_;
    std::unique_ptr<glare::PatternSource> source_;
    std::string reason_;
    std::map<double, Made> made_;  // by pitch
    bool reused_ = false;
};

}  // namespace seaglare::plugin
