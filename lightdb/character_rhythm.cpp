// From a character's words to its phases: written ones as they are, assumed ones (character_assumed.cpp) where none are.
#include <algorithm>
#include <cmath>

#include "lightdb/character_notation.h"
#include "lightdb/character_practice.h"

namespace seaglare::lightdb {
namespace {

constexpr double steady_level =
    0.1;  // of the flash, in a fixed and flashing light; neither lists nor charts tell

class Layout {
  public:
    Layout(const Notation& notation, Character& out) : notation_(notation), out_(out) {}

    void run() {
        terms_ = notation_.terms;
        if (terms_.empty()) terms_.push_back({missing_class(), {}, {}});
        for (const ClassTerm& term : terms_)
            if (term.kind == ClassKind::morse && term.morse.empty())
                throw CharacterError(notation_.class_end, "Mo needs its letter: expected (A) or another");
        if (!notation_.phases.empty()) {
            take_written_list();
        } else {
            if (steady() && !notation_.alternating) {
                if (notation_.period_s)
                    warn("a fixed light has no period: " + seconds_text(*notation_.period_s) + " is ignored");
                return;
            }
            fill_in();
        }
        colour_phases();
        if (notation_.fixed_under) light_the_eclipses();
        for (const Phase& phase : out_.rhythm.phases)
            out_.rhythm.period_s += phase.duration_s;
        check_class();
    }

  private:
    const ClassTerm& first() const { return terms_.front(); }
    bool steady() const { return terms_.size() == 1 && first().kind == ClassKind::fixed; }

    void assume(const std::string& text) { out_.assumptions.push_back(text); }
    void warn(const std::string& text) { out_.warnings.push_back(text); }

