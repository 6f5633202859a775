#include "lightdb/lint_report.h"

#include <algorithm>

namespace seaglare::lightdb {
namespace {

std::string text_of(const LintPlace& place) {
    if (place.where.line == 0) return place.file;
    return place.file + ":" + std::to_string(place.where.line) + ":" + std::to_string(place.where.column);
}

// "NGA Pub. 116 (2016/08), 3690 / C1532.603" of a source with notes behind it.
std::string record_of(const Light& light) {
    return light.source.substr(0, light.source.find("; "));
}

std::size_t count(std::span<const LintFinding> findings, LintKind kind) {
    return static_cast<std::size_t>(std::count_if(
        findings.begin(), findings.end(), [&](const LintFinding& finding) { return finding.kind == kind; }));
}

void write_light(json::Writer& writer, const Light& light, const LintPlace& place) {
    writer.member("light", light.name);
    if (!light.source.empty()) writer.member("source", record_of(light));
    writer.member("file", place.file);
    if (place.where.line == 0) return;
    writer.member("line", static_cast<double>(place.where.line));
    writer.member("column", static_cast<double>(place.where.column));
}

}  // namespace

std::string lint_lines(std::span<const LintFinding> findings, std::span<const Light> lights,
                       const LintPlaces& places) {
    std::string out;
    std::size_t of = lights.size();
    std::string where;
    for (const LintFinding& finding : findings) {
        if (finding.light != of)
            where = text_of(places(finding.light));  // a look at the whole text before it
        of = finding.light;
        const Light& light = lights[of];
        out += where + ": '" + light.name + "'";
        if (const std::string record = record_of(light); !record.empty()) out += " (" + record + ")";
        out += ": " + std::string(lint_name(finding.kind)) + ": " + finding.text;
        if (finding.other) {
            const std::string record = record_of(lights[*finding.other]);
            out +=
                " [with '" + lights[*finding.other].name + "'" + (record.empty() ? "" : ", " + record) + "]";
        }
        out += "\n";
    }
    return out;
}

std::string lint_counts(std::span<const LintFinding> findings) {
    std::string out;
    for (const LintKind kind : lint_kinds())
        if (const std::size_t found = count(findings, kind); found > 0)
            out += std::to_string(found) + " " + std::string(lint_name(kind)) + ": " +
                   std::string(lint_meaning(kind)) + "\n";
    return out;
}

void write_lint(json::Writer& writer, std::span<const LintFinding> findings, std::span<const Light> lights,
                const LintPlaces& places) {
    writer.key("counts");
    writer.begin_object();
    for (const LintKind kind : lint_kinds())
        if (const std::size_t found = count(findings, kind); found > 0)
            writer.member(lint_name(kind), static_cast<double>(found));
    writer.end_object();
    writer.key("findings");
    writer.begin_array();
    for (const LintFinding& finding : findings) {
        writer.begin_object();
        writer.member("kind", lint_name(finding.kind));
        write_light(writer, lights[finding.light], places(finding.light));
        writer.member("text", finding.text);
        if (finding.other) {
            writer.key("with");
            writer.begin_object();
            write_light(writer, lights[*finding.other], places(*finding.other));
            writer.end_object();
        }
        writer.end_object();
    }
    writer.end_array();
}

}  // namespace seaglare::lightdb
