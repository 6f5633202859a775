// libFuzzer target: no text crashes the parser, and what it accepts survives being written and read again: the same tree,
// every double to the bit.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"
#include "tests/fuzz/allocation_bound.h"

namespace {

using namespace seaglare::json;

// "0," is two bytes of text and one Value of 24: 12 for each byte. The stack that collects an array's elements may have
// room for twice as many and, while it grows, lives beside its smaller self: 36. The tree itself, with blocks that are
// not full: 18. The text's copy: 1.
constexpr std::size_t bytes_per_input_byte = 56;

bool same(const Value& a, const Value& b) {
    if (a.kind() != b.kind()) return false;
    switch (a.kind()) {
        case Kind::null:
            return true;
        case Kind::boolean:
            return a.boolean() == b.boolean();
        case Kind::number:
            return std::bit_cast<std::uint64_t>(a.number()) == std::bit_cast<std::uint64_t>(b.number());
        case Kind::string:
            return a.string() == b.string();
        case Kind::array:
            return std::ranges::equal(a.array(), b.array(), same);
        case Kind::object:
            return std::ranges::equal(a.object(), b.object(), [](const Member& x, const Member& y) {
                return x.name() == y.name() && same(x.value(), y.value());
            });
    }
    return false;
}

Document parse_within_bound(std::string_view text) {
    const seaglare::fuzz::AllocationBound bound(text.size(), bytes_per_input_byte,
                                                seaglare::fuzz::small_change_bytes);
    return parse(text, "fuzz");
}

std::string written(const Document& document) {
    Writer writer;
    writer.value(document.root());
    return writer.take();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const Document document = parse_within_bound(text);
        const std::string once = written(document);
        // Throws, and so stops the fuzzer, if our own text is not JSON.
        const Document again = parse(once, "again");
        if (!same(document.root(), again.root()) || written(again) != once) std::abort();
    } catch (const Error& error) {
        if (error.where().line == 0 || std::string_view(error.what()).starts_with("again")) std::abort();
    }
    return 0;
}
