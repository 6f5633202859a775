// Where a light shines: sectors, profiles around and up, beams that turn.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <system_error>

#include "lightdb/light_reader_parts.h"
#include "lightdb/photometry_file.h"
#include "lightdb/profile.h"
#include "lightdb/sector.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

constexpr double brightest_factor = 10;  // of a profile against the intensity it belongs to
constexpr double slowest_turn_s = 3600;
constexpr double fastest_turn_s = 0.1;

Sector read_sector(const json::Value& value) {
    ObjectReader reader(value, "sector");
    static constexpr std::string_view keys[] = {
        "colour", "from", "to", "intensity_factor", "transition_deg", "from_elevation", "to_elevation"};
    reader.only(keys);
    Sector sector;
    const json::Value& colour = reader.require("colour");
    if (colour.kind() != json::Kind::null && colour.string() != "obscured")
        sector.colour = read_colour(colour);
    sector.from_deg = reader.number("from", -360, 360);
    sector.to_deg = reader.number("to", -360, 720);
    sector.intensity_factor = reader.number("intensity_factor", 0, 100, 1);
    sector.transition_deg = reader.number("transition_deg", 0, 90, 0);
    sector.from_elevation_deg = reader.number("from_elevation", -90, 90, -90);
    sector.to_elevation_deg = reader.number("to_elevation", -90, 90, 90);
    if (sector_width_deg(sector) == 0)
        throw value.error("the sector has no width: 'from' and 'to' are equal");
    if (sector.from_elevation_deg >= sector.to_elevation_deg)
        throw value.error("the sector has no height: 'from_elevation' must lie below 'to_elevation'");
    return sector;
}

// Members "angle_deg" and "factor". Angles ascend; periodic ones stay within one turn.
AngleTable read_table(const json::Value& value, std::string_view what, double min_deg, double max_deg,
                      bool periodic) {
    ObjectReader reader(value, what);
    AngleTable table{reader.number_list("angle_deg", min_deg, max_deg),
                     reader.number_list("factor", 0, brightest_factor)};
    reader.finish();
    if (table.angle_deg.empty()) throw value.error("'angle_deg' has no numbers");
    if (table.angle_deg.size() != table.factor.size()) {
        throw value.error("'angle_deg' has " + std::to_string(table.angle_deg.size()) +
                          " numbers and 'factor' " + std::to_string(table.factor.size()));
    }
    for (std::size_t i = 1; i < table.angle_deg.size(); ++i) {
        if (table.angle_deg[i] <= table.angle_deg[i - 1]) throw value.error("'angle_deg' must ascend");
    }
    if (periodic && table.angle_deg.back() - table.angle_deg.front() >= 360)
        throw value.error("'angle_deg' goes round more than once: 360 is 0 again");
    return table;
}

AngleTable read_vertical_profile(const json::Value& value) {
    if (value.kind() != json::Kind::string) return read_table(value, "vertical_profile", -90, 90, false);
    if (auto profile = named_vertical_profile(value.string())) return *std::move(profile);
    std::string text = "there is no vertical profile '" + std::string(value.string()) + "', only";
    for (const std::string_view name : vertical_profile_names())
        text += " '" + std::string(name) + "'";
    throw value.error(text);
}

}  // namespace

void read_sectors(ObjectReader& reader, Light& light) {
    for (const json::Value& value : reader.optional_array("sectors"))
        light.sectors.push_back(read_sector(value));
    static constexpr json::Choice<SectorReference> references[] = {
        {"from_seaward", SectorReference::from_seaward},
        {"outward_from_ahead", SectorReference::outward_from_ahead},
    };
    light.sector_reference = reader.choice("sector_reference", references, SectorReference::from_seaward);
    if (reader.has("leading_bearing_deg"))
        light.leading_bearing_deg = reader.number("leading_bearing_deg", 0, 360);
}

