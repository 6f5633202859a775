// What a record of the List owes its neighbours: the rest of its name, its range line, its synchronized group.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "lightdb/import/nga_draft.h"
#include "lightdb/import/nga_text.h"
#include "lightdb/units.h"

namespace seaglare::lightdb::nga {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double metres_per_degree = 60 * metres_per_nautical_mile;
constexpr double doubtful_offset_m =
    100;  // beside the range line: beyond what whole seconds of position explain
constexpr double longest_range_line_m = 20000;  // between front and rear light: one of the positions is wrong

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

// Where the word stands that makes it a front light, and not one measured from the front light.
std::size_t front_at(std::string_view name) {
    for (std::size_t at = name.find("front"); at != std::string_view::npos; at = name.find("front", at + 1))
        if (!name.substr(0, at).ends_with("from ") && !name.substr(0, at).ends_with("from common "))
            return at;
    return std::string_view::npos;
}
bool is_front(std::string_view name) {
    return front_at(name) != std::string_view::npos;
}
bool is_rear(std::string_view name) {
    return contains(name, "Rear") || contains(name, "rear");
}
// Rear and middle lights: they have a front light.
bool has_front(std::string_view name) {
    return is_rear(name) || bearing_from_front(name).has_value();
}

std::string without_ending(std::string text, std::string_view ending) {
    if (text.ends_with(ending)) text.resize(text.size() - ending.size());
    while (!text.empty() && (text.back() == ' ' || text.back() == ','))
        text.pop_back();
    return text;
}

// What of a light's name heads the names below it: "Korsor Havn Range" of "Korsor Havn Range, front" for its rear light,
// "Korsor Havn" for other lights; the place in "W. mole, head".
std::string heading_for(const std::string& parent, const std::string& child) {
    if (!is_front(parent)) return parent.substr(0, parent.find(','));
    std::string head = without_ending(without_ending(parent.substr(0, front_at(parent)), ""), "common");
    if (has_front(child) || contains(child, "iddle") || contains(child, "enter")) return head;
    return without_ending(head, "Range");
}

struct Level {
    std::string text;
    std::optional<std::size_t> record;
};

class Names {
  public:
    explicit Names(std::vector<Draft>& drafts) : drafts_(drafts) {}

    void add(std::size_t i, const Heading& heading) {
        Draft& draft = drafts_[i];
        enter(heading);
        const auto [depth, rest] = name_depth(heading.raw_name);
        draft.own_name = tidy_name(rest);
        if (draft.own_name.empty() || (draft.char_no > 1 && !draft.is_racon())) {
            const bool same = i > 0 && drafts_[i - 1].number == draft.number;
            const std::string head = same ? root_name_ : std::string();
            draft.name =
                head + (draft.own_name.empty() || draft.own_name == head ? "" : ", " + draft.own_name);
            draft.name += " (" + std::to_string(draft.char_no) + ")";
            return;
        }
        std::vector<Level> above(levels_.begin(),
                                 levels_.begin() + std::min<std::ptrdiff_t>(depth, std::ssize(levels_)));
        for (std::size_t l = 0; l < above.size(); ++l) {
            const Level& level = above[l];
            if (level.text.empty()) continue;
            const std::string& below = l + 1 < above.size() ? above[l + 1].text : draft.own_name;
            const std::string head = level.record ? heading_for(level.text, below) : level.text;
            if (!head.empty() && head != draft.own_name) draft.name += head + ", ";
        }
        draft.name += draft.own_name;
        if (draft.is_racon()) return;
        if (has_front(draft.own_name)) draft.front = find_front(i, above);
        root_name_ = draft.name;
        levels_ = std::move(above);
        levels_.resize(static_cast<std::size_t>(depth));
        levels_.push_back({draft.own_name, i});
    }

  private:
    void enter(const Heading& heading) {
        if (heading.region != region_) {
            region_ = heading.region;
            subregion_.clear();
            levels_.clear();
            if (!region_.empty()) levels_.push_back({tidy_name(region_), std::nullopt});
        }
        if (heading.subregion != subregion_) {
            subregion_ = heading.subregion;
            if (subregion_.empty()) return;
            const auto [depth, rest] = name_depth(subregion_);
            levels_.resize(static_cast<std::size_t>(depth));
            levels_.push_back({tidy_name(rest), std::nullopt});
        }
    }

    std::optional<std::size_t> find_front(std::size_t i, const std::vector<Level>& above) const {
        if (!above.empty() && above.back().record && is_front(drafts_[*above.back().record].own_name))
            return above.back().record;
        for (std::size_t back = 1; back <= std::min<std::size_t>(6, i); ++back)
            if (is_front(drafts_[i - back].own_name)) return i - back;
        return std::nullopt;
    }

