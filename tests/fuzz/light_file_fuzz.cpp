// libFuzzer target: no text crashes the reading of a light file, and lights that were read are saved without a change.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lightdb/light_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace seaglare::lightdb;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (text.find("include") != std::string_view::npos) return 0;  // no walks through the file system
    try {
        const LightFile file = parse_light_file(text, "fuzz");
        if (parse_light_file(format_light_file(file), "again").lights != file.lights) std::abort();
    } catch (const seaglare::json::Error& error) {
        if (std::string_view(error.what()).starts_with("again")) std::abort();
    }
    return 0;
}
