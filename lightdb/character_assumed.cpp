// Durations that the notation leaves open, by practice (character_practice.h). Every choice is stated.
#include <algorithm>
#include <cmath>

#include "lightdb/character_practice.h"

namespace seaglare::lightdb {
namespace {

constexpr int most_interrupted_flashes = 240;  // UQ for a minute

class Builder {
  public:
    explicit Builder(const OpenRhythm& light) : light_(light), period_s_(light.period_s) {}

    AssumedPhases build() {
        if (light_.terms.size() > 1) {
            build_sum();
        } else {
            build_one(light_.terms.front());
        }
        // To the last bit the period that is written, whatever the sums round to.
        if (!out_.phases.empty()) out_.phases.back().first += period_s_ - used_s();
        return std::move(out_);
    }

  private:
    void build_one(const ClassTerm& term) {
        switch (term.kind) {
            case ClassKind::fixed:
                return;  // alternating: the colours fill the period
            case ClassKind::isophase:
                return build_isophase();
            case ClassKind::occulting:
                return build_occulting(term);
            case ClassKind::morse:
                return build_morse(term);
            case ClassKind::flashing:
                return build_flashing(term, flash_length_s(term));
            case ClassKind::long_flashing:
                return build_long(term);
            default:
                return is_interrupted(term.kind) && term.groups.empty() ? build_interrupted(term)
                                                                        : build_quick(term);
        }
    }

    void push(double duration_s, bool lit) {
        if (duration_s > 0) out_.phases.emplace_back(duration_s, lit);
    }
    void assume(const std::string& text) { out_.assumptions.push_back(text); }
    void warn(const std::string& text) { out_.warnings.push_back(text); }
    double used_s() const {
        double used_s = 0;
        for (const auto& [duration_s, lit] : out_.phases)
            used_s += duration_s;
        return used_s;
    }
    [[noreturn]] void fail_for_room(const std::string& what) const {
        throw CharacterError(light_.period_is_written ? light_.period_at : light_.class_at,
                             what + " do not fit into " + seconds_text(period_s_) +
                                 ": expected a longer period or fewer flashes");
    }

    // One light and one eclipse of the same length, for each colour of an alternating light.
    void build_isophase() {
        const double half_s = period_s_ / (2.0 * light_.repeats);
        for (int i = 0; i < light_.repeats; ++i) {
            push(half_s, true);
            push(half_s, false);
        }
    }

    double flash_length_s(const ClassTerm& term) const {
        const double usual_s = term.groups.empty() && period_s_ >= 4 ? 1.0 : 0.5;
        return std::min(usual_s, period_s_ / 3);
    }

    // Groups of flashes; between groups of a composite at least three times the eclipse within a group, so
    // that they read as groups, and the longest eclipse last, so that the count has a start.
    void build_flashing(const ClassTerm& term, double flash_s) {
        const std::vector<int> groups = term.groups.empty() ? std::vector<int>{light_.repeats} : term.groups;
        const bool alternate_singles = term.groups.empty() && light_.repeats > 1;
        int flashes = 0;
        for (const int group : groups)
            flashes += group;
        if (flashes == 1 || alternate_singles) {
            const double pitch_s = period_s_ / flashes;
            flash_s = std::min(flash_s, pitch_s / 3);
            for (int i = 0; i < flashes; ++i) {
                push(flash_s, true);
                push(pitch_s - flash_s, false);
            }
            assume("flashes of " + seconds_text(flash_s) + " assumed");
            return;
        }
        const int inner = flashes - static_cast<int>(groups.size());
        const int between = static_cast<int>(groups.size()) - 1;
        double gap_s = std::max(1.0, flash_s);
        const auto fits = [&](double flash, double gap) {
            const double used = flash * flashes + gap * inner + 3 * gap * between;
            return period_s_ - used >= (between > 0 ? 3 : 2) * gap - 1e-9;
        };
        if (!fits(flash_s, gap_s)) {
            const double unit_s = period_s_ / (flashes + inner + 3 * between + 3);
            flash_s = std::min(flash_s, unit_s);
            gap_s = unit_s;
        }
        for (std::size_t g = 0; g < groups.size(); ++g) {
            for (int i = 0; i < groups[g]; ++i) {
                push(flash_s, true);
                if (i + 1 < groups[g]) push(gap_s, false);
            }
            if (g + 1 < groups.size()) push(3 * gap_s, false);
        }
        push(period_s_ - used_s(), false);
        assume(
            "flashes of " + seconds_text(flash_s) +
            (inner > 0 ? " and eclipses of " + seconds_text(gap_s) + " within a group assumed" : " assumed"));
    }