void read_profiles(ObjectReader& reader, Light& light) {
    if (const json::Value* profile = reader.find("horizontal_profile"))
        light.horizontal = read_table(*profile, "horizontal_profile", -360, 360, true);
    if (const json::Value* profile = reader.find("vertical_profile"))
        light.vertical = read_vertical_profile(*profile);
}

// cos^2 in steps of an eighth of the width: with straight lines between them that is within 0.5 % of the peak.
AngleTable equal_beams(int beams, double width_deg) {
    constexpr int steps = 8;  // from the middle to the foot
    AngleTable table;
    for (int beam = 0; beam < beams; ++beam) {
        const double middle_deg = 360.0 * beam / beams;
        for (int i = -steps; i <= steps; ++i) {
            // Feet that touch are one sample.
            const double angle_deg = middle_deg + width_deg * i / steps;
            if (!table.angle_deg.empty() && angle_deg <= table.angle_deg.back()) continue;
            const double c = std::cos(std::numbers::pi / 2 * i / steps);
            table.angle_deg.push_back(angle_deg);
            table.factor.push_back(std::abs(i) == steps ? 0 : c * c);
        }
    }
    if (table.angle_deg.back() - table.angle_deg.front() >= 360) {
        table.angle_deg.pop_back();
        table.factor.pop_back();
    }
    return table;
}

void read_photometry(ObjectReader& reader, LightFolder& folder, Light& light,
                     std::vector<std::string>& warnings) {
    const json::Value* const value = reader.find("photometry");
    if (value == nullptr) return;
    const std::string name = json::checked_string(*value, "photometry");
    SharedSolid& solid = folder.solids[name];
    if (!solid) {
        const std::string path = (std::filesystem::path(folder.path) / name).string();
        try {
            PhotometryFile file = load_photometry_file(path);
            warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
            solid = std::move(file.solid);
        } catch (const PhotometryFileError& error) {
            throw value->error("the photometric file is not valid: " + std::string(error.what()));
        } catch (const std::system_error& error) {
            throw value->error("cannot read '" + path + "': " + error.code().message());
        }
    }
    light.photometry = solid;
}

double default_radius_m(const Light& light) {
    constexpr double smallest_m = 1e-3;
    constexpr double largest_m = 100;
    if (!light.photometry || !light.photometry->radius_m) return Light{}.radius_m;
    return std::clamp(*light.photometry->radius_m, smallest_m, largest_m);
}

void read_rotation(ObjectReader& reader, Light& light) {
    const json::Value* const value = reader.find("rotation");
    if (value == nullptr) return;
    ObjectReader rotation(*value, "rotation");
    static constexpr std::string_view keys[] = {"period_s", "direction", "beam", "beams", "width_deg"};
    rotation.only(keys);
    const double period_s = rotation.number("period_s", fastest_turn_s, slowest_turn_s);
    static constexpr json::Choice<double> directions[] = {{"clockwise", 1}, {"anticlockwise", -1}};
    light.rotation.period_s = period_s * rotation.choice("direction", directions, 1.0);
    const bool by_count = rotation.has("beams");
    if (by_count == rotation.has("beam")) {
        throw rotation.error(
            "give the beams either as a table 'beam' or as a number of them, 'beams' with 'width_deg'");
    }
    if (!by_count) {
        if (rotation.has("width_deg"))
            throw rotation.require("width_deg").error("'width_deg' belongs to 'beams', not to a table");
        light.rotation.beam = read_table(rotation.require("beam"), "beam", -360, 360, true);
        return;
    }
    const auto beams = static_cast<int>(rotation.integer("beams", 1, most_beams));
    const double width_deg = rotation.number("width_deg", 0.05, 180);
    if (beams * width_deg > 180) {
        throw rotation.require("width_deg")
            .error("so many beams of that width overlap: 'beams' times 'width_deg' must not be above 180");
    }
    light.rotation.beam = equal_beams(beams, width_deg);
}

}  // namespace seaglare::lightdb
