// libFuzzer target: no List of Lights crashes the importer, every record is accounted for, and what it writes is a light
// file with as many lights as it counted.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "lightdb/import/nga.h"
#include "tests/fuzz/allocation_bound.h"
#include "tests/fuzz/imported_lights.h"

namespace {

using namespace seaglare;
using fuzz::stop;
using lightdb::nga::Import;

// The shortest record, "0,", is two bytes; its draft, its headings and its line of the report are some hundred bytes each,
// in lists that live twice while they grow.
constexpr std::size_t bytes_per_input_byte = 1536;
constexpr std::size_t constant_bytes = std::size_t{64} << 10;

struct Result {
    Import import;
    std::string lights;
    std::string report;
};

Result import_within_bound(const json::Value& root, std::size_t text_bytes) {
    const fuzz::AllocationBound bound(text_bytes, bytes_per_input_byte, constant_bytes);
    Result result;
    result.import = lightdb::nga::import_list(root, "fuzz");
    result.lights = lightdb::nga::light_file_text(result.import);
    result.report = lightdb::nga::report_text(result.import);
    return result;
}

void check(const Result& result, std::size_t record_count) {
    if (result.import.records.size() != record_count) stop("a record is not accounted for");
    std::size_t light_count = 0;
    for (const lightdb::nga::RecordReport& record : result.import.records) {
        const bool imported = record.outcome == lightdb::nga::Outcome::imported;
        if (imported == (record.light_count == 0)) stop("an imported record without lights, or the reverse");
        if (!imported && record.reason.empty()) stop("a record is left out without a reason");
        light_count += static_cast<std::size_t>(record.light_count);
    }
    if (light_count != result.import.lights.size()) stop("the report counts other lights");
    fuzz::check_light_file(result.lights, light_count);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const json::Document document = json::parse(text, "fuzz");
        const json::Value& root = document.root();
        const Result result = import_within_bound(root, size);
        const json::Value& list = root.kind() == json::Kind::array ? root : *root.find("ngalol");
        check(result, list.array().size());
    } catch (const json::Error&) {  // no JSON, or no List
        return 0;
    }
    return 0;
}
