#include "host_stub/report/pattern_archive.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>

namespace seaglare::report {

namespace {

using reference::ReferencePattern;
constexpr double format = 1.0001;  // changes with what a file holds, or with how the reference computes

// FNV-1a, 64 bits, over the bytes of numbers.
class Hash {
  public:
    void add(double value) {
        std::array<unsigned char, sizeof value> bytes{};
        std::copy_n(reinterpret_cast<const unsigned char*>(&value), bytes.size(), bytes.begin());
        for (const unsigned char byte : bytes)
            state_ = (state_ ^ byte) * 0x100000001b3U;
    }
    std::string text() const {
        std::array<char, 24> digits{};
        std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(state_));
        return digits.data();
    }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325U;
};

std::string name_of(const reference::ReferenceRequest& request,
                    const std::vector<std::vector<reference::SpectralLine>>& lamps) {
    Hash hash;
    const reference::Aperture aperture =
        reference::aperture_of(request.eye, request.pupil_mm, request.time_s, request.seed);
    hash.add(format);
    hash.add(aperture.pupil_mm);
    for (const reference::Circle& circle : aperture.particles)
        for (const double value : {circle.x_mm, circle.y_mm, circle.radius_mm})
            hash.add(value);
    const auto& g = aperture.gratings;
    for (const double value :
         {static_cast<double>(g.count), g.inner_radius_mm, g.outer_radius_mm, g.duty, g.depth, request.pitch,
          static_cast<double>(request.radius), request.angular_scale})
        hash.add(value);
    for (const auto& blind : aperture.blinds_mm)
        for (const double value : blind)
            hash.add(value);
    for (const auto& lamp : lamps) {
        hash.add(static_cast<double>(lamp.size()));
        for (const reference::SpectralLine& line : lamp) {
            hash.add(line.wavelength_nm);
            for (const double value : line.rgbv)
                hash.add(value);
        }
    }
    return hash.text() + ".pattern";
}

void put(std::ostream& out, const double* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(double)));
}
bool get(std::istream& in, double* values, std::size_t count) {
    return static_cast<bool>(
        in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(double))));
}

bool load(const std::filesystem::path& path, const reference::ReferenceRequest& request,
          std::vector<ReferencePattern>& patterns) {
    std::ifstream in(path, std::ios::binary);
    for (ReferencePattern& pattern : patterns) {
        std::array<double, 12> head{};
        if (!get(in, head.data(), head.size()) || head[0] != format ||
            head[1] != static_cast<double>(request.radius) || head[2] != request.pitch)
            return false;
        pattern.radius = request.radius;
        pattern.pitch = request.pitch;
        pattern.transmitted = head[3];
        for (std::size_t c = 0; c < 4; ++c) {
            pattern.lamp[c] = head[4 + c];
            pattern.follows_luminance[c] = head[8 + c] != 0;
        }
        pattern.pixels.resize(static_cast<std::size_t>(pattern.side()) *
                              static_cast<std::size_t>(pattern.side()));
        if (!get(in, pattern.pixels.front().data(), 4 * pattern.pixels.size())) return false;
    }
    return true;
}

// Under another name first: a report that is stopped leaves no half file.
void keep(const std::filesystem::path& path, const std::vector<ReferencePattern>& patterns) {
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    const std::filesystem::path unfinished = path.string() + ".part";
    {
        std::ofstream out(unfinished, std::ios::binary);
        for (const ReferencePattern& pattern : patterns) {
            std::array<double, 12> head = {format, static_cast<double>(pattern.radius), pattern.pitch,
                                           pattern.transmitted};
            for (std::size_t c = 0; c < 4; ++c) {
                head[4 + c] = pattern.lamp[c];
                head[8 + c] = pattern.follows_luminance[c] ? 1 : 0;
            }
            put(out, head.data(), head.size());
            put(out, pattern.pixels.front().data(), 4 * pattern.pixels.size());
        }
        if (!out.flush()) {
            std::filesystem::remove(unfinished, ignored);
            return;
        }
    }
    std::filesystem::rename(unfinished, path, ignored);
}

}  // namespace

reference::PatternMaker archived_patterns(std::filesystem::path folder,
                                          std::function<void(const std::string&, double)> progress) {
    return [folder = std::move(folder), progress = std::move(progress)](
               const reference::ReferenceRequest& request,
               const std::vector<std::vector<reference::SpectralLine>>& lamps) {
        const std::filesystem::path path = folder / name_of(request, lamps);
        std::vector<ReferencePattern> patterns(lamps.size());
        if (load(path, request, patterns)) return patterns;
        const std::string what =
            "reference pattern, " + std::to_string(2 * request.radius + 1) + " samples a side";
        patterns = reference::make_reference(request, lamps, [&](double done) {
            if (progress) progress(what, done);
        });
        keep(path, patterns);
        return patterns;
    };
}

}  // namespace seaglare::report
