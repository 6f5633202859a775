#include "lightdb/import/osm.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "lightdb/import/charted_light.h"
#include "lightdb/import/osm_tags.h"

namespace seaglare::lightdb::osm {
namespace {

using Place = std::optional<std::pair<double, double>>;  // latitude and longitude in degrees

Place place_in(const json::Value& object) {
    const json::Value* lat = object.find("lat");
    const json::Value* lon = object.find("lon");
    if (lat == nullptr || lon == nullptr || lat->kind() != json::Kind::number ||
        lon->kind() != json::Kind::number || std::abs(lat->number()) > 90 || std::abs(lon->number()) > 180)
        return std::nullopt;
    return std::pair{lat->number(), lon->number()};
}

// The middle of some places. Lights are small, and none lies across the date line.
class Middle {
  public:
    void add(const Place& place) {
        if (!place) return;
        latitude_ += place->first;
        longitude_ += place->second;
        ++count_;
    }
    Place place() const {
        if (count_ == 0) return std::nullopt;
        return std::pair{latitude_ / count_, longitude_ / count_};
    }

  private:
    double latitude_ = 0;
    double longitude_ = 0;
    int count_ = 0;
};

// Ids are whole numbers below 2^53, which a double holds.
std::optional<std::int64_t> whole(const json::Value* id) {
    if (id == nullptr || id->kind() != json::Kind::number || !(std::abs(id->number()) < 0x1p53))
        return std::nullopt;
    return static_cast<std::int64_t>(id->number());
}

std::string id_text(const json::Value& element) {
    const json::Value* id = element.find("id");
    if (const auto number = whole(id)) return std::to_string(*number);
    return id != nullptr && id->kind() == json::Kind::string ? std::string(id->string()) : "without id";
}

using Nodes = std::map<std::int64_t, std::pair<double, double>>;

// A node's own place; a way's centre ("out center"), the middle of its geometry ("out geom") or of its nodes, where they
// stand in the same file; a relation's centre.
Place place_of(const json::Value& element, const Nodes& nodes) {
    if (const Place own = place_in(element)) return own;
    if (const json::Value* centre = element.find("center"))
        if (const Place place = place_in(*centre)) return place;
    Middle middle;
    if (const json::Value* geometry = element.find("geometry"))
        for (const json::Value& point : geometry->array())
            middle.add(place_in(point));
    if (const Place place = middle.place()) return place;
    if (const json::Value* members = element.find("nodes"))
        for (const json::Value& member : members->array())
            if (const auto number = whole(&member))
                if (const auto found = nodes.find(*number); found != nodes.end()) middle.add(found->second);
    return middle.place();
}

std::string name_of(const json::Value& tags) {
    for (const char* key : {"seamark:name", "name", "seamark:longname", "seamark:light:name"})
        if (std::string name = tag(tags, key); !name.empty()) return name;
    return {};
}

bool is_floating(const std::string& type) {
    return type.starts_with("buoy_") || type == "light_float" || type == "light_vessel";
}

void import_element(const json::Value& element, const json::Value& tags, const Nodes& nodes, Import& out) {
    ElementReport report;
    const std::string kind = tag(element, "type");
    report.id = (kind.empty() ? "element" : kind) + " " + id_text(element);
    report.name = name_of(tags);
    const Place place = place_of(element, nodes);
    TaggedLights tagged = read_tags(tags);
    report.doubts = tagged.doubts;
    for (const std::string& reason : tagged.left_out)
        report.reason += (report.reason.empty() ? "" : "; ") + reason;
    if (!has_light_tags(tags)) {
        report.reason = "it calls itself a light, but has no seamark:light tags";
    } else if (!place) {
        report.reason = "no position";
    } else if (!tagged.lights.empty()) {
        ChartedPlace charted;
        charted.name = report.name;
        charted.record = "OSM " + report.id;
        charted.source = "OpenStreetMap " + report.id + " (ODbL)";
        charted.latitude_deg = place->first;
        charted.longitude_deg = place->second;
        charted.floating = is_floating(tag(tags, "seamark:type"));
        charted.lights = std::move(tagged.lights);
        ChartedResult made = lights_of(charted);
        report.first_light = out.lights.size();
        report.light_count = made.lights.size();
        report.imported = !made.lights.empty();
        report.doubts.insert(report.doubts.end(), made.doubts.begin(), made.doubts.end());
        for (const std::string& reason : made.left_out)
            report.reason += (report.reason.empty() ? "" : "; ") + reason;
        for (ImportedLight& light : made.lights)
            out.lights.push_back(std::move(light));
    }
    if (report.imported && !report.reason.empty()) {
        report.doubts.push_back("left out: " + report.reason);
        report.reason.clear();
    }
    if (!report.imported && report.reason.empty()) report.reason = "no tag says what it shows";
    out.records.push_back(std::move(report));
}

}  // namespace

Import import_elements(const json::Value& root, std::string_view file) {
    const json::Value* elements = root.kind() == json::Kind::object ? root.find("elements") : nullptr;
    if (elements == nullptr || elements->kind() != json::Kind::array)
        throw json::Error(file, root.location(),
                          "not OSM JSON: expected {\"elements\": [...]}, as the Overpass API answers");
    Nodes nodes;
    for (const json::Value& element : elements->array())
        if (const Place place = place_in(element))
            if (const auto number = whole(element.find("id"))) nodes.emplace(*number, *place);
    Import result;
    result.elements = elements->array().size();
    for (const json::Value& element : elements->array()) {
        const json::Value* tags = element.find("tags");
        if (tags == nullptr) continue;
        const std::string type = tag(*tags, "seamark:type");
        if (has_light_tags(*tags) || type == "light_major" || type == "light_minor")
            import_element(element, *tags, nodes, result);
    }
    return result;
}

std::string light_file_text(const Import& import) {
    return imported_light_file_text(import.lights,
                                    "OpenStreetMap contributors, Open Database License (ODbL) 1.0. Generated "
                                    "by seaglare-lights import osm.");
}

}  // namespace seaglare::lightdb::osm
