#include "lightdb/tool/commands.h"

#include <fstream>
#include <ostream>
#include <string_view>
#include <system_error>

#include "lightdb/json/value.h"
#include "lightdb/light_file.h"

namespace seaglare::lights_tool {
namespace {

// Errors of the input are 1, of the file system 2.
template <class Work>
int guarded(std::ostream& err, const Work& work) {
    try {
        return work();
    } catch (const std::system_error& error) {
        err << "seaglare-lights: " << error.what() << "\n";
        return 2;
    } catch (const json::Error& error) {
        err << error.what() << "\n";
        return 1;
    }
}

bool write_file(const std::string& path, const std::string& text, std::ostream& err) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (file) return true;
    err << "seaglare-lights: cannot write " << path << "\n";
    return false;
}

}  // namespace

int validate(const std::vector<std::string>& files, std::ostream& out, std::ostream& err) {
    int status = 0;
    for (const std::string& file : files) {
        const int result = guarded(err, [&] {
            const lightdb::LightFile loaded = lightdb::load_light_file(file);
            for (const std::string& warning : loaded.warnings)
                err << warning << " (warning)\n";
            out << file << ": " << loaded.lights.size() << " lights, " << loaded.warnings.size()
                << " warnings\n";
            return 0;
        });
        status = std::max(status, result);
    }
    return status;
}

int check_json(const std::string& file, std::ostream& err) {
    return guarded(err, [&] {
        json::parse_file(file);
        return 0;
    });
}

int import_nga(const ImportRequest& request, std::ostream& out, std::ostream& err) {
    return guarded(err, [&] {
        const auto progress = [&](std::string_view text) {
            if (request.show_progress) err << "\r\x1b[K" << text << std::flush;
        };
        progress("reading the List of Lights");
        const json::Document document = json::parse_file(request.file);
        progress("importing");
        const lightdb::nga::Import import =
            lightdb::nga::import_list(document.root(), request.file, request.area);
        progress("");
        const std::string lights = lightdb::nga::light_file_text(import);
        const std::string report = lightdb::nga::report_text(import);
        if (request.output.empty()) {
            out << lights;
        } else if (!write_file(request.output, lights, err)) {
            return 2;
        }
        if (request.report.empty()) {
            err << report.substr(0, report.find("\n\n") + 1);
        } else if (!write_file(request.report, report, err)) {
            return 2;
        }
        return 0;
    });
}

}  // namespace seaglare::lights_tool
