// From one record of the List to its lights: characters, ranges, sectors, lamps.
#include <algorithm>
#include <array>
#include <cmath>

#include "lightdb/character.h"
#include "lightdb/import/nga_draft.h"
#include "lightdb/import/nga_ranges.h"
#include "lightdb/import/nga_text.h"

namespace seaglare::lightdb::nga {
namespace {

constexpr double alternating_colour_s = 2;  // per colour, where an alternating sector has no period

struct CharacterParts {
    std::vector<std::string> classes;  // "Fl.(2)W.R.G." or, for several lights in one record, one each
    std::string rest;                  // period and durations
};

CharacterParts split(std::string text) {
    for (std::size_t at = text.find("null"); at != std::string::npos; at = text.find("null"))
        text.erase(at, 4);
    const std::size_t line = text.find('\n');
    CharacterParts parts;
    if (line != std::string::npos) parts.rest = text.substr(line);
    std::string first = text.substr(0, line);
    for (std::size_t comma = first.find(','); comma != std::string::npos; comma = first.find(',')) {
        parts.classes.push_back(first.substr(0, comma));
        first.erase(0, comma + 1);
    }
    parts.classes.push_back(first);
    return parts;
}

void add_unique(std::vector<Colour>& colours, Colour colour) {
    if (std::find(colours.begin(), colours.end(), colour) == colours.end()) colours.push_back(colour);
}

std::string letters(const std::vector<Colour>& colours) {
    std::string text;
    for (const Colour colour : colours)
        text += std::string(colour_letter(colour)) + ".";
    return text;
}

bool inside(const Arc& arc, double bearing_deg) {
    const double width = tidy_bearing_deg(arc.to_deg - arc.from_deg);
    return tidy_bearing_deg(bearing_deg - arc.from_deg) < (width == 0 ? 360 : width);
}

class LightBuilder {
  public:
    LightBuilder(const Draft& draft, RecordReport& report)
        : draft_(draft), remarks_(draft.remarks), ranges_(draft), report_(report) {}

    std::vector<ImportedLight> build() {
        report_.doubts = draft_.doubts;
        report_.doubts.insert(report_.doubts.end(), remarks_.doubts.begin(), remarks_.doubts.end());
        report_.unread = remarks_.unread;
        const CharacterParts parts = split(draft_.characteristic);
        std::vector<std::string> classes;
        for (const SectorItem& item : remarks_.sectors)
            if (!item.light_class.empty() &&
                std::find(classes.begin(), classes.end(), item.light_class) == classes.end())
                classes.push_back(item.light_class);
        if (classes.size() > 1) return directional(classes, parts.rest);
        for (const std::string& text : parts.classes) {
            std::string whole = text;
            // "Dir.W.R.G." whose sectors say "Oc.": the class stands in the remarks.
            if (classes.size() == 1 && whole.find("Dir.") != std::string::npos &&
                whole.find(classes[0]) == std::string::npos)
                whole.replace(whole.find("Dir.") + 4, 0, classes[0]);
            const Character character = parse_character(whole + parts.rest);
            check_durations(character);
            add_lamps(character, parts.classes.size() > 1);
        }
        return std::move(lights_);
    }

  private:
    void check_durations(const Character& character) {
        for (const std::string& warning : character.warnings)
            report_.doubts.push_back(warning);
        if (character.written_phases.empty()) return;
        report_.has_phase_list = true;
        double sum = 0;
        for (const Phase& phase : character.written_phases)
            sum += phase.duration_s;
        report_.phase_list_adds_up =
            !character.period_s || std::abs(sum - *character.period_s) <= sum_tolerance_s;
    }

