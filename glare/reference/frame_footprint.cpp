#include "glare/reference/frame_footprint.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace seaglare::reference {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double hann_px = 1.5;
constexpr double least_part = 1e-9;
constexpr double margin_px = 4;  // beyond the picture, where a disc's inside need not be followed

// Integral of (1 + cos(2 pi t/w))/w over -w/2 ... x.
double hann_up_to(double x) {
    if (x <= -hann_px / 2) return 0;
    if (x >= hann_px / 2) return 1;
    return 0.5 + x / hann_px + std::sin(2 * pi * x / hann_px) / (2 * pi);
}

// Integral of that.
double hann_twice_up_to(double x) {
    if (x <= -hann_px / 2) return 0;
    if (x >= hann_px / 2) return x;
    const double before = -hann_px / 2;
    const auto antiderivative = [](double t) {
        return t / 2 + t * t / (2 * hann_px) - hann_px / (4 * pi * pi) * std::cos(2 * pi * t / hann_px);
    };
    return antiderivative(x) - antiderivative(before);
}

struct Span {
    double from = 0;
    double to = 0;
    bool empty() const { return !(from < to); }
};

// Where c + 2 b t + a t^2 >= 0 for a < 0.
Span not_negative(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0)) return {0, 0};
    const double root = std::sqrt(discriminant);
    return {(-b + root) / a, (-b - root) / a};
}

Span within(const Span& a, const Span& limits) {
    return {std::max(a.from, limits.from), std::min(a.to, limits.to)};
}

// Of a row of the image plane the part inside the cone: |d x p|^2 <= sin^2 |p|^2 with p = a + t b.
struct Row {
    double square = 0, mixed = 0, constant = 0;
};
Row row_of(const FrameScreen& screen, const Vector& direction, double sine2, double x0, double y) {
    const Vector a = screen.plane_point(x0, y);
    const Vector& b = screen.step_x();
    const Vector da = cross(direction, a);
    const Vector db = cross(direction, b);
    return {sine2 * dot(b, b) - dot(db, db), sine2 * dot(a, b) - dot(da, db),
            sine2 * dot(a, a) - dot(da, da)};
}

// The row's chord in the cone ahead, as far as the limits go: the quadratic has the cone behind in it, too.
Span chord_of(const Row& row, const Span& limits, const std::function<double(double)>& ahead) {
    if (row.square < 0) {
        const Span chord = within(not_negative(row.square, row.mixed, row.constant), limits);
        return !chord.empty() && ahead((chord.from + chord.to) / 2) > 0 ? chord : Span{};
    }
    const double discriminant = row.mixed * row.mixed - row.square * row.constant;
    if (!(discriminant > 0) || row.square == 0)
        return ahead((limits.from + limits.to) / 2) > 0 ? limits : Span{};
    const double root = std::sqrt(discriminant);
    const Span low = within({limits.from, (-row.mixed - root) / row.square}, limits);
    const Span high = within({(-row.mixed + root) / row.square, limits.to}, limits);
    if (!low.empty() && ahead(limits.from) > 0) return low;
    if (!high.empty() && ahead(limits.to) > 0) return high;
    return {};
}

void spread_row(const FrameScreen& screen, double y, double height, const Span& chord, double disc_sr,
                const std::function<void(int, int, double)>& visit) {
    const int bottom = std::max(0, static_cast<int>(std::floor(y - footprint_reach_px)));
    const int top = std::min(screen.height_px() - 1, static_cast<int>(std::ceil(y + footprint_reach_px)));
    const int left = std::max(0, static_cast<int>(std::floor(chord.from - footprint_reach_px)));
    const int right =
        std::min(screen.width_px() - 1, static_cast<int>(std::ceil(chord.to + footprint_reach_px)));
    for (int x = left; x <= right; ++x) {
        const double middle = x + 0.5;
        const double inside = footprint_integral(middle - chord.from) - footprint_integral(middle - chord.to);
        if (inside <= 0) continue;
        // The light that leaves this part of the disc, where it is.
        const double from_sr = screen.pixel_sr(std::clamp(middle, chord.from, chord.to), y);
        for (int row = bottom; row <= top; ++row) {
            const double across = footprint(row + 0.5 - y);
            if (across <= 0) continue;
            visit(x, row,
                  inside * across * height * from_sr / (disc_sr * screen.pixel_sr(middle, row + 0.5)));
        }
    }
}

}  // namespace

double footprint(double x_px) {
    return 0.5 * (hann_up_to(x_px + 1) - hann_up_to(x_px - 1));
}

double footprint_integral(double x_px) {
    return 0.5 * (hann_twice_up_to(x_px + 1) - hann_twice_up_to(x_px - 1));
}

