// EULUMDAT (.ldt): A. W. Stockmar, "EULUMDAT - ein Leuchtendatenformat für den europäischen Beleuchtungsplaner", Licht '90.
// The numbers in the comments are the items of its description.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/photometric_planes.h"
#include "lightdb/photometry_file.h"
#include "lightdb/photometry_text.h"

namespace seaglare::lightdb {

namespace {

constexpr double brightest_cd = 1e9;
constexpr double lumens_per_kilolumen = 1000;
constexpr double metres_per_millimetre = 1e-3;

class EulumdatReader {
  public:
    EulumdatReader(std::string_view text, const std::string& file)
        : text_(text, file, PhotometryText::Comma::decimal_point) {}

    PhotometryFile read() {
        read_header();
        read_lamps();
        for (int i = 0; i < 10; ++i)  // 27: for room indices
            text_.number("a direct ratio");
        read_angles();
        auto solid = std::make_shared<PhotometricSolid>(read_solid());
        if (!(solid->reference_cd > 0)) text_.fail("all luminous intensities are 0");
        solid->radius_m = radius_m_;
        solid->file = text_.file();
        warn_of_flux(*solid);
        result_.solid = std::move(solid);
        return std::move(result_);
    }

  private:
    void warn(const std::string& text) { result_.warnings.push_back(text_.warning(text)); }

    std::size_t line_count(std::string_view what, double min, double max) {
        const double value = text_.line_number(what);
        if (!(value >= min && value <= max) || value != std::floor(value)) {
            text_.fail(std::string(what) + " is " + short_number(value) + ", not a whole number from " +
                       short_number(min) + " to " + short_number(max));
        }
        return static_cast<std::size_t>(value);
    }

    void read_header() {
        text_.line("the company's identification");                                    // 1
        line_count("the type indicator Ityp", 0, 3);                                   // 2
        symmetry_ = line_count("the symmetry indicator Isym", 0, 4);                   // 3
        planes_ = line_count("the number of C planes, Mc", 1, 1e6);                    // 4
        plane_step_deg_ = text_.line_number("the distance of C planes, Dc", 0);        // 5
        intensities_ = line_count("the number of intensities per plane, Ng", 2, 1e6);  // 6
        text_.check_room(static_cast<double>(intensities_), "luminous intensities per plane");
        intensity_step_deg_ = text_.line_number("the distance of intensities, Dg", 0);            // 7
        text_.line("the measurement report's number");                                            // 8
        result_.name = trimmed(text_.line("the luminaire's name"));                               // 9
        for (const char* const what : {"the luminaire's number", "the file's name", "the date"})  // 10 to 12
            text_.line(what);
        read_sizes();
        downward_fraction_ = text_.line_number("the downward flux fraction, DFF", 0) / 100;    // 22
        output_ratio_ = text_.line_number("the light output ratio, LORL", 0) / 100;            // 23
        conversion_ = text_.line_number("the conversion factor for luminous intensities", 1);  // 24
        if (!(conversion_ > 0 && conversion_ <= 1e6)) {
            text_.fail("the conversion factor for luminous intensities is " + short_number(conversion_));
        }
        if (conversion_ != 1)
            warn("the intensities are multiplied by the conversion factor " + short_number(conversion_));
        const double tilt_deg = text_.line_number("the tilt of the luminaire", 0);  // 25
        if (tilt_deg != 0)
            warn("the luminaire was measured tilted by " + short_number(tilt_deg) +
                 " degrees: not turned back");
    }

    // 13 to 21, millimetres. The luminous area seen from the side if it has a height, else from below, as a disc.
    void read_sizes() {
        for (const char* const what : {"the luminaire's length", "its width", "its height"})
            text_.line_number(what, 0);
        const double length = text_.line_number("the length of the luminous area", 0);
        const double width = text_.line_number("the width of the luminous area", 0);
        double height = 0;
        for (const char* const what :
             {"the height of the luminous area at C0", "at C90", "at C180", "at C270"})
            height = std::max(height, text_.line_number(what, 0));
        if (!(length > 0)) return;
        const bool round = width == 0;
        const double across = round ? length : width;
        const double below = round ? std::numbers::pi / 4 * length * length : length * across;
        const double area = height > 0 ? across * height : below;
        radius_m_ = std::sqrt(area / std::numbers::pi) * metres_per_millimetre;
        if (!std::isfinite(*radius_m_) || *radius_m_ > 1e4 || *radius_m_ <= 0) radius_m_.reset();
    }

    // 26: sets of lamps that the luminaire may hold. The first is the one it burns.
    void read_lamps() {
        const std::size_t sets = line_count("the number of lamp sets", 1, 1000);
        for (std::size_t i = 0; i < sets; ++i) {
            const double lamps = text_.line_number("the number of lamps");
            text_.line("the type of lamps");
            const double flux_lm = text_.line_number("the total luminous flux of the lamps");
            if (!(flux_lm > 0 && flux_lm <= 1e9))
                text_.fail("the total luminous flux of the lamps is " + short_number(flux_lm));
            for (const char* const what : {"the colour of the light", "the colour rendering", "the wattage"})
                text_.line(what);
            if (i > 0) continue;
            set_flux_lm_ = flux_lm;
            // A negative number of lamps means absolute photometry: the flux is then the luminaire's own.
            if (lamps > 0) result_.lamp_flux_lm = flux_lm;
        }
        if (sets > 1)
            warn("the luminaire has " + std::to_string(sets) + " sets of lamps: the first is taken");
    }

