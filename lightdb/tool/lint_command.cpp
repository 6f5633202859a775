#include "lightdb/tool/lint_command.h"

#include <filesystem>
#include <optional>
#include <ostream>

#include "lightdb/json/value.h"
#include "lightdb/light_file.h"
#include "lightdb/lint.h"
#include "lightdb/lint_report.h"
#include "lightdb/tool/guarded.h"

namespace seaglare::lights_tool {
namespace {

namespace fs = std::filesystem;
using lightdb::LintPlace;

// Where the lights of a file stand, in the order in which load_light_file() gives them: what a file includes comes before
// its own lights, and a file that is included twice counts once. Lights of vessels and buoys stand nowhere.
class Places {
  public:
    Places(const std::string& file, const std::vector<lightdb::Light>& lights)
        : file_(file), place_of_(lights.size()) {
        read(file);
        std::size_t next = 0;
        for (std::size_t i = 0; i < lights.size() && next < values_.size(); ++i)
            if (is_named(*values_[next].second, lights[i].name)) place_of_[i] = next++;
        // A file that changed between the two readings: no place rather than a wrong one.
        if (next < values_.size()) place_of_.assign(lights.size(), std::nullopt);
    }

    LintPlace operator()(std::size_t light) const {
        if (!place_of_[light]) return {file_, {0, 0}};
        const auto& [document, value] = values_[*place_of_[light]];
        return {documents_[document].file(), value->location()};
    }

  private:
    static bool is_named(const json::Value& light, const std::string& name) {
        const json::Value* const own = light.find("name");
        return own != nullptr && own->string() == name;
    }
    void read(const fs::path& path) {
        const fs::path known = fs::weakly_canonical(path);
        for (const fs::path& done : done_)
            if (done == known) return;
        done_.push_back(known);
        json::Document document = json::parse_file(path.string());
        const json::Value root = document.root();
        documents_.push_back(std::move(document));
        const std::size_t index = documents_.size() - 1;
        if (const json::Value* include = root.find("include"))
            for (const json::Value& name : include->array())
                read(path.parent_path() / name.string());
        if (const json::Value* lights = root.find("lights"))
            for (const json::Value& light : lights->array())
                values_.emplace_back(index, &light);
    }

    std::string file_;
    std::vector<fs::path> done_;
    std::vector<json::Document> documents_;
    std::vector<std::pair<std::size_t, const json::Value*>> values_;
    std::vector<std::optional<std::size_t>> place_of_;  // of each light, in values_
};

}  // namespace

int lint_files(const LintRequest& request, std::ostream& out, std::ostream& err) {
    json::Writer writer;
    writer.begin_object();
    writer.key("files");
    writer.begin_array();
    int status = 0;
    for (const std::string& file : request.files) {
        const int result = guarded(err, [&] {
            const lightdb::LightFile loaded = lightdb::load_light_file(file);
            const std::vector<lightdb::LintFinding> findings = lightdb::lint(loaded.lights);
            const Places where(file, loaded.lights);
            const auto places = [&](std::size_t light) { return where(light); };
            if (request.json) {
                writer.begin_object();
                writer.member("file", file);
                writer.member("lights", static_cast<double>(loaded.lights.size()));
                lightdb::write_lint(writer, findings, loaded.lights, places);
                writer.end_object();
            } else {
                out << lightdb::lint_lines(findings, loaded.lights, places);
                err << file << ": " << loaded.lights.size() << " lights, " << findings.size() << " findings\n"
                    << lightdb::lint_counts(findings);
            }
            return request.strict && !findings.empty() ? 1 : 0;
        });
        status = std::max(status, result);
    }
    writer.end_array();
    writer.end_object();
    if (request.json) out << writer.take();
    return status;
}

}  // namespace seaglare::lights_tool
