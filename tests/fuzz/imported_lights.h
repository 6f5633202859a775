// What fuzz targets of importers hold what they get to.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "lightdb/light_file.h"

namespace seaglare::fuzz {

[[noreturn]] inline void stop(const char* broken) {
    std::fprintf(stderr, "error: %s\n", broken);
    std::abort();
}

// The text that an importer wrote is a light file of so many lights.
inline void check_light_file(const std::string& text, std::size_t light_count) {
    try {
        if (lightdb::parse_light_file(text, "imported").lights.size() != light_count)
            stop("the light file holds other lights");
    } catch (const json::Error& error) {
        stop(error.what());
    }
}

}  // namespace seaglare::fuzz
