// The patterns that a source has made, one per pitch. Shared by the sources.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "glare/psf/pattern.h"
#include "glare/psf/pattern_grid.h"

namespace seaglare::glare {

class PatternCache {
  public:
    static constexpr std::size_t capacity = 16;  // pitches; the one not asked for longest makes room

    struct Entry {
        PatternGrid grid;
        Pattern pattern;
        double time_s = 0;
        double lid_closure = 0;
        bool made = false;
        std::uint32_t lamps = 0;      // made so far
        std::uint64_t lamp_list = 0;  // the version they are of
        std::uint64_t used = 0;
    };
    // The entry of this pitch, new (made == false) when there is none. Throws as plan_grid does.
    Entry& find(const PatternSettings& settings, double pitch);

  private:
    std::vector<std::unique_ptr<Entry>> entries_;
    std::uint64_t clock_ = 0;
};

// Fills in everything that a pattern says of itself before its nodes are known, and returns the energy of core + skirt.
double describe_pattern(const EyeModel& eye, const PatternSettings& settings, const PatternGrid& grid,
                        const PatternRequest& request, Pattern& pattern);

// The list a request means.
inline const LampList& lamp_list_of(const PatternRequest& request) {
    return request.lamp_list != nullptr ? *request.lamp_list : navigation_lamps();
}

// The wavelengths of the lamps of a list, kept from request to request. With samples of the caller's own, navigation
// lamps keep those.
class LampWavelengths {
  public:
    LampWavelengths(LampSamples navigation, int count) : samples_(std::move(navigation)), count_(count) {}

    const std::vector<SpectralSample>& operator[](std::size_t lamp) const { return samples_[lamp]; }
    // Takes up what has changed since the last call, and tells `changed` each lamp whose samples are new.
    template <class Changed>
    void follow(const LampList& list, const Changed& changed) {
        if (list.version == version_) return;
        for (std::size_t lamp = lamp_count; lamp < most_lamps; ++lamp) {
            if (list.spectra[lamp] == spectra_[lamp]) continue;
            const auto& spectrum = list.spectra[lamp];
            samples_[lamp].clear();
            if (spectrum)
                samples_[lamp] = sample_spectrum([&](double l) { return spectrum->power(l); }, count_);
            spectra_[lamp] = spectrum;
            changed(lamp);
        }
        version_ = list.version;
    }

  private:
    LampSamples samples_;
    std::array<std::shared_ptr<const LampSpectrum>, most_lamps> spectra_{};
    std::uint64_t version_ = 0;
    int count_;
};

// A generation that no pattern has had yet. Patterns of two sources would look the same to a view otherwise, when a new
// configuration, or the loss of OpenCL, puts one in the place of the other. Any thread.
std::uint64_t new_generation();

// A pupil that can be drawn: finite, at least a tenth of a millimetre, inside the plane.
double drawable_pupil_mm(double pupil_mm, double plane_width_mm);

// Throws std::invalid_argument naming what is wrong: a transform size that is not a power of two from 256 to 4096, a
// plane or a scale that is not positive, no wavelengths, more than most_layers.
void validate(const PatternSettings& settings);

}  // namespace seaglare::glare
