// libFuzzer target: no OSM JSON crashes the importer of OpenSeaMap's lights, every element with a light is accounted for, and
// what it writes is a light file with as many lights as it counted.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lightdb/import/osm.h"
#include "tests/fuzz/allocation_bound.h"
#include "tests/fuzz/imported_lights.h"

namespace {

using namespace seaglare;
using fuzz::stop;
using lightdb::osm::Import;

// An element with a light is at least its tag of 25 bytes; it becomes a place, its report, a light of about 500 bytes and
// 500 bytes of text, in lists that live twice while they grow, and a message for each thing that is missing.
constexpr std::size_t bytes_per_input_byte = 256;
constexpr std::size_t constant_bytes = std::size_t{64} << 10;

struct Result {
    Import import;
    std::string lights;
};

Result import_within_bound(const json::Value& root, std::size_t text_bytes) {
    const fuzz::AllocationBound bound(text_bytes, bytes_per_input_byte, constant_bytes);
    Result result;
    result.import = lightdb::osm::import_elements(root, "fuzz");
    result.lights = lightdb::osm::light_file_text(result.import);
    return result;
}

void check(const Result& result) {
    std::size_t light_count = 0;
    for (const lightdb::osm::ElementReport& record : result.import.records) {
        if (record.imported == (record.light_count == 0))
            stop("an imported element without lights, or the reverse");
        if (!record.imported && record.reason.empty()) stop("an element is left out without a reason");
        light_count += record.light_count;
    }
    if (light_count != result.import.lights.size()) stop("the report counts other lights");
    fuzz::check_light_file(result.lights, light_count);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const json::Document document = json::parse(text, "fuzz");
        check(import_within_bound(document.root(), size));
    } catch (const json::Error&) {  // no JSON, or no OSM JSON
        return 0;
    }
    return 0;
}
