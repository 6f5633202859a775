#include "lightdb/import/charted_light.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lightdb/character.h"
#include "lightdb/photometry.h"

namespace seaglare::lightdb {
namespace {

constexpr double floating_height_m = 3;  // of a buoy's lantern above the water, where none is given

std::string letters(const std::vector<Colour>& colours) {
    std::string text;
    for (const Colour colour : colours)
        text += colour_letter(colour);
    return text;
}

void add_unique(std::vector<Colour>& colours, Colour colour) {
    if (std::find(colours.begin(), colours.end(), colour) == colours.end()) colours.push_back(colour);
}

bool has_sector(const ChartedLight& light) {
    return light.sector_from_deg && light.sector_to_deg;
}

// What the objects of one lantern have in common.
bool same_lantern(const ChartedLight& a, const ChartedLight& b) {
    return a.light_class == b.light_class && a.group == b.group && a.period_s == b.period_s &&
           a.sequence == b.sequence && a.lamps == b.lamps && a.day_only == b.day_only &&
           a.all_day == b.all_day && a.name == b.name && a.height_m == b.height_m;
}

double width_deg(const ChartedLight& light) {
    const double turn = *light.sector_to_deg - *light.sector_from_deg;
    const double width = tidy_bearing_deg(turn);
    return width == 0 && turn != 0 ? 360 : width;
}

bool overlap(const ChartedLight& a, const ChartedLight& b) {
    return tidy_bearing_deg(*b.sector_from_deg - *a.sector_from_deg) < width_deg(a) ||
           tidy_bearing_deg(*a.sector_from_deg - *b.sector_from_deg) < width_deg(b);
}

// Groups of objects that become one light, in their order.
std::vector<std::vector<const ChartedLight*>> lanterns(const ChartedPlace& place) {
    std::vector<std::vector<const ChartedLight*>> groups;
    for (const ChartedLight& light : place.lights) {
        const bool alternates = light.colours.size() > 1;
        auto found = groups.end();
        if (has_sector(light) && !alternates)
            found = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
                return has_sector(*group.front()) && group.front()->colours.size() <= 1 &&
                       same_lantern(*group.front(), light);
            });
        if (found == groups.end()) {
            groups.push_back({&light});
        } else {
            found->push_back(&light);
        }
    }
    return groups;
}

class Builder {
  public:
    explicit Builder(const ChartedPlace& place) : place_(place) {}

