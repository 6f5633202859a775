// Front and rear lights of a leading line: do they stand on it, is the rear one higher, do both show along it?
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>

#include "lightdb/lint_checks.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb::lint_checks {
namespace {

constexpr double farthest_m = 20000;          // between front and rear: a name does not make a pair beyond it
constexpr double bearing_rounding_deg = 0.5;  // of whole degrees
constexpr double survey_m = 10;               // lists place the structure, not the lamp
constexpr std::size_t shortest_shared_name = 4;

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Where the word stands in a name in lower case, whole and not behind "from ": "340 m from front" is no front light.
std::size_t word_at(const std::string& name, std::string_view word) {
    for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
        const bool whole = (at == 0 || !is_letter(name[at - 1])) &&
                           (at + word.size() == name.size() || !is_letter(name[at + word.size()]));
        const std::string_view before = std::string_view(name).substr(0, at);
        if (whole && !before.ends_with("from ") && !before.ends_with("from common ") &&
            !before.ends_with("with ") && !before.ends_with("of "))
            return at;
    }
    return std::string::npos;
}

// "…, lamp 2 of 3" and "… (2)", as importers name what stands beside the first lamp of one structure: the first is the one
// that leads.
bool is_further_lamp(const std::string& name) {
    const std::size_t lamp = name.rfind(", lamp ");
    if (lamp != std::string::npos && !name.substr(lamp).starts_with(", lamp 1 of")) return true;
    const std::size_t bracket = name.rfind(" (");
    return bracket != std::string::npos && name.size() == bracket + 4 && name.back() == ')' &&
           name[bracket + 2] >= '2' && name[bracket + 2] <= '9';
}

// An importer's note: the height is no fact that could contradict another.
bool height_is_assumed(const Light& light) {
    return light.source.find("no height is given") != std::string::npos;
}

struct End {
    std::size_t subject = 0;
    std::string root;  // the name before the word
};

std::string root_of(const std::string& name, std::size_t at) {
    std::string root = name.substr(0, at);
    while (!root.empty() && !is_letter(root.back()) && (root.back() < '0' || root.back() > '9'))
        root.pop_back();
    return root;
}

// "288°" of "Rear, 340 meters 288° from front", "073°30'".
std::optional<double> named_bearing_deg(const std::string& name) {
    const std::size_t from = name.find(" from ");
    if (from == std::string::npos || name.find("front", from) == std::string::npos) return std::nullopt;
    const std::size_t sign = name.rfind("\xC2\xB0", from);
    if (sign == std::string::npos) return std::nullopt;
    std::size_t start = sign;
    while (start > 0 &&
           (std::isdigit(static_cast<unsigned char>(name[start - 1])) != 0 || name[start - 1] == '.'))
        --start;
    double degrees = 0;
    const auto read = std::from_chars(name.data() + start, name.data() + sign, degrees);
    if (read.ec != std::errc{} || degrees > 360) return std::nullopt;
    double minutes = 0;
    const auto rest = std::from_chars(name.data() + sign + 2, name.data() + from, minutes);
    return degrees + (rest.ec == std::errc{} && minutes < 60 ? minutes / 60 : 0);
}

bool shows_on(const Light& light, double bearing_deg) {
    const SectorFactors factors = sector_factors(light.sectors, bearing_deg);
    return std::any_of(factors.begin(), factors.end(), [](double factor) { return factor > 0; });
}

void check_own_line(const Subject& subject, double bearing_deg, Findings& findings) {
    const Light& light = *subject.light;
    if (light.sector_reference != SectorReference::from_seaward || shows_on(light, bearing_deg)) return;
    findings.push_back(subject.finding(
        LintKind::leading_invisible, "it is dark on its leading line, " + rounded(bearing_deg) + " degrees"));
}

class Pair {
  public:
    Pair(const Subject& front, const Subject& rear, Offset between, Findings& findings)
        : front_(front), rear_(rear), between_(between), findings_(findings) {}

