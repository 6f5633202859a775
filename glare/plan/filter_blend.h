// Between a pattern for each lamp and one for all: what a time budget fades through.
#pragma once

#include <cstdint>

#include "glare/psf/pattern.h"

namespace seaglare::glare {

// out: the pattern with every lamp's core and skirt mixed with those of the first lamp, of which `blend` (0 ... 1) is taken.
// Energies of all are alike, so none is lost. Its memory is used again; its generation is new.
void blend_towards_first_lamp(const Pattern& pattern, double blend, Pattern& out);

// The same for frame after frame: mixes only what is not mixed yet, and nothing where there is nothing to mix.
class BlendedPattern {
  public:
    // `pattern` itself, or a mixture that stays as it is until the next call.
    const Pattern& of(const Pattern& pattern, double blend);

  private:
    Pattern mixed_;
    std::uint64_t from_ = 0;  // generation of the pattern that was mixed; 0: none
    double blend_ = 0;
};

}  // namespace seaglare::glare