    std::vector<Draft>& drafts_;
    std::vector<Level> levels_;
    std::string region_;
    std::string subregion_;
    std::string root_name_;
};

struct Course {
    double bearing_deg = 0;
    double distance_m = 0;
};
Course course(std::pair<double, double> from_deg, std::pair<double, double> to_deg) {
    const double north_m = (to_deg.first - from_deg.first) * metres_per_degree;
    const double east_m =
        (to_deg.second - from_deg.second) * metres_per_degree * std::cos(from_deg.first * degree);
    double bearing = std::atan2(east_m, north_m) / degree;
    if (bearing < 0) bearing += 360;
    return {bearing, std::hypot(north_m, east_m)};
}

// Of two lights of a range that cannot be that far apart, the one that is farther from its neighbours in the List.
void find_misplaced(std::vector<Draft>& drafts, std::size_t front, std::size_t rear) {
    if (!drafts[front].position_deg || !drafts[rear].position_deg) return;
    const double apart_m = course(*drafts[front].position_deg, *drafts[rear].position_deg).distance_m;
    if (apart_m < longest_range_line_m) return;
    const auto to_neighbours_m = [&](std::size_t i) {
        double nearest = 1e12;
        const std::size_t first = front > 4 ? front - 4 : 0;
        for (std::size_t n = first; n < std::min(drafts.size(), rear + 5); ++n)
            if (n != front && n != rear && drafts[n].position_deg)
                nearest =
                    std::min(nearest, course(*drafts[i].position_deg, *drafts[n].position_deg).distance_m);
        return nearest;
    };
    Draft& wrong = drafts[to_neighbours_m(front) > to_neighbours_m(rear) ? front : rear];
    wrong.misplaced = "the position is " + std::to_string(std::lround(apart_m / 1000)) +
                      " km from the other light of its range";
}

void link_range(std::vector<Draft>& drafts, Draft& rear) {
    if (!rear.front) return;
    Draft& front = drafts[*rear.front];
    std::optional<double> bearing = bearing_from_front(rear.own_name);
    if (front.position_deg && rear.position_deg) {
        const Course computed = course(*front.position_deg, *rear.position_deg);
        if (bearing && computed.distance_m > 1) {
            const double off = std::remainder(*bearing - computed.bearing_deg, 360.0);
            const bool behind = std::abs(off) > 90;
            if (behind || std::abs(std::sin(off * degree)) * computed.distance_m > doubtful_offset_m)
                rear.doubts.push_back("the name puts it on " + std::to_string(std::lround(*bearing)) +
                                      " degrees from the front light, the positions on " +
                                      std::to_string(std::lround(computed.bearing_deg)) + " degrees at " +
                                      std::to_string(std::lround(computed.distance_m)) + " m");
        } else if (!bearing && computed.distance_m > 10) {
            bearing = std::round(computed.bearing_deg * 10) / 10;
        }
    }
    if (!bearing) return;
    rear.range_line_deg.push_back(*bearing);
    front.range_line_deg.push_back(*bearing);
}

class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t root(std::size_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> parent_;
};

std::string list_number(const Draft& draft) {
    return draft.number.substr(0, draft.number.find(' '));
}

void link_synchronized(std::vector<Draft>& drafts) {
    std::map<std::string, std::size_t> by_number;
    for (std::size_t i = 0; i < drafts.size(); ++i)
        if (!drafts[i].is_racon()) by_number.emplace(list_number(drafts[i]), i);
    Groups groups(drafts.size());
    std::vector<bool> grouped(drafts.size());
    const auto join = [&](std::size_t a, std::size_t b) {
        groups.join(a, b);
        grouped[a] = grouped[b] = true;
    };
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        Draft& draft = drafts[i];
        if (draft.remarks.sync_with_front) {
            std::optional<std::size_t> front = draft.front;
            for (std::size_t back = 1; !front && back <= std::min<std::size_t>(4, i); ++back)
                if (is_front(drafts[i - back].own_name)) front = i - back;
            if (front) {
                join(i, *front);
            } else {
                draft.doubts.emplace_back("synchronized with a front light that was not found");
            }
        }
        if (draft.remarks.sync_with_rear) {
            std::size_t rear = i;
            while (rear < drafts.size() && drafts[rear].front != i)
                ++rear;
            if (rear < drafts.size()) {
                join(i, rear);
            } else {
                draft.doubts.emplace_back("synchronized with a rear light that was not found");
            }
        }
        for (const std::string& number : draft.remarks.sync_with) {
            const auto found = by_number.find(number);
            if (found != by_number.end()) {
                join(i, found->second);
            } else {
                draft.doubts.push_back("synchronized with " + number + ", which the List does not have");
            }
        }
    }
    for (std::size_t i = 0; i < drafts.size(); ++i)
        if (grouped[i]) drafts[i].sync_group = "NGA " + list_number(drafts[groups.root(i)]);
}

}  // namespace

bool Draft::is_racon() const {
    return contains(own_name, "RACON") || contains(characteristic, "\xE2\x80\xA2") ||
           contains(characteristic, "(-") || contains(characteristic, "(=)");
}

void link_records(std::vector<Draft>& drafts, const std::vector<Heading>& headings) {
    Names names(drafts);
    for (std::size_t i = 0; i < drafts.size(); ++i)
        names.add(i, headings[i]);
    for (Draft& draft : drafts)
        link_range(drafts, draft);
    for (std::size_t i = 0; i < drafts.size(); ++i)
        if (drafts[i].front) find_misplaced(drafts, *drafts[i].front, i);
    link_synchronized(drafts);
}

}  // namespace seaglare::lightdb::nga
