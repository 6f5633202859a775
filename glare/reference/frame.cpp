#include "glare/reference/frame.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "glare/reference/frame_footprint.h"

namespace seaglare::reference {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double point_below_px = 0.02;
constexpr double nodes_below_px = 0.3;
constexpr int rows_at_once = 4;

// The CIE's curve outside the simulated structure, over the chord of the angle, 2 sin(angle/2) = sqrt(2 (1 - cos)).
class Tail {
  public:
    explicit Tail(const GlareShape& shape) {
        if (!(shape.tail_scale > 0)) return;
        values_.resize(steps + 2);
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const double chord = static_cast<double>(i) / steps * std::numbers::sqrt2;
            const double angle = 2 * std::asin(std::min(chord / 2, 1.0));
            const double sine = std::sin(std::min(angle, pi / 2));
            const double t = std::clamp(
                (sine - shape.window_inner) / std::max(shape.window_outer - shape.window_inner, 1e-12), 0.0,
                1.0);
            // The last ten degrees before the quarter turn fade.
            const double end = std::clamp(std::cos(angle) / 0.17, 0.0, 1.0);
            values_[i] = shape.tail_scale * (0.5 - 0.5 * std::cos(pi * t)) * end * end * (3 - 2 * end) *
                         cie_curve_sr(angle * 180 / pi, shape.tail_age_years, shape.tail_pigmentation);
        }
    }
    bool empty() const { return values_.empty(); }
    double at(double cosine) const {
        const double x = std::sqrt(std::max(1 - cosine, 0.0)) * steps;
        const auto i = static_cast<std::size_t>(x);
        return values_[i] + (x - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
    }

  private:
    static constexpr std::size_t steps = 65536;
    std::vector<double> values_;
};

struct Light {
    Vector direction{};
    FrameScreen::Tangents tangents;
    double radius_rad = 0;
    double disc_px = 0;       // of the pattern's pitch
    double reach_cosine = 1;  // the skirt ends there
    Rgbv lux{};
    const LampShape* shape = nullptr;
    std::vector<Vector> tail_nodes;  // directions over the disc, of equal weight; empty: a point will do
};

// Seven nodes in the unit disc, exact to the fifth order (Stroud 1971, S2 5-1).
struct Node {
    double x, y, weight;
};
std::array<Node, 7> seven_nodes() {
    std::array<Node, 7> nodes{{{0, 0, 0.25}}};
    for (std::size_t i = 0; i < 6; ++i) {
        const double angle = static_cast<double>(i) * pi / 3;
        nodes[i + 1] = {std::sqrt(2.0 / 3) * std::cos(angle), std::sqrt(2.0 / 3) * std::sin(angle), 0.125};
    }
    return nodes;
}

// Rings of equal area, so that all directions weigh the same; spacing small against the tail's own scale.
std::vector<Vector> tail_nodes(const Light& light, const GlareShape& shape) {
    const double scale = std::max(shape.window_inner, 1e-3);
    // A point's error is about (radius/angle)^2/2.
    if (light.radius_rad < 0.004 * scale) return {};
    const int rings = std::clamp(static_cast<int>(std::ceil(light.radius_rad / (0.1 * scale))), 2, 24);
    std::vector<Vector> nodes = {light.direction};
    const double count = 1.0 + 3.0 * rings * (rings + 1);
    for (int ring = 1; ring <= rings; ++ring) {
        // The middle of the ring's share of the cap: areas go with the square of the chord.
        const double share = (1 + 3.0 * ring * (ring - 1) + 3.0 * ring) / count;
        const double angle = 2 * std::asin(std::min(std::sin(light.radius_rad / 2) * std::sqrt(share), 1.0));
        for (int i = 0; i < 6 * ring; ++i) {
            const double around = 2 * pi * i / (6 * ring);
            const Vector aside =
                along(along({}, light.tangents.u, std::cos(around)), light.tangents.v, std::sin(around));
            nodes.push_back(along(along({}, light.direction, std::cos(angle)), aside, std::sin(angle)));
        }
    }
    return nodes;
}

std::vector<Light> take_in(const FrameScreen& screen, const GlareShape& shape,
                           std::span<const glare::PointSource> sources) {
    std::vector<Light> lights;
    for (const glare::PointSource& source : sources) {
        const Vector at = {static_cast<double>(source.position_view_m[0]),
                           static_cast<double>(source.position_view_m[1]),
                           static_cast<double>(source.position_view_m[2])};
        const double distance = length(at);
        Light light;
        light.lux = {static_cast<double>(source.illuminance_rgb_lx[0]),
                     static_cast<double>(source.illuminance_rgb_lx[1]),
                     static_cast<double>(source.illuminance_rgb_lx[2]),
                     static_cast<double>(source.illuminance_scotopic_lx)};
        double sum = distance;
        double largest = 0;
        for (const double lux : light.lux) {
            sum += lux;
            largest = std::max(largest, std::abs(lux));
        }
        if (!std::isfinite(sum) || !(largest > 0) || !(distance > 0)) continue;
        const double radius = std::max(static_cast<double>(source.radius_m), 0.0);
        light.direction = unit(at);
        light.tangents = screen.tangents(light.direction);
        light.radius_rad = radius < distance ? std::asin(radius / distance) : pi / 2;
        light.disc_px = std::sin(light.radius_rad) / shape.pitch;
        light.shape = &shape.lamps.at(shape.shape_of_lamp.at(source.lamp));
        double reach_px = 0;
        for (const SkirtLevel& level : light.shape->levels)
            reach_px = std::max(reach_px, level.reach_px() * std::numbers::sqrt2 + light.disc_px);
        const double reach = std::min(reach_px * shape.pitch, 1.0);
        light.reach_cosine = std::sqrt(1 - reach * reach);
        light.tail_nodes = tail_nodes(light, shape);
        lights.push_back(std::move(light));
    }
    return lights;
}

// Of a disc, averaged over cells, four times the second moment along an axis.
double moment_of(const DiscLayer& layer) {
    return layer.radius_px > 0 ? layer.radius_px * layer.radius_px + 1.0 / 3 : 0;
}

Rgbv skirt_at(const Light& light, const Vector& ray, double pitch) {
    static const std::array<Node, 7> nodes = seven_nodes();
    const double u = dot(ray, light.tangents.u) / pitch;
    const double v = dot(ray, light.tangents.v) / pitch;
    Rgbv sum{};
    const auto add = [&sum](const Rgbv& value, double weight) {
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += weight * value[c];
    };
    if (const std::vector<DiscLayer>& layers = light.shape->layers;
        !layers.empty() && light.disc_px <= layers.back().radius_px) {
        const double moment = light.disc_px * light.disc_px;
        std::size_t upper = 0;
        while (upper + 1 < layers.size() && moment_of(layers[upper]) < moment)
            ++upper;
        const std::size_t lower = upper > 0 ? upper - 1 : 0;
        const double span = moment_of(layers[upper]) - moment_of(layers[lower]);
        const double share = span > 0 ? std::min((moment - moment_of(layers[lower])) / span, 1.0) : 0;
        for (const SkirtLevel& level : layers[lower].levels)
            add(level.at(u, v), 1 - share);
        for (const SkirtLevel& level : layers[upper].levels)
            add(level.at(u, v), share);
        return sum;
    }
    for (const SkirtLevel& level : light.shape->levels) {
        const double reach = level.reach_px() + light.disc_px;
        if (std::abs(u) >= reach || std::abs(v) >= reach) continue;
        if (light.disc_px < point_below_px)
            add(level.at(u, v), 1);
        else if (light.disc_px < nodes_below_px)
            for (const Node& node : nodes)
                add(level.at(u - node.x * light.disc_px, v - node.y * light.disc_px), node.weight);
        else
            add(level.over_disc(u, v, light.disc_px), 1);
    }
    return sum;
}

void draw_row(const FrameScreen& screen, const GlareShape& shape, const Tail& tail,
              const std::vector<Vector>& rays, const Light& light, Rgbv* pixels) {
    for (int x = 0; x < screen.width_px(); ++x) {
        const Vector& ray = rays[static_cast<std::size_t>(x)];
        const double cosine = dot(ray, light.direction);
        Rgbv per_sr{};
        if (cosine > light.reach_cosine && cosine > 0) per_sr = skirt_at(light, ray, shape.pitch);
        double outside = 0;
        if (!tail.empty()) {
            if (light.tail_nodes.empty()) {
                if (cosine > 0) outside = tail.at(cosine);
            } else {
                for (const Vector& node : light.tail_nodes) {
                    const double to_node = dot(ray, node);
                    if (to_node > 0) outside += tail.at(to_node);
                }
                outside /= static_cast<double>(light.tail_nodes.size());
            }
        }
        for (std::size_t c = 0; c < 4; ++c)
            pixels[x][c] += light.lux[c] * (per_sr[c] + outside);
    }
}

}  // namespace