    ChartedResult build() {
        const auto groups = lanterns(place_);
        const std::vector<std::size_t> in_step = one_optic(groups);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            const bool step = std::find(in_step.begin(), in_step.end(), g) != in_step.end();
            add(groups[g], groups.size() > 1, step);
        }
        return std::move(result_);
    }

  private:
    // Lanterns of one place whose sectors, taken together, do not overlap: a direction light that shows "F" in one
    // sector and "Oc" in the next is one optic, and turns its shutters in step.
    static std::vector<std::size_t> one_optic(const std::vector<std::vector<const ChartedLight*>>& groups) {
        std::vector<std::size_t> members;
        std::vector<const ChartedLight*> all;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            if (!has_sector(*groups[g].front())) continue;
            members.push_back(g);
            all.insert(all.end(), groups[g].begin(), groups[g].end());
        }
        if (members.size() < 2) return {};
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = i + 1; j < all.size(); ++j)
                if (overlap(*all[i], *all[j])) return {};
        return members;
    }

    std::string about(const ChartedLight& light, const std::string& text) const {
        return light.id.empty() ? text : light.id + ": " + text;
    }
    void doubt(const ChartedLight& light, const std::string& text) {
        result_.doubts.push_back(about(light, text));
    }

    void add(const std::vector<const ChartedLight*>& objects, bool several, bool in_step) {
        const ChartedLight& first = *objects.front();
        if (first.day_only) {
            for (const ChartedLight* object : objects)
                result_.left_out.push_back(about(*object, "it is shown by day only"));
            return;
        }
        std::vector<Colour> colours;
        for (const ChartedLight* object : objects)
            if (object->visibility != Visibility::obscured)
                for (const Colour colour : object->colours)
                    add_unique(colours, colour);
        ImportedLight light;
        light.notes = first.notes;
        if (colours.empty()) {
            const bool dark = std::all_of(objects.begin(), objects.end(), [](const auto* object) {
                return object->visibility == Visibility::obscured;
            });
            if (dark) {
                for (const ChartedLight* object : objects)
                    result_.left_out.push_back(about(*object, "it is obscured all over its sectors"));
                return;
            }
            colours = {Colour::white};
            light.notes.emplace_back("no colour is given: white assumed");
        }
        light.latitude_deg = tidy_position_deg(place_.latitude_deg);
        light.longitude_deg = tidy_position_deg(place_.longitude_deg);
        light.source = place_.source;
        light.all_day = first.all_day;
        if (first.orientation_deg && (first.leading || first.directional))
            light.leading_bearing_deg = tidy_bearing_deg(*first.orientation_deg);
        set_height(first, light);
        if (const std::string reason = set_character(first, colours, light); !reason.empty()) {
            for (const ChartedLight* object : objects)
                result_.left_out.push_back(about(*object, reason));
            return;
        }
        set_ranges(objects, colours, light);
        set_sectors(objects, colours, light);
        light.name = name_of(first, colours, several, objects.size() > 1);
        if (in_step || first.synchronized) light.sync_group = place_.record;
        add_lamps(first, std::move(light));
    }

    std::string name_of(const ChartedLight& first, const std::vector<Colour>& colours, bool several,
                        bool sectored) const {
        std::string name = place_.name.empty() ? place_.record : place_.name;
        if (!first.name.empty() && first.name != place_.name) name += ", " + first.name;
        const auto add = [&](bool is, std::string_view word) {
            if (is && name.find(word) == std::string::npos) name += ", " + std::string(word);
        };
        add(first.front, "front");
        add(first.rear, "rear");
        if (several && !first.id.empty()) name += ", " + first.id;
        if (several && first.id.empty() && !sectored) name += ", " + letters(colours);
        return name;
    }

    void set_height(const ChartedLight& first, ImportedLight& light) {
        if (first.height_m && *first.height_m > 0 && *first.height_m <= highest_m) {
            light.height_m = *first.height_m;
            return;
        }
        if (first.height_m) doubt(first, "a height of " + plain_number(*first.height_m) + " m is left out");
        light.height_m = place_.floating ? floating_height_m : assumed_height_m;
        light.notes.push_back("no height is given: " + plain_number(light.height_m) + " m assumed");
    }

    // Empty, or why the character cannot be read.
    std::string set_character(const ChartedLight& first, const std::vector<Colour>& colours,
                              ImportedLight& light) {
        std::string light_class = class_with_group(first.light_class, first.group);
        if (light_class.empty()) {
            light_class = first.period_s && *first.period_s > 0 ? "Fl" : "F";
            light.notes.push_back("no character is given: " +
                                  std::string(light_class == "F" ? "fixed" : "flashing") + " assumed");
        }
        std::string prefix;
        if (first.directional) prefix += "Dir ";
        if (first.aero) prefix += "Aero ";
        std::string text = prefix + light_class + " " + letters(colours);
        if (first.period_s && *first.period_s > 0) text += " " + plain_number(*first.period_s) + "s";
        std::string with_durations = text;
        if (const auto durations = durations_of_sequence(first.sequence)) {
            if (!durations->empty()) with_durations += " " + *durations;
        } else {
            doubt(first, "its sequence '" + first.sequence + "' is not understood");
        }
        try {
            return accept(first, parse_character(with_durations), colours, light);
        } catch (const CharacterError& error) {
            if (with_durations != text) {
                try {
                    const Character character = parse_character(text);
                    doubt(first, "its sequence '" + first.sequence +
                                     "' does not fit its character: " + error.what());
                    return accept(first, character, colours, light);
                } catch (const CharacterError&) {
                    // The class is what cannot be read; its phases may still do.
                }
            }
            if (phases_alone(first, colours.front(), light)) {
                doubt(first, "no notation for '" + light_class + "': only its phases are kept");
                return {};
            }
            return "character '" + text + "': " + error.what();
        }
    }

    // Empty, or why it cannot be the character of a light of these colours.
    std::string accept(const ChartedLight& first, const Character& character,
                       const std::vector<Colour>& colours, ImportedLight& light) {
        for (const Colour colour : character.colours) {
            if (std::find(colours.begin(), colours.end(), colour) == colours.end())
                return "character '" + first.light_class + "': names a colour besides " + letters(colours);
        }
        for (const std::string& warning : character.warnings)
            doubt(first, warning);
        for (const std::string& assumption : character.assumptions)
            if (assumption.find("no period") != std::string::npos) light.notes.push_back(assumption);
        light.character = format_character(character);
        return {};
    }

    // "Oc+Fl" and the like have no notation of ours; with a sequence they need none.
    bool phases_alone(const ChartedLight& first, Colour colour, ImportedLight& light) const {
        const auto durations = durations_of_sequence(first.sequence);
        if (!durations || durations->empty()) return false;
        try {
            light.phases =
                parse_character("Fl " + std::string(colour_letter(colour)) + " " + *durations).rhythm.phases;
        } catch (const CharacterError&) {
            return false;
        }
        return !light.phases.empty();
    }

    void set_ranges(const std::vector<const ChartedLight*>& objects, const std::vector<Colour>& colours,
                    ImportedLight& light) {
        double smallest = 1e9;
        for (const ChartedLight* object : objects) {
            if (!object->range_nm) continue;
            if (!(*object->range_nm > 0 && *object->range_nm <= farthest_nm)) {
                doubt(*object, "a range of " + plain_number(*object->range_nm) + " M is left out");
                continue;
            }
            smallest = std::min(smallest, *object->range_nm);
        }
        double largest_of_all = 0;
        for (const Colour colour : colours) {
            double largest = 0;
            for (const ChartedLight* object : objects)
                if (object->range_nm && *object->range_nm <= farthest_nm &&
                    std::find(object->colours.begin(), object->colours.end(), colour) !=
                        object->colours.end())
                    largest = std::max(largest, *object->range_nm);
            if (!(largest > 0)) {
                largest = smallest < 1e9 ? smallest : assumed_range_nm;
                light.notes.push_back("no range is given for " + std::string(colour_letter(colour)) + ": " +
                                      plain_number(largest) + " M assumed");
            }
            light.nominal_range_nm.emplace_back(colour, largest);
            largest_of_all = std::max(largest_of_all, largest);
        }
        light.radius_m = lantern_radius_m(largest_of_all);
    }

    static double range_of(const ImportedLight& light, Colour colour) {
        for (const auto& [of, range_nm] : light.nominal_range_nm)
            if (of == colour) return range_nm;
        return 0;
    }

    void set_sectors(const std::vector<const ChartedLight*>& objects, const std::vector<Colour>& colours,
                     ImportedLight& light) {
        for (const ChartedLight* object : objects) {
            if (!has_sector(*object)) {
                if (object->sector_from_deg || object->sector_to_deg)
                    doubt(*object, "its sector has one limit only: left out");
                if (object->directional && object->orientation_deg) {
                    light.sectors.push_back(
                        {colours.front(), tidy_bearing_deg(*object->orientation_deg - line_half_width_deg),
                         tidy_bearing_deg(*object->orientation_deg + line_half_width_deg)});
                    light.notes.push_back(
                        "a direction light of unknown width: " + plain_number(line_half_width_deg) +
                        " degrees to either side assumed");
                }
                continue;
            }
            if (width_deg(*object) == 0) {
                doubt(*object, "a sector has no width: left out");
                continue;
            }
            if (width_deg(*object) == 360 && objects.size() == 1 && object->visibility == Visibility::plain)
                continue;  // all round, said as a sector
            light.sectors.push_back(sector_of(*object, colours, light));
        }
    }

    Sector sector_of(const ChartedLight& object, const std::vector<Colour>& colours, ImportedLight& light) {
        Sector sector;
        const bool whole = width_deg(object) == 360;
        sector.from_deg = whole ? 0 : tidy_bearing_deg(*object.sector_from_deg);
        sector.to_deg = whole ? 360 : tidy_bearing_deg(*object.sector_to_deg);
        if (object.visibility == Visibility::obscured) return sector;
        sector.colour = object.colours.empty() ? colours.front() : object.colours.front();
        double factor = 1;
        if (object.range_nm && *object.range_nm > 0) {
            factor = intensity_for_range_cd(*object.range_nm) /
                     intensity_for_range_cd(range_of(light, *sector.colour));
        }
        if (factor >= 1 && object.visibility == Visibility::unintensified) {
            factor = assumed_dim_factor;
            light.notes.emplace_back("an unintensified sector: a quarter of the intensity assumed");
        } else if (factor >= 1 && object.visibility == Visibility::faint) {
            factor = faint_factor;
            light.notes.emplace_back("a faint sector: a twentieth of the intensity assumed");
        }
        sector.intensity_factor = std::max(tidy_factor(std::min(1.0, factor)), 0.001);
        return sector;
    }

    void add_lamps(const ChartedLight& first, ImportedLight light) {
        if (first.lamps < 2 || !first.vertical) {
            if (first.lamps > 1)
                light.notes.push_back(std::to_string(first.lamps) +
                                      " lamps at this position are written as one");
            result_.lights.push_back(std::move(light));
            return;
        }
        const std::string name = light.name;
        const double top_m = light.height_m;
        light.notes.push_back("lamps " + plain_number(lamp_spacing_m) + " m above each other assumed");
        for (int lamp = 0; lamp < first.lamps; ++lamp) {
            light.name = name + ", lamp " + std::to_string(lamp + 1) + " of " + std::to_string(first.lamps);
            light.height_m = std::max(0.5, top_m - lamp * lamp_spacing_m);
            if (light.sync_group.empty()) light.sync_group = place_.record;
            result_.lights.push_back(light);
        }
    }

    const ChartedPlace& place_;
    ChartedResult result_;
};

