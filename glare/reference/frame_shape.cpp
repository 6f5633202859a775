#include "glare/reference/frame_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "glare/reference/comparison.h"

namespace seaglare::reference {

namespace {

double half_cosine(double t) {
    return 0.5 + 0.5 * std::cos(std::numbers::pi * std::clamp(t, 0.0, 1.0));
}

Rgbv mixed(const Rgbv& a, const Rgbv& b, double t) {
    Rgbv value{};
    for (std::size_t c = 0; c < 4; ++c)
        value[c] = a[c] + t * (b[c] - a[c]);
    return value;
}

// One level of detail: samples per pixel, and the radius up to which it is used. The levels hand over to one another
// within the last third of their radius.
struct Detail {
    int per_px = 1;
    double radius_px = 0;
};

std::vector<Detail> details_for(double window_px) {
    std::vector<Detail> details;
    for (const Detail& wanted : {Detail{8, 12}, Detail{2, 32}}) {
        if (window_px <= wanted.radius_px) return details.push_back({wanted.per_px, window_px}), details;
        details.push_back(wanted);
    }
    details.push_back({1, window_px});
    return details;
}

// Share of a level in what is summed at a distance, given what the finer ones leave.
double share_of_level(const std::vector<Detail>& details, std::size_t level, double distance_px) {
    double left = 1;
    for (std::size_t i = 0; i < level; ++i) {
        const double end = details[i].radius_px;
        left *= 1 - half_cosine((distance_px - end * 2 / 3) / (end / 3));
    }
    if (level + 1 == details.size()) return left;
    const double end = details[level].radius_px;
    return left * half_cosine((distance_px - end * 2 / 3) / (end / 3));
}

// Cells to samples: the mean over a pixel around each, exactly: per_px cells, those at the ends by half when the pixel
// ends in their middle.
void average_over_pixels(SkirtLevel& level) {
    if (level.per_px == 1) return;
    const int k = level.per_px;
    const int half = k / 2;
    const int side = level.side();
    const auto pass = [&](bool rows) {
        const std::vector<Rgbv> from = level.samples;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                Rgbv sum{};
                for (int d = -half; d <= half; ++d) {
                    const int at = (rows ? x : y) + d;
                    if (at < 0 || at >= side) continue;
                    const double weight = (k % 2 == 0 && std::abs(d) == half) ? 0.5 : 1.0;
                    const auto i = static_cast<std::size_t>(rows ? y * side + at : at * side + x);
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += weight * from[i][c];
                }
                Rgbv& to = level.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                         static_cast<std::size_t>(x)];
                for (std::size_t c = 0; c < 4; ++c)
                    to[c] = sum[c] / k;
            }
        }
    };
    pass(true);
    pass(false);
}

// Linear between production's nodes is what is drawn: they are the samples.
SkirtLevel level_of_nodes(std::span<const float> nodes, int radius, int per_px = 1) {
    SkirtLevel level;
    level.per_px = per_px;
    level.radius = radius;
    level.samples.resize(nodes.size() / 4);
    for (std::size_t i = 0; i < level.samples.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            level.samples[i][c] = static_cast<double>(nodes[4 * i + c]);
    level.integrate();
    return level;
}

// How much of a level's own values is there at a distance: the finer one has what lies inside. Complete before the finer one
// ends.
double beyond_finer(const std::vector<Detail>& details, std::size_t level, double distance_px) {
    if (level == 0) return 1;
    const double end = details[level - 1].radius_px;
    return 1 - half_cosine((distance_px - end * 2 / 3) / (end / 6));
}

// Where the coarser levels are complete, what is left to a level is how much better it knows what lies between their
// samples; that fades.
double within_own(const std::vector<Detail>& details, std::size_t level, double distance_px) {
    if (level + 1 == details.size()) return 1;
    const double end = details[level].radius_px;
    return half_cosine((distance_px - end * 5 / 6) / (end / 6));
}

// Means over pixels become what each level adds to the coarser ones, as these are drawn: linear between their samples. To
// share the values out by weights would be off by a per cent where the weights change, as products are not linear.
void hand_over(std::vector<SkirtLevel>& levels, const std::vector<Detail>& details) {
    for (std::size_t d = levels.size(); d-- > 0;) {
        SkirtLevel& level = levels[d];
        std::size_t i = 0;
        for (int b = -level.radius; b <= level.radius; ++b) {
            for (int a = -level.radius; a <= level.radius; ++a, ++i) {
                const double u = static_cast<double>(a) / level.per_px;
                const double v = static_cast<double>(b) / level.per_px;
                const double distance_px = std::hypot(u, v);
                Rgbv coarser{};
                for (std::size_t k = d + 1; k < levels.size(); ++k) {
                    const Rgbv part = levels[k].at(u, v);
                    for (std::size_t c = 0; c < 4; ++c)
                        coarser[c] += part[c];
                }
                const double own = beyond_finer(details, d, distance_px);
                const double share = within_own(details, d, distance_px);
                for (std::size_t c = 0; c < 4; ++c)
                    level.samples[i][c] = share * (own * level.samples[i][c] - coarser[c]);
            }
        }
    }
}

void refuse_unknown(const glare::EyeModel& eye) {
    if (eye.eyelashes.count > 0 || eye.lids.closure > 0)
        throw std::invalid_argument("frame reference: lashes and lids are not known to it");
    if (eye.cie_calibrated)
        throw std::invalid_argument(
            "frame reference: an eye calibrated to the CIE's curve is not known to it");
}

}  // namespace

