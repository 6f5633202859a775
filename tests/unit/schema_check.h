// As much of JSON Schema (draft 2020-12) as the project's schemas use. A keyword that it does not know is a failure, so
// that no rule is passed over in silence.
#pragma once

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>

#include "lightdb/json/value.h"

namespace seaglare::json {

class SchemaCheck {
  public:
    explicit SchemaCheck(const Value& root) : root_(root) {}

    // Empty, or the first thing that is wrong.
    std::string error(const Value& value) const { return error(root_, value); }
    std::string error(const Value& schema, const Value& value) const {
        for (const auto& [keyword, rule] : schema.object()) {
            std::string found = error_of(keyword, rule, schema, value);
            if (!found.empty()) return found;
        }
        return {};
    }

  private:
    static bool equal(const Value& a, const Value& b) {
        return a.kind() == b.kind() && a.string() == b.string() && a.number() == b.number() &&
               a.boolean() == b.boolean();
    }
    static bool is_type(const Value& value, std::string_view type) {
        if (type == "integer")
            return value.kind() == Kind::number && value.number() == std::floor(value.number());
        static constexpr std::string_view names[] = {"null",   "boolean", "number",
                                                     "string", "array",   "object"};
        return type == names[static_cast<std::size_t>(value.kind())];
    }
    const Value& resolved(std::string_view reference) const {
        const Value* at = &root_;
        for (std::string path(reference.substr(2)); !path.empty();) {
            const std::size_t end = std::min(path.find('/'), path.size());
            at = at->find(path.substr(0, end));
            if (at == nullptr) throw std::runtime_error("no " + std::string(reference));
            path.erase(0, end + 1);
        }
        return *at;
    }
    std::string error_of(std::string_view keyword, const Value& rule, const Value& schema,
                         const Value& value) const {
        const auto wrong = [&] {
            return std::string(value.error("against the rule '" + std::string(keyword) + "'").what());
        };
        const auto demand = [&](bool held) { return held ? std::string() : wrong(); };
        if (keyword == "description" || keyword == "title" || keyword == "default" || keyword == "$schema" ||
            keyword == "$defs" || keyword == "$id" || keyword == "examples")
            return {};
        if (keyword == "$ref") return error(resolved(rule.string()), value);
        if (keyword == "type") return demand(is_type(value, rule.string()));
        if (keyword == "const") return demand(equal(rule, value));
        if (keyword == "enum") {
            return demand(std::any_of(rule.array().begin(), rule.array().end(),
                                      [&](const Value& one) { return equal(one, value); }));
        }
        if (keyword == "oneOf" || keyword == "anyOf") {
            const auto held = std::count_if(rule.array().begin(), rule.array().end(),
                                            [&](const Value& one) { return error(one, value).empty(); });
            return demand(keyword == "oneOf" ? held == 1 : held > 0);
        }
        if (keyword == "allOf") {
            for (const Value& one : rule.array()) {
                std::string found = error(one, value);
                if (!found.empty()) return found;
            }
            return {};
        }
        if (keyword == "not") return demand(!error(rule, value).empty());
        if (keyword == "minimum")
            return demand(value.kind() != Kind::number || value.number() >= rule.number());
        if (keyword == "maximum")
            return demand(value.kind() != Kind::number || value.number() <= rule.number());
        if (keyword == "exclusiveMinimum")
            return demand(value.kind() != Kind::number || value.number() > rule.number());
        if (keyword == "minItems")
            return demand(value.kind() != Kind::array ||
                          static_cast<double>(value.array().size()) >= rule.number());
        if (keyword == "maxItems")
            return demand(value.kind() != Kind::array ||
                          static_cast<double>(value.array().size()) <= rule.number());
        if (keyword == "pattern") {
            return demand(
                value.kind() != Kind::string ||
                std::regex_search(std::string(value.string()), std::regex(std::string(rule.string()))));
        }
        if (keyword == "required") {
            if (value.kind() != Kind::object) return {};
            for (const Value& key : rule.array())
                if (value.find(key.string()) == nullptr) return wrong() + " " + std::string(key.string());
            return {};
        }
        if (keyword == "items") {
            for (const Value& element : value.array()) {
                std::string found = error(rule, element);
                if (!found.empty()) return found;
            }
            return {};
        }
        if (keyword == "propertyNames") {
            for (const Member& member : value.object()) {
                std::string found = error(rule, member.key());
                if (!found.empty()) return found;
            }
            return {};
        }
        if (keyword == "properties") {
            for (const auto& [name, property] : rule.object()) {
                const Value* const found = value.find(name);
                std::string text = found != nullptr ? error(property, *found) : std::string();
                if (!text.empty()) return text;
            }
            return {};
        }
        if (keyword == "additionalProperties") {
            const Value* const known = schema.find("properties");
            for (const Member& member : value.object()) {
                if (known != nullptr && known->find(member.name()) != nullptr) continue;
                if (rule.kind() == Kind::boolean && !rule.boolean())
                    return std::string(member.key().error("not a known key").what());
                std::string found = rule.kind() == Kind::object ? error(rule, member.value()) : std::string();
                if (!found.empty()) return found;
            }
            return {};
        }
        throw std::runtime_error("the checker does not know the keyword '" + std::string(keyword) + "'");
    }

    const Value& root_;
};

}  // namespace seaglare::json
