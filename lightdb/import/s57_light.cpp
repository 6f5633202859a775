#include "lightdb/import/s57_light.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

namespace seaglare::lightdb::s57 {
namespace {

struct Code {
    int code;
    std::string_view text;
};

template <std::size_t N>
std::string_view text_of(const Code (&codes)[N], int code) {
    for (const Code& entry : codes)
        if (entry.code == code) return entry.text;
    return {};
}

// Attribute 107, LITCHR. 20, "group alternating", says no more than that the colours take turns in groups.
constexpr Code classes[] = {{1, "F"},      {2, "Fl"},      {3, "LFl"},     {4, "Q"},       {5, "VQ"},
                            {6, "UQ"},     {7, "Iso"},     {8, "Oc"},      {9, "IQ"},      {10, "IVQ"},
                            {11, "IUQ"},   {12, "Mo"},     {13, "FFl"},    {14, "Fl+LFl"}, {15, "Oc+Fl"},
                            {16, "FLFl"},  {17, "Al Oc"},  {18, "Al LFl"}, {19, "Al Fl"},  {20, "Al Fl"},
                            {25, "Q+LFl"}, {26, "VQ+LFl"}, {27, "UQ+LFl"}, {28, "Al"},     {29, "Al FFl"}};

// Attribute 149, STATUS: what a light's source should tell. 1 permanent and 14 public go without saying.
constexpr Code statuses[] = {{2, "occasional"}, {3, "recommended"},        {5, "periodic or intermittent"},
                             {6, "reserved"},   {7, "temporary"},          {8, "private"},
                             {9, "mandatory"},  {12, "illuminated"},       {16, "watched"},
                             {17, "unwatched"}, {18, "existence doubtful"}};

std::string_view value_of(const Attributes& attributes, std::string_view key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string_view() : std::string_view(found->second);
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    return text;
}

class Reader {
  public:
    Reader(const Attributes& attributes, std::vector<std::string>& doubts)
        : attributes_(attributes), doubts_(doubts) {}

    std::optional<double> number(std::string_view key) const {
        const std::string_view text = trimmed(value_of(attributes_, key));
        if (text.empty()) return std::nullopt;
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(value)) return value;
        doubts_.push_back(std::string(key) + " '" + std::string(text) + "' is no number");
        return std::nullopt;
    }

    std::vector<int> list(std::string_view key) const {
        std::vector<int> codes;
        std::string_view text = value_of(attributes_, key);
        while (!text.empty()) {
            const std::size_t comma = std::min(text.find(','), text.size());
            const std::string_view item = trimmed(text.substr(0, comma));
            int code = 0;
            const auto [end, error] = std::from_chars(item.data(), item.data() + item.size(), code);
            if (error == std::errc{} && end == item.data() + item.size()) {
                codes.push_back(code);
            } else if (!item.empty()) {
                doubts_.push_back(std::string(key) + " '" + std::string(item) + "' is no code");
            }
            text.remove_prefix(std::min(comma + 1, text.size()));
        }
        return codes;
    }

    void unknown(std::string_view key, int code) const {
        doubts_.push_back(std::string(key) + " " + std::to_string(code) + " is not understood");
    }

  private:
    const Attributes& attributes_;
    std::vector<std::string>& doubts_;
};

// Attribute 75, COLOUR.
std::optional<Colour> colour_of(int code) {
    switch (code) {
        case 1:
            return Colour::white;
        case 3:
            return Colour::red;
        case 4:
            return Colour::green;
        case 5:
            return Colour::blue;
        case 6:
        case 9:  // amber, which lights call yellow
            return Colour::yellow;
        case 10:
            return Colour::violet;
        case 11:
            return Colour::orange;
        default:
            return std::nullopt;
    }
}

// Attribute 37, CATLIT.
void read_categories(const Reader& reader, ChartedLight& light) {
    for (const int code : reader.list("CATLIT")) {
        switch (code) {
            case 1:
                light.directional = true;
                break;
            case 4:
                light.leading = true;
                break;
            case 5:
            case 6:
                light.aero = true;
                break;
            case 7:
                light.notes.emplace_back("a fog detector light");
                break;
            case 8:
                light.notes.emplace_back("a flood light");
                break;
            case 9:
                light.notes.emplace_back("a strip light");
                break;
            case 10:
                light.notes.emplace_back("a subsidiary light");
                break;
            case 11:
                light.notes.emplace_back("a spotlight");
                break;
            case 12:
                light.front = true;
                break;
            case 13:
                light.rear = true;
                break;
            case 14:
                light.notes.emplace_back("the lower light");
                break;
            case 15:
                light.notes.emplace_back("the upper light");
                break;
            case 16:
                light.notes.emplace_back("moire effect");
                break;
            case 17:
                light.notes.emplace_back("an emergency light");
                break;
            case 18:
                light.notes.emplace_back("a bearing light");
                break;
            case 19:
                light.horizontal = true;
                break;
            case 20:
                light.vertical = true;
                break;
            default:
                reader.unknown("CATLIT", code);
        }
    }
}

// Attribute 108, LITVIS.
void read_visibility(const Reader& reader, ChartedLight& light) {
    for (const int code : reader.list("LITVIS")) {
        switch (code) {
            case 1:  // high and low intensity: the range says how high
            case 2:
                break;
            case 3:
                light.visibility = Visibility::faint;
                break;
            case 4:
                light.visibility = Visibility::intensified;
                break;
            case 5:
                light.visibility = Visibility::unintensified;
                break;
            case 6:
                light.notes.emplace_back("visibility deliberately restricted");
                break;
            case 7:
                light.visibility = Visibility::obscured;
                break;
            case 8:
                light.notes.emplace_back("partially obscured");
                break;
            default:
                reader.unknown("LITVIS", code);
        }
    }
}

// Attributes 92, EXCLIT, and 149, STATUS.
void read_conditions(const Reader& reader, ChartedLight& light) {
    for (const int code : reader.list("EXCLIT")) {
        switch (code) {
            case 1:
                light.all_day = true;
                break;
            case 2:
                light.day_only = true;
                break;
            case 3:
                light.notes.emplace_back("shown in fog only");
                break;
            case 4:
                break;  // by night only, as all others
            default:
                reader.unknown("EXCLIT", code);
        }
    }
    for (const int code : reader.list("STATUS")) {
        if (code == 15) light.synchronized = true;
        if (const std::string_view text = text_of(statuses, code); !text.empty()) {
            light.notes.emplace_back(text);
        } else if (code != 1 && code != 14 && code != 15) {
            reader.unknown("STATUS", code);
        }
    }
}

}  // namespace

