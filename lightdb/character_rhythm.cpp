// From a class to durations. What the notation leaves open follows practice (character_practice.h), and every choice is
// stated.
#include <algorithm>
#include <cmath>

#include "lightdb/character_notation.h"
#include "lightdb/character_practice.h"

namespace seaglare::lightdb {
namespace {

constexpr double sum_tolerance_s = 0.011;  // lists print tenths
constexpr double steady_level =
    0.1;  // of the flash, in a fixed and flashing light; neither lists nor charts tell

std::string seconds(double value) {
    return number_text(std::round(value * 1000) / 1000) + " s";
}

class Layout {
  public:
    Layout(const Notation& notation, Character& out) : notation_(notation), out_(out) {}

    void run() {
        terms_ = notation_.terms;
        if (terms_.empty()) terms_.push_back({missing_class(), {}, {}});
        if (!notation_.phases.empty()) {
            take_written_list();
        } else {
            if (steady() && !notation_.alternating) {
                if (notation_.period_s)
                    out_.warnings.emplace_back("a fixed light has no period: it is ignored");
                return;
            }
            period_s_ = notation_.period_s.value_or(0);
            if (period_s_ == 0) assume_period();
            build();
        }
        colour_phases();
        if (notation_.fixed_under) light_the_eclipses();
        double sum = 0;
        for (const Phase& phase : out_.rhythm.phases)
            sum += phase.duration_s;
        out_.rhythm.period_s = sum;
        check_class();
    }

  private:
    const ClassTerm& first() const { return terms_.front(); }
    bool steady() const { return terms_.size() == 1 && first().kind == ClassKind::fixed; }

    void assume(const std::string& text) { out_.assumptions.push_back(text); }
    void warn(const std::string& text) { out_.warnings.push_back(text); }
    void push(double duration_s, bool lit) {
        if (duration_s > 0) out_.rhythm.phases.push_back({duration_s, lit, Colour::white});
    }

    // A bare "Dir" or "Al": the durations tell, else nothing does.
    ClassKind missing_class() {
        if (notation_.alternating) return ClassKind::fixed;
        if (!notation_.phases.empty()) {
            double lit = 0;
            double dark = 0;
            for (const WrittenPhase& phase : notation_.phases)
                (phase.lit ? lit : dark) += phase.duration_s;
            const ClassKind kind = lit > dark    ? ClassKind::occulting
                                   : lit == dark ? ClassKind::isophase
                                                 : ClassKind::flashing;
            assume("no class is written: the durations make it " + kind_name(kind));
            return kind;
        }
        const ClassKind kind = notation_.period_s ? ClassKind::isophase : ClassKind::fixed;
        assume("no class is written: " + kind_name(kind) + " assumed");
        return kind;
    }

    static std::string kind_name(ClassKind kind) {
        switch (kind) {
            case ClassKind::occulting:
                return "occulting";
            case ClassKind::isophase:
                return "isophase";
            case ClassKind::fixed:
                return "fixed";
            default:
                return "flashing";
        }
    }

    int flashes_in(const ClassTerm& term) const {
        int count = 0;
        for (const int group : term.groups)
            count += group;
        return count;
    }

    // The list's own durations stand. A list shorter than the period is followed by darkness, a longer one
    // makes the period; either is said.
    void take_written_list() {
        for (const WrittenPhase& phase : notation_.phases)
            out_.written_phases.push_back({phase.duration_s, phase.lit, out_.colours.front()});
        double sum = 0;
        int flashes = 0;
        bool last_lit = false;
        for (const WrittenPhase& phase : notation_.phases) {
            if (phase.lit && (flashes == 0 || !last_lit)) ++flashes;
            last_lit = phase.lit;
            push(phase.duration_s, phase.lit);
            sum += phase.duration_s;
        }
        if (notation_.period_s && std::abs(*notation_.period_s - sum) > sum_tolerance_s) {
            const double period_s = *notation_.period_s;
            std::string text =
                "the durations add up to " + seconds(sum) + ", the period is " + seconds(period_s) + ": ";
            if (sum < period_s) {
                text += "the light stays dark for the other " + seconds(period_s - sum);
                push(period_s - sum, false);
            } else {
                text += "the durations are used";
            }
            warn(text);
        } else if (notation_.period_s && notation_.period_s != sum) {
            out_.rhythm.phases.back().duration_s +=
                *notation_.period_s - sum;  // the rounding of sums of tenths
        }
        if (out_.rhythm.phases.size() > 1 && out_.rhythm.phases.back().lit == false &&
            out_.rhythm.phases[out_.rhythm.phases.size() - 2].lit == false) {
            out_.rhythm.phases[out_.rhythm.phases.size() - 2].duration_s +=
                out_.rhythm.phases.back().duration_s;
            out_.rhythm.phases.pop_back();
        }
        const int written = terms_.size() == 1 ? flashes_in(first()) : 0;
        if (written > 0 && first().kind != ClassKind::occulting && written != flashes)
            warn("the group counts " + std::to_string(written) + ", the durations show " +
                 std::to_string(flashes));
    }

