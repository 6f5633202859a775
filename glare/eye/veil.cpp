#include "glare/eye/veil.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "glare/eye/noise.h"

namespace seaglare::glare {

namespace {

constexpr int margin_pieces = 64;
constexpr int lash_pieces = 16;
constexpr double tip_share = 0.1;     // of the root's width
constexpr double root_field_mm = 4;   // lashes stand before the widest pupil
constexpr double soft_mm = 0.05;      // what the anti-aliased edge of a pupil may reach beyond it
constexpr double rim_mm = 0.5;        // how far beyond the pupil a lid is drawn
constexpr double steepest_rad = 1.3;  // of a lash: it hangs, it does not lie

Quad quad(double x0, double y0, double x1, double y1, double x2, double y2, double x3, double y3) {
    return {{static_cast<float>(x0), static_cast<float>(y0), static_cast<float>(x1), static_cast<float>(y1),
             static_cast<float>(x2), static_cast<float>(y2), static_cast<float>(x3), static_cast<float>(y3)}};
}

// A normal deviate from two uniform ones (Box & Muller 1958).
double normal(std::uint64_t seed, std::uint64_t i) {
    const double u = 1 - uniform(seed, i, 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * uniform(seed, i, 2));
}

// Height of a margin's arch below its middle: a parabola, which flattens as the lids close on a line.
double arch_mm(const Lids& lids, double closure, double x_mm) {
    return lids.edge_radius_mm > 0 ? (1 - closure) * x_mm * x_mm / (2 * lids.edge_radius_mm) : 0;
}

double opening_mm(const Lids& lids) {
    return lids.upper_margin_mm + lids.lower_margin_mm;
}

// One lid: strips between its margin and a line beyond the pupil's edge; `side` is 1 above, -1 below.
template <typename Margin>
void place_lid(Margin margin_mm, double side, double radius_mm, std::vector<Quad>& quads) {
    const double width_mm = radius_mm + rim_mm;
    const double far_mm = side * (radius_mm + 2 * rim_mm);
    for (int i = 0; i < margin_pieces; ++i) {
        const double left = width_mm * (2.0 * i / margin_pieces - 1);
        const double right = width_mm * (2.0 * (i + 1) / margin_pieces - 1);
        const double from = margin_mm(left);
        const double to = margin_mm(right);
        // A margin beyond the circle of the pupil covers none of it here.
        const double nearest_mm = left * right <= 0 ? 0 : std::min(std::abs(left), std::abs(right));
        const double edge_mm = radius_mm + soft_mm;
        const double circle_mm = std::sqrt(std::max(edge_mm * edge_mm - nearest_mm * nearest_mm, 0.0));
        if (side * from >= circle_mm && side * to >= circle_mm) continue;
        // Far enough down to hold the whole circle is far enough.
        const double low = side * std::max(side * from, -radius_mm - rim_mm);
        const double low_right = side * std::max(side * to, -radius_mm - rim_mm);
        quads.push_back(quad(left, low, right, low_right, right, far_mm, left, far_mm));
    }
}

struct Interval {
    double from;
    double to;
};

// Where the line at height y meets a convex quadrangle; empty: from > to.
Interval crossing(const Quad& q, double y) {
    Interval result{1e30, -1e30};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t j = (i + 1) % 4;
        const double y0 = static_cast<double>(q.xy[2 * i + 1]);
        const double y1 = static_cast<double>(q.xy[2 * j + 1]);
        if ((y0 <= y) == (y1 <= y)) continue;
        const double x0 = static_cast<double>(q.xy[2 * i]);
        const double x1 = static_cast<double>(q.xy[2 * j]);
        const double x = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
        result.from = std::min(result.from, x);
        result.to = std::max(result.to, x);
    }
    return result;
}

// What is left of [-half, half] on the line, weighted by what the lens lets pass there.
class Line {
  public:
    Line(double half, double y, double inner, double outer, double passed) : half_(half), passed_(passed) {
        const auto root = [y](double r) { return std::sqrt(std::max(r * r - y * y, 0.0)); };
        inner_ = root(inner);
        outer_ = root(outer);
    }
    double open(std::vector<Interval>& covered) const {
        std::sort(covered.begin(), covered.end(),
                  [](const Interval& a, const Interval& b) { return a.from < b.from; });
        double sum = 0;
        double at = -half_;
        for (const Interval& c : covered) {
            if (c.from > at) sum += weight(at, std::min(c.from, half_));
            at = std::max(at, c.to);
            if (at >= half_) return sum;
        }
        return sum + weight(at, half_);
    }

  private:
    double weight(double from, double to) const { return to > from ? integral(to) - integral(from) : 0; }
    // From 0 to x: the ring of gratings counts by what it passes.
    double integral(double x) const {
        const double far = std::abs(x);
        const double in_ring = std::clamp(far, inner_, outer_) - inner_;
        return std::copysign(far - (1 - passed_) * in_ring, x);
    }
    double half_;
    double passed_;
    double inner_ = 0;
    double outer_ = 0;
};

}  // namespace

bool lids_move(const Lids& lids) {
    const Lids open;
    return lids.closure > 0 || lids.motion.squint > 0 || lids.motion.blink_interval_s > 0 ||
           lids.upper_margin_mm < open.upper_margin_mm || lids.lower_margin_mm < open.lower_margin_mm;
}