std::vector<Rgbv> draw_frame(const FrameScreen& screen, const GlareShape& shape,
                             std::span<const glare::PointSource> sources,
                             const std::function<void(double)>& progress, int row_step) {
    if (row_step < 1) throw std::invalid_argument("frame reference: a row step is at least 1");
    const auto width = static_cast<std::size_t>(screen.width_px());
    const auto height = static_cast<std::size_t>(screen.height_px());
    std::vector<Rgbv> pixels(width * height);
    const std::vector<Light> lights = take_in(screen, shape, sources);
    const Tail tail(shape);

    // A few rows stay in the cache while all lights go over them.
    std::atomic<std::size_t> next{0};
    std::mutex reporting;
    const auto worker = [&] {
        std::vector<std::vector<Vector>> rays(rows_at_once, std::vector<Vector>(width));
        for (std::size_t first = next.fetch_add(rows_at_once); first < height;
             first = next.fetch_add(rows_at_once)) {
            const std::size_t rows = std::min<std::size_t>(rows_at_once, height - first);
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t x = 0; x < width; ++x)
                    rays[r][x] =
                        screen.ray(static_cast<double>(x) + 0.5, static_cast<double>(first + r) + 0.5);
            for (const Light& light : lights)
                for (std::size_t r = 0; r < rows; ++r)
                    if (is_drawn(first + r, row_step))
                        draw_row(screen, shape, tail, rays[r], light, pixels.data() + (first + r) * width);
            if (progress) {
                const std::lock_guard lock(reporting);
                progress(static_cast<double>(first) / static_cast<double>(height));
            }
        }
    };
    std::vector<std::thread> threads(std::clamp(std::thread::hardware_concurrency(), 1U, 8U) - 1);
    for (std::thread& thread : threads)
        thread = std::thread(worker);
    worker();
    for (std::thread& thread : threads)
        thread.join();

    for (const Light& light : lights) {
        spread_core(screen, light.direction, light.radius_rad, [&](int x, int y, double per_sr) {
            if (!is_drawn(static_cast<std::size_t>(y), row_step)) return;
            Rgbv& pixel = pixels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
            for (std::size_t c = 0; c < 4; ++c)
                pixel[c] += light.lux[c] * light.shape->core[c] * per_sr;
        });
    }
    return pixels;
}

}  // namespace seaglare::reference