Rgbv SkirtLevel::at(double u_px, double v_px) const {
    const double x = u_px * per_px + radius;
    const double y = v_px * per_px + radius;
    if (!(x >= 0) || !(y >= 0) || x >= 2 * radius || y >= 2 * radius) return {};
    const auto i = static_cast<std::size_t>(x);
    const auto j = static_cast<std::size_t>(y);
    const auto stride = static_cast<std::size_t>(side());
    const Rgbv* const row = samples.data() + j * stride + i;
    const double tx = x - static_cast<double>(i);
    return mixed(mixed(row[0], row[1], tx), mixed(row[stride], row[stride + 1], tx),
                 y - static_cast<double>(j));
}

void SkirtLevel::integrate() {
    integrals.assign(samples.size(), Rgbv{});
    const auto stride = static_cast<std::size_t>(side());
    for (std::size_t y = 0; y < stride; ++y)
        for (std::size_t x = 1; x < stride; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                integrals[y * stride + x][c] =
                    integrals[y * stride + x - 1][c] +
                    0.5 * (samples[y * stride + x - 1][c] + samples[y * stride + x][c]);
}

Rgbv SkirtLevel::over_disc(double u_px, double v_px, double radius_px) const {
    const double reach = reach_px() + radius_px;
    if (std::abs(u_px) >= reach || std::abs(v_px) >= reach) return {};
    const auto stride = static_cast<std::size_t>(side());
    // Integral of a row's interpolant up to x, in samples.
    const auto up_to = [&](std::size_t row, double x) {
        const double clamped = std::clamp(x, 0.0, static_cast<double>(2 * radius));
        const auto i = std::min(static_cast<std::size_t>(clamped), stride - 2);
        const double t = clamped - static_cast<double>(i);
        const Rgbv& a = samples[row * stride + i];
        const Rgbv& b = samples[row * stride + i + 1];
        Rgbv value = integrals[row * stride + i];
        for (std::size_t c = 0; c < 4; ++c)
            value[c] += t * (a[c] + 0.5 * t * (b[c] - a[c]));
        return value;
    };
    // Chords at v + r sin(phi): their lengths are smooth in phi, so the midpoint rule converges fast.
    const int chords = std::max(12, static_cast<int>(std::ceil(3 * radius_px * std::max(per_px, 4))));
    Rgbv sum{};
    for (int i = 0; i < chords; ++i) {
        const double phi = std::numbers::pi * ((i + 0.5) / chords - 0.5);
        const double y = (v_px + radius_px * std::sin(phi)) * per_px + radius;
        if (!(y >= 0) || y >= 2 * radius) continue;
        const double half = radius_px * std::cos(phi) * per_px;
        const double x = u_px * per_px + radius;
        const auto j = static_cast<std::size_t>(y);
        const double t = y - static_cast<double>(j);
        const Rgbv from = mixed(up_to(j, x - half), up_to(j + 1, x - half), t);
        const Rgbv to = mixed(up_to(j, x + half), up_to(j + 1, x + half), t);
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += (to[c] - from[c]) * std::cos(phi);
    }
    // dv = r cos(phi) dphi; chords are in samples; divided by pi r^2.
    const double scale = 1 / (chords * radius_px * per_px);
    for (double& value : sum)
        value *= scale;
    return sum;
}

GlareShape make_shape(const ShapeRequest& request, const PatternMaker& maker) {
    refuse_unknown(request.eye);
    if (request.lamps.size() != request.lines.size() || request.lamps.empty())
        throw std::invalid_argument("frame reference: as many lamps as spectra, and at least one");
    GlareShape shape;
    shape.pitch = request.pitch;
    shape.window_inner = request.window_inner;
    shape.window_outer = request.window_outer;
    shape.tail_age_years = request.eye.age_years;
    shape.tail_pigmentation = request.eye.pigmentation;
    shape.lamps.resize(request.lamps.size());
    for (std::size_t l = 0; l < request.lamps.size(); ++l)
        shape.shape_of_lamp.at(request.lamps[l]) = static_cast<std::uint8_t>(l);

    std::vector<Rgbv> totals(request.lamps.size());
    const std::vector<Detail> details = details_for(request.window_outer / request.pitch);
    double passed = 1;
    for (std::size_t d = 0; d < details.size(); ++d) {
        const Detail& detail = details[d];
        ReferenceRequest wanted;
        wanted.eye = request.eye;
        wanted.pupil_mm = request.pupil_mm;
        wanted.time_s = request.time_s;
        wanted.seed = request.seed;
        wanted.angular_scale = request.angular_scale;
        wanted.pitch = request.pitch / detail.per_px;
        wanted.radius = static_cast<int>(std::ceil(detail.radius_px * detail.per_px)) + detail.per_px;
        const std::vector<ReferencePattern> patterns = maker(wanted, request.lines);
        for (std::size_t l = 0; l < patterns.size(); ++l) {
            const ReferencePattern& pattern = patterns[l];
            passed = pattern.transmitted;
            SkirtLevel level;
            level.per_px = detail.per_px;
            level.radius = pattern.radius;
            level.samples.resize(pattern.pixels.size());
            std::size_t i = 0;
            for (int b = -pattern.radius; b <= pattern.radius; ++b) {
                for (int a = -pattern.radius; a <= pattern.radius; ++a, ++i) {
                    const double distance_px = std::hypot(a, b) / detail.per_px;
                    const double window = half_cosine((distance_px * request.pitch - request.window_inner) /
                                                      (request.window_outer - request.window_inner));
                    if (window <= 0) continue;
                    const double in_core = half_cosine(distance_px / request.core_radius_px);
                    const double cell =
                        share_of_level(details, d, distance_px) * pattern.pitch * pattern.pitch;
                    const Rgbv value = pattern.relative(a, b);
                    for (std::size_t c = 0; c < 4; ++c) {
                        const double energy = value[c] * window * cell;
                        totals[l][c] += energy;
                        shape.lamps[l].core[c] += energy * in_core;
                        level.samples[i][c] = value[c] * window * (1 - in_core);
                    }
                }
            }
            average_over_pixels(level);
            shape.lamps[l].levels.push_back(std::move(level));
        }
    }
    shape.tail_scale = request.eye.cie_tail && request.angular_scale == 1 ? passed : 0;
    const double energy =
        passed - shape.tail_scale * tail_energy(request.eye.age_years, request.eye.pigmentation,
                                                request.window_inner, request.window_outer);
    shape.structure_scale = energy / totals.front()[1];
    for (std::size_t l = 0; l < shape.lamps.size(); ++l) {
        hand_over(shape.lamps[l].levels, details);
        for (std::size_t c = 0; c < 4; ++c) {
            const double scale = energy / totals[l][c];
            shape.lamps[l].core[c] *= scale;
            for (SkirtLevel& level : shape.lamps[l].levels)
                for (Rgbv& sample : level.samples)
                    sample[c] *= scale;
        }
        for (SkirtLevel& level : shape.lamps[l].levels)
            level.integrate();
    }
    return shape;
}

GlareShape shape_of(const glare::Pattern& pattern) {
    GlareShape shape;
    shape.pitch = pattern.pitch;
    shape.window_inner = pattern.window_inner;
    shape.window_outer = pattern.window_outer;
    shape.tail_scale = pattern.tail_scale;
    shape.tail_age_years = pattern.tail_age_years;
    shape.tail_pigmentation = pattern.tail_pigmentation;
    shape.structure_scale = pattern.structure_scale;
    shape.shape_of_lamp = pattern.slot_of_lamp;
    const auto side = 2 * static_cast<std::size_t>(pattern.radius_nodes) + 1;
    const std::size_t layers = std::max<std::size_t>(pattern.layer_radius_nodes.size(), 1);
    for (std::size_t slot = 0; slot < pattern.lamps.size(); ++slot) {
        LampShape lamp;
        for (std::size_t c = 0; c < 4; ++c)
            lamp.core[c] = static_cast<double>(pattern.core_energy[slot][c]);
        if (!pattern.skirt.empty()) {
            for (std::size_t l = 0; l < layers; ++l) {
                const auto nodes =
                    std::span(pattern.skirt).subspan((slot * layers + l) * side * side * 4, side * side * 4);
                DiscLayer& layer = lamp.layers.emplace_back();
                if (l > 0) layer.radius_px = static_cast<double>(pattern.layer_radius_nodes[l]);
                layer.levels = {level_of_nodes(nodes, pattern.radius_nodes)};
                if (l == 0 && !pattern.fine.empty())
                    layer.levels.push_back(level_of_nodes(
                        std::span(pattern.fine).subspan(slot * glare::fine_floats, glare::fine_floats),
                        glare::fine_per_node * glare::fine_radius_nodes, glare::fine_per_node));
            }
            lamp.levels = lamp.layers.front().levels;
        }
        shape.lamps.push_back(std::move(lamp));
    }
    return shape;
}

}  // namespace seaglare::reference
