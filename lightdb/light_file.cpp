#include "lightdb/light_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "lightdb/json/reader.h"
#include "lightdb/light_reader.h"

namespace seaglare::lightdb {

namespace {

namespace fs = std::filesystem;

// Files by their canonical path, so that "a.json" and "../lights/a.json" are one.
fs::path identity_of(const fs::path& path) {
    std::error_code failed;
    fs::path result = fs::weakly_canonical(path, failed);
    return failed ? path.lexically_normal() : result;
}

class Loader {
  public:
    void read(const json::Document& document) {
        const fs::path path = document.file();
        reading_.push_back(identity_of(path));
        json::ObjectReader reader(document.root(), "light file");
        static constexpr std::string_view keys[] = {"origin", "source", "include", "lights"};
        reader.only(keys);
        read_origin(reader);
        const std::string source = reader.string("source", "");
        if (result.source.empty()) result.source = source;
        for (const json::Value& include : reader.optional_array("include"))
            read_include(include, path.parent_path());
        for (const json::Value& light : reader.optional_array("lights")) {
            result.lights.push_back(read_light(light, source, result.warnings));
        }
        reader.finish();
        done_.push_back(std::move(reading_.back()));
        reading_.pop_back();
    }

    LightFile result;

  private:
    void read_origin(json::ObjectReader& reader) {
        auto child = reader.optional_object("origin");
        if (!child) return;
        const GeographicPoint origin = {child->number("lat", -90, 90), child->number("lon", -180, 180),
                                        child->number("height_m", -500, 5000, 0)};
        child->finish();
        if (result.origin && !(*result.origin == origin)) {
            throw child->error(
                "differs from the origin of the file that includes this one, or of one read before");
        }
        result.origin = origin;
    }

    void read_include(const json::Value& value, const fs::path& folder) {
        const std::string name = json::checked_string(value, "include");
        const fs::path path = folder / name;
        const fs::path known = identity_of(path);
        if (std::find(reading_.begin(), reading_.end(), known) != reading_.end()) {
            throw value.error("'" + name + "' includes itself, by this or over other files");
        }
        if (std::find(done_.begin(), done_.end(), known) != done_.end()) return;
        try {
            read(json::parse_file(path.string()));
        } catch (const std::system_error& error) {
            throw value.error("cannot read '" + path.string() + "': " + error.code().message());
        }
    }

    std::vector<fs::path> reading_;  // from the outermost file inwards
    std::vector<fs::path> done_;
};

LightFile read(const json::Document& document) {
    Loader loader;
    loader.read(document);
    return std::move(loader.result);
}

}  // namespace

LightFile load_light_file(const std::string& path) {
    return read(json::parse_file(path));
}

LightFile parse_light_file(std::string_view text, const std::string& file) {
    return read(json::parse(text, file));
}

void save_light_file(const LightFile& file, const std::string& path) {
    const std::string text = format_light_file(file);
    const std::string beside = path + ".part";
    errno = 0;
    std::FILE* const out = std::fopen(beside.c_str(), "wb");
    if (out == nullptr) throw std::system_error(errno, std::generic_category(), beside);
    const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
    const bool closed = std::fclose(out) == 0;
    if (!written || !closed || std::rename(beside.c_str(), path.c_str()) != 0) {
        const int code = errno != 0 ? errno : EIO;
        std::remove(beside.c_str());
        throw std::system_error(code, std::generic_category(), path);
    }
}

}  // namespace seaglare::lightdb
