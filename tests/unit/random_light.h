// Lights of all sorts, as a light file may hold them: for tests that hold for every light.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "glare/colour/named_spectra.h"
#include "lightdb/character.h"
#include "lightdb/light.h"
#include "lightdb/light_reader_parts.h"
#include "lightdb/light_store.h"
#include "lightdb/photometry.h"
#include "lightdb/profile.h"

namespace seaglare::lightdb {

class RandomLights {
  public:
    explicit RandomLights(std::uint64_t seed) : random_(seed) {}

    Light next() {
        Light light;
        light.name = text();
        place(light);
        rhythm(light);
        for (int n = chance(0.5) ? whole(1, 6) : 0; n > 0; --n)
            light.sectors.push_back(sector());
        if (chance(0.3)) light.sector_reference = SectorReference::outward_from_ahead;
        brightness(light);
        if (chance(0.2)) light.leading_bearing_deg = number(0, 360);
        if (chance(0.3)) light.horizontal = table(-180, 175);
        if (chance(0.5)) {
            const auto names = vertical_profile_names();
            light.vertical =
                chance(0.5) ? table(-90, 90) : *named_vertical_profile(names[index(names.size())]);
        }
        if (chance(0.2)) light.rotation = {(chance(0.5) ? -1 : 1) * number(0.1, 3600), table(-170, 180)};
        light.radius_m = chance(0.5) ? light.radius_m : number(0.001, 100);
        if (chance(0.3)) light.spectrum = spectrum(light);
        if (chance(0.5)) light.source = text();
        light.stable_key = chance(0.2) ? random_() | 1 : stable_key_of(light);
        return light;
    }

  private:
    bool chance(double p) { return std::bernoulli_distribution(p)(random_); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    std::size_t index(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }
    // Often a short decimal, as authors write them; often all 53 bits.
    double number(double low, double high) {
        const double value = std::uniform_real_distribution<double>(low, high)(random_);
        if (chance(0.5)) return value;
        const double rounded = std::round(value * 100) / 100;
        return rounded < low || rounded > high ? value : rounded;
    }
    SharedLightSpectrum spectrum(const Light& light) {
        const auto names = glare::spectrum_names();
        const auto glasses = glare::filter_names();
        const ColourSet lit = lit_colours(light);
        LightSpectrum chosen;
        // Violet has no glass of its own.
        chosen.per_colour = chance(0.5) || lit[index_of(Colour::violet)];
        for (std::size_t c = 0; c < colour_count; ++c) {
            if (chosen.per_colour ? !lit[c] : c > 0) continue;
            chosen.choice[c].source = chance(0.2) ? glare::planck_name(number(1000, 25000))
                                                  : std::string(names[index(names.size())]);
            if (chosen.per_colour && chance(0.3))
                chosen.choice[c] = {"e", std::string(glasses[index(glasses.size())])};
        }
        if (!chosen.per_colour) chosen.choice[0].source = chance(0.5) ? "a" : "led_white";
        if (std::find(lit.begin(), lit.end(), true) == lit.end()) return {};
        return resolved(chosen, lit, lamps_);
    }
    std::string text() {
        static constexpr const char* pieces[] = {"",   "a",  "Ø",  " ",    "\"",
                                                 "\\", "\n", "灯", "\x01", "\U0001F6A8"};
        std::string result;
        for (int n = whole(0, 4); n > 0; --n)
            result += pieces[index(std::size(pieces))];
        return result;
    }
    Colour colour() { return static_cast<Colour>(whole(0, colour_count - 1)); }

    void place(Light& light) {
        if (chance(0.5)) {
            light.geographic = true;
            light.latitude_deg = number(-90, 90);
            light.longitude_deg = number(-180, 180);
            light.height_m = number(-500, 5000);
        } else {
            light.position_m = {number(-1e7, 1e7), number(-1, 1), number(-500, 5000)};
            light.height_m = light.position_m[2];
            if (chance(0.3)) light.body_id = static_cast<std::uint32_t>(random_());
            if (chance(0.3)) light.true_north_deg = number(-360, 360);
        }
        if (chance(0.3)) {
            const double half_rad = number(-3, 3);
            light.orientation = {0, std::sin(half_rad), 0, std::cos(half_rad)};
        }
    }
    void rhythm(Light& light) {
        static constexpr const char* characters[] = {"F R",        "Fl(2) WRG 10s",   "Q(6)+LFl 15s",
                                                     "Al WR 7s",   "Iso 4s",          "Mo(K) Y 20s",
                                                     "Oc G 5s 3m", "Fl W 5s 12m 10M", "FFl 10s"};
        if (chance(0.6)) {
            light.character = characters[index(std::size(characters))];
            light.rhythm = parse_character(light.character).rhythm;
        }
        if (light.character.empty() || chance(0.3)) {
            light.rhythm.phases.clear();
            light.rhythm.period_s = 0;
            for (int n = whole(0, 5); n > 0; --n) {
                Phase phase{number(0.001, 30), chance(0.5)};
                if (phase.lit) {
                    phase.colour = colour();
                    if (chance(0.3)) phase.level = number(0, 1);
                }
                light.rhythm.period_s += phase.duration_s;
                light.rhythm.phases.push_back(phase);
            }
        }
        if (chance(0.3)) light.rhythm.sync_group = text();
        if (chance(0.3)) light.rhythm.delay_s = number(-3600, 3600);
        if (chance(0.3)) light.rhythm.rise_s = number(0, 60);
        if (chance(0.3)) light.rhythm.fall_s = number(0, 60);
    }
    Sector sector() {
        Sector sector;
        if (chance(0.8)) sector.colour = colour();
        sector.from_deg = number(-360, 360);
        sector.to_deg = sector.from_deg + number(0.5, 359);
        if (chance(0.3)) sector.intensity_factor = number(0, 100);
        if (chance(0.3)) sector.transition_deg = number(0, 90);
        if (chance(0.2)) sector.from_elevation_deg = number(-90, 0);
        if (chance(0.2)) sector.to_elevation_deg = number(0.1, 90);
        return sector;
    }
    void brightness(Light& light) {
        const bool by_range = chance(0.5);
        for (double& intensity_cd : light.intensity_cd) {
            if (chance(0.3)) continue;
            intensity_cd = by_range ? intensity_for_range_cd(whole(1, 300) / 10.0) : number(0, 1e8);
        }
        light.day_off = chance(0.2);
        if (light.day_off || chance(0.6)) return;
        const bool by_day_range = chance(0.5);
        for (double& intensity_cd : light.day_intensity_cd) {
            intensity_cd = by_day_range ? intensity_for_range_cd(whole(1, 150) / 10.0, day_threshold_lx)
                                        : number(0, 1e8);
        }
    }
    AngleTable table(double low_deg, double high_deg) {
        AngleTable table;
        for (double angle_deg = number(low_deg, low_deg + 20); angle_deg <= high_deg;
             angle_deg += number(0.5, 90)) {
            table.angle_deg.push_back(angle_deg);
            table.factor.push_back(number(0, 10));
        }
        return table;
    }

    std::mt19937_64 random_;
    LampShelf lamps_;
};

}  // namespace seaglare::lightdb