    // A bare "Dir" or "Al": the durations tell, else nothing does.
    ClassKind missing_class() {
        if (notation_.alternating) return ClassKind::fixed;
        if (!notation_.phases.empty()) {
            double lit_s = 0;
            double dark_s = 0;
            for (const ListedPhase& phase : notation_.phases)
                (phase.lit ? lit_s : dark_s) += phase.duration_s;
            const ClassKind kind = lit_s > dark_s    ? ClassKind::occulting
                                   : lit_s == dark_s ? ClassKind::isophase
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

    // The list's own durations stand. A list shorter than the period is followed by darkness, a longer one
    // makes the period; either is said.
    void take_written_list() {
        std::vector<Phase>& phases = out_.rhythm.phases;
        double sum_s = 0;
        int flashes = 0;
        bool last_lit = false;
        for (const ListedPhase& listed : notation_.phases) {
            const Phase phase{listed.duration_s, listed.lit, listed.colour.value_or(out_.colours.front()),
                              listed.level};
            out_.written_phases.push_back(phase);
            phases.push_back(phase);
            if (listed.lit && !last_lit) ++flashes;
            last_lit = listed.lit;
            sum_s += listed.duration_s;
        }
        if (notation_.period_s && std::abs(*notation_.period_s - sum_s) > sum_tolerance_s) {
            const double period_s = *notation_.period_s;
            std::string text = "the durations add up to " + seconds_text(sum_s) + ", the period is " +
                               seconds_text(period_s) + ": ";
            if (sum_s < period_s) {
                text += "the light stays dark for the other " + seconds_text(period_s - sum_s);
                phases.push_back({period_s - sum_s, false, Colour::white});  // apart: the list stays as it is
            } else {
                text += "the durations are used";
            }
            warn(text);
        }
        if (steady() && !notation_.alternating && !notation_.terms.empty())
            warn("a fixed light has no durations: they make it rhythmic");
        const int written = terms_.size() == 1 ? counted(first()) : 0;
        if (written > 0 && first().kind != ClassKind::occulting && written != flashes)
            warn("the group counts " + std::to_string(written) + ", the durations show " +
                 std::to_string(flashes));
    }

    void fill_in() {
        const bool continuous = terms_.size() == 1 && is_quick(first().kind) && first().groups.empty();
        OpenRhythm open;
        open.terms = terms_;
        open.repeats =
            notation_.alternating ? static_cast<int>(std::max<std::size_t>(1, out_.colours.size())) : 1;
        open.period_is_written = notation_.period_s.has_value();
        open.class_at = notation_.class_at;
        open.period_at = notation_.period_at;
        if (notation_.period_s) {
            open.period_s = *notation_.period_s;
        } else if (continuous) {
            open.period_s = quick_rate(first().kind).pitch_s * open.repeats;  // said with the rate
        } else {
            open.period_s = usual_period_s(terms_, out_.colours.size());
            assume("no period is written: " + seconds_text(open.period_s) + " assumed");
        }
        period_s_ = open.period_s;
        const AssumedPhases assumed = assume_phases(open);
        for (const auto& [duration_s, lit] : assumed.phases)
            out_.rhythm.phases.push_back({duration_s, lit, Colour::white});
        for (const std::string& text : assumed.assumptions)
            assume(text);
        for (const std::string& text : assumed.warnings)
            warn(text);
    }

    bool list_has_colours() const {
        return std::any_of(notation_.phases.begin(), notation_.phases.end(),
                           [](const ListedPhase& phase) { return phase.colour.has_value(); });
    }

    void colour_phases() {
        std::vector<Phase>& phases = out_.rhythm.phases;
        const std::vector<Colour>& colours = out_.colours;
        if (list_has_colours()) return check_listed_colours();
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

    void check_listed_colours() {
        for (const Phase& phase : out_.written_phases) {
            if (!phase.lit ||
                std::find(out_.colours.begin(), out_.colours.end(), phase.colour) != out_.colours.end())
                continue;
            return warn("the durations show " + std::string(colour_letter(phase.colour)) +
                        ", which the character does not name");
        }
    }

    // Fixed and flashing: no darkness, but a weaker steady light. Alternating, the steady light has the first
    // colour.
    void light_the_eclipses() {
        const bool listed_level = std::any_of(notation_.phases.begin(), notation_.phases.end(),
                                              [](const ListedPhase& phase) { return phase.level != 1; });
        if (listed_level) return;
        const bool colours_change = notation_.alternating && out_.colours.size() > 1 && !list_has_colours();
        std::size_t flash = 0;
        for (Phase& phase : out_.rhythm.phases) {
            if (!phase.lit) {
                phase = {phase.duration_s, true, out_.colours.front(), steady_level};
            } else if (colours_change) {
                phase.colour = out_.colours[1 + flash++ % (out_.colours.size() - 1)];
            }
        }
        assume("the steady light is taken as a tenth of the flashes");
    }

    void check_class() {
        if (terms_.size() > 1 || notation_.alternating || notation_.fixed_under) return;
        double lit_s = 0;
        double dark_s = 0;
        double shortest_lit_s = HUGE_VAL;
        int flashes = 0;
        for (const Phase& phase : out_.rhythm.phases) {
            (phase.lit ? lit_s : dark_s) += phase.duration_s;
            if (!phase.lit) continue;
            shortest_lit_s = std::min(shortest_lit_s, phase.duration_s);
            ++flashes;
        }
        const ClassKind kind = first().kind;
        const double per_minute = 60.0 * flashes / std::max(1e-9, lit_s + dark_s);
        if (kind == ClassKind::flashing && first().groups.empty() && per_minute >= 50)
            warn("flashing means fewer than 50 flashes a minute, this has " +
                 number_text(std::round(per_minute)));
        if ((kind == ClassKind::flashing || kind == ClassKind::long_flashing) && lit_s > dark_s)
            warn("flashing means more darkness than light, this has more light");
        if (kind == ClassKind::occulting && lit_s < dark_s)
            warn("occulting means more light than darkness, this has more darkness");
        if (out_.written_phases.empty()) return;
        if (kind == ClassKind::long_flashing && shortest_lit_s < 2.0)
            warn("a long flash lasts 2 s or more, this has one of " + seconds_text(shortest_lit_s));
        if (kind == ClassKind::isophase && std::abs(lit_s - dark_s) > sum_tolerance_s)
            warn("isophase means as much light as darkness, this has " + seconds_text(lit_s) + " and " +
                 seconds_text(dark_s));
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
