// Small files of other formats than JSON, from makers of lamps: read as a whole, told apart by their names. Internal to lightdb.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seaglare::lightdb {

// A file, or a pipe to its end. Throws std::system_error, naming the path, when it cannot be read or holds more than `most_bytes`
// (EFBIG).
std::string read_text_file(const std::string& path, std::size_t most_bytes);

// `end` in lower case, ASCII.
bool ends_with_ignoring_case(std::string_view text, std::string_view end);

}  // namespace seaglare::lightdb
