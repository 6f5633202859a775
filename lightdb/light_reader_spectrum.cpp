// A light's lamps: one name or object for all its colours, or an object by colour.
//
//     "spectrum": "led_white"      "spectrum": {"planck_k": 2700}      "spectrum": {"source": "a", "filter": "red"}
//     "spectrum": {"W": "led_white", "R": "sector_red.spdx", "G": {"source": "a", "filter": "green"}}
#include <algorithm>
#include <array>
#include <filesystem>

#include "glare/colour/named_spectra.h"
#include "lightdb/lamp_choice.h"
#include "lightdb/light_reader_parts.h"

namespace seaglare::lightdb {

namespace {

using json::ObjectReader;

std::string found_from(const LightFolder& folder, const std::string& name) {
    return is_lamp_file(name) ? (std::filesystem::path(folder.path) / name).string() : name;
}

LampChoice read_choice(const json::Value& value, const LightFolder& folder) {
    LampChoice choice;
    if (value.kind() != json::Kind::object) {
        choice.source = found_from(folder, json::checked_string(value, "spectrum"));
        if (choice.source.empty()) throw value.error("'spectrum' is empty");
        return choice;
    }
    ObjectReader reader(value, "spectrum");
    const auto kelvin = reader.optional_number("planck_k", glare::coldest_planck_k, glare::hottest_planck_k);
    const auto source = reader.optional_string("source");
    if (kelvin.has_value() == source.has_value())
        throw reader.error("give its lamp as 'source' or as 'planck_k', or a lamp for each colour");
    choice.source = kelvin ? glare::planck_name(*kelvin) : found_from(folder, *source);
    if (const auto filter = reader.optional_string("filter")) choice.filter = found_from(folder, *filter);
    reader.finish();
    return choice;
}

bool is_by_colour(const json::Value& value) {
    return value.kind() == json::Kind::object &&
           std::any_of(std::begin(colour_names), std::end(colour_names), [&](const ColourName& colour) {
               return value.find(colour.letters) != nullptr || value.find(colour.name) != nullptr;
           });
}

void read_by_colour(const json::Value& value, const LightFolder& folder, const ColourSet& lit,
                    LightSpectrum& chosen) {
    chosen.per_colour = true;
    ObjectReader reader(value, "spectrum");
    for (const ColourName& colour : colour_names) {
        const bool by_letters = reader.has(colour.letters);
        if (by_letters && reader.has(colour.name)) throw reader.error("the same colour twice");
        const json::Value* const lamp = reader.find(by_letters ? colour.letters : colour.name);
        if (lamp == nullptr) continue;
        if (!lit[index_of(colour.colour)])
            throw lamp->error("a lamp for " + std::string(colour.name) + ", which the light does not show");
        chosen.choice[index_of(colour.colour)] = read_choice(*lamp, folder);
    }
    reader.finish();
}

// A red light with a white lamp and no glass is a likely slip.
void warn_of_another_colour(const json::Value& value, const LightSpectrum& spectrum,
                            std::vector<std::string>& warnings) {
    for (std::size_t c = 0; c < colour_count; ++c) {
        if (!spectrum.lamp[c] || c == index_of(Colour::violet)) continue;
        std::array<double, index_of(Colour::violet)> distance_nm{};
        for (std::size_t other = 0; other < distance_nm.size(); ++other) {
            distance_nm[other] = glare::spectral_distance_nm(
                *spectrum.lamp[c], glare::navigation_lamp_spectrum(static_cast<int>(other)));
        }
        const auto nearest = static_cast<std::size_t>(
            std::min_element(distance_nm.begin(), distance_nm.end()) - distance_nm.begin());
        if (nearest == c || distance_nm[nearest] > distance_nm[c] / 2) continue;
        std::string text = "the lamp of the colour " + std::string(colour_names[c].name) + " is " +
                           std::string(colour_names[nearest].name);
        if (nearest == index_of(Colour::white)) text += ": is a 'filter' missing?";
        warnings.emplace_back(value.error(text).what());
    }
}

}  // namespace

ColourSet lit_colours(const Light& light) {
    ColourSet lit{};
    for (std::size_t c = 0; c < colour_count; ++c)
        lit[c] = light.intensity_cd[c] > 0 || light.day_intensity_cd[c] > 0;
    return lit;
}

void read_spectrum(ObjectReader& reader, LightFolder& folder, Light& light,
                   std::vector<std::string>& warnings) {
    const json::Value* const value = reader.find("spectrum");
    if (value == nullptr) return;
    const ColourSet lit = lit_colours(light);
    LightSpectrum chosen;
    if (is_by_colour(*value)) {
        read_by_colour(*value, folder, lit, chosen);
    } else {
        chosen.choice[0] = read_choice(*value, folder);
    }
    try {
        light.spectrum = resolved(std::move(chosen), lit, folder.lamps);
    } catch (const LampError& error) {
        throw value->error(error.what());
    }
    warn_of_another_colour(*value, *light.spectrum, warnings);
}

}  // namespace seaglare::lightdb