    void check_step(const std::vector<double>& angle_deg, double step_deg, std::string_view what) {
        constexpr double rounded_deg = 0.06;
        for (std::size_t i = 1; step_deg > 0 && i < angle_deg.size(); ++i) {
            if (std::abs(angle_deg[i] - angle_deg[i - 1] - step_deg) <= rounded_deg) continue;
            warn(std::string(what) + " do not lie " + short_number(step_deg) +
                 " degrees apart as stated: the angles hold");
            return;
        }
    }

    void read_angles() {
        c_deg_ = text_.ascending(planes_, "C angle", 0, 360);  // 28
        check_step(c_deg_, plane_step_deg_, "the C angles");
        elevation_deg_ = text_.ascending(intensities_, "gamma angle", 0, 180);  // 29
        check_step(elevation_deg_, intensity_step_deg_, "the gamma angles");
        for (double& angle_deg : elevation_deg_)
            angle_deg -= 90;
    }

    // The planes that the file states, of the Mc whose angles it lists: Mc1 to Mc2 of its item 30.
    std::vector<double> stated_planes() const {
        const std::size_t half = planes_ / 2;
        const std::size_t quarter = planes_ / 4;
        const auto from_to = [this](std::size_t from, std::size_t count) {
            std::vector<double> result;
            for (std::size_t i = from; i < from + count; ++i)
                result.push_back(i < planes_ ? c_deg_[i] : c_deg_[i - planes_] + 360);
            return result;
        };
        switch (symmetry_) {
            case 1:
                return from_to(0, 1);
            case 2:
                return from_to(0, half + 1);
            case 3:
                return from_to(3 * quarter, half + 1);
            case 4:
                return from_to(0, quarter + 1);
            default:
                return from_to(0, planes_);
        }
    }

    // That the planes between which a symmetric file states its intensities stand where the symmetry needs them.
    void check_symmetry() {
        const std::size_t parts = symmetry_ >= 3 ? 4 : symmetry_ == 2 ? 2 : 1;
        if (planes_ % parts != 0) {
            text_.fail(std::to_string(planes_) + " C planes cannot be parted by " + std::to_string(parts) +
                       ", as the symmetry Isym " + std::to_string(symmetry_) + " asks");
        }
        for (std::size_t part = 0; parts > 1 && part < parts; ++part) {
            constexpr double tolerance_deg = 0.01;
            const std::size_t plane = part * planes_ / parts;
            const double wanted_deg = 360.0 * static_cast<double>(part) / static_cast<double>(parts);
            if (std::abs(c_deg_[plane] - wanted_deg) <= tolerance_deg) continue;
            text_.fail("C plane " + std::to_string(plane + 1) + " stands at " + short_number(c_deg_[plane]) +
                       " degrees, the symmetry Isym " + std::to_string(symmetry_) + " needs it at " +
                       short_number(wanted_deg));
        }
    }

    PhotometricSolid read_solid() {
        static constexpr std::array<PlaneSymmetry, 5> symmetries = {
            PlaneSymmetry::none, PlaneSymmetry::none, PlaneSymmetry::plane_0_180, PlaneSymmetry::plane_90_270,
            PlaneSymmetry::both_planes};
        check_symmetry();
        std::vector<Plane> planes = all_c_planes(stated_planes(), symmetries[symmetry_]);
        for (Plane& plane : planes)
            plane.angle_deg = -plane.angle_deg;  // C counts anticlockwise, bearings clockwise
        const std::vector<double> candela = read_candela(stated_planes().size() * intensities_);
        text_.expect_end("the luminous intensities");
        return solid_of_vertical_planes(std::move(planes), true, std::move(elevation_deg_), candela);
    }

    std::vector<double> read_candela(std::size_t count) {  // 30, in cd per 1000 lm of the lamps
        text_.check_room(static_cast<double>(count), "luminous intensities");
        const double scale = set_flux_lm_ / lumens_per_kilolumen * conversion_;
        std::vector<double> candela;
        candela.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double value = text_.number("luminous intensity", 0, brightest_cd) * scale;
            if (value > brightest_cd) text_.fail("the luminous intensity is " + short_number(value) + " cd");
            candela.push_back(value);
        }
        return candela;
    }

    void warn_of_flux(const PhotometricSolid& solid) {
        constexpr double tolerance =
            0.05;  // of the lamps' flux; tables of 5 degrees and other rules of summing
        const double flux = flux_lm(solid);
        const double ratio = flux / set_flux_lm_;
        if (output_ratio_ > 0 && std::abs(ratio - output_ratio_) > tolerance) {
            warn("the intensities add up to " + percent(ratio) +
                 " of the lamps' flux, the light output ratio LORL is " + percent(output_ratio_));
        }
        const double down = flux > 0 ? flux_below_horizon_lm(solid) / flux : 0;
        if (downward_fraction_ > 0 && std::abs(down - downward_fraction_) > tolerance) {
            warn("the intensities send " + percent(down) +
                 " of their flux down, the downward fraction DFF is " + percent(downward_fraction_));
        }
    }

    static std::string percent(double share) { return short_number(std::round(share * 100)) + " %"; }

    PhotometryText text_;
    PhotometryFile result_;
    std::size_t symmetry_ = 0;
    std::size_t planes_ = 0;
    std::size_t intensities_ = 0;
    double plane_step_deg_ = 0;
    double intensity_step_deg_ = 0;
    double downward_fraction_ = 0;
    double output_ratio_ = 0;
    double conversion_ = 1;
    double set_flux_lm_ = 0;
    std::optional<double> radius_m_;
    std::vector<double> c_deg_;
    std::vector<double> elevation_deg_;
};

}  // namespace

PhotometryFile parse_eulumdat(std::string_view text, const std::string& file) {
    return EulumdatReader(text, file).read();
}

}  // namespace seaglare::lightdb
