// What the host's visibility callback says of each light, smoothed in time as what its depth hides is
// (glare/apply/visibility_history.h): a lamp that another channel sees go behind a headland fades in both alike. One view's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "glare/apply/visibility_history.h"
#include "glare/frame.h"

namespace seaglare::plugin {

class HostVisibility {
  public:
    // Replaces what the host has answered in this frame, 0 ... 1 for each light, by what is shown. Of a light that it was
    // not asked about in the frame before, after a jump in time and with smoothing_s 0 the answer counts at once. No
    // allocation in a steady frame.
    void smooth(double time_s, double smoothing_s, std::span<const glare::PointSource> lights,
                std::span<float> visibility);
    // A frame without the callback: what was said before says nothing any more.
    void clear();

  private:
    glare::VisibilityHistory history_;
    std::vector<std::int32_t> previous_;
    std::vector<float> before_;  // by place in the frame before
};

}  // namespace seaglare::plugin
