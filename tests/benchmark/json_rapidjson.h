// RapidJSON's DOM under the namespace that the including file chose. Two builds of it cannot share one.
#pragma once

#include <rapidjson/document.h>
#include <rapidjson/rapidjson.h>

#include "tests/benchmark/json_yardsticks.h"

namespace seaglare::benchmark {

namespace {

namespace rj = RAPIDJSON_NAMESPACE;

constexpr unsigned flags = rj::kParseFullPrecisionFlag | rj::kParseValidateEncodingFlag;

void walk(const rj::Value& value, Contents& contents) {
    if (value.IsNumber()) {
        contents.numbers.push_back(value.GetDouble());
    } else if (value.IsString()) {
        contents.add({value.GetString(), value.GetStringLength()});
    } else if (value.IsArray()) {
        for (const rj::Value& element : value.GetArray())
            walk(element, contents);
    } else if (value.IsObject()) {
        for (const auto& member : value.GetObject()) {
            contents.add({member.name.GetString(), member.name.GetStringLength()});
            walk(member.value, contents);
        }
    }
}

bool parse(std::string_view text) {
    rj::Document document;
    document.Parse<flags>(text.data(), text.size());
    return !document.HasParseError();
}

Contents contents(std::string_view text) {
    rj::Document document;
    document.Parse<flags>(text.data(), text.size());
    Contents result;
    if (!document.HasParseError()) walk(document, result);
    return result;
}

}  // namespace

}  // namespace seaglare::benchmark
