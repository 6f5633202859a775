// A file's text, as the parser wants it. Internal to lightdb/json.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "lightdb/json/source.h"

namespace seaglare::json {

// Reads a file, or a pipe to its end. Throws std::system_error (it cannot be read; names the path) or too_large().
std::unique_ptr<Source> read_source(const std::string& path);

// The error for a text of more than max_text_bytes.
Error too_large(std::string_view file);

}  // namespace seaglare::json
