// Durations against the period and the class.
#include <algorithm>
#include <cmath>

#include "lightdb/lint_checks.h"

namespace seaglare::lightdb::lint_checks {
namespace {

constexpr double shortest_s = 1e-3;
constexpr double rounding_s = 0.011;  // of a sum: durations come in tenths, and in hundredths at the finest

const std::vector<Phase>& durations_of(const Subject& subject) {
    static const std::vector<Phase> none;
    if (subject.character && !subject.character->written_phases.empty())
        return subject.character->written_phases;
    return subject.light->character.empty() || !subject.character ? subject.light->rhythm.phases : none;
}

double sum_of(const std::vector<Phase>& phases) {
    double sum_s = 0;
    for (const Phase& phase : phases)
        sum_s += phase.duration_s;
    return sum_s;
}

// The first class of "Q(6)+LFl", without its group: "Q". "Dir" and "Aero" are no classes.
std::string plain_class(std::string text) {
    for (const char* prefix : {"Dir ", "Aero "})
        if (text.starts_with(prefix)) text.erase(0, std::string_view(prefix).size());
    return text;
}

// Definitions of IHO S-57 Appendix A, attribute 107 (LITCHR), as far as durations alone decide.
std::string contradiction(const std::string& light_class, const std::vector<Phase>& phases) {
    double lit_s = 0;
    double dark_s = 0;
    double shortest_flash_s = 1e9;
    for (const Phase& phase : phases) {
        (phase.lit ? lit_s : dark_s) += phase.duration_s;
        if (phase.lit) shortest_flash_s = std::min(shortest_flash_s, phase.duration_s);
    }
    const auto is = [&](std::string_view name) {
        return light_class == name || light_class.starts_with(std::string(name) + "(");
    };
    const std::string times = rounded(lit_s, 2) + " s lit and " + rounded(dark_s, 2) + " s dark";
    if (light_class == "F" && dark_s > 0) return "a fixed light has eclipses: " + times;
    if (is("Fl") && lit_s > dark_s + rounding_s)
        return "a flashing light is lit for longer than dark: " + times;
    if (is("LFl") && shortest_flash_s < 2 - rounding_s)
        return "a long flash lasts " + rounded(shortest_flash_s, 2) + " s, not 2 s or more";
    if (is("Oc") && dark_s > lit_s + rounding_s)
        return "an occulting light is dark for longer than lit: " + times;
    if (light_class == "Iso" && std::abs(lit_s - dark_s) > rounding_s)
        return "an isophase light is not lit for as long as dark: " + times;
    return {};
}

}  // namespace

void check_rhythm(const Subject& subject, Findings& findings) {
    const std::vector<Phase>& written = durations_of(subject);
    const std::optional<double> period_s = subject.character ? subject.character->period_s : std::nullopt;
    if (period_s && !written.empty() && std::abs(sum_of(written) - *period_s) > rounding_s)
        findings.push_back(subject.finding(LintKind::phases_miss_period,
                                           "its durations sum to " + rounded(sum_of(written), 3) +
                                               " s, its period is " + rounded(*period_s, 3) + " s"));
    // Explicit phases beside a character hold instead of its own, which may last several periods: "Al.Fl(3)WR.15s" repeats
    // after two.
    const std::vector<Phase>& held = subject.light->rhythm.phases;
    if (period_s && written.empty() && !held.empty() && held != subject.character->rhythm.phases &&
        std::abs(sum_of(held) - *period_s) > rounding_s)
        findings.push_back(
            subject.finding(LintKind::phases_miss_period, "its phases sum to " + rounded(sum_of(held), 3) +
                                                              " s, its character's period is " +
                                                              rounded(*period_s, 3) + " s"));
    const std::vector<Phase>& phases = written.empty() ? held : written;
    for (const Phase& phase : phases) {
        const std::string what = phase.lit ? "a flash" : "an eclipse";
        if (!(phase.duration_s >= shortest_s))
            findings.push_back(subject.finding(
                LintKind::phase_too_short, what + " lasts " + rounded(phase.duration_s * 1e3, 3) + " ms"));
        if (period_s && phase.duration_s > *period_s + rounding_s)
            findings.push_back(
                subject.finding(LintKind::phase_too_long, what + " lasts " + rounded(phase.duration_s, 3) +
                                                              " s, longer than the period of " +
                                                              rounded(*period_s, 3) + " s"));
    }
    if (subject.character && !written.empty())
        if (const std::string text = contradiction(plain_class(subject.character->light_class), written);
            !text.empty())
            findings.push_back(subject.finding(LintKind::class_against_rhythm, text));
}

}  // namespace seaglare::lightdb::lint_checks