ChartedLight read_light(const Attributes& attributes, std::vector<std::string>& doubts) {
    const Reader reader(attributes, doubts);
    ChartedLight light;
    light.name = trimmed(value_of(attributes, "OBJNAM"));
    const std::vector<int> characters = reader.list("LITCHR");
    if (characters.size() > 1) doubts.emplace_back("LITCHR has several values: the first is used");
    if (!characters.empty()) {
        light.light_class = text_of(classes, characters.front());
        if (light.light_class.empty()) reader.unknown("LITCHR", characters.front());
    }
    light.group = trimmed(value_of(attributes, "SIGGRP"));
    light.sequence = trimmed(value_of(attributes, "SIGSEQ"));
    light.period_s = reader.number("SIGPER");
    for (const int code : reader.list("COLOUR")) {
        const auto colour = colour_of(code);
        if (!colour) {
            doubts.push_back("COLOUR " + std::to_string(code) + " is no colour of light");
        } else {
            light.colours.push_back(*colour);
            if (code == 9) light.notes.emplace_back("amber, drawn as yellow");
        }
    }
    light.sector_from_deg = reader.number("SECTR1");
    light.sector_to_deg = reader.number("SECTR2");
    light.orientation_deg = reader.number("ORIENT");
    light.height_m = reader.number("HEIGHT");
    light.range_nm = reader.number("VALNMR");
    if (const auto lamps = reader.number("MLTYLT")) {
        if (*lamps >= 1 && *lamps <= 99 && *lamps == std::floor(*lamps)) {
            light.lamps = static_cast<int>(*lamps);
        } else {
            doubts.push_back("MLTYLT '" + std::string(value_of(attributes, "MLTYLT")) + "' is no count");
        }
    }
    read_categories(reader, light);
    read_visibility(reader, light);
    read_conditions(reader, light);
    return light;
}

bool is_shown(const Attributes& attributes, std::string& reason) {
    std::vector<std::string> ignored;
    const Reader reader(attributes, ignored);
    for (const int code : reader.list("STATUS")) {
        if (code == 4) reason = "disused";
        if (code == 11) reason = "extinguished";
        if (code == 13) reason = "historic";
    }
    return reason.empty();
}

Import import_features(const std::vector<Feature>& features, std::string_view cell) {
    Import result;
    std::vector<ChartedPlace> places;
    std::vector<std::vector<std::size_t>> of_place;  // features
    std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> by_position;
    for (std::size_t i = 0; i < features.size(); ++i) {
        const Feature& feature = features[i];
        FeatureReport report;
        report.id = feature.id;
        ChartedLight light = read_light(feature.attributes, report.doubts);
        light.id = feature.id;
        report.name = light.name.empty() ? feature.structure_name : light.name;
        const bool placed = std::abs(feature.latitude_deg) <= 90 && std::abs(feature.longitude_deg) <= 180;
        if (!placed) report.reason = "no position";
        if (placed && is_shown(feature.attributes, report.reason)) {
            // S-57 positions are whole multiples of 1e-7 degrees.
            const std::pair key{std::llround(feature.latitude_deg * 1e7),
                                std::llround(feature.longitude_deg * 1e7)};
            const auto [found, fresh] = by_position.emplace(key, places.size());
            if (fresh) {
                ChartedPlace place;
                place.record = feature.id;
                place.source = std::string(cell) + ", " + feature.id;
                place.latitude_deg = feature.latitude_deg;
                place.longitude_deg = feature.longitude_deg;
                places.push_back(std::move(place));
                of_place.emplace_back();
            }
            ChartedPlace& place = places[found->second];
            place.floating = place.floating || feature.floating;
            if (place.name.empty())
                place.name = feature.structure_name.empty() ? light.name : feature.structure_name;
            place.lights.push_back(std::move(light));
            of_place[found->second].push_back(i);
            report.imported = true;
        }
        result.records.push_back(std::move(report));
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
        const ChartedResult made = lights_of(places[p]);
        result.lights.insert(result.lights.end(), made.lights.begin(), made.lights.end());
        for (const std::size_t i : of_place[p]) {
            FeatureReport& report = result.records[i];
            const std::string mark = report.id + ": ";
            for (const std::string& doubt : made.doubts)
                if (doubt.starts_with(mark)) report.doubts.push_back(doubt.substr(mark.size()));
            for (const std::string& reason : made.left_out)
                if (reason.starts_with(mark)) {
                    report.imported = false;
                    report.reason = reason.substr(mark.size());
                }
        }
    }
    return result;
}

std::string light_file_text(const Import& import, std::string_view cell) {
    return imported_light_file_text(import.lights,
                                    std::string(cell) + ". Generated by seaglare-lights import s57.");
}

}  // namespace seaglare::lightdb::s57
