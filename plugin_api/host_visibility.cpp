#include "plugin_api/host_visibility.h"

#include <cmath>

namespace seaglare::plugin {

namespace {

// An exponential never comes to its end: this near, no light is bright enough to tell.
constexpr float as_good_as_there = 1e-7F;

}  // namespace

void HostVisibility::smooth(double time_s, double smoothing_s, std::span<const glare::PointSource> lights,
                            std::span<float> visibility) {
    history_.begin(time_s, smoothing_s);
    if (!(smoothing_s > 0)) return;
    history_.match(lights, previous_);
    const auto blend = static_cast<float>(history_.blend());
    for (std::size_t i = 0; i < visibility.size(); ++i) {
        if (previous_[i] < 0) continue;
        const float was = before_[static_cast<std::size_t>(previous_[i])];
        const float is = was + blend * (visibility[i] - was);
        if (std::abs(is - visibility[i]) > as_good_as_there) visibility[i] = is;
    }
    before_.assign(visibility.begin(), visibility.end());
}

void HostVisibility::clear() {
    history_.clear();
}

}  // namespace seaglare::plugin