namespace {

void spread_point(const FrameScreen& screen, const std::array<double, 2>& place, double part,
                  const std::function<void(int, int, double)>& visit) {
    const int x0 = static_cast<int>(std::floor(std::clamp(place[0], -1e6, 1e6)));
    const int y0 = static_cast<int>(std::floor(std::clamp(place[1], -1e6, 1e6)));
    for (int y = std::max(0, y0 - 3); y <= std::min(screen.height_px() - 1, y0 + 3); ++y) {
        for (int x = std::max(0, x0 - 3); x <= std::min(screen.width_px() - 1, x0 + 3); ++x) {
            const double share = footprint(x + 0.5 - place[0]) * footprint(y + 0.5 - place[1]);
            if (share > 0) visit(x, y, part * share / screen.pixel_sr(x + 0.5, y + 0.5));
        }
    }
}

double cap_sr(double radius_rad) {
    const double half_sine = std::sin(radius_rad / 2);
    return 4 * pi * half_sine * half_sine;
}

void spread_disc(const FrameScreen& screen, const Vector& direction, double radius_rad, double part,
                 const std::function<void(int, int, double)>& visit);

}  // namespace

void spread_core(const FrameScreen& screen, const Vector& direction, double radius_rad,
                 const std::function<void(int, int, double)>& visit) {
    std::array<double, 2> place{};
    if (screen.place_px(direction, place)) {
        const double px_sr = screen.pixel_sr(place[0], place[1]);
        const double radius_px = std::sqrt(cap_sr(radius_rad) / pi / px_sr);
        if (radius_px < smallest_disc_px) {
            // Energy and second moment are kept, but for what is no more than a point.
            const double come_in =
                std::clamp((radius_px - point_alone_px) / (disc_in_px - point_alone_px), 0.0, 1.0);
            const double part = come_in * std::pow(radius_px / smallest_disc_px, 2);
            spread_point(screen, place, 1 - part, visit);
            if (part > least_part)
                spread_disc(screen, direction, radius_rad * smallest_disc_px / radius_px, part, visit);
            return;
        }
    }
    spread_disc(screen, direction, radius_rad, 1, visit);
}

namespace {

void spread_disc(const FrameScreen& screen, const Vector& direction, double radius_rad, double part,
                 const std::function<void(int, int, double)>& visit) {
    std::array<double, 2> place{};
    const bool ahead = screen.place_px(direction, place);
    const double disc_sr = cap_sr(radius_rad) / part;
    const double sine2 = std::pow(std::sin(radius_rad), 2);
    const double x0 = ahead ? std::clamp(place[0], -1e6, 1e6) : screen.width_px() / 2.0;
    const double y0 = ahead ? std::clamp(place[1], -1e6, 1e6) : screen.height_px() / 2.0;
    const Span columns = {-margin_px - x0, screen.width_px() + margin_px - x0};
    const Span all_rows = {-margin_px - y0, screen.height_px() + margin_px - y0};

    // The discriminant of a row's quadratic is itself quadratic in y: the disc's lowest and highest rows are its roots.
    const auto discriminant = [&](double dy) {
        const Row r = row_of(screen, direction, sine2, x0, y0 + dy);
        return r.mixed * r.mixed - r.square * r.constant;
    };
    const double middle = discriminant(0);
    const double step = 1;
    const double linear = (discriminant(step) - discriminant(-step)) / (4 * step);
    const double curve = (discriminant(step) + discriminant(-step) - 2 * middle) / (2 * step * step);
    const bool bounded = ahead && curve < 0 && row_of(screen, direction, sine2, x0, y0).square < 0;
    const Span whole = bounded ? not_negative(curve, linear, middle) : all_rows;
    if (whole.empty()) return;

    const auto draw = [&](double dy, double height) {
        if (dy < all_rows.from || dy > all_rows.to) return;
        const Row r = row_of(screen, direction, sine2, x0, y0 + dy);
        const Span chord = chord_of(
            r, columns, [&](double dx) { return dot(direction, screen.plane_point(x0 + dx, y0 + dy)); });
        if (chord.empty()) return;
        spread_row(screen, y0 + dy, height, {x0 + chord.from, x0 + chord.to}, disc_sr, visit);
    };
    const double half = (whole.to - whole.from) / 2;
    const double centre = (whole.to + whole.from) / 2;
    const int rows = static_cast<int>(std::clamp(16 * half, 64.0, 65536.0));
    if (!bounded) {
        for (int i = 0; i < rows; ++i)
            draw(whole.from + (whole.to - whole.from) * (i + 0.5) / rows, (whole.to - whole.from) / rows);
        return;
    }
    // y = centre + half sin(phi): chords are then smooth in phi.
    for (int i = 0; i < rows; ++i) {
        const double phi = pi * ((i + 0.5) / rows - 0.5);
        draw(centre + half * std::sin(phi), half * std::cos(phi) * pi / rows);
    }
}

}  // namespace

}  // namespace seaglare::reference