    void build_long(const ClassTerm& term) {
        const int flashes = std::max(light_.repeats, counted(term));
        double flash_s = 2.0;
        if (period_s_ < 4.0 * flashes) {
            flash_s = period_s_ / (2.0 * flashes + 1);
            warn("a period of " + seconds_text(period_s_) +
                 " leaves no room for flashes of 2 s, the least a long flash lasts");
        }
        if (flashes == 1) {
            push(flash_s, true);
            push(period_s_ - flash_s, false);
            assume("a long flash of " + seconds_text(flash_s) + " assumed");
            return;
        }
        build_flashing(term, flash_s);
    }

    void build_occulting(const ClassTerm& term) {
        if (term.groups.empty() && light_.repeats > 1) {  // one appearance of light for each colour
            const double pitch_s = period_s_ / light_.repeats;
            // A third: half a second in the "Al.Oc.BuY.3s" of IALA's emergency wreck buoy (O-133).
            const double eclipse_s = std::min(1.0, pitch_s / 3);
            for (int i = 0; i < light_.repeats; ++i) {
                push(pitch_s - eclipse_s, true);
                push(eclipse_s, false);
            }
            assume("eclipses of " + seconds_text(eclipse_s) + " assumed");
            return;
        }
        const std::vector<int> groups = term.groups.empty() ? std::vector<int>{1} : term.groups;
        int eclipses = 0;
        for (const int group : groups)
            eclipses += group;
        const int inner = eclipses - static_cast<int>(groups.size());
        const int between = static_cast<int>(groups.size()) - 1;
        double dark_s = eclipses == 1 && period_s_ >= 8 ? 2.0 : 1.0;
        double light_s = period_s_ >= 9 ? 2.0 : 1.0;
        const double used = dark_s * eclipses + light_s * inner + 3 * light_s * between;
        if (period_s_ - used < 2 * light_s) {
            const double unit_s = period_s_ / (eclipses + inner + 3 * between + 3);
            dark_s = std::min(dark_s, unit_s);
            light_s = unit_s;
        }
        const double last_light_s = period_s_ - dark_s * eclipses - light_s * inner - 3 * light_s * between;
        push(last_light_s, true);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            for (int i = 0; i < groups[g]; ++i) {
                push(dark_s, false);
                if (i + 1 < groups[g]) push(light_s, true);
            }
            if (g + 1 < groups.size()) push(3 * light_s, true);
        }
        assume("eclipses of " + seconds_text(dark_s) +
               (eclipses > 1 ? ", " + seconds_text(light_s) + " of light between them," : "") + " assumed");
    }

    void build_quick(const ClassTerm& term) {
        const QuickRate rate = quick_rate(term.kind);
        if (!term.groups.empty()) return build_quick_groups(term, rate);
        if (light_.period_is_written) {
            warn("a continuous quick light has no period: taken as one flash every " +
                 seconds_text(period_s_ / light_.repeats));
            const double pitch_s = period_s_ / light_.repeats;
            const double flash_s = std::min(rate.flash_s, pitch_s / 2);
            for (int i = 0; i < light_.repeats; ++i) {
                push(flash_s, true);
                push(pitch_s - flash_s, false);
            }
            return;
        }
        for (int i = 0; i < light_.repeats; ++i) {
            push(rate.flash_s, true);
            push(rate.pitch_s - rate.flash_s, false);
        }
        assume(std::string(rate.per_minute) + " flashes a minute, each of " + seconds_text(rate.flash_s) +
               ", assumed");
    }

