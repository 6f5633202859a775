// Light files for measuring: of any size, always the same bytes for the same request, and in proportion what real ones hold:
// names in the letters of many coasts, coordinates with many digits, sectors, phases, tables.
#pragma once

#include <cstddef>
#include <string>

namespace seaglare::benchmark {

// The text of a light file with `light_count` lights, about 900 bytes each, as seaglare-lights would save it. The lights
// lie within 100 nautical miles of 55.5 N 11 E. It is valid: `seaglare-lights validate` has nothing to say about it.
std::string light_file_text(std::size_t light_count);

// The same with as many lights as it takes to reach `bytes`.
std::string light_file_text_of_bytes(std::size_t bytes);

}  // namespace seaglare::benchmark
