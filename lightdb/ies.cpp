// ANSI/IES LM-63, "Standard File Format for the Electronic Transfer of Photometric Data": the editions of 1986, 1991, 1995,
// 2002 and 2019.
#include <algorithm>
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
#include "lightdb/profile.h"
#include "lightdb/units.h"

namespace seaglare::lightdb {

namespace {

enum class Edition : std::uint8_t { lm_63_1986, lm_63_1991, lm_63_1995, lm_63_2002, lm_63_2019 };
enum class Type : std::uint8_t { c = 1, b = 2, a = 3 };

constexpr double brightest_cd = 1e9;  // ten times the brightest light that evaluation is tested for
constexpr double angle_tolerance_deg = 0.01;
// A file may hold millions of lines that are wrong in the same way.
constexpr std::size_t most_warnings = 20;
constexpr std::size_t most_keywords = 1000;

bool is_at(double angle_deg, double wanted_deg) {
    return std::abs(angle_deg - wanted_deg) <= angle_tolerance_deg;
}

bool starts_with(std::string_view text, std::string_view start) {
    return text.size() >= start.size() &&
           std::equal(start.begin(), start.end(), text.begin(), [](char a, char b) {
               return a == (b >= 'a' && b <= 'z' ? static_cast<char>(b - 'a' + 'A') : b);
           });
}

// Width, length and height of the luminous opening, negative where it is round, to the radius of a disc as large as it is
// seen: from the side if it has a height, else from below. In editions before 2002 a 0 beside a negative number is the same
// diameter again.
std::optional<double> opening_radius_m(double width, double length, double height) {
    const double across = width != 0 ? width : height != 0 && length < 0 ? length : width;
    const double first = height != 0 ? (across != 0 ? across : height) : width;
    const double second = height != 0 ? height : length;
    const double a = first != 0 ? first : second;
    const double b = second != 0 ? second : first;
    if (a == 0) return std::nullopt;
    const bool round = a < 0 && b < 0;
    const double area = std::abs(a * b) * (round ? std::numbers::pi / 4 : 1);
    return std::sqrt(area / std::numbers::pi);
}

class IesReader {
  public:
    IesReader(std::string_view text, const std::string& file)
        : text_(text, file, PhotometryText::Comma::parts_numbers) {}

    PhotometryFile read() {
        read_edition_and_keywords();
        read_numbers();
        auto solid = std::make_shared<PhotometricSolid>(make_solid());
        if (!(solid->reference_cd > 0)) text_.fail("all candela are 0");
        solid->radius_m = radius_m_;
        solid->file = text_.file();
        warn_of_flux(*solid);
        result_.solid = std::move(solid);
        return std::move(result_);
    }

  private:
    void warn(const std::string& text) {
        if (result_.warnings.size() < most_warnings) result_.warnings.push_back(text_.warning(text));
    }

    // Up to and including the TILT line.
    void read_edition_and_keywords() {
        for (bool first = true;; first = false) {
            const std::string_view line = trimmed(text_.line("a line TILT=NONE or TILT=INCLUDE"));
            if (starts_with(line, "TILT=")) {
                read_tilt(trimmed(line.substr(5)));
                break;
            }
            if (first && read_edition(line)) continue;
            if (!line.empty() && line.front() == '[') read_keyword(line);
        }
        for (const auto& [key, value] : result_.keywords) {
            if (key == "LUMINAIRE" || (key == "LUMCAT" && result_.name.empty())) result_.name = value;
        }
    }

    // The 1986 edition has no line for it: its files begin with any text.
    bool read_edition(std::string_view line) {
        struct Header {
            std::string_view text;
            Edition edition;
        };
        static constexpr Header headers[] = {
            {"IES:LM-63-2019", Edition::lm_63_2019},   {"IESNA:LM-63-2002", Edition::lm_63_2002},
            {"IESNA:LM-63-1995", Edition::lm_63_1995}, {"IESNA:LM-63-1991", Edition::lm_63_1991},
            {"IESNA91", Edition::lm_63_1991},          {"IESNA:LM-63-1986", Edition::lm_63_1986},
            {"IESNA86", Edition::lm_63_1986},
        };
        for (const Header& header : headers) {
            if (!starts_with(line, header.text)) continue;
            edition_ = header.edition;
            return true;
        }
        if (!starts_with(line, "IES:") && !starts_with(line, "IESNA")) return false;
        edition_ = Edition::lm_63_2002;
        warn("an edition of LM-63 that is not known: read as that of 2002");
        return true;
    }

    void read_keyword(std::string_view line) {
        const std::size_t end = line.find(']');
        if (end == std::string_view::npos) {
            warn("a keyword has no ']'");
            return;
        }
        const std::string_view key = line.substr(1, end - 1);
        const std::string_view value = trimmed(line.substr(end + 1));
        if (result_.keywords.size() == most_keywords) return;
        if (key != "MORE") {
            result_.keywords.emplace_back(key, value);
        } else if (result_.keywords.empty()) {
            warn("[MORE] continues nothing");
        } else {
            std::string& before = result_.keywords.back().second;
            if (!before.empty() && !value.empty()) before += ' ';
            before += value;
        }
    }

