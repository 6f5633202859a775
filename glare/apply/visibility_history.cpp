#include "glare/apply/visibility_history.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

bool is_the_same(const std::array<float, 3>& was, float was_m, const LightInstance& is) {
    const float turn = was[0] * is.direction[0] + was[1] * is.direction[1] + was[2] * is.direction[2];
    constexpr auto approach = static_cast<float>(VisibilityHistory::largest_approach);
    return turn >= static_cast<float>(VisibilityHistory::cos_largest_turn) &&
           is.distance_m <= approach * was_m && was_m <= approach * is.distance_m;
}

}  // namespace

void VisibilityHistory::begin(double time_s, double smoothing_s) {
    const double step_s = time_s - time_s_;
    const bool jumped = !begun_ || !(step_s >= 0) || step_s > longest_step_s;
    begun_ = true;
    anew_ = jumped;
    time_s_ = time_s;
    if (jumped || !(smoothing_s > 0)) last_.clear();
    standstill_ = step_s == 0 ? standstill_ + 1 : 0;
    const bool at_once = last_.empty() || standstill_ > longest_standstill_frames;
    blend_ = at_once ? 1 : -std::expm1(-step_s / smoothing_s);
}

void VisibilityHistory::match(std::span<const LightInstance> lights, std::span<const std::uint32_t> tags,
                              std::vector<std::int32_t>& previous) {
    const auto by_tag = [](const Entry& a, const Entry& b) { return a.tag < b.tag; };
    previous.assign(lights.size(), -1);
    now_.clear();
    bool ascending = true;
    auto from = last_.cbegin();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const LightInstance& light = lights[i];
        ascending = ascending && (i == 0 || tags[i - 1] <= tags[i]);
        // The database gives its lights in the order of their tags, so that the search goes on where it was.
        const Entry wanted{.tag = tags[i]};
        from = std::lower_bound(ascending ? from : last_.cbegin(), last_.cend(), wanted, by_tag);
        if (from != last_.cend() && from->tag == tags[i] &&
            is_the_same(from->direction, from->distance_m, light)) {
            previous[i] = from->index;
        }
        now_.push_back({tags[i], static_cast<std::int32_t>(i), light.direction, light.distance_m});
    }
    if (!ascending) std::sort(now_.begin(), now_.end(), by_tag);
    last_.swap(now_);
}

}  // namespace seaglare::glare