    void assume_period() {
        if (terms_.size() == 1 && is_quick(first().kind) && first().groups.empty()) {
            period_s_ = quick_rate(first().kind).pitch_s;
            if (notation_.alternating)
                period_s_ *= static_cast<double>(std::max<std::size_t>(2, out_.colours.size()));
            return;  // said with the rate
        }
        double period_s = 0;
        for (const ClassTerm& term : terms_) {
            const double count = std::max(1, flashes_in(term));
            switch (term.kind) {
                case ClassKind::fixed:
                    period_s += 2.0 * static_cast<double>(std::max<std::size_t>(2, out_.colours.size()));
                    break;
                case ClassKind::isophase:
                    period_s += 4;
                    break;
                case ClassKind::morse:
                    period_s += 10;
                    break;
                case ClassKind::long_flashing:
                    period_s += 5 * count + 5;
                    break;
                case ClassKind::occulting:
                case ClassKind::flashing:
                    period_s += 2 * count + 3;
                    break;
                default:
                    period_s += is_interrupted(term.kind) ? 10 : quick_rate(term.kind).pitch_s * count + 5;
            }
        }
        if (notation_.fixed_under || period_s <= 0) period_s = std::max(period_s, 5.0);
        period_s_ = period_s;
        assume("no period is written: " + seconds(period_s_) + " assumed");
    }

    void build() {
        if (terms_.size() > 1) return build_sum();
        const ClassTerm& term = first();
        switch (term.kind) {
            case ClassKind::fixed:
                return;  // alternating: the colours fill the period
            case ClassKind::isophase:
                push(period_s_ / 2, true);
                push(period_s_ / 2, false);
                return;
            case ClassKind::occulting:
                return build_occulting(term);
            case ClassKind::morse:
                return build_morse(term);
            case ClassKind::flashing:
                return build_flashing(term, flash_length(term), true);
            case ClassKind::long_flashing:
                return build_long(term);
            default:
                break;
        }
        if (is_interrupted(term.kind)) return build_interrupted(term);
        build_quick(term);
    }

    double flash_length(const ClassTerm& term) const {
        const double usual = term.groups.empty() && period_s_ >= 4 ? 1.0 : 0.5;
        return std::min(usual, period_s_ / 3);
    }

    // Groups of flashes; between groups of a composite at least three times the eclipse within a group, so
    // that they read as groups, and the longest eclipse last, so that the count has a start.
    void build_flashing(const ClassTerm& term, double flash_s, bool say) {
        const std::vector<int> groups = term.groups.empty() ? std::vector<int>{repeats()} : term.groups;
        const bool alternate_singles = term.groups.empty() && repeats() > 1;
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
            if (say) assume("flashes of " + seconds(flash_s) + " assumed");
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
        push(period_s_ - flash_s * flashes - gap_s * inner - 3 * gap_s * between, false);
        if (say)
            assume("flashes of " + seconds(flash_s) + " and eclipses of " + seconds(gap_s) +
                   " within a group assumed");
    }

    void build_long(const ClassTerm& term) {
        const int flashes = std::max(1, flashes_in(term));
        double flash_s = 2.0;
        if (period_s_ < 4.0 * flashes) {
            flash_s = period_s_ / (2.0 * flashes + 1);
            warn("a period of " + seconds(period_s_) +
                 " leaves no room for flashes of 2 s, the least a long flash lasts");
        }
        if (flashes == 1) {
            push(flash_s, true);
            push(period_s_ - flash_s, false);
            assume("a long flash of " + seconds(flash_s) + " assumed");
            return;
        }
        build_flashing(term, flash_s, true);
    }

