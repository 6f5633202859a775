#include "lightdb/tool/import_command.h"

#include <string_view>
#include <vector>

#include "lightdb/import/osm.h"
#include "lightdb/import/s57.h"
#include "lightdb/light_file.h"
#include "lightdb/lint.h"
#include "lightdb/lint_report.h"
#include "lightdb/tool/guarded.h"

namespace seaglare::lights_tool {
namespace {

class Progress {
  public:
    Progress(const ImportRequest& request, std::ostream& err) : shown_(request.show_progress), err_(err) {}
    ~Progress() { say(""); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void say(std::string_view text) {
        if (shown_) err_ << "\r\x1b[K" << text << std::flush;
    }

  private:
    bool shown_;
    std::ostream& err_;
};

struct Report {
    std::string summary;  // counts, a line each
    std::string details;  // every record that gave no light, every doubt
};

// The records of OpenSeaMap and S-57 imports tell the same.
template <class Import>
Report report_on(const Import& import, const std::string& what) {
    std::size_t imported = 0;
    std::size_t doubtful = 0;
    Report report;
    std::string doubts;
    report.details = "\nNot imported:\n";
    for (const auto& record : import.records) {
        const std::string who = record.id + (record.name.empty() ? "" : ", " + record.name) + ": ";
        if (record.imported) ++imported;
        if (!record.imported) report.details += who + record.reason + "\n";
        if (record.imported && !record.doubts.empty()) ++doubtful;
        for (const std::string& doubt : record.doubts)
            doubts += who + doubt + "\n";
    }
    report.details += "\nWith a doubt:\n" + doubts;
    const std::size_t left_out = import.records.size() - imported;
    report.summary = std::to_string(import.records.size()) + " " + what + ", of these\n  " +
                     std::to_string(imported) + " imported as " + std::to_string(import.lights.size()) +
                     " lights\n  " + std::to_string(left_out) + " not imported, with their reasons below\n" +
                     std::to_string(doubtful) + " imported with a doubt\n";
    return report;
}

// Writes the light file, lints it as an operator would, and reports.
int finish(const ImportRequest& request, const std::string& lights, const Report& report, std::ostream& out,
           std::ostream& err) {
    if (request.output.empty()) {
        out << lights;
    } else if (!write_file(request.output, lights, err)) {
        return 2;
    }
    const std::string name = request.output.empty() ? "(standard output)" : request.output;
    const lightdb::LightFile file = lightdb::parse_light_file(lights, name);
    const std::vector<lightdb::LintFinding> findings = lightdb::lint(file.lights);
    const json::Document document = json::parse(lights, name);
    const json::Value* written = document.root().find("lights");
    const auto places = [&](std::size_t light) -> lightdb::LintPlace {
        return {name, written->array()[light].location()};
    };
    const std::string counts = std::to_string(findings.size()) +
                               " lint findings: what the source says twice and differently, or oddly\n" +
                               lightdb::lint_counts(findings);
    if (request.report.empty()) {
        err << report.summary << counts;
        return 0;
    }
    const std::string text = report.summary + counts + report.details + "\nLint:\n" +
                             lightdb::lint_lines(findings, file.lights, places);
    return write_file(request.report, text, err) ? 0 : 2;
}

}  // namespace

int import_nga(const ImportRequest& request, std::ostream& out, std::ostream& err) {
    return guarded(err, [&] {
        Progress progress(request, err);
        progress.say("reading the List of Lights");
        const json::Document document = json::parse_file(request.file);
        progress.say("importing");
        const lightdb::nga::Import import =
            lightdb::nga::import_list(document.root(), request.file, request.area);
        const std::string text = lightdb::nga::report_text(import);
        const std::size_t details = text.find("\n\n") + 1;
        progress.say("");
        return finish(request, lightdb::nga::light_file_text(import),
                      {text.substr(0, details), text.substr(details)}, out, err);
    });
}

int import_osm(const ImportRequest& request, std::ostream& out, std::ostream& err) {
    return guarded(err, [&] {
        Progress progress(request, err);
        progress.say("reading OpenStreetMap's elements");
        const json::Document document = json::parse_file(request.file);
        const lightdb::osm::Import import = lightdb::osm::import_elements(document.root(), request.file);
        Report report = report_on(import, "elements with a light");
        report.summary = std::to_string(import.elements) + " elements in the file\n" + report.summary;
        progress.say("");
        return finish(request, lightdb::osm::light_file_text(import), report, out, err);
    });
}

int import_s57(const ImportRequest& request, std::ostream& out, std::ostream& err) {
    return guarded(err, [&] {
        Progress progress(request, err);
        progress.say("reading the cell");
        lightdb::s57::Cell cell;
        try {
            cell = lightdb::s57::read_cell(request.file);
        } catch (const lightdb::s57::CellError& error) {
            err << "seaglare-lights: " << error.what() << "\n";
            return 2;
        }
        const lightdb::s57::Import import = lightdb::s57::import_features(cell.features, cell.name);
        progress.say("");
        return finish(request, lightdb::s57::light_file_text(import, cell.name),
                      report_on(import, "LIGHTS objects"), out, err);
    });
}

}  // namespace seaglare::lights_tool
