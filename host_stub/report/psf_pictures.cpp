#include "host_stub/report/psf_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seaglare::report {

namespace {

constexpr double ten_thousand_cd_at_1_km_lx = 1e-2;
constexpr double degree = std::numbers::pi / 180;

// A picture as gnuplot draws it: axes in degrees, and the scale of its colours.
void plot_map(Page& page, const std::string& name, const std::string& title, const std::string& png, int zoom,
              const PatternImage& image, const std::string& scale) {
    const std::string pixel = std::to_string(std::asin(std::min(image.pitch, 1.0)) / degree / zoom);
    const std::string edge = std::to_string((image.radius + 0.5) * image.pitch / degree);
    Plot plot;
    plot.name = name;
    plot.title = title;
    plot.x_label = plot.y_label = "degrees";
    plot.width = 640;
    plot.height = 520;
    plot.extra = scale + "\nunset key\nunset grid\nset size ratio -1\nset tics out nomirror\nset xrange [-" +
                 edge + ":" + edge + "]\nset yrange [-" + edge + ":" + edge + "]";
    // The second plot draws nothing; without it there would be no scale.
    plot.command = "'" + png + "' binary filetype=png origin=(-" + edge + ",-" + edge + ") dx=" + pixel +
                   " dy=" + pixel + " with rgbimage, 1/0 with lines palette";
    page.plot(plot);
}

// What CIE's or Spencer's curve has inside an angle, by the midpoint rule; asked for growing angles.
template <typename Curve>
class Encircled {
  public:
    explicit Encircled(Curve curve) : curve_(curve) {}
    double up_to(double angle_deg) {
        constexpr int steps = 200;
        const double from_deg = at_deg_;
        for (int s = 0; s < steps; ++s) {
            const double a = from_deg + (angle_deg - from_deg) * std::pow(static_cast<double>(s) / steps, 2);
            const double b = from_deg + (angle_deg - from_deg) * std::pow((s + 1.0) / steps, 2);
            const double middle = (a + b) / 2;
            inside_ += curve_(middle) * 2 * std::numbers::pi * std::sin(middle * degree) * (b - a) * degree;
        }
        at_deg_ = angle_deg;
        return inside_;
    }

  private:
    Curve curve_;
    double at_deg_ = 0;
    double inside_ = 0;
};

double solid_angle_sr(double inner_deg, double outer_deg) {
    return 2 * std::numbers::pi * (std::cos(inner_deg * degree) - std::cos(outer_deg * degree));
}

void write_curves(Page& page, double age, double pigment, double from_deg, double to_deg) {
    Table table({"angle deg", "CIE 135/1 1/sr", "Spencer photopic 1/sr", "Spencer scotopic 1/sr",
                 "CIE inside", "Spencer photopic inside"});
    const auto cie = [&](double angle) { return reference::cie_curve_sr(angle, age, pigment); };
    Encircled cie_inside(cie);
    Encircled spencer_inside(spencer_photopic_sr);
    constexpr int points = 200;
    for (int i = 0; i <= points; ++i) {
        const double angle = from_deg * std::pow(to_deg / from_deg, static_cast<double>(i) / points);
        table.add() << angle << cie(angle) << spencer_photopic_sr(angle) << spencer_scotopic_sr(angle)
                    << cie_inside.up_to(angle) << spencer_inside.up_to(angle);
    }
    page.table("curves", "The published curves", table, false);
}

Table profile_table(const Subject& subject, const PatternImage& made, const PatternImage& truth) {
    const std::vector<Ring> ours = rings_of(made);
    const std::vector<Ring> exact = rings_of(truth);
    const double age = subject.eye.age_years;
    const double pigment = subject.eye.pigmentation;
    Table table({"angle deg", "production 1/sr", "reference 1/sr", "CIE mean of the ring 1/sr",
                 "production/CIE", "reference/CIE", "outer deg", "production inside", "reference inside",
                 "CIE inside"});
    Encircled inside([&](double angle) { return reference::cie_curve_sr(angle, age, pigment); });
    double from_deg = 0;
    double before = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const double cie_inside = inside.up_to(ours[i].outer_deg);
        const double cie = (cie_inside - before) / solid_angle_sr(from_deg, ours[i].outer_deg);
        from_deg = ours[i].outer_deg;
        before = cie_inside;
        // The middle pixel has no angle of its own on a logarithmic axis: a third of a pixel.
        const double angle = std::max(ours[i].angle_deg, subject.pitch / degree / 3);
        table.add() << angle << ours[i].mean_sr << exact[i].mean_sr << cie << ours[i].mean_sr / cie
                    << exact[i].mean_sr / cie << ours[i].outer_deg << ours[i].energy_inside
                    << exact[i].energy_inside << cie_inside;
    }
    return table;
}

}  // namespace