    void build_occulting(const ClassTerm& term) {
        if (term.groups.empty() && repeats() > 1) {  // one appearance of light for each colour
            const double pitch_s = period_s_ / repeats();
            const double eclipse_s = std::min(1.0, pitch_s / 4);
            for (int i = 0; i < repeats(); ++i) {
                push(pitch_s - eclipse_s, true);
                push(eclipse_s, false);
            }
            assume("eclipses of " + seconds(eclipse_s) + " assumed");
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
        assume("eclipses of " + seconds(dark_s) +
               (eclipses > 1 ? ", " + seconds(light_s) + " of light between them," : "") + " assumed");
    }

    void build_quick(const ClassTerm& term) {
        const QuickRate rate = quick_rate(term.kind);
        const std::string per_minute(rate.per_minute);
        if (term.groups.empty()) {
            if (notation_.period_s) {
                warn("a continuous quick light has no period: taken as one flash every " +
                     seconds(period_s_));
                const double flash_s = std::min(rate.flash_s, period_s_ / 2);
                push(flash_s, true);
                push(period_s_ - flash_s, false);
                return;
            }
            const int flashes = repeats();
            for (int i = 0; i < flashes; ++i) {
                push(rate.flash_s, true);
                push(rate.pitch_s - rate.flash_s, false);
            }
            assume(per_minute + " flashes a minute, each of " + seconds(rate.flash_s) + ", assumed");
            return;
        }
        const double pitch_s = push_quick_groups(term, period_s_);
        double used = 0;
        for (const Phase& phase : out_.rhythm.phases)
            used += phase.duration_s;
        if (used >= period_s_)
            throw CharacterError(0, "the flashes of this group do not fit into " + seconds(period_s_));
        push(period_s_ - used, false);
        assume(number_text(std::round(60 / pitch_s)) + " flashes a minute within the group assumed");
    }

    // Every group but the last is followed by its long eclipse; returns the pitch.
    double push_quick_groups(const ClassTerm& term, double room_s) {
        const QuickRate rate = quick_rate(term.kind);
        const int flashes = std::max(1, flashes_in(term));
        const int groups = static_cast<int>(std::max<std::size_t>(1, term.groups.size()));
        // The last eclipse must stand out: two pitches of darkness or more.
        const double pitch_s =
            std::clamp(room_s / (flashes + 2.0 * groups - 1 + 0.5), rate.fastest_pitch_s, rate.pitch_s);
        const double flash_s = std::min(rate.flash_s, 0.4 * pitch_s);
        for (int g = 0; g < groups; ++g) {
            const int count = term.groups.empty() ? 1 : term.groups[static_cast<std::size_t>(g)];
            for (int i = 0; i < count; ++i) {
                push(flash_s, true);
                if (i + 1 < count) push(pitch_s - flash_s, false);
            }
            if (g + 1 < groups) push(3 * pitch_s - flash_s, false);
        }
        return pitch_s;
    }

    void build_interrupted(const ClassTerm& term) {
        const QuickRate rate = quick_rate(term.kind);
        const int flashes = std::max(2, static_cast<int>(std::floor(0.6 * period_s_ / rate.pitch_s)));
        const double train_s = flashes * rate.pitch_s;
        if (train_s >= period_s_)
            throw CharacterError(0, "an interrupted light needs a period longer than two flashes");
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
        bool said_long = false;
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            const ClassTerm& term = terms_[t];
            const int count = std::max(1, flashes_in(term));
            double flash_s = 0.5;
            double gap_s = 1.0;
            if (is_quick(term.kind)) {
                const QuickRate rate = quick_rate(term.kind);
                flash_s = rate.flash_s;
                gap_s = rate.pitch_s - rate.flash_s;
                assume(std::string(rate.per_minute) + " flashes a minute within the group assumed");
            } else if (term.kind == ClassKind::long_flashing) {
                flash_s = 2.0;
                said_long = true;
            } else if (term.kind != ClassKind::flashing) {
                throw CharacterError(0, "only flashes add up: Fl, LFl, Q, VQ or UQ");
            }
            for (int i = 0; i < count; ++i) {
                push(flash_s, true);
                push(gap_s, false);
            }
        }
        double used = 0;
        for (const Phase& phase : out_.rhythm.phases)
            used += phase.duration_s;
        if (used >= period_s_) throw CharacterError(0, "these flashes do not fit into " + seconds(period_s_));
        out_.rhythm.phases.back().duration_s += period_s_ - used;
        if (said_long) assume("a long flash of 2 s assumed");
    }

