// libFuzzer target: no text crashes the reading of a light file, and lights that were read are saved without a change.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lightdb/light_file.h"
#include "tests/fuzz/allocation_bound.h"

namespace {

using namespace seaglare;

// A light of the fewest words, {"name":"","position":[0,0,0],"intensity_cd":1}, is 50 bytes and a Light of about 1 kB with
// its rhythm; while the list of lights grows, it lives twice and has room for twice as many. With the JSON tree (56 for
// each byte, see json_fuzz.cpp) and a character such as "UQ(20)", which stands for 40 phases of 24 bytes.
constexpr std::size_t bytes_per_input_byte = 256;
constexpr std::size_t constant_bytes = std::size_t{1} << 20;

lightdb::LightFile read_within_bound(std::string_view text) {
    const fuzz::AllocationBound bound(text.size(), bytes_per_input_byte, constant_bytes);
    return lightdb::parse_light_file(text, "fuzz");
}

// Walks through the file system are no part of this.
bool includes_others(std::string_view text) {
    const json::Document document = json::parse(text, "fuzz");
    return document.root().find("include") != nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        if (includes_others(text)) return 0;
        const lightdb::LightFile file = read_within_bound(text);
        if (lightdb::parse_light_file(lightdb::format_light_file(file), "again").lights != file.lights)
            std::abort();
    } catch (const json::Error& error) {
        if (std::string_view(error.what()).starts_with("again")) std::abort();
    }
    return 0;
}
