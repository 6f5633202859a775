// A pattern as the gather reads it (shaders/gather.cl): radial means, and the nodes and their departures from the mean in half
// precision, on the device. Made once per pattern, on whatever thread makes patterns, and then read by any number of views of
// the same OpenCL context.
#pragma once

#include <cstdint>
#include <vector>

#include "glare/apply/pattern_profile.h"
#include "glare/device/cl_device.h"
#include "glare/device/half.h"

namespace seaglare::glare {

struct GatherPattern {
    std::uint64_t generation = 0;  // of the pattern it was made from; 0: of none
    PatternProfile profile;
    ClBuffer tables;        // profile.tables()
    ClBuffer skirt;         // Pattern::skirt, in its order
    ClBuffer departures;    // PatternProfile::departures()
    float skirt_scale = 1;  // what a half is to be multiplied by
    float departures_scale = 1;
    std::size_t bytes() const { return tables.bytes() + skirt.bytes() + departures.bytes(); }
};

// Makes them, on one queue: one thread at a time.
class GatherPatternWriter {
  public:
    // Keeps `device`'s context and queue: it must outlive this.
    explicit GatherPatternWriter(const ClDevice& device) : device_(device) {}
    // Nothing to do where `to` is of this pattern already. On return the copies are there for every queue of the context.
    // Memory of `to` is used again. Throws ClError; `to` is then of no pattern.
    void write(const Pattern& pattern, GatherPattern& to);

  private:
    const ClDevice& device_;
    // On their way to the device.
    std::vector<float> departures_;
    std::vector<Half> skirt_halves_;
    std::vector<Half> departure_halves_;
};

}  // namespace seaglare::glare