    ImportedLight base() const {
        ImportedLight light;
        light.name = draft_.name;
        light.latitude_deg = tidy_position_deg(draft_.position_deg->first);
        light.longitude_deg = tidy_position_deg(draft_.position_deg->second);
        light.height_m = draft_.heights_m.empty() ? assumed_height_m : draft_.heights_m.front();
        if (draft_.heights_m.empty())
            light.notes.push_back("no height is given: " + plain_number(assumed_height_m) + " m assumed");
        light.sync_group = draft_.sync_group;
        light.all_day = remarks_.all_day;
        light.source = "NGA Pub. " + draft_.volume +
                       (draft_.notice == "/" ? "" : " (" + draft_.notice + ")") + ", " + draft_.full_number();
        for (const std::string& when : remarks_.seen_sometimes)
            light.notes.push_back(tidy_name(when));
        return light;
    }

    // What lights of this record share when they are in step.
    std::string lantern_group() const {
        return draft_.sync_group.empty() ? "NGA " + draft_.number.substr(0, draft_.number.find(' '))
                                         : draft_.sync_group;
    }

    void set_ranges(ImportedLight& light, const std::vector<Colour>& colours) const {
        double largest = 0;
        for (const Colour colour : colours) {
            const double range_nm = ranges_.largest_nm(colour, light.notes);
            light.nominal_range_nm.emplace_back(colour, range_nm);
            largest = std::max(largest, range_nm);
        }
        std::vector<std::string> once;
        for (const std::string& note : light.notes)
            if (std::find(once.begin(), once.end(), note) == once.end()) once.push_back(note);
        light.notes = std::move(once);
        light.radius_m = lantern_radius_m(largest);
    }

    // A record of one character: one light, or one per lamp where they stand apart or differ in colour.
    void add_lamps(Character character, bool several) {
        const int lamps = character.lamp_count;
        const bool stacked = character.arrangement == "vert" && lamps > 1;
        const std::vector<Colour> written = character.colours;
        const bool colour_each =
            lamps > 1 && static_cast<int>(written.size()) == lamps && remarks_.sectors.empty();
        character.lamp_count = 1;
        character.arrangement.clear();
        character.height_m.reset();
        character.range_nm.clear();
        if (!stacked && !colour_each) {
            ImportedLight light = finish(character, several && written.size() == 1);
            if (lamps > 1)
                light.notes.push_back(std::to_string(lamps) + " lamps at this position are written as one");
            if (several) light.name += ", " + std::string(colour_letter(written.front()));
            lights_.push_back(std::move(light));
            return;
        }
        for (int lamp = 0; lamp < lamps; ++lamp) {
            if (colour_each) character.colours = {written[static_cast<std::size_t>(lamp)]};
            ImportedLight light = finish(character, false);
            light.name += ", lamp " + std::to_string(lamp + 1) + " of " + std::to_string(lamps);
            // One character, one flasher: lamps of one record are in step.
            if (character.rhythm.period_s > 0) light.sync_group = lantern_group();
            if (stacked && draft_.heights_m.size() == static_cast<std::size_t>(lamps)) {
                light.height_m = draft_.heights_m[static_cast<std::size_t>(lamp)];
            } else if (stacked) {
                light.height_m = std::max(0.0, light.height_m - lamp * lamp_spacing_m);
                light.notes.push_back("lamps " + plain_number(lamp_spacing_m) +
                                      " m above each other assumed");
            }
            lights_.push_back(std::move(light));
        }
    }

    ImportedLight finish(const Character& character, bool one_of_several) {
        ImportedLight light = base();
        std::vector<Colour> colours = character.colours;
        for (const SectorItem& item : remarks_.sectors)
            for (const Colour colour : item.colours) {
                if (std::find(colours.begin(), colours.end(), colour) == colours.end())
                    report_.doubts.push_back("a sector shows " + std::string(colour_letter(colour)) +
                                             ", which the characteristic does not");
                add_unique(colours, colour);
            }
        set_ranges(light, colours);
        light.sectors = sectors_for(colours, light);
        light.character = format_character(character);
        for (const std::string& assumption : character.assumptions)
            if (assumption.find("no period") != std::string::npos ||
                assumption.find("no class") != std::string::npos)
                light.notes.push_back(assumption);
        if (colours.size() > 1 && light.sectors.empty() && !one_of_several &&
            character.light_class.find("Al") == std::string::npos)
            report_.doubts.push_back("shows " + letters(colours) + " but no sectors are given: " +
                                     std::string(colour_letter(colours.front())) + " all round");
        return light;
    }

