#include "lightdb/import/osm_tags.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "lightdb/light_file.h"
#include "lightdb/units.h"

namespace seaglare::lightdb::osm {
namespace {

constexpr std::string_view prefix = "seamark:light:";
constexpr double kilometres_per_mile = metres_per_nautical_mile / 1000;

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
        text.remove_suffix(1);
    return text;
}

std::vector<std::string> list_of(std::string_view text) {
    std::vector<std::string> items;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(';'), text.size());
        if (const std::string_view item = trimmed(text.substr(0, end)); !item.empty())
            items.emplace_back(item);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return items;
}

// A figure and what stands behind it: "45 ft" gives 45 and "ft".
std::optional<std::pair<double, std::string>> figure(std::string_view text) {
    text = trimmed(text);
    std::string figures(text);
    std::replace(figures.begin(), figures.end(), ',', '.');  // 3,5
    double value = 0;
    const auto [end, error] = std::from_chars(figures.data(), figures.data() + figures.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    const std::string_view unit = trimmed(text.substr(static_cast<std::size_t>(end - figures.data())));
    return std::pair{value, std::string(unit)};
}

struct ClassName {
    std::string_view osm;
    std::string_view chart;
};
constexpr ClassName classes[] = {{"FlLFl", "Fl+LFl"}, {"OcFl", "Oc+Fl"}, {"Al.Gr", "Al Fl"},
                                 {"Al.Grp", "Al Fl"}, {"fixed", "F"},    {"flashing", "Fl"}};

// Keys of one light: what follows "seamark:light:" and the number.
using Keys = std::map<std::string, std::string>;

class LightReader {
  public:
    LightReader(const Keys& keys, std::string id, TaggedLights& out)
        : keys_(keys), id_(std::move(id)), out_(out) {}

    void read() {
        ChartedLight light;
        light.id = id_;
        for (const auto& [key, value] : keys_)
            read_key(key, value, light);
        if (!reason_.empty()) {
            out_.left_out.push_back(about(reason_));
            return;
        }
        out_.lights.push_back(std::move(light));
    }

  private:
    std::string about(const std::string& text) const { return id_.empty() ? text : id_ + ": " + text; }
    void doubt(const std::string& key, const std::string& value) {
        out_.doubts.push_back(about(key + " '" + value + "' is not understood"));
    }

    void read_key(const std::string& key, const std::string& value, ChartedLight& light) {
        if (key == "character") {
            light.light_class = value;
            for (const ClassName& name : classes)
                if (name.osm == value) light.light_class = name.chart;
        } else if (key == "colour" || key == "color") {
            read_colours(value, light);
        } else if (key == "period") {
            light.period_s = measured(key, value, {{"s", 1}, {"sec", 1}, {"seconds", 1}});
        } else if (key == "group") {
            light.group = value;
            std::replace(light.group.begin(), light.group.end(), ';', '+');
        } else if (key == "sequence") {
            light.sequence = value;
        } else if (key == "height") {
            light.height_m =
                measured(key, value, {{"m", 1}, {"ft", metres_per_foot}, {"'", metres_per_foot}});
        } else if (key == "range") {
            read_range(key, value, light);
        } else if (key == "sector_start") {
            light.sector_from_deg = bearing(key, value);
        } else if (key == "sector_end") {
            light.sector_to_deg = bearing(key, value);
        } else if (key == "orientation") {
            light.orientation_deg = bearing(key, value);
        } else if (key == "multiple") {
            const auto count = figure(value);
            if (count && count->second.empty() && count->first >= 1 && count->first <= 99 &&
                count->first == std::floor(count->first)) {
                light.lamps = static_cast<int>(count->first);
            } else {
                doubt(key, value);
            }
        } else if (key == "name" || key == "information") {
            (key == "name" ? light.name : light.notes.emplace_back()) = value;
        } else if (key == "reference") {
            light.notes.push_back("list number " + value);
        } else if (key == "category") {
            for (const std::string& item : list_of(value))
                read_category(key, item, light);
        } else if (key == "visibility") {
            for (const std::string& item : list_of(value))
                read_visibility(key, item, light);
        } else if (key == "exhibition") {
            for (const std::string& item : list_of(value))
                read_exhibition(key, item, light);
        } else if (key == "status") {
            for (const std::string& item : list_of(value))
                read_status(key, item, light);
        } else {
            out_.doubts.push_back(about("the tag '" + key + "' = '" + value + "' is not understood"));
        }
    }

    struct Unit {
        std::string_view name;
        double factor;
    };
    std::optional<double> measured(const std::string& key, const std::string& value,
                                   std::initializer_list<Unit> units) {
        const auto read = figure(value);
        if (read && read->second.empty()) return read->first;
        if (read)
            for (const Unit& unit : units)
                if (read->second == unit.name) return read->first * unit.factor;
        doubt(key, value);
        return std::nullopt;
    }
    std::optional<double> bearing(const std::string& key, const std::string& value) {
        const auto degrees = measured(key, value, {{"\xC2\xB0", 1}, {"deg", 1}});
        if (!degrees || (*degrees >= -360 && *degrees <= 720)) return degrees;
        doubt(key, value);
        return std::nullopt;
    }

    void read_colours(const std::string& value, ChartedLight& light) {
        for (const std::string& item : list_of(value)) {
            if (const auto colour = colour_from_name(item)) {
                light.colours.push_back(*colour);
            } else if (item == "amber") {
                light.colours.push_back(Colour::yellow);
                light.notes.emplace_back("amber, drawn as yellow");
            } else {
                doubt("colour", item);
            }
        }
        if (light.colours.size() > 1) {
            const auto character = keys_.find("character");
            if (character == keys_.end() || !character->second.starts_with("Al"))
                out_.doubts.push_back(about("several colours, but it does not alternate: '" + value + "'"));
        }
    }

    // "12;9": of several colours, in their order; the largest holds.
    void read_range(const std::string& key, const std::string& value, ChartedLight& light) {
        std::optional<double> largest;
        const std::vector<std::string> items = list_of(value);
        for (const std::string& item : items) {
            const auto range =
                measured(key, item, {{"M", 1}, {"nm", 1}, {"NM", 1}, {"km", 1 / kilometres_per_mile}});
            if (range && (!largest || *range > *largest)) largest = range;
        }
        if (items.size() > 1)
            out_.doubts.push_back(about("several ranges, the largest holds: '" + value + "'"));
        light.range_nm = largest;
    }

    void read_category(const std::string& key, const std::string& item, ChartedLight& light) {
        if (item == "directional")
            light.directional = true;
        else if (item == "leading")
            light.leading = true;
        else if (item == "aero" || item == "air_obstruction")
            light.aero = true;
        else if (item == "front")
            light.front = true;
        else if (item == "rear")
            light.rear = true;
        else if (item == "vertical")
            light.vertical = true;
        else if (item == "horizontal")
            light.horizontal = true;
        else if (item == "lower" || item == "upper" || item == "subsidiary" || item == "floodlight" ||
                 item == "strip_light" || item == "spotlight" || item == "fog_detector" || item == "moire" ||
                 item == "emergency" || item == "bearing")
            light.notes.push_back(item);
        else
            doubt(key, item);
    }

    void read_visibility(const std::string& key, const std::string& item, ChartedLight& light) {
        if (item == "high" || item == "low") return;  // its range says how high
        if (item == "faint")
            light.visibility = Visibility::faint;
        else if (item == "intensified")
            light.visibility = Visibility::intensified;
        else if (item == "unintensified")
            light.visibility = Visibility::unintensified;
        else if (item == "obscured")
            light.visibility = Visibility::obscured;
        else if (item == "restricted" || item == "part_obscured")
            light.notes.push_back(item);
        else
            doubt(key, item);
    }

    void read_exhibition(const std::string& key, const std::string& item, ChartedLight& light) {
        if (item == "night") return;
        if (item == "24h")
            light.all_day = true;
        else if (item == "day")
            light.day_only = true;
        else if (item == "fog" || item == "warning" || item == "storm")
            light.notes.push_back("shown as " + item + " light only");
        else
            doubt(key, item);
    }

    void read_status(const std::string& key, const std::string& item, ChartedLight& light) {
        if (item == "permanent" || item == "public") return;
        if (item == "not_in_use" || item == "extinguished" || item == "historic") {
            reason_ = item == "not_in_use" ? "disused" : item;
        } else if (item == "synchronised" || item == "synchronized") {
            light.synchronized = true;
        } else if (item == "occasional" || item == "recommended" || item == "intermittent" ||
                   item == "reserved" || item == "temporary" || item == "private" || item == "mandatory" ||
                   item == "illuminated" || item == "watched" || item == "unwatched" ||
                   item == "existence_doubtful") {
            light.notes.push_back(item);
        } else {
            doubt(key, item);
        }
    }

    const Keys& keys_;
    std::string id_;
    TaggedLights& out_;
    std::string reason_;
};

}  // namespace

