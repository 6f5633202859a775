// Quality files with single settings changed: what the report's knobs are.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace seaglare::report {

// By the keys on the way, joined with dots ("pattern.transform_size"): the value as JSON text; empty: the key is left out.
using Changes = std::map<std::string, std::string>;

// Writes a copy of a quality file with changes to `to`. The eye and the display that it names become part of the copy, so
// that "eye.…" and "display.…" can be changed, too. Throws json::Error, std::system_error, std::runtime_error.
void write_quality(const std::filesystem::path& base, const Changes& changes,
                   const std::filesystem::path& to);

}  // namespace seaglare::report