    std::vector<Sector> sectors_for(const std::vector<Colour>& colours, ImportedLight& light) {
        std::vector<Sector> sectors = chain(light);
        const Colour first = colours.front();
        if (!sectors.empty()) {
            if (remarks_.range_line_only)
                for (const Colour colour : colours)
                    add_line_where_missing(sectors, colour);
            if (!remarks_.visible.empty())
                report_.doubts.emplace_back("has sectors and a visible arc: the sectors are used");
        } else if (!remarks_.visible.empty()) {
            visible_arcs(sectors, first, light);
        } else if (remarks_.range_line_only) {
            const std::vector<double> lines = line_bearings();
            for (const double bearing : lines)
                sectors.push_back(line_sector(first, bearing));
            if (lines.empty()) {
                report_.doubts.emplace_back("visible on a range line of unknown bearing: all round");
            } else {
                light.notes.push_back("visible on the range line only: " + plain_number(line_half_width_deg) +
                                      " degrees to either side assumed");
            }
        }
        lay_over(sectors, first, light);
        return sectors;
    }

    std::vector<Sector> chain(ImportedLight& light) {
        std::vector<Sector> sectors;
        double total = 0;
        const bool intensified =
            std::any_of(remarks_.sectors.begin(), remarks_.sectors.end(),
                        [](const SectorItem& item) { return item.arc.strength == Strength::intensified; });
        for (const SectorItem& item : remarks_.sectors) {
            Sector sector;
            sector.from_deg = tidy_bearing_deg(item.arc.from_deg);
            sector.to_deg = tidy_bearing_deg(item.arc.to_deg);
            const double width = tidy_bearing_deg(sector.to_deg - sector.from_deg);
            if (width == 0) {
                report_.doubts.emplace_back("a sector has no width");
                continue;
            }
            total += width;
            if (!item.colours.empty()) {
                sector.colour = item.colours.front();
                const bool weak = item.arc.strength == Strength::unintensified ||
                                  (intensified && item.arc.strength == Strength::plain);
                if (weak)
                    sector.intensity_factor = tidy_factor(ranges_.dim_factor(*sector.colour, light.notes));
                if (item.arc.range_nm)
                    sector.intensity_factor =
                        tidy_factor(by_range(*sector.colour, *item.arc.range_nm, light));
            }
            sectors.push_back(sector);
        }
        if (total > 360.05)
            report_.doubts.push_back("the sectors span " + std::to_string(std::lround(total)) + " degrees");
        return sectors;
    }

    double by_range(Colour colour, double range_nm, const ImportedLight& light) const {
        for (const auto& [of, largest_nm] : light.nominal_range_nm)
            if (of == colour) return Ranges::factor(range_nm, largest_nm);
        return 1;
    }

    void visible_arcs(std::vector<Sector>& sectors, Colour colour, ImportedLight& light) {
        const bool intensified =
            std::any_of(remarks_.visible.begin(), remarks_.visible.end(),
                        [](const Arc& arc) { return arc.strength == Strength::intensified; });
        if (remarks_.faint_elsewhere) {
            sectors.push_back({colour, 0, 360, faint_factor, 0});
            light.notes.emplace_back("faintly visible elsewhere: a twentieth of the intensity assumed");
        }
        for (const Arc& arc : remarks_.visible) {
            Sector sector{colour, tidy_bearing_deg(arc.from_deg), tidy_bearing_deg(arc.to_deg), 1, 0};
            if (sector.from_deg == sector.to_deg) {
                report_.doubts.emplace_back("a visible arc has no width");
                continue;
            }
            if (arc.strength == Strength::unintensified || (intensified && arc.strength == Strength::plain))
                sector.intensity_factor = tidy_factor(ranges_.dim_factor(colour, light.notes));
            if (arc.range_nm) sector.intensity_factor = tidy_factor(by_range(colour, *arc.range_nm, light));
            sectors.push_back(sector);
        }
    }