std::string tag(const json::Value& tags, std::string_view key) {
    const json::Value* value = tags.find(key);
    return value != nullptr ? std::string(value->string()) : std::string();
}

bool has_light_tags(const json::Value& tags) {
    for (const auto& [key, value] : tags.object())
        if (key.starts_with(prefix)) return true;
    return false;
}

TaggedLights read_tags(const json::Value& tags) {
    std::map<int, Keys> lights;  // 0: the unnumbered one
    TaggedLights out;
    for (const auto& [key, value] : tags.object()) {
        if (!key.starts_with(prefix)) continue;
        std::string_view rest = key.substr(prefix.size());
        int number = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (error == std::errc{}) {
            rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
            if (number < 1 || number > 999 || !rest.starts_with(':')) {
                out.doubts.push_back("the tag '" + std::string(key) + "' is not understood");
                continue;
            }
            rest.remove_prefix(1);
        }
        const std::string_view text = trimmed(value.string());
        if (value.kind() != json::Kind::string) {
            out.doubts.push_back("the tag '" + std::string(key) + "' is no text");
        } else if (!text.empty()) {
            lights[number].emplace(rest, text);
        }
    }
    for (const auto& [number, keys] : lights) {
        // Beside numbered lights, "seamark:light:reference" and the like say something of the whole.
        const bool whole = number == 0 && lights.size() > 1 && !keys.contains("character") &&
                           !keys.contains("colour") && !keys.contains("sector_start");
        if (whole) continue;
        LightReader(keys, number == 0 ? std::string() : "light " + std::to_string(number), out).read();
    }
    if (lights.size() > 1 && lights.contains(0)) {
        const Keys& common = lights[0];
        if (!common.contains("character") && !common.contains("colour") && !common.contains("sector_start"))
            for (const auto& [key, value] : common) {
                // What the lights do not say themselves, they have in common.
                TaggedLights shared;
                LightReader({{key, value}}, "", shared).read();
                for (ChartedLight& light : out.lights) {
                    const ChartedLight& from = shared.lights.empty() ? light : shared.lights.front();
                    if (!light.height_m) light.height_m = from.height_m;
                    if (!light.range_nm) light.range_nm = from.range_nm;
                    if (!light.period_s) light.period_s = from.period_s;
                    if (light.notes.empty()) light.notes = from.notes;
                    light.all_day = light.all_day || from.all_day;
                }
                out.doubts.insert(out.doubts.end(), shared.doubts.begin(), shared.doubts.end());
                if (!shared.left_out.empty()) {
                    out.left_out.insert(out.left_out.end(), shared.left_out.begin(), shared.left_out.end());
                    out.lights.clear();
                }
            }
    }
    return out;
}

}  // namespace seaglare::lightdb::osm