std::vector<std::string> brackets_of(const std::string& group) {
    std::vector<std::string> parts;
    if (group.find('(') == std::string::npos) return {group};
    for (std::size_t at = group.find('('); at != std::string::npos; at = group.find('(', at + 1)) {
        const std::size_t end = std::min(group.find(')', at), group.size());
        parts.push_back(group.substr(at + 1, end - at - 1));
    }
    return parts;
}

}  // namespace

std::string class_with_group(const std::string& light_class, const std::string& group) {
    std::vector<std::string> parts = brackets_of(group);
    const auto bracket = [](const std::string& text) {
        return text.empty() || text == "1" || text == "0" ? std::string() : "(" + text + ")";
    };
    const std::size_t plus = light_class.find('+');
    if (plus != std::string::npos && light_class.find('(') == std::string::npos) {
        // "6+1" of OpenSeaMap's "VQ+LFl": a count for each class.
        const std::size_t between = parts.size() == 1 ? parts[0].find('+') : std::string::npos;
        if (between != std::string::npos) {
            parts.push_back(parts[0].substr(between + 1));
            parts[0].resize(between);
        }
        parts.resize(std::max<std::size_t>(parts.size(), 2));
        return light_class.substr(0, plus) + bracket(parts[0]) + light_class.substr(plus) + bracket(parts[1]);
    }
    if (light_class.find('(') != std::string::npos) return light_class;
    // "()(1)": the fixed part of a fixed and flashing light has no group, its flashes have.
    std::string flashes;
    for (const std::string& part : parts)
        if (!part.empty()) flashes += flashes.empty() ? part : "+" + part;
    return light_class + bracket(flashes);
}

std::optional<std::string> durations_of_sequence(const std::string& sequence) {
    std::string out;
    std::size_t at = 0;
    const auto skip = [&] {
        while (at < sequence.size() && (sequence[at] == ' ' || sequence[at] == '+' || sequence[at] == ','))
            ++at;
    };
    for (skip(); at < sequence.size(); skip()) {
        const bool eclipse = sequence[at] == '(';
        if (eclipse) ++at;
        double duration_s = 0;
        const auto [end, error] = std::from_chars(sequence.data() + at, sequence.data() + sequence.size(),
                                                  duration_s, std::chars_format::fixed);
        if (error != std::errc{}) return std::nullopt;
        at = static_cast<std::size_t>(end - sequence.data());
        if (eclipse) {
            if (at >= sequence.size() || sequence[at] != ')') return std::nullopt;
            ++at;
        }
        if (!(duration_s > 0)) continue;  // a fixed part may be written as 00.0
        if (!out.empty()) out += ", ";
        out += (eclipse ? "ec. " : "fl. ") + plain_number(duration_s) + "s";
    }
    return out;
}

ChartedResult lights_of(const ChartedPlace& place) {
    return Builder(place).build();
}

}  // namespace seaglare::lightdb
