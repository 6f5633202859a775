#include "lightdb/lamp_choice.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <system_error>
#include <vector>

#include "glare/colour/named_spectra.h"
#include "lightdb/json/reader.h"
#include "lightdb/spectrum_file.h"

namespace seaglare::lightdb {

namespace {

namespace fs = std::filesystem;
using glare::Spectrum;

constexpr int deepest_source = 8;  // files that name files

bool ends_with_json(std::string_view name) {
    return name.ends_with(".json") || name.ends_with(".JSON");
}

std::string list_of(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names)
        text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

std::string unknown(const char* what, std::string_view name, std::span<const std::string_view> names) {
    std::string text = std::string("unknown ") + what + " '" + std::string(name) + "'";
    const std::string_view near = json::nearest_name(name, names);
    if (!near.empty()) return text + ", did you mean '" + std::string(near) + "'?";
    return text + ": it is none of " + list_of(names) + ", and no file ending in .csv or .spdx";
}

SpectrumTable table_from(const std::string& path) {
    try {
        return load_spectrum_table(path);
    } catch (const SpectrumFileError& error) {
        throw LampError(std::string("the spectrum file is not valid: ") + error.what());
    } catch (const std::system_error& error) {
        throw LampError("cannot read '" + path + "': " + error.code().message());
    }
}

// A table as it stands, for products at its own resolution.
Spectrum interpolated(SpectrumTable table) {
    auto shared = std::make_shared<const SpectrumTable>(std::move(table));
    const auto lamp = glare::LampSpectrum::from(shared->wavelength_nm, shared->value);
    if (!lamp) return [](double) { return 0.0; };
    return [lamp = *lamp](double l) { return lamp.power(l); };
}

// A glass passes at most all of the light; only the shape matters, as with a lamp.
Spectrum filter_of(const std::string& name) {
    if (const auto named = glare::named_filter(name)) return *named;
    if (!is_spectrum_table_name(name)) throw LampError(unknown("filter", name, glare::filter_names()));
    SpectrumTable table = table_from(name);
    if (table.quantity == SpectralQuantity::power)
        throw LampError("'" + name + "' is the spectrum of a lamp, not the transmittance of a glass");
    return interpolated(std::move(table));
}

Spectrum source_of(const std::string& name, int depth);

Spectrum gaussians_of(json::ObjectReader& reader) {
    struct Lobe {
        double peak_nm;
        double sigma_nm;
        double power;
    };
    std::vector<Lobe> lobes;
    const double sigma_per_fwhm = 1 / (2 * std::sqrt(2 * std::numbers::ln2));
    for (const json::Value& value : reader.array("gaussians")) {
        json::ObjectReader lobe(value, "gaussian");
        const double peak_nm = lobe.number("peak_nm", 300, 900);
        const auto fwhm_nm = lobe.optional_number("fwhm_nm", 1, 1000);
        const auto sigma_nm = lobe.optional_number("sigma_nm", 0.5, 500);
        if (fwhm_nm.has_value() == sigma_nm.has_value())
            throw lobe.error("give its width as 'sigma_nm' or as 'fwhm_nm'");
        const double power = lobe.number("power", 0, 1e6, 1);
        lobe.finish();
        lobes.push_back({peak_nm, sigma_nm ? *sigma_nm : *fwhm_nm * sigma_per_fwhm, power});
    }
    if (lobes.empty()) throw reader.require("gaussians").error("'gaussians' needs one at least");
    return [lobes](double l) {
        double sum = 0;
        for (const Lobe& lobe : lobes)
            sum += lobe.power * glare::gaussian(l, lobe.peak_nm, lobe.sigma_nm);
        return sum;
    };
}

// A name within a spectrum file: a file beside it, or no file.
std::string beside(const std::string& file, const std::string& name) {
    return is_lamp_file(name) ? (fs::path(file).parent_path() / name).string() : name;
}

Spectrum read_spectrum(const json::Document& document, int depth) {
    const std::string& file = document.file();
    json::ObjectReader reader(document.root(), "spectrum");
    static constexpr std::string_view keys[] = {"name",     "reference", "table", "gaussians",
                                                "planck_k", "source",    "filter"};
    reader.only(keys);
    reader.optional_string("name");
    reader.optional_string("reference");
    int ways = 0;
    Spectrum spectrum;
    const auto named = [&](std::string_view key, auto&& make) {
        if (!reader.has(key)) return;
        ++ways;
        try {
            spectrum = make();
        } catch (const LampError& error) {
            throw reader.require(key).error(error.what());
        }
    };
    named("table", [&] {
        const std::string name = reader.string("table");
        if (!is_spectrum_table_name(name)) throw LampError("'table' is a file ending in .csv or .spdx");
        return source_of(beside(file, name), depth);
    });
    named("gaussians", [&] { return gaussians_of(reader); });
    named("planck_k", [&] {
        const double kelvin = reader.number("planck_k", glare::coldest_planck_k, glare::hottest_planck_k);
        return Spectrum([kelvin](double l) { return glare::planck(l, kelvin); });
    });
    named("source", [&] { return source_of(beside(file, reader.string("source")), depth); });
    if (ways != 1) throw reader.error("give one of 'table', 'gaussians', 'planck_k' and 'source'");
    if (const auto filter = reader.optional_string("filter")) {
        try {
            spectrum = [lamp = spectrum, glass = filter_of(beside(file, *filter))](double l) {
                return lamp(l) * glass(l);
            };
        } catch (const LampError& error) {
            throw reader.require("filter").error(error.what());
        }
    }
    reader.finish();
    if (!glare::LampSpectrum::from(spectrum))
        throw reader.error("the spectrum has no light that the eye sees");
    return spectrum;
}

Spectrum source_of(const std::string& name, int depth) {
    if (auto named = glare::named_spectrum(name)) return *std::move(named);
    if (name.starts_with(glare::planck_prefix))
        throw LampError("'" + name + "' has no temperature from 1000 to 25000 K");
    if (is_spectrum_table_name(name)) {
        SpectrumTable table = table_from(name);
        if (table.quantity == SpectralQuantity::transmittance)
            throw LampError("'" + name + "' is the transmittance of a glass, not the spectrum of a lamp");
        return interpolated(std::move(table));
    }
    if (!ends_with_json(name)) throw LampError(unknown("spectrum", name, glare::spectrum_names()));
    if (depth >= deepest_source) throw LampError("'" + name + "' names files that name files without an end");
    try {
        return read_spectrum(json::parse_file(name), depth + 1);
    } catch (const std::system_error& error) {
        throw LampError("cannot read '" + name + "': " + error.code().message());
    } catch (const json::Error& error) {
        throw LampError(std::string("the spectrum file is not valid: ") + error.what());
    }
}

}  // namespace

bool is_lamp_file(std::string_view name) {
    return is_spectrum_table_name(name) || ends_with_json(name);
}

SharedLamp LampShelf::lamp(const LampChoice& choice) {
    SharedLamp& known = lamps_[{choice.source, choice.filter}];
    if (known) return known;
    Spectrum spectrum = source_of(choice.source, 0);
    if (!choice.filter.empty()) {
        spectrum = [lamp = spectrum, glass = filter_of(choice.filter)](double l) {
            return lamp(l) * glass(l);
        };
    }
    const auto lamp = glare::LampSpectrum::from(spectrum);
    if (!lamp) {
        throw LampError("'" + choice.source + "'" +
                        (choice.filter.empty() ? "" : " behind the filter '" + choice.filter + "'") +
                        " has no light that the eye sees");
    }
    known = std::make_shared<const glare::LampSpectrum>(*lamp);
    return known;
}

SharedLightSpectrum resolved(LightSpectrum chosen, const std::array<bool, LightSpectrum::colours>& shown,
                             LampShelf& shelf) {
    const bool several = std::count(shown.begin(), shown.end(), true) > 1;
    for (std::size_t c = 0; c < LightSpectrum::colours; ++c) {
        chosen.lamp[c] = nullptr;
        LampChoice choice = chosen.choice[chosen.per_colour ? c : 0];
        if (!shown[c] || choice.source.empty()) continue;
        if (!chosen.per_colour && several) {
            if (!choice.filter.empty())
                throw LampError("one filter, but the light shows several colours: give each its own lamp");
            if (c != 0) {
                const auto glass = glare::filter_of_colour(static_cast<int>(c));
                if (!glass) throw LampError("there is no filter for violet: give each colour its own lamp");
                choice.filter = *glass;
            }
        }
        chosen.lamp[c] = shelf.lamp(choice);
    }
    return std::make_shared<const LightSpectrum>(std::move(chosen));
}

bool operator==(const LightSpectrum& a, const LightSpectrum& b) {
    for (std::size_t c = 0; c < LightSpectrum::colours; ++c) {
        const SharedLamp& p = a.lamp[c];
        const SharedLamp& q = b.lamp[c];
        if (p != q && !(p && q && *p == *q)) return false;
    }
    return true;
}

}  // namespace seaglare::lightdb