    // A dash is three dots, darkness within a letter one dot, between letters three (ITU-R M.1677); the rest
    // of the period is dark, at least five dots so that the letter has a start.
    void build_morse(const ClassTerm& term) {
        if (term.morse.empty()) throw CharacterError(0, "Mo needs its letter, as in Mo(A)");
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
        assume("a dot of " + seconds(dot_s) + ", a dash of three dots assumed");
    }

    // One flash per colour of an alternating light whose group is not written.
    int repeats() const {
        return notation_.alternating ? static_cast<int>(std::max<std::size_t>(1, out_.colours.size())) : 1;
    }

    void colour_phases() {
        std::vector<Phase>& phases = out_.rhythm.phases;
        const std::vector<Colour>& colours = out_.colours;
        if (!notation_.alternating) {
            for (Phase& phase : phases)
                phase.colour = colours.front();
            return;
        }
        if (colours.size() < 2) warn("an alternating light has two colours or more");
        if (phases.empty()) {  // alternating without darkness
            for (const Colour colour : colours)
                phases.push_back({period_s_ / static_cast<double>(colours.size()), true, colour});
            if (colours.size() > 1) assume("each colour is shown for an equal part of the period");
            return;
        }
        std::size_t next = 0;
        std::size_t lit = 0;
        for (Phase& phase : phases)
            if (phase.lit) {
                phase.colour = colours[next++ % colours.size()];
                ++lit;
            }
        if (lit % colours.size() == 0) return;
        // An odd count: the colours come round only after several periods.
        const std::vector<Phase> once = phases;
        for (std::size_t turn = 1; turn < colours.size(); ++turn)
            for (Phase phase : once) {
                if (phase.lit) phase.colour = colours[next++ % colours.size()];
                phases.push_back(phase);
            }
        assume("the colours change from flash to flash, so the whole repeats after " +
               std::to_string(colours.size()) + " periods");
    }

    // Fixed and flashing: no darkness, but a weaker steady light. Alternating, the steady light has the first
    // colour.
    void light_the_eclipses() {
        std::size_t flash = 0;
        for (Phase& phase : out_.rhythm.phases) {
            if (!phase.lit) {
                phase = {phase.duration_s, true, out_.colours.front(), steady_level};
            } else if (notation_.alternating && out_.colours.size() > 1) {
                phase.colour = out_.colours[1 + flash++ % (out_.colours.size() - 1)];
            }
        }
        assume("the steady light is taken as a tenth of the flashes");
    }

    void check_class() {
        double lit = 0;
        double dark = 0;
        int flashes = 0;
        for (const Phase& phase : out_.rhythm.phases) {
            (phase.lit ? lit : dark) += phase.duration_s;
            if (phase.lit) ++flashes;
        }
        if (terms_.size() > 1 || notation_.alternating || notation_.fixed_under) return;
        const double per_minute = 60.0 * flashes / std::max(1e-9, lit + dark);
        if (first().kind == ClassKind::flashing && first().groups.empty() && per_minute >= 50)
            warn("flashing means fewer than 50 flashes a minute, this has " +
                 number_text(std::round(per_minute)));
        if ((first().kind == ClassKind::flashing || first().kind == ClassKind::long_flashing) && lit > dark)
            warn("flashing means more darkness than light, this has more light");
        if (first().kind == ClassKind::occulting && lit < dark)
            warn("occulting means more light than darkness, this has more darkness");
        if (first().kind == ClassKind::long_flashing && !out_.written_phases.empty())
            for (const Phase& phase : out_.rhythm.phases)
                if (phase.lit && phase.duration_s < 2.0) {
                    warn("a long flash lasts 2 s or more, this has one of " + seconds(phase.duration_s));
                    break;
                }
    }

    const Notation& notation_;
    Character& out_;
    std::vector<ClassTerm> terms_;
    double period_s_ = 0;
};

}  // namespace

void lay_out_phases(const Notation& notation, Character& character) {
    Layout(notation, character).run();
}

}  // namespace seaglare::lightdb