    void check() {
        if (front_.light->height_m > rear_.light->height_m && !height_is_assumed(*front_.light) &&
            !height_is_assumed(*rear_.light))
            add(LintKind::leading_heights, "it is " + rounded(rear_.light->height_m) +
                                               " m high, lower than its front light at " +
                                               rounded(front_.light->height_m) + " m");
        const auto named = named_bearing_deg(rear_.light->name);
        if (named) compare(*named, "its name");
        const auto& own = rear_.light->leading_bearing_deg;
        const auto& of_front = front_.light->leading_bearing_deg;
        if (own) compare(*own, "its leading bearing");
        if (of_front && !(own && agree(*own, *of_front)))
            compare(*of_front, "its front light's leading bearing");
        // The sectors matter on the line as it stands; where the data name no line, that of the positions.
        const std::optional<double> stated = own ? own : of_front ? of_front : named;
        const double line_deg = stated ? *stated : between_.bearing_deg();
        if (!stated && between_.distance_m() < 4 * uncertainty_m()) return;
        check_own_line(front_, line_deg, findings_);
        check_own_line(rear_, line_deg, findings_);
    }

  private:
    static bool agree(double a_deg, double b_deg) {
        return std::abs(std::remainder(a_deg - b_deg, 360.0)) <= 2 * bearing_rounding_deg;
    }
    double uncertainty_m() const {
        return std::max(survey_m,
                        position_uncertainty_m(*front_.light) + position_uncertainty_m(*rear_.light));
    }
    void add(LintKind kind, std::string text) {
        LintFinding finding = rear_.finding(kind, std::move(text));
        finding.other = front_.index;
        findings_.push_back(std::move(finding));
    }
    void compare(double stated_deg, const std::string& who) {
        const double off_deg = std::abs(std::remainder(stated_deg - between_.bearing_deg(), 360.0));
        // What rounded positions and a rounded bearing may turn the line by.
        const double distance_m = between_.distance_m();
        if (distance_m <= uncertainty_m()) return;
        const double from_positions_deg =
            std::asin(std::min(1.0, uncertainty_m() / distance_m)) * 57.29577951308232;
        if (off_deg <= from_positions_deg + bearing_rounding_deg) return;
        add(LintKind::leading_bearing,
            who + " puts it on " + rounded(stated_deg) + " degrees from the front light, the positions on " +
                rounded(between_.bearing_deg()) + " at " + rounded(distance_m, 0) + " m");
    }

    const Subject& front_;
    const Subject& rear_;
    Offset between_;
    Findings& findings_;
};

std::size_t shared_length(const std::string& a, const std::string& b) {
    return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

void check_leading_lights(std::span<const Subject> subjects, Findings& findings) {
    std::map<std::string, std::vector<End>> fronts;  // by the first letters of their names
    std::vector<End> rears;
    for (const Subject& subject : subjects) {
        const std::string name = lower_case(subject.light->name);
        if (is_further_lamp(name)) continue;
        const std::size_t rear = word_at(name, "rear");
        const std::size_t front = word_at(name, "front");
        if (rear != std::string::npos) {
            rears.push_back({subject.index, root_of(name, rear)});
        } else if (front != std::string::npos) {
            const std::string root = root_of(name, front);
            fronts[root.substr(0, shortest_shared_name)].push_back({subject.index, root});
        } else if (subject.light->leading_bearing_deg) {
            check_own_line(subject, *subject.light->leading_bearing_deg, findings);
        }
    }
    for (const End& rear : rears) {
        const auto candidates = fronts.find(rear.root.substr(0, shortest_shared_name));
        if (candidates == fronts.end()) continue;
        const End* best = nullptr;
        std::size_t best_length = 0;
        double best_m = farthest_m;
        for (const End& front : candidates->second) {
            const auto between = offset(*subjects[front.subject].light, *subjects[rear.subject].light);
            if (!between || between->distance_m() > farthest_m) continue;
            // "Korsor, Entrance Range" and "Korsor, Entrance Range" share more than "Korsor, Inner Range" does.
            const std::size_t length = shared_length(front.root, rear.root);
            if (length < best_length || (length == best_length && between->distance_m() >= best_m)) continue;
            best = &front;
            best_length = length;
            best_m = between->distance_m();
        }
        if (best == nullptr || best_length < std::min(best->root.size(), rear.root.size())) continue;
        const auto between = offset(*subjects[best->subject].light, *subjects[rear.subject].light);
        Pair(subjects[best->subject], subjects[rear.subject], *between, findings).check();
    }
}

}  // namespace seaglare::lightdb::lint_checks
