#include "lightdb/sector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace seaglare::lightdb {

namespace {

constexpr double deg_per_rad = 180 / std::numbers::pi;

// Clockwise from `from_deg` to `to_deg`, -180 ... 180.
double difference_deg(double to_deg, double from_deg) {
    const double difference = wrapped_deg(to_deg - from_deg);
    return difference > 180 ? difference - 360 : difference;
}

constexpr double zenith_deg = 90;
constexpr double widest_transition_deg = 180;
// To look at what lies just before or behind a limit.
constexpr double beside_deg = 1e-7;

struct Direction {
    double bearing_deg = 0;
    double elevation_deg = 0;
};

bool has_bearing_limits(const Sector& sector) {
    return sector_width_deg(sector) < 360;
}

bool holds(const Sector& sector, const Direction& direction) {
    if (!(direction.elevation_deg >= sector.from_elevation_deg)) return false;
    if (direction.elevation_deg >= sector.to_elevation_deg && sector.to_elevation_deg < zenith_deg)
        return false;
    return wrapped_deg(direction.bearing_deg - sector.from_deg) < sector_width_deg(sector);
}

// What one direction shows with hard edges: a colour and its factor, or nothing.
struct Look {
    std::optional<Colour> colour;
    double factor = 0;
    friend bool operator==(const Look&, const Look&) = default;
};

Look look_of(std::span<const Sector> sectors, const Direction& direction) {
    for (std::size_t i = sectors.size(); i-- > 0;) {
        const Sector& sector = sectors[i];
        if (!holds(sector, direction)) continue;
        if (!sector.colour) return {};
        return {sector.colour, sector.intensity_factor};
    }
    return {};
}

void add(const Look& look, double weight, SectorFactors& factors) {
    if (look.colour) factors[static_cast<std::size_t>(*look.colour)] += weight * look.factor;
}

// A limit near the direction that is looked at.
struct Edge {
    double at_deg = 0;          // from that direction
    double transition_deg = 0;  // 0: sharp
};

// How far the direction lies behind an edge: 0 before its transition, 1 after it.
double passed(const Edge& edge) {
    const double half_deg = edge.transition_deg / 2;
    if (edge.at_deg <= -half_deg) return 1;
    if (edge.at_deg >= half_deg) return 0;
    return 0.5 - edge.at_deg / edge.transition_deg;
}

// Edges in their order, without memory of its own.
class Edges {
  public:
    void insert(const Edge& edge) {
        Edge* const begin = edges_.data();
        Edge* const end = begin + count_;
        Edge* const place = std::lower_bound(
            begin, end, edge, [](const Edge& a, const Edge& b) { return a.at_deg < b.at_deg - beside_deg; });
        if (place != end && std::abs(place->at_deg - edge.at_deg) <= beside_deg) {
            place->transition_deg = std::max(place->transition_deg, edge.transition_deg);
        } else if (count_ < edges_.size()) {
            std::move_backward(place, end, end + 1);
            *place = edge;
            ++count_;
        }
    }

    // Calls seen(at_deg, share) for each of the pieces that the edges part: a place inside it, from the direction looked
    // at, and its share.
    template <typename Seen>
    void for_each_piece(Seen seen) const {
        const std::array<double, most> shares = passed_in_order();
        double before = 1;
        for (std::size_t i = 0; i <= count_; ++i) {
            const double here = i < count_ ? shares[i] : 0;
            if (before > here) seen(middle_deg(i), before - here);
            before = here;
        }
    }

    std::size_t size() const { return count_; }

  private:
    static constexpr std::size_t most = 64;

    // passed() of each edge, falling from edge to edge: one is behind us before the next is. Where a wide transition
    // breaks that order with a narrower one, the narrower keeps its own shape and the wider gives way.
    std::array<double, most> passed_in_order() const {
        std::array<double, most> shares{};
        std::array<bool, most> done{};
        for (std::size_t round = 0; round < count_; ++round) {
            std::size_t next = count_;
            for (std::size_t i = 0; i < count_; ++i) {
                if (!done[i] && (next == count_ || edges_[i].transition_deg < edges_[next].transition_deg))
                    next = i;
            }
            double least = 0;
            double most_passed = 1;
            for (std::size_t i = 0; i < next; ++i)
                if (done[i]) most_passed = shares[i];
            for (std::size_t i = count_; i-- > next + 1;)
                if (done[i]) least = shares[i];
            shares[next] = std::clamp(passed(edges_[next]), least, most_passed);
            done[next] = true;
        }
        return shares;
    }

    double middle_deg(std::size_t i) const {
        if (count_ == 0) return 0;
        if (i == 0) return edges_[0].at_deg - beside_deg;
        if (i == count_) return edges_[count_ - 1].at_deg + beside_deg;
        return (edges_[i - 1].at_deg + edges_[i].at_deg) / 2;
    }

