#include "glare/apply/band_lights.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

// A picture in parts of so many rows.
struct Parts {
    Parts(int height_px, int rows_each)
        : rows(rows_each), count(std::max((height_px - 1) / rows_each + 1, 1)) {}
    // Rows far outside the picture, and what is not a number, belong to its first or last part.
    std::size_t of(float row) const {
        const float part = std::floor(row / static_cast<float>(rows));
        return static_cast<std::size_t>(part > 0 ? std::min(part, static_cast<float>(count - 1)) : 0.0F);
    }
    int rows;
    int count;
};

}  // namespace

void RowOrder::sort(int height_px, std::vector<LightInstance>& lights, std::vector<std::uint32_t>& tags) {
    const Parts steps(height_px, step_rows);
    next_.assign(static_cast<std::size_t>(steps.count) + 1, 0);
    for (const LightInstance& light : lights)
        ++next_[steps.of(light.centre_px[1]) + 1];
    for (std::size_t step = 1; step < next_.size(); ++step)
        next_[step] += next_[step - 1];
    // They change places below: what one has room for, the other has, too.
    lights_.reserve(lights.capacity());
    lights_.resize(lights.size());
    tags_.reserve(tags.capacity());
    tags_.resize(tags.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::size_t to = next_[steps.of(lights[i].centre_px[1])]++;
        lights_[to] = lights[i];
        tags_[to] = tags[i];
    }
    lights.swap(lights_);
    tags.swap(tags_);
}

void BandLights::find(std::span<const LightInstance> lights, RectPx LightInstance::*rect, int height_px) {
    const Parts bands(height_px, band_rows);
    ranges_.assign(static_cast<std::size_t>(bands.count), {lights.size(), 0});
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const RectPx& r = lights[i].*rect;
        if (!(r[0] < r[2] && r[1] < r[3])) continue;
        const std::size_t last = bands.of(r[3]);
        for (std::size_t band = bands.of(r[1]); band <= last; ++band) {
            ranges_[band].first = std::min(ranges_[band].first, i);
            ranges_[band].end = i + 1;
        }
    }
}

}  // namespace seaglare::glare