    std::vector<double> line_bearings() const {
        return remarks_.range_line_deg.empty() ? draft_.range_line_deg : remarks_.range_line_deg;
    }

    static Sector line_sector(Colour colour, double bearing_deg) {
        return {colour, tidy_bearing_deg(bearing_deg - line_half_width_deg),
                tidy_bearing_deg(bearing_deg + line_half_width_deg), 1, 0};
    }

    void add_line_where_missing(std::vector<Sector>& sectors, Colour colour) const {
        for (const Sector& sector : sectors)
            if (sector.colour == colour) return;
        for (const double bearing : line_bearings())
            sectors.push_back(line_sector(colour, bearing));
    }

    std::vector<Arc> with_width(std::vector<Arc> arcs, const char* what) const {
        const auto empty = [](const Arc& arc) {
            return tidy_bearing_deg(arc.from_deg) == tidy_bearing_deg(arc.to_deg);
        };
        for (auto left = std::erase_if(arcs, empty); left > 0; --left)
            report_.doubts.push_back(std::string(what) + " arc has no width");
        return arcs;
    }

    // Obscured, intensified and unintensified arcs: where sectors overlap, the later one holds.
    void lay_over(std::vector<Sector>& sectors, Colour first, ImportedLight& light) {
        std::vector<Arc> strong = with_width(remarks_.intensified, "an intensified");
        const std::vector<Arc> weak = with_width(remarks_.unintensified, "an unintensified");
        const std::vector<Arc> obscured = with_width(remarks_.obscured, "an obscured");
        if (remarks_.intensified_on_range_line) {
            const std::vector<double> lines = line_bearings();
            for (const double bearing : lines)
                strong.push_back(
                    {bearing - line_half_width_deg, bearing + line_half_width_deg, Strength::plain, {}});
            if (lines.empty()) {
                report_.doubts.emplace_back(
                    "intensified on a range line of unknown bearing: not taken into account");
            } else {
                light.notes.push_back("intensified on the range line: " + plain_number(line_half_width_deg) +
                                      " degrees to either side assumed");
            }
        }
        const bool all_round = sectors.empty() && !(strong.empty() && weak.empty() && obscured.empty());
        if (all_round) sectors.push_back({first, 0, 360, 1, 0});
        if (!strong.empty()) intensify(sectors, strong, light);
        // Where weak arcs overlap, the light is weak once.
        const std::vector<Sector> below = weak.empty() ? std::vector<Sector>() : sectors;
        for (const Arc& arc : weak) {
            for (const Sector& sector : below) {
                if (!sector.colour) continue;
                if (const auto common = overlap(sector, arc); common) {
                    sectors.push_back(*common);
                    sectors.back().intensity_factor = tidy_factor(
                        sector.intensity_factor * ranges_.dim_factor(*sector.colour, light.notes));
                }
            }
        }
        for (const Arc& arc : obscured) {
            sectors.push_back(
                {std::nullopt, tidy_bearing_deg(arc.from_deg), tidy_bearing_deg(arc.to_deg), 1, 0});
        }
    }

    // The colours that show in the strong arcs are weaker everywhere else.
    void intensify(std::vector<Sector>& sectors, const std::vector<Arc>& strong, ImportedLight& light) const {
        std::vector<Sector> laid;
        std::vector<Colour> stronger;
        for (const Sector& sector : sectors)
            for (const Arc& arc : strong)
                if (const auto common = sector.colour ? overlap(sector, arc) : std::nullopt) {
                    laid.push_back(*common);
                    add_unique(stronger, *sector.colour);
                }
        for (Sector& sector : sectors)
            if (sector.colour &&
                std::find(stronger.begin(), stronger.end(), *sector.colour) != stronger.end())
                sector.intensity_factor =
                    tidy_factor(sector.intensity_factor * ranges_.dim_factor(*sector.colour, light.notes));
        sectors.insert(sectors.end(), laid.begin(), laid.end());
    }