    // Every group but the last is followed by an eclipse of three pitches, the last by the rest of the period.
    void build_quick_groups(const ClassTerm& term, const QuickRate& rate) {
        const int flashes = counted(term);
        const auto groups = static_cast<double>(term.groups.size());
        // The last eclipse must stand out: two pitches of darkness or more.
        const double pitch_s =
            std::clamp(period_s_ / (flashes + 2.0 * groups - 1 + 0.5), rate.fastest_pitch_s, rate.pitch_s);
        const double flash_s = std::min(rate.flash_s, 0.4 * pitch_s);
        for (std::size_t g = 0; g < term.groups.size(); ++g) {
            for (int i = 0; i < term.groups[g]; ++i) {
                push(flash_s, true);
                if (i + 1 < term.groups[g]) push(pitch_s - flash_s, false);
            }
            if (g + 1 < term.groups.size()) push(3 * pitch_s - flash_s, false);
        }
        if (used_s() >= period_s_) fail_for_room("the flashes of this group");
        push(period_s_ - used_s(), false);
        assume(number_text(std::round(60 / pitch_s)) + " flashes a minute within the group assumed");
    }

    void build_interrupted(const ClassTerm& term) {
        const QuickRate rate = quick_rate(term.kind);
        const int flashes = std::max(2, static_cast<int>(std::floor(0.6 * period_s_ / rate.pitch_s)));
        // Nobody counts as many, and a light file full of such periods would need thousands of bytes for each of its own.
        if (flashes > most_interrupted_flashes) {
            throw CharacterError(
                light_.period_is_written ? light_.period_at : light_.class_at,
                "more than " + std::to_string(most_interrupted_flashes) +
                    " flashes in one period of an interrupted light: expected a shorter period");
        }
        const double train_s = flashes * rate.pitch_s;
        if (train_s >= period_s_) fail_for_room("two flashes and the eclipse of an interrupted light");
        for (int i = 0; i < flashes; ++i) {
            push(rate.flash_s, true);
            push(i + 1 < flashes ? rate.pitch_s - rate.flash_s
                                 : rate.pitch_s - rate.flash_s + period_s_ - train_s,
                 false);
        }
        assume(std::string(rate.per_minute) +
               " flashes a minute for six tenths of the period, then the eclipse, assumed");
    }

    // "Q(6)+LFl", "Fl+LFl": the parts follow each other, the rest of the period is dark.
    void build_sum() {
        bool has_long = false;
        for (const ClassTerm& term : light_.terms) {
            const int count = std::max(1, counted(term));
            double flash_s = 0.5;
            double gap_s = 1.0;
            if (is_quick(term.kind)) {
                const QuickRate rate = quick_rate(term.kind);
                flash_s = rate.flash_s;
                gap_s = rate.pitch_s - rate.flash_s;
                assume(std::string(rate.per_minute) + " flashes a minute within the group assumed");
            } else if (term.kind == ClassKind::long_flashing) {
                flash_s = 2.0;
                has_long = true;
            } else if (term.kind == ClassKind::flashing) {
                assume("flashes of " + seconds_text(flash_s) + " and eclipses of " + seconds_text(gap_s) +
                       " within the group assumed");
            } else {
                throw CharacterError(light_.class_at, "only flashes add up: expected Fl, LFl, Q, VQ or UQ");
            }
            for (int i = 0; i < count; ++i) {
                push(flash_s, true);
                push(gap_s, false);
            }
        }
        if (used_s() >= period_s_) fail_for_room("these flashes");
        out_.phases.back().first += period_s_ - used_s();
        if (has_long) assume("a long flash of 2 s assumed");
    }

    // A dash is three dots, darkness within a letter one dot, between letters three (ITU-R M.1677); the rest
    // of the period is dark, at least five dots so that the letter has a start.
    void build_morse(const ClassTerm& term) {
        std::vector<std::pair<int, bool>> units;
        for (std::size_t l = 0; l < term.morse.size(); ++l) {
            if (l > 0) units.back().first = 3;
            for (const char mark : morse_code(term.morse[l])) {
                units.emplace_back(mark == '-' ? 3 : 1, true);
                units.emplace_back(1, false);
            }
        }
        units.pop_back();
        int total = 0;
        for (const auto& [count, lit] : units)
            total += count;
        const double dot_s = std::min(0.5, period_s_ / (total + 5));
        for (const auto& [count, lit] : units)
            push(count * dot_s, lit);
        push(period_s_ - total * dot_s, false);
        assume("a dot of " + seconds_text(dot_s) + ", a dash of three dots assumed");
    }

    const OpenRhythm& light_;
    double period_s_;
    AssumedPhases out_;
};

}  // namespace

AssumedPhases assume_phases(const OpenRhythm& light) {
    return Builder(light).build();
}

}  // namespace seaglare::lightdb
