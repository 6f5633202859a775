#include "lightdb/import/nga.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "lightdb/character.h"
#include "lightdb/import/nga_draft.h"
#include "lightdb/import/nga_text.h"

namespace seaglare::lightdb::nga {
namespace {

// A field of a record: its text, a number as text, or nothing where it is null, missing or anything else.
std::string field(const json::Value& record, std::string_view key) {
    const json::Value* value = record.find(key);
    if (value == nullptr) return {};
    if (value->kind() == json::Kind::number && std::abs(value->number()) < 1e9)
        return plain_number(value->number());
    return std::string(value->string());
}

int char_no(const json::Value& record) {
    const std::string text = field(record, "charNo");
    const auto number = Cursor(text).number();
    return number && *number >= 1 && *number <= 99 ? static_cast<int>(*number) : 1;
}

// "PUB 110" gives "110". Records without a volume are of Pub. 116, the one of this importer's first days.
std::string read_volume(const json::Value& record) {
    std::string digits;
    for (const char c : field(record, "volumeNumber"))
        if (c >= '0' && c <= '9' && digits.size() < 4) digits += c;
    return digits.empty() ? "116" : digits;
}

Draft read_record(const json::Value& record, std::size_t index) {
    Draft draft;
    draft.index = index;
    draft.volume = read_volume(record);
    draft.aid_type = field(record, "aidType");
    draft.removed = field(record, "removeFromList") == "Y";
    draft.number = read_number(field(record, "featureNumber"));
    draft.char_no = char_no(record);
    draft.characteristic = field(record, "characteristic");
    draft.position_text = field(record, "position");
    draft.position_deg = read_position(draft.position_text);
    draft.heights_m = read_heights_m(field(record, "heightFeetMeters"));
    draft.ranges_nm = read_ranges_nm(field(record, "range"));
    draft.remarks = read_remarks(field(record, "remarks"));
    draft.notice = field(record, "noticeYear") + "/" + field(record, "noticeWeek");
    return draft;
}

// What no light has is a slip of the pen: left out, and said.
void drop_impossible(Draft& draft) {
    const auto drop = [&](const char* what) {
        draft.doubts.push_back(std::string("an impossible ") + what + " is left out");
    };
    if (std::erase_if(draft.heights_m, [](double height_m) { return height_m > highest_m; }) > 0)
        drop("height");
    if (std::erase_if(draft.ranges_nm, [](const auto& range) {
            return !(range.second > 0 && range.second <= farthest_nm);
        }) > 0)
        drop("range");
}

std::string identity(const Draft& draft) {
    return draft.volume + "|" + draft.full_number() + "|" + draft.position_text + "|" + draft.characteristic;
}

}  // namespace

bool Area::contains(double latitude_deg, double longitude_deg) const {
    const bool over_180 = west_deg > east_deg;
    const bool in_width = over_180 ? longitude_deg >= west_deg || longitude_deg <= east_deg
                                   : longitude_deg >= west_deg && longitude_deg <= east_deg;
    if (latitude_deg < south_deg || latitude_deg > north_deg || !in_width) return false;
    if (!centre_deg) return true;
    // Great circle by haversine; a minute of arc is a nautical mile.
    constexpr double degree = std::numbers::pi / 180;
    const double half_north = std::sin((latitude_deg - centre_deg->first) * degree / 2);
    const double half_east = std::sin((longitude_deg - centre_deg->second) * degree / 2);
    const double h = half_north * half_north + std::cos(latitude_deg * degree) *
                                                   std::cos(centre_deg->first * degree) * half_east *
                                                   half_east;
    return 2 * std::asin(std::sqrt(std::min(1.0, h))) / degree * 60 <= radius_nm;
}

std::size_t Import::count(Outcome outcome) const {
    return static_cast<std::size_t>(std::count_if(
        records.begin(), records.end(), [&](const RecordReport& r) { return r.outcome == outcome; }));
}

Import import_list(const json::Value& root, std::string_view file, const Area& area) {
    const json::Value* list = root.kind() == json::Kind::array ? &root : root.find("ngalol");
    if (list == nullptr || list->kind() != json::Kind::array)
        throw json::Error(file, root.location(),
                          "not an NGA List of Lights: expected {\"ngalol\": [records]}");

    std::vector<Draft> drafts;
    std::vector<Heading> headings;
    std::size_t index = 0;
    for (const json::Value& record : list->array()) {
        drafts.push_back(read_record(record, index++));
        drop_impossible(drafts.back());
        headings.push_back(
            {field(record, "regionHeading"), field(record, "subregionHeading"), field(record, "name")});
    }
    link_records(drafts, headings);

    Import result;
    std::set<std::string> seen;
    for (const Draft& draft : drafts) {
        if (std::find(result.volumes.begin(), result.volumes.end(), draft.volume) == result.volumes.end())
            result.volumes.push_back(draft.volume);
        RecordReport report;
        report.index = draft.index;
        report.number = draft.full_number();
        report.name = draft.name;
        const auto leave_out = [&](Outcome outcome, std::string reason) {
            report.outcome = outcome;
            report.reason = std::move(reason);
        };
        const bool first = seen.insert(identity(draft)).second;
        const bool inside =
            !draft.position_deg || area.contains(draft.position_deg->first, draft.position_deg->second);
        if (!inside) {
            leave_out(Outcome::outside_area, "outside the area asked for");
        } else if (!draft.aid_type.empty() && draft.aid_type != "Lighted Aids") {
            leave_out(Outcome::no_light, "of the kind '" + draft.aid_type + "', which shows no light");
        } else if (draft.removed) {
            leave_out(Outcome::removed, "removed from the List");
        } else if (draft.is_racon()) {
            leave_out(Outcome::racon, "a radar beacon shows no light");
        } else if (!draft.position_deg) {
            leave_out(Outcome::no_position, draft.position_text.find_first_not_of(" \n") == std::string::npos
                                                ? "no position is given"
                                                : "position not understood: '" + draft.position_text + "'");
        } else if (!draft.misplaced.empty()) {
            leave_out(Outcome::no_position, draft.misplaced);
        } else if (!first) {
            leave_out(Outcome::duplicate, "the same number, position and characteristic stand before");
        } else {
            try {
                std::vector<ImportedLight> lights = lights_of(draft, report);
                report.outcome = Outcome::imported;
                report.light_count = static_cast<int>(lights.size());
                result.lights.insert(result.lights.end(), std::make_move_iterator(lights.begin()),
                                     std::make_move_iterator(lights.end()));
            } catch (const CharacterError& error) {
                leave_out(Outcome::not_understood,
                          "characteristic '" + tidy_name(draft.characteristic) + "': " + error.what());
            }
        }
        result.records.push_back(std::move(report));
    }
    return result;
}

}  // namespace seaglare::lightdb::nga
