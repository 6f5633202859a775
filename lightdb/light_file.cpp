#include "lightdb/light_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "lightdb/buoy_reader.h"
#include "lightdb/json/reader.h"
#include "lightdb/light_reader.h"
#include "lightdb/mistakes.h"
#include "lightdb/vessel_reader.h"

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
    explicit Loader(Mistakes::Policy policy) : mistakes(policy) {}

    void read(const json::Document& document) {
        const fs::path path = document.file();
        reading_.push_back(identity_of(path));
        mistakes.attempt([&] { read_members(document, path.parent_path()); });
        done_.push_back(std::move(reading_.back()));
        reading_.pop_back();
    }

    LightFile result;
    Mistakes mistakes;

  private:
    void read_members(const json::Document& document, const fs::path& folder) {
        json::ObjectReader reader(document.root(), "light file");
        static constexpr std::string_view keys[] = {"origin",  "source", "include",
                                                    "vessels", "buoys",  "lights"};
        reader.only(keys);
        mistakes.attempt([&] { read_origin(reader); });
        std::string source;
        mistakes.attempt([&] { source = reader.string("source", ""); });
        if (result.source.empty()) result.source = source;
        mistakes.attempt([&] {
            for (const json::Value& include : reader.optional_array("include"))
                mistakes.attempt([&] { read_include(include, folder); });
        });
        mistakes.attempt([&] {
            for (const json::Value& vessel : reader.optional_array("vessels")) {
                mistakes.attempt([&] {
                    for (Light& light : read_vessel(vessel, source, result.warnings)) {
                        result.lights.push_back(std::move(light));
                    }
                });
            }
        });
        LightFolder beside{folder.string(), {}};
        mistakes.attempt([&] {
            for (const json::Value& buoy : reader.optional_array("buoys"))
                mistakes.attempt([&] { read_one_buoy(buoy, source, beside); });
        });
        mistakes.attempt([&] {
            for (const json::Value& light : reader.optional_array("lights")) {
                if (mistakes.full()) return;
                Light read;
                if (read_light(light, source, beside, mistakes, result.warnings, read))
                    result.lights.push_back(std::move(read));
            }
        });
    }

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

    void read_one_buoy(const json::Value& value, const std::string& source, LightFolder& beside) {
        BuoyWithLights read = read_buoy(value, source, beside, mistakes, result.warnings);
        for (const Buoy& known : result.buoys) {
            if (known.body_id == read.buoy.body_id) {
                throw value.error("buoy '" + read.buoy.name + "' has the body of buoy '" + known.name +
                                  "': give one of them another 'body'");
            }
        }
        result.buoys.push_back(std::move(read.buoy));
        for (Light& light : read.lights)
            result.lights.push_back(std::move(light));
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
    Loader loader(Mistakes::Policy::stop_at_first);
    loader.read(document);
    return std::move(loader.result);
}

}  // namespace

std::string file_identity(const std::string& path) {
    return identity_of(path).string();
}

LightFile load_light_file(const std::string& path) {
    return read(json::parse_file(path));
}

LightFile parse_light_file(std::string_view text, const std::string& file) {
    return read(json::parse(text, file));
}

LightFileCheck check_light_file(const std::string& path) {
    Loader loader(Mistakes::Policy::collect);
    loader.mistakes.attempt([&] { loader.read(json::parse_file(path)); });
    return {loader.mistakes.texts(), std::move(loader.result.warnings), loader.result.lights.size(),
            !loader.mistakes.full()};
}

namespace {

// A new file beside `path`: two that save at once do not write into each other's. Returns its descriptor.
int open_beside(const std::string& path, std::string& beside) {
    for (int i = 0;; ++i) {
        beside = path + "." + std::to_string(getpid()) + "." + std::to_string(i) + ".part";
        const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) return file;
        if (errno != EEXIST) throw std::system_error(errno, std::generic_category(), beside);
    }
}

bool write_all(int file, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = write(file, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return fsync(file) == 0;
}

}  // namespace

void save_light_file(const LightFile& file, const std::string& path) {
    const std::string text = format_light_file(file, fs::path(path).parent_path().string());
    parse_light_file(text, path);
    const std::string target = identity_of(path).string();  // a link stays a link
    std::string beside;
    const int out = open_beside(target, beside);
    struct stat old {};
    // Whoever may read the old file may read the new one.
    if (stat(target.c_str(), &old) == 0) static_cast<void>(fchmod(out, old.st_mode & 07777));
    int failed = write_all(out, text) ? 0 : errno;
    if (close(out) != 0 && failed == 0) failed = errno;
    if (failed == 0 && std::rename(beside.c_str(), target.c_str()) != 0) failed = errno;
    if (failed == 0) return;
    std::remove(beside.c_str());
    throw std::system_error(failed, std::generic_category(), path);
}

}  // namespace seaglare::lightdb
