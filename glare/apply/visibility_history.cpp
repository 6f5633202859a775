#include "glare/apply/visibility_history.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

constexpr auto approach = static_cast<float>(VisibilityHistory::largest_approach);
constexpr auto cos_turn = static_cast<float>(VisibilityHistory::cos_largest_turn);

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

template <class EntryOf>
void VisibilityHistory::match_all(std::size_t count, const EntryOf& entry_of,
                                  std::vector<std::int32_t>& previous) {
    const auto by_tag = [](const Entry& a, const Entry& b) { return a.tag < b.tag; };
    const auto is_the_same = [](const Entry& was, const Entry& is) {
        const float turn = was.direction[0] * is.direction[0] + was.direction[1] * is.direction[1] +
                           was.direction[2] * is.direction[2];
        return turn >= cos_turn && is.distance_m <= approach * was.distance_m &&
               was.distance_m <= approach * is.distance_m;
    };
    previous.assign(count, -1);
    now_.clear();
    bool ascending = true;
    auto from = last_.cbegin();
    for (std::size_t i = 0; i < count; ++i) {
        Entry light = entry_of(i);
        light.index = static_cast<std::int32_t>(i);
        ascending = ascending && (i == 0 || now_.back().tag <= light.tag);
        // The database gives its lights in the order of their tags, so that the search goes on where it was.
        from = std::lower_bound(ascending ? from : last_.cbegin(), last_.cend(), light, by_tag);
        if (from != last_.cend() && from->tag == light.tag && is_the_same(*from, light))
            previous[i] = from->index;
        now_.push_back(light);
    }
    if (!ascending) std::sort(now_.begin(), now_.end(), by_tag);
    last_.swap(now_);
}

void VisibilityHistory::match(std::span<const LightInstance> lights, std::span<const std::uint32_t> tags,
                              std::vector<std::int32_t>& previous) {
    match_all(
        lights.size(),
        [&](std::size_t i) {
            return Entry{tags[i], 0, lights[i].direction, lights[i].distance_m};
        },
        previous);
}

void VisibilityHistory::match(std::span<const PointSource> lights, std::vector<std::int32_t>& previous) {
    match_all(
        lights.size(),
        [&](std::size_t i) {
            const auto& p = lights[i].position_view_m;
            const float distance_m = std::hypot(p[0], p[1], p[2]);
            const float scale = distance_m > 0 ? 1 / distance_m : 0;
            return Entry{lights[i].tag, 0, {p[0] * scale, p[1] * scale, p[2] * scale}, distance_m};
        },
        previous);
}

}  // namespace seaglare::glare
