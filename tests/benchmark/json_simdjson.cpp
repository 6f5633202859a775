#include <simdjson.h>

#include "tests/benchmark/json_yardsticks.h"

namespace seaglare::benchmark {

namespace {

void walk(const simdjson::dom::element& value, Contents& contents) {
    using simdjson::dom::element_type;
    switch (value.type()) {
        case element_type::INT64:
        case element_type::UINT64:
        case element_type::DOUBLE:
            contents.numbers.push_back(double(value));
            return;
        case element_type::STRING:
            contents.add(std::string_view(value));
            return;
        case element_type::ARRAY:
            for (const simdjson::dom::element element : simdjson::dom::array(value))
                walk(element, contents);
            return;
        case element_type::OBJECT:
            for (const simdjson::dom::key_value_pair member : simdjson::dom::object(value)) {
                contents.add(member.key);
                walk(member.value, contents);
            }
            return;
        default:
            return;
    }
}

// Like the others it may not ask the caller for padding: it copies the text, as they copy its strings.
bool parse(std::string_view text) {
    simdjson::dom::parser parser;
    return parser.parse(text.data(), text.size()).error() == simdjson::SUCCESS;
}

bool parse_again(std::string_view text) {
    static simdjson::dom::parser parser;
    return parser.parse(text.data(), text.size()).error() == simdjson::SUCCESS;
}

Contents contents(std::string_view text) {
    simdjson::dom::parser parser;
    Contents result;
    walk(parser.parse(text.data(), text.size()).value(), result);
    return result;
}

}  // namespace

const JsonParser simdjson_parser = {"simdjson", parse, contents};
const JsonParser simdjson_reused_parser = {"simdjson_reused", parse_again, contents};

}  // namespace seaglare::benchmark
