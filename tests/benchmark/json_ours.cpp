#include <cstdlib>
#include <string>

#include "lightdb/json/value.h"
#include "tests/benchmark/json_yardsticks.h"

namespace seaglare::benchmark {

namespace {

void walk(const json::Value& value, Contents& contents) {
    switch (value.kind()) {
        case json::Kind::number:
            contents.numbers.push_back(value.number());
            return;
        case json::Kind::string:
            contents.add(value.string());
            return;
        case json::Kind::array:
            for (const json::Value& element : value.array())
                walk(element, contents);
            return;
        case json::Kind::object:
            for (const auto& [name, member] : value.object()) {
                contents.add(name);
                walk(member, contents);
            }
            return;
        default:
            return;
    }
}

bool parse(std::string_view text) {
    const json::Document document = json::parse(text, "bench");
    return document.root().kind() == json::Kind::object;
}

Contents contents(std::string_view text) {
    const json::Document document = json::parse(text, "bench");
    Contents result;
    walk(document.root(), result);
    return result;
}

Contents numbers_by_strtod(std::string_view text) {
    const std::string with_end(text);
    Contents result;
    bool in_string = false;
    for (const char* p = with_end.c_str(); *p != 0;) {
        if (in_string && *p == '\\') {
            p += 2;
        } else if (*p == '"') {
            in_string = !in_string;
            ++p;
        } else if (!in_string && (*p == '-' || (*p >= '0' && *p <= '9'))) {
            char* end = nullptr;
            result.numbers.push_back(std::strtod(p, &end));
            p = end;
        } else {
            ++p;
        }
    }
    return result;
}

}  // namespace

const JsonParser our_parser = {"seaglare", parse, contents};
const JsonParser c_library = {"strtod", nullptr, numbers_by_strtod};

}  // namespace seaglare::benchmark
