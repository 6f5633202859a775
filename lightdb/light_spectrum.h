// What lamp a light has: for each colour that it shows the spectrum that a file gives it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "glare/colour/lamp_spectrum.h"

namespace seaglare::lightdb {

using SharedLamp = std::shared_ptr<const glare::LampSpectrum>;

// How a file says it: a lamp, perhaps behind a coloured glass. A name (glare/colour/named_spectra.h) or the path of a file.
struct LampChoice {
    std::string source;  // empty: not said
    std::string filter;  // empty: no glass
    friend bool operator==(const LampChoice&, const LampChoice&) = default;
};

struct LightSpectrum {
    static constexpr std::size_t colours = 7;  // lightdb::colour_count

    // One lamp for the whole light, in choice[0], or each colour its own. Where one lamp serves a light of several colours,
    // all but white stand behind the glass of their colour.
    bool per_colour = false;
    std::array<LampChoice, colours> choice;
    std::array<SharedLamp, colours> lamp;  // null: the navigation colour's own
};

// Equal lamps, whatever they are called: a file elsewhere with the same numbers is the same lamp.
bool operator==(const LightSpectrum& a, const LightSpectrum& b);

// Shared by the lights of a file, compared by what it holds. False: the colours' own lamps.
class SharedLightSpectrum {
  public:
    SharedLightSpectrum() = default;
    SharedLightSpectrum(std::shared_ptr<const LightSpectrum> spectrum) : spectrum_(std::move(spectrum)) {}
    explicit operator bool() const { return spectrum_ != nullptr; }
    const LightSpectrum& operator*() const { return *spectrum_; }
    const LightSpectrum* operator->() const { return spectrum_.get(); }
    const LightSpectrum* get() const { return spectrum_.get(); }
    friend bool operator==(const SharedLightSpectrum& a, const SharedLightSpectrum& b) {
        return a.spectrum_ == b.spectrum_ || (a.spectrum_ && b.spectrum_ && *a.spectrum_ == *b.spectrum_);
    }

  private:
    std::shared_ptr<const LightSpectrum> spectrum_;
};

}  // namespace seaglare::lightdb