    void read_tilt(std::string_view tilt) {
        if (starts_with(tilt, "NONE")) return;
        if (!starts_with(tilt, "INCLUDE")) {
            text_.fail(
                "TILT names another file: write TILT=INCLUDE and that file's lines below it, or TILT=NONE "
                "for a lamp "
                "that burns the same in any position");
        }
        text_.number("the lamp's position in the luminaire", 1, 3);
        const std::size_t count = text_.count("the number of tilt angles", 1);
        AngleTable factors;
        factors.angle_deg = text_.ascending(count, "tilt angle", -360, 360);
        text_.check_room(static_cast<double>(count), "tilt factors");
        for (std::size_t i = 0; i < count; ++i)
            factors.factor.push_back(text_.number("tilt factor", 0, 100));
        // The lantern stands as it was measured: tilted by nothing.
        scale_ *= clamped_factor(factors, 0);
    }

    void read_numbers() {
        const double lamps = text_.number("the number of lamps", 0, 1e6);
        const double lumens = text_.number("the lumens per lamp", -1, 1e9);
        if (lumens > 0) result_.lamp_flux_lm = lamps * lumens;
        scale_ *= text_.number("the candela multiplier", 0, 1e9);
        const std::size_t vertical = text_.count("the number of vertical angles", 2);
        const std::size_t horizontal = text_.count("the number of horizontal angles", 1);
        text_.check_room(static_cast<double>(vertical) * static_cast<double>(horizontal), "candela values");
        type_ = static_cast<Type>(text_.count("the photometric type", 1));
        if (type_ > Type::a) text_.fail("the photometric type is 1 (C), 2 (B) or 3 (A)");
        read_opening();
        ballast_factor_ = text_.number("the ballast factor", 0, 100);
        scale_ *= ballast_factor_;
        read_future_use();
        text_.number("the input watts", -1, 1e9);
        read_angles(vertical, horizontal);
        read_candela(vertical * horizontal);
        text_.expect_end("the candela values");
    }

    void read_opening() {
        const std::size_t units = text_.count("the type of units", 1);
        if (units > 2) text_.fail("the type of units is 1 (feet) or 2 (metres)");
        const double width = text_.number("the width of the luminous opening", -1e4, 1e4);
        const double length = text_.number("the length of the luminous opening", -1e4, 1e4);
        const double height = text_.number("the height of the luminous opening", -1e4, 1e4);
        radius_m_ = opening_radius_m(width, length, height);
        if (radius_m_ && units == 1) *radius_m_ *= metres_per_foot;
    }

    // The number between ballast factor and input watts: a factor until 1991, "future use" until 2002, since 2019 how the
    // file was made.
    void read_future_use() {
        const double value = text_.number("the number between ballast factor and input watts", -1e9, 1e9);
        if (edition_ <= Edition::lm_63_1991) {
            if (!(value >= 0 && value <= 100))
                text_.fail("the ballast-lamp photometric factor is " + short_number(value));
            scale_ *= value;
        } else if (edition_ <= Edition::lm_63_2002 && value != 1) {
            warn("the number that this edition keeps for future use is " + short_number(value) +
                 ", not 1: not used");
        }
    }

    void read_angles(std::size_t vertical, std::size_t horizontal) {
        const bool is_c = type_ == Type::c;
        const double vertical_end_deg = type_ == Type::b ? 180 : 90;
        vertical_deg_ = text_.ascending(vertical, "vertical angle", is_c ? 0 : -vertical_end_deg,
                                        is_c ? 180 : vertical_end_deg);
        const auto ends = [this](double first, double last) {
            return is_at(vertical_deg_.front(), first) && is_at(vertical_deg_.back(), last);
        };
        const bool as_standard =
            is_c ? ends(0, 90) || ends(0, 180) || ends(90, 180) : ends(-90, 90) || ends(0, 90);
        if (!as_standard) {
            warn("the vertical angles run from " + short_number(vertical_deg_.front()) + " to " +
                 short_number(vertical_deg_.back()) + ": beyond them the light is dark");
        }
        const double horizontal_end_deg = type_ == Type::a ? 180 : 90;
        horizontal_deg_ = text_.ascending(horizontal, "horizontal angle", is_c ? 0 : -horizontal_end_deg,
                                          is_c ? 360 : horizontal_end_deg);
        check_horizontal_angles();
    }

