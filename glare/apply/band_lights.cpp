#include "glare/apply/band_lights.h"

#include <algorithm>
#include <cmath>

namespace seaglare::glare {

namespace {

int bands_of(int height_px) {
    return std::max((height_px + band_rows - 1) / band_rows, 1);
}

// Rows far outside the picture, and what is not a number, belong to its first or last band.
std::size_t band_of(float row, int bands) {
    const float band = std::floor(row / static_cast<float>(band_rows));
    return static_cast<std::size_t>(band > 0 ? std::min(band, static_cast<float>(bands - 1)) : 0.0F);
}

}  // namespace

void RowOrder::sort(int height_px, std::vector<LightInstance>& lights, std::vector<std::uint32_t>& tags) {
    const int bands = bands_of(height_px);
    next_.assign(static_cast<std::size_t>(bands) + 1, 0);
    for (const LightInstance& light : lights)
        ++next_[band_of(light.centre_px[1], bands) + 1];
    for (std::size_t band = 1; band < next_.size(); ++band)
        next_[band] += next_[band - 1];
    lights_.resize(lights.size());
    tags_.resize(tags.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::size_t to = next_[band_of(lights[i].centre_px[1], bands)]++;
        lights_[to] = lights[i];
        tags_[to] = tags[i];
    }
    lights.swap(lights_);
    tags.swap(tags_);
}

void BandLights::find(std::span<const LightInstance> lights, RectPx LightInstance::*rect, int height_px) {
    const int bands = bands_of(height_px);
    ranges_.assign(static_cast<std::size_t>(bands), {lights.size(), 0});
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const RectPx& r = lights[i].*rect;
        if (!(r[0] < r[2] && r[1] < r[3])) continue;
        const std::size_t last = band_of(r[3], bands);
        for (std::size_t band = band_of(r[1], bands); band <= last; ++band) {
            ranges_[band].first = std::min(ranges_[band].first, i);
            ranges_[band].end = i + 1;
        }
    }
}

}  // namespace seaglare::glare
