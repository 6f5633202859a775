// Lint findings as lines for people and as JSON for machines.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "lightdb/json/writer.h"
#include "lightdb/lint.h"

namespace seaglare::lightdb {

// Where a light stands: a file and, if known, its line and column; line 0 is not known.
struct LintPlace {
    std::string file;
    json::Location where{0, 0};
};
using LintPlaces = std::function<LintPlace(std::size_t light)>;

// "FILE:LINE:COL: 'name' (source): kind: text", one a line; the source is where the light's facts come from, with its
// record's number, without notes on what was assumed.
std::string lint_lines(std::span<const LintFinding> findings, std::span<const Light> lights,
                       const LintPlaces& places);

// "12 sector_gap: a dark gap …", one line for each kind that was found, in the kinds' order.
std::string lint_counts(std::span<const LintFinding> findings);

// Members "counts" and "findings" of the object that is open in `writer`.
void write_lint(json::Writer& writer, std::span<const LintFinding> findings, std::span<const Light> lights,
                const LintPlaces& places);

}  // namespace seaglare::lightdb