double upper_margin_mm(const Lids& lids, double closure, double x_mm) {
    return lids.upper_margin_mm - closure * (1 - lids.lower_share) * opening_mm(lids) -
           arch_mm(lids, closure, x_mm);
}

double lower_margin_mm(const Lids& lids, double closure, double x_mm) {
    return -lids.lower_margin_mm + closure * lids.lower_share * opening_mm(lids) +
           arch_mm(lids, closure, x_mm);
}

Veil::Veil(const EyeModel& eye, std::uint64_t seed) : lids_(eye.lids) {
    const Eyelashes& lashes = eye.eyelashes;
    if (lashes.count <= 0 || !(lashes.width_um > 0) || !(lashes.length_mm > 0)) return;
    width_mm_ = lashes.width_um / 1000;
    length_mm_ = lashes.length_mm;
    constexpr std::uint64_t lash_stream = 0x6C617368;
    const std::uint64_t own = hash(seed, lash_stream, lashes.seed);
    for (int i = 0; i < lashes.count; ++i) {
        const auto n = static_cast<std::uint64_t>(i);
        Lash lash;
        lash.root_mm = root_field_mm * (2 * (i + 0.2 + 0.6 * uniform(own, n, 0)) / lashes.count - 1);
        const double angle_deg = lashes.mean_angle_deg + lashes.spread_deg * normal(own, n);
        lash.angle_rad = std::clamp(angle_deg * std::numbers::pi / 180, -steepest_rad, steepest_rad);
        lash.curvature_per_mm = lashes.curvature_per_mm * (2 * uniform(own, n, 3) - 1);
        lashes_.push_back(lash);
    }
}

std::size_t Veil::capacity() const {
    return 2 * margin_pieces + lashes_.size() * lash_pieces;
}

void Veil::place(const EyeInstant& instant, std::vector<Quad>& quads) const {
    quads.clear();
    const double radius_mm = instant.pupil_mm / 2;
    const double closure = instant.lid_closure;
    place_lid([&](double x) { return upper_margin_mm(lids_, closure, x); }, 1, radius_mm, quads);
    place_lid([&](double x) { return lower_margin_mm(lids_, closure, x); }, -1, radius_mm, quads);
    const double piece_mm = length_mm_ / lash_pieces;
    for (const Lash& lash : lashes_) {
        double x = lash.root_mm;
        double y = upper_margin_mm(lids_, closure, x);
        // The mean angle is that of the middle.
        double angle = lash.angle_rad - lash.curvature_per_mm * length_mm_ / 2;
        double half_mm = width_mm_ / 2;
        std::array<double, 4> end = {x - half_mm * std::cos(angle), y - half_mm * std::sin(angle),
                                     x + half_mm * std::cos(angle), y + half_mm * std::sin(angle)};
        for (int i = 1; i <= lash_pieces; ++i) {
            const double middle = angle + lash.curvature_per_mm * piece_mm / 2;
            x += piece_mm * std::sin(middle);
            y -= piece_mm * std::cos(middle);
            angle += lash.curvature_per_mm * piece_mm;
            half_mm = width_mm_ / 2 * (1 - (1 - tip_share) * i / lash_pieces);
            const std::array<double, 4> next = {x - half_mm * std::cos(angle), y - half_mm * std::sin(angle),
                                                x + half_mm * std::cos(angle), y + half_mm * std::sin(angle)};
            if (std::hypot(x, y) < radius_mm + rim_mm + piece_mm)
                quads.push_back(quad(end[0], end[1], end[2], end[3], next[2], next[3], next[0], next[1]));
            end = next;
        }
    }
}

double transmitted_fraction(const EyeModel& eye, const EyeInstant& instant, const std::vector<Quad>& veil) {
    const double radius = instant.pupil_mm / 2;
    if (veil.empty() && instant.lens_scale == 1) return transmitted_fraction(eye, instant.pupil_mm);
    if (!(radius > 0)) return 1;
    const LensGratings& g = eye.gratings;
    const bool absorbs = g.count > 0;
    const double inner = absorbs ? std::clamp(g.inner_radius_mm * instant.lens_scale, 0.0, radius) : 0;
    const double outer = absorbs ? std::clamp(g.outer_radius_mm * instant.lens_scale, inner, radius) : 0;
    const double passed = absorbs ? 1 - g.duty * (1 - (1 - g.depth) * (1 - g.depth)) : 1;
    constexpr int lines = 2048;
    std::vector<Interval> covered;
    double sum = 0;
    for (int i = 0; i < lines; ++i) {
        const double y = radius * (2 * (i + 0.5) / lines - 1);
        covered.clear();
        for (const Quad& q : veil) {
            const Interval c = crossing(q, y);
            if (c.to > c.from) covered.push_back(c);
        }
        sum += Line(std::sqrt(radius * radius - y * y), y, inner, outer, passed).open(covered);
    }
    return sum * (2 * radius / lines) / (std::numbers::pi * radius * radius);
}

void to_samples(std::vector<Quad>& quads, int n, double plane_width_mm) {
    const auto scale = static_cast<float>(n / plane_width_mm);
    const auto axis = static_cast<float>(n) / 2;
    for (Quad& q : quads)
        for (float& v : q.xy)
            v = axis + v * scale;
}

}  // namespace seaglare::glare