    // The part of a sector inside an arc; an arc that reaches over both ends of a sector gives the piece it begins in.
    static std::optional<Sector> overlap(const Sector& sector, const Arc& arc) {
        const bool whole = sector.from_deg == 0 && sector.to_deg == 360;
        Sector common = sector;
        if (whole) {
            common.from_deg = tidy_bearing_deg(arc.from_deg);
            common.to_deg = tidy_bearing_deg(arc.to_deg);
            return common;
        }
        const Arc of_sector{sector.from_deg, sector.to_deg, Strength::plain, {}};
        const bool arc_starts_inside = inside(of_sector, arc.from_deg);
        const bool sector_starts_inside = inside(arc, sector.from_deg);
        if (!arc_starts_inside && !sector_starts_inside) return std::nullopt;
        common.from_deg = arc_starts_inside ? tidy_bearing_deg(arc.from_deg) : sector.from_deg;
        const double left_of_arc = tidy_bearing_deg(arc.to_deg - common.from_deg);
        const double left_of_sector = tidy_bearing_deg(sector.to_deg - common.from_deg);
        common.to_deg = tidy_bearing_deg(common.from_deg + std::min(left_of_arc, left_of_sector));
        if (common.from_deg == common.to_deg) return std::nullopt;
        return common;
    }

    // A directional light whose sectors differ in rhythm: one light for each class, all of one lantern and in step.
    std::vector<ImportedLight> directional(const std::vector<std::string>& classes, const std::string& rest) {
        const std::string group = lantern_group();
        for (const std::string& light_class : classes)
            for (const SectorItem& item : remarks_.sectors) {
                if (item.light_class != light_class) continue;
                if (light_class == "Al.") {
                    for (std::size_t c = 0; c < item.colours.size(); ++c)
                        lights_.push_back(alternating(item, c, group));
                    continue;
                }
                const bool fixed = light_class == "F.";
                const Character character =
                    parse_character(light_class + letters(item.colours) + (fixed ? std::string() : rest));
                check_durations(character);
                lights_.push_back(one_sector(item, item.colours, group));
                lights_.back().character = format_character(character);
                for (const std::string& assumption : character.assumptions)
                    if (assumption.find("no period") != std::string::npos)
                        lights_.back().notes.push_back(assumption);
            }
        return std::move(lights_);
    }

    ImportedLight one_sector(const SectorItem& item, const std::vector<Colour>& colours,
                             const std::string& group) const {
        ImportedLight light = base();
        light.sync_group = group;
        set_ranges(light, colours);
        const Sector sector{colours.front(), tidy_bearing_deg(item.arc.from_deg),
                            tidy_bearing_deg(item.arc.to_deg), 1, 0};
        if (sector.from_deg == sector.to_deg) {
            report_.doubts.emplace_back("a sector has no width: its light shows all round");
        } else {
            light.sectors.push_back(sector);
        }
        light.name += ", sector " + item.light_class + letters(item.colours);
        return light;
    }

    // A sector shows one colour; an alternating one is two lights that take turns.
    ImportedLight alternating(const SectorItem& item, std::size_t turn, const std::string& group) const {
        ImportedLight light = one_sector(item, {item.colours[turn]}, group);
        light.name += " (" + std::string(colour_letter(item.colours[turn])) + ")";
        const std::string half_s = plain_number(alternating_colour_s) + "s";
        light.character =
            "Iso " + std::string(colour_letter(item.colours[turn])) + " " +
            plain_number(2 * alternating_colour_s) + "s " +
            (turn == 0 ? "fl. " + half_s + ", ec. " + half_s : "ec. " + half_s + ", fl. " + half_s);
        light.notes.push_back("an alternating sector, " + half_s + " for each colour assumed");
        return light;
    }

    const Draft& draft_;
    const Remarks& remarks_;
    Ranges ranges_;
    RecordReport& report_;
    std::vector<ImportedLight> lights_;
};

}  // namespace

std::vector<ImportedLight> lights_of(const Draft& draft, RecordReport& report) {
    return LightBuilder(draft, report).build();
}

}  // namespace seaglare::lightdb::nga