    void check_horizontal_angles() {
        if (type_ == Type::b && horizontal_deg_.size() < 2)
            text_.fail("a file of Type B needs two horizontal angles or more");
        if (type_ != Type::c || horizontal_deg_.size() == 1) return;
        const double first = horizontal_deg_.front();
        const double last = horizontal_deg_.back();
        if (is_at(first, 0) && is_at(last, 90)) {
            symmetry_ = PlaneSymmetry::both_planes;
        } else if (is_at(first, 0) && is_at(last, 180)) {
            symmetry_ = PlaneSymmetry::plane_0_180;
        } else if (is_at(first, 90) && is_at(last, 270)) {
            symmetry_ = PlaneSymmetry::plane_90_270;
        } else if (is_at(first, 0) && last > 180) {
            if (!is_at(last, 360))
                warn("the horizontal angles end at " + short_number(last) + ": read on to 0 again");
        } else {
            text_.fail("the horizontal angles run from " + short_number(first) + " to " + short_number(last) +
                       ": Type C has 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360");
        }
    }

    void read_candela(std::size_t count) {
        if (!(scale_ > 0))
            text_.fail("the multiplier, the ballast factor and the tilt factor make the light dark");
        text_.check_room(static_cast<double>(count), "candela values");
        candela_.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double value = text_.number("candela value", 0, brightest_cd) * scale_;
            if (value > brightest_cd)
                text_.fail("candela value is " + short_number(value) + " with its factors");
            candela_.push_back(value);
        }
    }

    PhotometricSolid make_solid() {
        switch (type_) {
            case Type::a:
                return type_a();
            case Type::b:
                return type_b();
            case Type::c:
                break;
        }
        std::vector<double> elevation_deg = vertical_deg_;
        for (double& angle_deg : elevation_deg)
            angle_deg -= 90;
        std::vector<Plane> planes = all_c_planes(horizontal_deg_, symmetry_);
        for (Plane& plane : planes)
            plane.angle_deg = -plane.angle_deg;  // C counts anticlockwise, bearings clockwise
        return solid_of_vertical_planes(std::move(planes), true, std::move(elevation_deg), candela_);
    }

    // The horizontal planes of A and B: a file that begins at 0 states the starboard half of a symmetric beam.
    std::vector<Plane> beam_planes() const {
        std::vector<Plane> planes;
        planes.reserve(2 * horizontal_deg_.size());
        const bool mirrored = is_at(horizontal_deg_.front(), 0);
        for (std::size_t i = horizontal_deg_.size(); mirrored && i-- > 1;)
            planes.push_back({-horizontal_deg_[i], i});
        for (std::size_t i = 0; i < horizontal_deg_.size(); ++i)
            planes.push_back({horizontal_deg_[i], i});
        return planes;
    }

    PhotometricSolid type_a() {
        std::vector<Plane> planes = beam_planes();
        const bool one = planes.size() == 1;
        if (one) warn("one horizontal angle: the same in every direction");
        const bool whole_turn = one || is_at(planes.back().angle_deg - planes.front().angle_deg, 360);
        return solid_of_vertical_planes(std::move(planes), whole_turn, vertical_deg_, candela_);
    }

    PhotometricSolid type_b() {
        PhotometricSolid solid;
        solid.axis = PhotometricSolid::Axis::starboard;
        const std::vector<Plane> planes = beam_planes();
        for (const Plane& plane : planes)
            solid.latitude_deg.push_back(plane.angle_deg);
        solid.azimuth_deg = vertical_deg_;
        solid.whole_turn = is_at(vertical_deg_.back() - vertical_deg_.front(), 360);
        if (solid.whole_turn) solid.azimuth_deg.pop_back();
        solid.candela.reserve(solid.azimuth_deg.size() * planes.size());
        for (std::size_t v = 0; v < solid.azimuth_deg.size(); ++v) {
            for (const Plane& plane : planes)
                solid.candela.push_back(candela_[plane.column * vertical_deg_.size() + v]);
        }
        finish(solid);
        return solid;
    }

    void warn_of_flux(const PhotometricSolid& solid) {
        constexpr double measured_too_well = 1.05;
        const double flux = flux_lm(solid);
        if (result_.lamp_flux_lm > 0 &&
            flux > measured_too_well * result_.lamp_flux_lm * std::max(ballast_factor_, 1.0)) {
            warn("the candela add up to " + short_number(std::round(flux)) + " lm, more than the lamps' " +
                 short_number(result_.lamp_flux_lm) + " lm");
        }
    }

    PhotometryText text_;
    PhotometryFile result_;
    Edition edition_ = Edition::lm_63_1986;
    Type type_ = Type::c;
    PlaneSymmetry symmetry_ = PlaneSymmetry::none;
    double scale_ = 1;
    double ballast_factor_ = 1;
    std::optional<double> radius_m_;
    std::vector<double> vertical_deg_;
    std::vector<double> horizontal_deg_;
    std::vector<double> candela_;
};

}  // namespace

PhotometryFile parse_ies(std::string_view text, const std::string& file) {
    return IesReader(text, file).read();
}

}  // namespace seaglare::lightdb
