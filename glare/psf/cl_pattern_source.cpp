#include <cmath>
#include <memory>
#include <utility>

#include "glare/device/cl_device.h"
#include "glare/device/cl_signal_guard.h"
#include "glare/psf/cl_eye_stage.h"
#include "glare/psf/cl_screen_stage.h"
#include "glare/psf/pattern_cache.h"
#include "glare/psf/pattern_sources.h"
#include "glare/psf/two_scale.h"
#include "glare/psf/veiled_pattern.h"

namespace seaglare::glare {

namespace {

class ClPatternSource final : public PatternSource {
  public:
    ClPatternSource(const EyeModel& eye, const PatternSettings& settings, std::uint64_t seed,
                    LampSamples samples)
        : eye_(eye),
          seed_(seed),
          settings_(settings),
          eye_stage_(device_, eye, settings, seed),
          screen_stage_(device_, settings, std::move(samples)) {
        screen_stage_.calibrate(eye.cie_calibrated);
        if (settings.wide_field_size == 0) return;
        wide_field_ = std::make_unique<WideField>(device_, eye, settings, seed);
        eye_stage_.fade(wide_field_->join().inner, wide_field_->join().outer);
    }

    const Pattern& make(const PatternRequest& request) override {
        PatternCache::Entry& entry = cache_.find(settings_, request.pitch);
        make(request, entry, entry.pattern);
        return entry.pattern;
    }
    void make_into(const PatternRequest& request, Pattern& pattern) override {
        make(request, cache_.find(settings_, request.pitch), pattern);
    }
    void prepare(const LampList& lamps) override { screen_stage_.follow(lamps); }

    void warm_up(double pitch, double pupil_mm) override {
        const SignalGuard guard;
        const PatternGrid grid = plan_grid(settings_, pitch);
        float largest = 0;
        for (float radius : settings_.layer_radii_px)
            largest = std::max(largest, radius);
        screen_stage_.reserve(grid, plan_layers(settings_, grid, largest).size());
        PatternRequest request;
        request.pupil_mm = pupil_mm;
        request.pitch = pitch;
        request.largest_disc_nodes = largest;
        Pattern pattern;
        make_into(request, pattern);
    }

    DeviceMemory device_memory() const override {
        DeviceMemory memory;
        memory.pattern_core = static_cast<double>(eye_stage_.device_bytes());
        memory.pattern_wide_field = wide_field_ ? static_cast<double>(wide_field_->device_bytes()) : 0;
        memory.pattern_screen = static_cast<double>(screen_stage_.device_bytes());
        return memory;
    }
    std::string device_name() const override { return device_.name(); }

  private:
    void make(const PatternRequest& request, const PatternCache::Entry& entry, Pattern& pattern) {
        PatternRequest wanted = request;
        wanted.pupil_mm = drawable_pupil_mm(request.pupil_mm, settings_.plane_width_mm);
        if (!std::isfinite(wanted.time_s)) wanted.time_s = 0;
        pattern.generation = 0;  // what follows may throw half way
        const EyeInstant instant =
            eye_instant(eye_, wanted.pupil_mm, wanted.time_s, wanted.lids, wanted.vitreous_roll_rad, seed_);
        double structure = describe_pattern(eye_, settings_, entry.grid, wanted, pattern);
        structure *= describe_veil(eye_, wanted.pupil_mm, eye_stage_.transmitted(instant), pattern);
        screen_stage_.follow(lamp_list_of(wanted));
        int launches = eye_stage_.update(instant);
        if (wide_field_) {
            const bool follows = !wide_field_->moves() || !(wanted.resting_pupil_mm > 0);
            const double pupil = follows ? wanted.pupil_mm : wanted.resting_pupil_mm;
            launches += wide_field_->advance(wanted.time_s, pupil, wanted.pitch);
        }
        launches += screen_stage_.make(eye_stage_, wide_field_.get(), entry.grid, structure, pattern);
        pattern.kernel_launches = launches;
        pattern.generation = new_generation();
    }

    EyeModel eye_;
    std::uint64_t seed_;
    PatternSettings settings_;
    ClDevice device_;
    ClEyeStage eye_stage_;
    std::unique_ptr<WideField> wide_field_;
    ClScreenStage screen_stage_;
    PatternCache cache_;
};

}  // namespace

std::unique_ptr<PatternSource> make_cl_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                      std::uint64_t seed, LampSamples samples) {
    validate(settings);
    // Drivers may touch signal handlers at any point of this, not only where PoCL 3.1 does.
    const SignalGuard guard;
    return std::make_unique<ClPatternSource>(eye, settings, seed, std::move(samples));
}

std::unique_ptr<PatternSource> make_cl_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                      std::uint64_t seed) {
    return make_cl_pattern_source(eye, settings, seed, sample_lamps(settings.wavelengths));
}

}  // namespace seaglare::glare
