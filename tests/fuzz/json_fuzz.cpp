// libFuzzer target: no text crashes the parser, and what it accepts survives being written and read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"

namespace {

std::string written(const seaglare::json::Document& document) {
    seaglare::json::Writer writer;
    writer.value(document.root());
    return writer.take();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using seaglare::json::parse;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const std::string once = written(parse(text, "fuzz"));
        // Throws, and so stops the fuzzer, if our own text is not JSON.
        if (written(parse(once, "again")) != once) std::abort();
    } catch (const seaglare::json::Error& error) {
        if (error.where().line == 0 || std::string_view(error.what()).starts_with("again")) std::abort();
    }
    return 0;
}
