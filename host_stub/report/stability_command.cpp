// seaglare-report stability: stiff and extreme cases as tables, with the explicit scheme's blow-up beside them, so that one
// can see that the tables tell the two apart.
#include <iostream>

#include "glare/eye/adaptation.h"
#include "host_stub/report/commands.h"
#include "host_stub/report/progress.h"
#include "host_stub/report/report_page.h"
#include "host_stub/report/stability.h"

namespace seaglare::report {

namespace {

// Adds the checks to the page; returns how many fail.
int add_checks(Page& page, const std::string& name, const std::string& caption,
               const std::vector<Check>& checks) {
    Table table({"what", "cases", "must hold", "values tried", "worst error", "allowed", "verdict"});
    int failed = 0;
    for (const Check& check : checks) {
        table.add() << check.what << check.cases << check.holds << check.tried << check.worst << check.allowed
                    << (check.passed() ? "holds" : "FAILS");
        failed += check.passed() ? 0 : 1;
        if (!check.passed())
            std::cerr << "seaglare-report: " << check.what << ", " << check.cases << ": " << check.holds
                      << " fails: worst " << check.worst << ", allowed " << check.allowed << "\n";
    }
    page.table(name, caption, table);
    return failed;
}

// A start at B = 1 before 1e4 cd/m2, where the rods' pigment has a time constant of 1.6 ms, by steps of a frame.
void add_explicit_scheme(Page& page) {
    Table table({"time [s]", "explicit Euler", "exact step", "explicit Euler, size", "exact step, size"});
    constexpr double luminance_cd_m2 = 1e4;
    constexpr double step_s = 1.0 / 60;
    double euler = 1;
    glare::Pigments exact;
    for (int i = 0; i <= 10; ++i) {
        table.add() << i * step_s << euler << exact.rod << std::abs(euler) << exact.rod;
        euler += step_s * ((1 - euler) / 400 - luminance_cd_m2 * euler / 16);
        exact = glare::bleached(exact, luminance_cd_m2, step_s);
    }
    page.table("explicit_scheme", "Rod pigment before 10 000 cd/m2, frames of 1/60 s", table);
    Plot plot;
    plot.name = "explicit_scheme";
    plot.title = "Rod pigment that bleaches: explicit Euler beside the exact step";
    plot.x_label = "time, s";
    plot.y_label = "size of the unbleached share (must be 0 to 1)";
    plot.log_y = true;
    plot.curves = {{"explicit_scheme.csv", 1, 4, "explicit Euler", "linespoints lt 2"},
                   {"explicit_scheme.csv", 1, 5, "exact step", "linespoints lt 1"}};
    page.plot(plot);
}

}  // namespace

int stability_command(const std::filesystem::path& out) {
    Progress progress;
    Page page(out, "Seaglare: stability");
    page.paragraph(
        "Each line is one thing that must hold over many values. The worst error of all of them stands "
        "beside what is "
        "allowed; a value that is not finite counts as an infinite error.");
    progress.show("moving parts", 0);
    page.heading("Everything that moves");
    int failed =
        add_checks(page, "moving_parts",
                   "Time steps 0, 1e-9, 1/240, 1/60, 1 and 10 s, times 0 to 1e7 s, adaptation 0 to 1e6 cd/m2",
                   moving_parts());
    progress.show("lights and what goes over", 0.3);
    failed += add_checks(page, "moving_lights",
                         "Lights that move, and what goes over from one state to another, likewise",
                         moving_lights());
    page.heading("Extremes");
    progress.show("extremes", 0.4);
    failed += add_checks(page, "extremes", "The ends of every quantity", extremes());
    progress.show("a million lights", 0.8);
    failed += add_checks(page, "scene_extremes", "The ends of scenes and pictures", scene_extremes());
    page.heading("What an explicit scheme would do");
    page.paragraph(
        "The same pigment by explicit Euler steps leaves the range it lives in at once and grows by a factor "
        "of "
        "ten in every frame. The tables above would show it as a failure of every kind.");
    add_explicit_scheme(page);
    page.finish();
    std::cout << (out / "index.html").string() << "\n";
    return failed == 0 ? 0 : 1;
}

}  // namespace seaglare::report