    std::array<Edge, most> edges_{};
    std::size_t count_ = 0;
};

double transition_of(const Sector& sector) {
    return std::clamp(sector.transition_deg, 0.0, widest_transition_deg);
}

double widest_transition(std::span<const Sector> sectors) {
    double widest_deg = 0;
    for (const Sector& sector : sectors)
        widest_deg = std::max(widest_deg, transition_of(sector));
    return widest_deg;
}

bool is_inside(const Edge& edge) {
    return 2 * std::abs(edge.at_deg) < edge.transition_deg;
}

template <typename Visit>  // visit(edge): true to go on
void for_each_bearing_edge(std::span<const Sector> sectors, double bearing_deg, Visit visit) {
    for (const Sector& sector : sectors) {
        if (!has_bearing_limits(sector)) continue;
        for (const double limit_deg : {sector.from_deg, sector.to_deg}) {
            if (!visit(Edge{difference_deg(limit_deg, bearing_deg), transition_of(sector)})) return;
        }
    }
}

template <typename Visit>
void for_each_elevation_edge(std::span<const Sector> sectors, double elevation_deg, Visit visit) {
    for (const Sector& sector : sectors) {
        for (const double limit_deg : {sector.from_elevation_deg, sector.to_elevation_deg}) {
            if (std::abs(limit_deg) >= zenith_deg) continue;
            if (!visit(Edge{limit_deg - elevation_deg, transition_of(sector)})) return;
        }
    }
}

// The factors across the limits of bearing, times `weight`, at an elevation that lies in no transition.
void add_across_bearings(std::span<const Sector> sectors, const Direction& direction, double widest_deg,
                         double weight, SectorFactors& factors) {
    bool graded = false;
    for_each_bearing_edge(sectors, direction.bearing_deg, [&](const Edge& edge) {
        graded = is_inside(edge);
        return !graded;
    });
    const auto look_at = [&](double at_deg) {
        return look_of(sectors, {direction.bearing_deg + at_deg, direction.elevation_deg});
    };
    if (!graded) {
        add(look_at(0), weight, factors);
        return;
    }
    Edges edges;
    for_each_bearing_edge(sectors, direction.bearing_deg, [&](const Edge& edge) {
        if (2 * std::abs(edge.at_deg) < widest_deg &&
            !(look_at(edge.at_deg - beside_deg) == look_at(edge.at_deg + beside_deg)))
            edges.insert(edge);
        return true;
    });
    if (edges.size() == 0) {
        add(look_at(0), weight, factors);
        return;
    }
    edges.for_each_piece([&](double at_deg, double share) { add(look_at(at_deg), weight * share, factors); });
}

// Whether a limit of elevation parts anything that the direction shows.
bool parts_anything(std::span<const Sector> sectors, const Direction& direction, double at_deg,
                    double widest_deg) {
    for (const double aside_deg : {0.0, -widest_deg / 2, widest_deg / 2}) {
        const double bearing_deg = direction.bearing_deg + aside_deg;
        const double limit_deg = direction.elevation_deg + at_deg;
        if (!(look_of(sectors, {bearing_deg, limit_deg - beside_deg}) ==
              look_of(sectors, {bearing_deg, limit_deg + beside_deg})))
            return true;
    }
    return false;
}

}  // namespace

double wrapped_deg(double angle_deg) {
    if (!std::isfinite(angle_deg)) return 0;
    double result = std::fmod(angle_deg, 360.0);
    if (result < 0) result += 360;
    return result < 360 ? result : 0;  // -1e-20 + 360 is 360
}

double bearing_from_seaward_deg(const std::array<double, 3>& to_light_m, double true_north_deg) {
    if (to_light_m[0] == 0 && to_light_m[1] == 0) return 0;
    return wrapped_deg(std::atan2(to_light_m[0], to_light_m[1]) * deg_per_rad - true_north_deg);
}

double bearing_from_ahead_deg(const std::array<double, 3>& to_eye_m) {
    if (to_eye_m[0] == 0 && to_eye_m[1] == 0) return 0;
    return wrapped_deg(std::atan2(to_eye_m[0], to_eye_m[1]) * deg_per_rad);
}

double sector_width_deg(const Sector& sector) {
    const double turn_deg = sector.to_deg - sector.from_deg;
    const double width_deg = wrapped_deg(turn_deg);
    return width_deg == 0 && turn_deg != 0 ? 360 : width_deg;
}

SectorFactors sector_factors(std::span<const Sector> sectors, double bearing_deg, double elevation_deg) {
    SectorFactors factors{};
    if (sectors.empty()) {
        factors.fill(1);
        return factors;
    }
    const Direction direction = {bearing_deg, elevation_deg};
    const double widest_deg = widest_transition(sectors);
    if (widest_deg == 0) {
        add(look_of(sectors, direction), 1, factors);
        return factors;
    }
    bool graded = false;
    for_each_elevation_edge(sectors, elevation_deg, [&](const Edge& edge) {
        graded = is_inside(edge);
        return !graded;
    });
    if (!graded) {
        add_across_bearings(sectors, direction, widest_deg, 1, factors);
        return factors;
    }
    Edges edges;
    for_each_elevation_edge(sectors, elevation_deg, [&](const Edge& edge) {
        if (2 * std::abs(edge.at_deg) < widest_deg &&
            parts_anything(sectors, direction, edge.at_deg, widest_deg))
            edges.insert(edge);
        return true;
    });
    edges.for_each_piece([&](double at_deg, double share) {
        add_across_bearings(sectors, {bearing_deg, elevation_deg + at_deg}, widest_deg, share, factors);
    });
    return factors;
}

}  // namespace seaglare::lightdb
