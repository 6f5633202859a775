#include "tests/benchmark/light_file_text.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "lightdb/json/writer.h"

namespace seaglare::benchmark {

namespace {

using json::Writer;
using Layout = Writer::Layout;

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers with every standard library.
class Random {
  public:
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31);
    }
    std::size_t below(std::size_t end) { return bits() % end; }
    double from_to(double low, double high) {
        return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }
    // Rounded as people write it.
    double decimal(double low, double high, int digits) {
        const double scale = std::pow(10, digits);
        return std::round(from_to(low, high) * scale) / scale;
    }
    template <std::size_t N>
    std::string_view one_of(const std::array<std::string_view, N>& names) {
        return names[below(N)];
    }

  private:
    std::uint64_t state_ = 20240101;
};

constexpr std::array<std::string_view, 16> places = {"Halskov Rev",
                                                     "Æbelø, nordspids",
                                                     "Måløy, Skongsnes",
                                                     "Öland, södra udde",
                                                     "Świnoujście, wejście",
                                                     "Šventoji",
                                                     "Hiiumaa, Kõpu",
                                                     "Ведущий, Толбухин",
                                                     "Turku, Örö",
                                                     "Île d’Ouessant, le Créac’h",
                                                     "Ría de Arousa",
                                                     "Πειραιάς",
                                                     "Üsküdar",
                                                     "犬吠埼灯台",
                                                     "Sejerø, havnemole",
                                                     "Kap Arkona \"Alt\""};
constexpr std::array<std::string_view, 6> characters = {"Fl(2) WRG 10s",
                                                        "Oc WRG 6s",
                                                        "Iso WRG 4s",
                                                        "Q(6)+LFl WRG 15s",
                                                        "Fl WRG 5s fl. 0.8s, ec. 2.2s, fl. 0.5s, ec. 1.5s",
                                                        "LFl WRG 12s"};
constexpr std::array<std::string_view, 3> spectra = {"", "", "led_white"};

void write_sectors(Writer& writer, Random& random) {
    writer.key("sectors");
    writer.begin_array();
    constexpr std::array<std::string_view, 3> colours = {"R", "W", "G"};
    const std::size_t count = 3 + random.below(5);
    double from_deg = random.decimal(0, 90, 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double to_deg = std::round((from_deg + random.from_to(2, 30)) * 10) / 10;
        writer.begin_object(Layout::line);
        writer.member("colour", colours[i % 3]);
        writer.member("from", from_deg);
        writer.member("to", to_deg);
        if (random.below(4) == 0) writer.member("transition_deg", random.decimal(0.1, 1.5, 2));
        writer.end_object();
        from_deg = to_deg;
    }
    writer.end_array();
}

void write_profile(Writer& writer, Random& random) {
    writer.key("vertical_profile");
    writer.begin_object();
    writer.key("angle_deg");
    writer.begin_array(Layout::line);
    for (int i = -5; i <= 5; ++i)
        writer.value(static_cast<double>(i) + 0.125);
    writer.end_array();
    writer.key("factor");
    writer.begin_array(Layout::line);
    for (int i = -5; i <= 5; ++i)
        writer.value(std::exp(-0.08 * i * i) * random.from_to(0.95, 1));  // 15 to 17 digits
    writer.end_array();
    writer.end_object();
}

void write_light(Writer& writer, Random& random, std::size_t number) {
    writer.begin_object();
    writer.member("name", std::string(random.one_of(places)) + " no. " + std::to_string(number));
    // Cartesian and geographic, in digits as a survey and as a conversion leave them.
    const double degree_of_nm = 100.0 / 60;
    if (random.below(2) == 0) {
        writer.member("lat", random.decimal(55.5 - degree_of_nm, 55.5 + degree_of_nm, 7));
        writer.member("lon", random.decimal(11 - degree_of_nm, 11 + degree_of_nm, 7));
    } else {
        writer.member("lat", random.from_to(55.5 - degree_of_nm, 55.5 + degree_of_nm));
        writer.member("lon", random.from_to(11 - degree_of_nm, 11 + degree_of_nm));
    }
    writer.member("height_m", random.decimal(2, 60, 1));
    writer.member("character", random.one_of(characters));
    writer.key("nominal_range_nm");
    writer.begin_object(Layout::line);
    const double range_nm = random.decimal(6, 18, 1);
    writer.member("W", range_nm);
    writer.member("R", std::round(range_nm * 7) / 10);
    writer.member("G", std::round(range_nm * 6) / 10);
    writer.end_object();
    write_sectors(writer, random);
    if (random.below(3) == 0) write_profile(writer, random);
    writer.member("radius_m", random.decimal(0.05, 0.5, 3));
    if (const std::string_view spectrum = random.one_of(spectra); !spectrum.empty())
        writer.member("spectrum", spectrum);
    writer.member("day", random.below(2) == 0 ? "off" : "on");
    writer.member("source", "made for measuring, not for navigation;\nrecord " + std::to_string(number));
    writer.end_object();
}

// Lights are written as long as `more(lights so far, bytes so far)`.
template <class More>
std::string text_while(const More& more) {
    std::string text = "{\n\"origin\": {\"lat\": 55.5, \"lon\": 11},\n\"lights\": [\n";
    Random random;
    for (std::size_t number = 0; more(number, text.size()); ++number) {
        Writer writer;
        write_light(writer, random, number);
        if (number != 0) text += ",\n";
        text += writer.take();
        text.pop_back();
    }
    return text += "\n]\n}\n";
}

}  // namespace

std::string light_file_text(std::size_t light_count) {
    return text_while([&](std::size_t lights, std::size_t) { return lights < light_count; });
}

std::string light_file_text_of_bytes(std::size_t bytes) {
    return text_while([&](std::size_t, std::size_t so_far) { return so_far < bytes; });
}

}  // namespace seaglare::benchmark