void write_pictures(Page& page, const std::string& name, const std::string& what, const PatternImage& image) {
    const int zoom = std::max(1, 520 / image.side());
    const std::filesystem::path& out = page.folder();
    write_night_png(image, out / (name + "_night.png"), zoom, ten_thousand_cd_at_1_km_lx);
    write_linear_png(image, out / (name + "_linear.png"), zoom, 100);
    write_log_png(image, out / (name + "_log.png"), zoom);
    write_false_colour_png(image, out / (name + "_false.png"), zoom);
    write_image_exr(image, out / (name + ".exr"));
    page.pictures({name + "_night.png", name + "_linear.png", name + "_log.png", name + "_false.png"},
                  {what + ": 10 000 cd at 1 km by starlight, photographic operator",
                   what + ": linear, white at 100 per steradian",
                   what + ": logarithmic, 0.03 to 10 000 per steradian, colours strengthened",
                   what + ": false colour of the photopic value, scale below"});
    plot_map(page, name + "_map", what + ", photopic", name + "_false.png", zoom, image,
             false_colour_scale());
}

void write_difference(Page& page, const PatternImage& made, const PatternImage& truth) {
    const int zoom = std::max(1, 520 / made.side());
    write_difference_png(made, truth, page.folder() / "difference.png", zoom);
    plot_map(page, "difference_map", "Production less reference, per cent of the ring's mean",
             "difference.png", zoom, made, difference_scale());
    page.paragraph(
        "All of it is a little blue by the structure scale of the tables; at the edge production fades into "
        "the CIE "
        "curve, which it follows beyond.");
}

void write_profiles(Page& page, const Subject& subject, const PatternImage& made, const PatternImage& truth) {
    page.heading("Radial profile and encircled energy");
    page.paragraph(
        "CIE 135/1-1999, total glare, for the eye's own age and pigmentation; Spencer et al. 1995, photopic "
        "and "
        "scotopic. Within two pixels production keeps its core as one energy and draws it as a footprint "
        "that does "
        "not flicker; here it is laid mostly on the middle pixel. Production's core and structure together "
        "are "
        "scaled to what the CIE tail beyond the field leaves of the light, so it lies below the reference by "
        "the "
        "structure scale of the tables.");
    page.table("profile", "Per ring of pixels", profile_table(subject, made, truth), false);
    write_curves(page, subject.eye.age_years, subject.eye.pigmentation, subject.pitch / degree / 3,
                 std::asin(std::min(1.0, 1.4 * made.radius * made.pitch)) / degree);
    page.plot({"profile",
               "Radial average of the glare of one light",
               "angle from the light, degrees",
               "luminance per illuminance, 1/sr",
               {{"profile.csv", 1, 2, "production", "lines lt 1", 0},
                {"profile.csv", 1, 3, "reference", "lines lt 2", 0},
                {"curves.csv", 1, 2, "CIE 135/1-1999", "lines lt 3", 0},
                {"curves.csv", 1, 3, "Spencer 1995, photopic", "lines lt 4", 0},
                {"curves.csv", 1, 4, "Spencer 1995, scotopic", "lines lt 5", 0}},
               true,
               true,
               "set key inside right top"});
    page.plot(
        {"ratio",
         "Radial average over the CIE curve's mean in the same ring",
         "angle from the light, degrees",
         "ratio",
         {{"profile.csv", 1, 5, "production", "lines lt 1", 0},
          {"profile.csv", 1, 6, "reference", "lines lt 2", 0}},
         true,
         false,
         "set yrange [0:*]\nset key inside right top\nset arrow from graph 0, first 1 to graph 1, first 1 "
         "nohead lc rgb '#888888' lw 1"});
    page.plot({"encircled",
               "Encircled energy",
               "angle from the light, degrees",
               "share of the light",
               {{"profile.csv", 7, 8, "production", "lines lt 1", 0},
                {"profile.csv", 7, 9, "reference", "lines lt 2", 0},
                {"curves.csv", 1, 5, "CIE 135/1-1999", "lines lt 3", 0},
                {"curves.csv", 1, 6, "Spencer 1995, photopic", "lines lt 4", 0}},
               true,
               false,
               "set yrange [0:1.05]\nset key inside right bottom"});
}

}  // namespace seaglare::report
