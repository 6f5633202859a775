#include "lightdb/json/reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_set>

namespace seaglare::json {

namespace {

std::string shown(double number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    return {text, end};
}

std::string in_quotes(std::string_view name) {
    return "'" + std::string(name) + "'";
}

Error wrong_kind(const Value& value, std::string_view name, std::string_view wanted) {
    return value.error(in_quotes(name) + " must be " + std::string(wanted) + ", not " +
                       std::string(kind_name(value.kind())));
}

void throw_if_keys_repeat(const Value& object, std::string_view what) {
    std::unordered_set<std::string_view> seen;
    for (const Member& member : object.object()) {
        if (seen.insert(member.name()).second) continue;
        const auto first = std::find_if(object.object().begin(), object.object().end(),
                                        [&](const Member& m) { return m.name() == member.name(); });
        const Location place = first->key().location();
        throw member.key().error("key " + in_quotes(member.name()) + " stands twice in " + std::string(what) +
                                 ", first in line " + std::to_string(place.line) + ", column " +
                                 std::to_string(place.column));
    }
}

}  // namespace

double checked_number(const Value& value, std::string_view name, double min, double max) {
    if (value.kind() != Kind::number) throw wrong_kind(value, name, "a number");
    const double number = value.number();
    if (!(number >= min && number <= max)) {
        throw value.error(in_quotes(name) + " must be from " + shown(min) + " to " + shown(max) + ", not " +
                          shown(number));
    }
    return number;
}

std::string checked_string(const Value& value, std::string_view name) {
    if (value.kind() != Kind::string) throw wrong_kind(value, name, "a string");
    return std::string(value.string());
}

ObjectReader::ObjectReader(const Value& value, std::string_view what) : value_(&value), what_(what) {
    if (value.kind() != Kind::object) {
        throw value.error(what_ + " must be an object, not " + std::string(kind_name(value.kind())));
    }
    throw_if_keys_repeat(value, what_);
}

const Value* ObjectReader::find(std::string_view key) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
    return value_->find(key);
}

const Value& ObjectReader::require(std::string_view key) {
    const Value* value = find(key);
    if (value == nullptr) throw value_->error(what_ + " needs " + in_quotes(key));
    return *value;
}

double ObjectReader::number(std::string_view key, double min, double max) {
    return checked_number(require(key), key, min, max);
}

double ObjectReader::number(std::string_view key, double min, double max, double default_value) {
    return optional_number(key, min, max).value_or(default_value);
}

std::optional<double> ObjectReader::optional_number(std::string_view key, double min, double max) {
    const Value* value = find(key);
    if (value == nullptr) return std::nullopt;
    return checked_number(*value, key, min, max);
}

std::int64_t ObjectReader::integer(std::string_view key, std::int64_t min, std::int64_t max) {
    const Value& value = require(key);
    const double number = checked_number(value, key, static_cast<double>(min), static_cast<double>(max));
    if (number != std::floor(number)) {
        throw value.error(in_quotes(key) + " must be a whole number, not " + shown(number));
    }
    return static_cast<std::int64_t>(number);
}

std::int64_t ObjectReader::integer(std::string_view key, std::int64_t min, std::int64_t max,
                                   std::int64_t default_value) {
    return has(key) ? integer(key, min, max) : default_value;
}

bool ObjectReader::boolean(std::string_view key) {
    const Value& value = require(key);
    if (value.kind() != Kind::boolean) throw wrong_kind(value, key, "true or false");
    return value.boolean();
}

bool ObjectReader::boolean(std::string_view key, bool default_value) {
    return has(key) ? boolean(key) : default_value;
}

std::string ObjectReader::string(std::string_view key) {
    return checked_string(require(key), key);
}

std::string ObjectReader::string(std::string_view key, std::string_view default_value) {
    return has(key) ? string(key) : std::string(default_value);
}

std::optional<std::string> ObjectReader::optional_string(std::string_view key) {
    if (!has(key)) return std::nullopt;
    return string(key);
}

std::vector<double> ObjectReader::number_list(std::string_view key, double min, double max) {
    const Value& value = require(key);
    if (value.kind() != Kind::array) throw wrong_kind(value, key, "an array of numbers");
    std::vector<double> result(value.array().size());
    read_numbers(value, key, min, max, result);
    return result;
}

void ObjectReader::read_numbers(const Value& value, std::string_view key, double min, double max,
                                std::span<double> out) const {
    if (value.kind() != Kind::array) throw wrong_kind(value, key, "an array of numbers");
    const std::span<const Value> elements = value.array();
    if (elements.size() != out.size()) {
        throw value.error(in_quotes(key) + " must have " + std::to_string(out.size()) + " numbers, not " +
                          std::to_string(elements.size()));
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = checked_number(elements[i], std::string(key) + "[" + std::to_string(i) + "]", min, max);
    }
}

std::size_t ObjectReader::choose(const Value& value, std::string_view key,
                                 std::span<const std::string_view> names) const {
    const std::string name = checked_string(value, key);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    std::string list;
    for (const std::string_view candidate : names)
        list += (list.empty() ? "" : ", ") + in_quotes(candidate);
    throw value.error(in_quotes(key) + " must be one of " + list + ", not " + in_quotes(name));
}

std::span<const Value> ObjectReader::array(std::string_view key) {
    const Value& value = require(key);
    if (value.kind() != Kind::array) throw wrong_kind(value, key, "an array");
    return value.array();
}

std::span<const Value> ObjectReader::optional_array(std::string_view key) {
    return has(key) ? array(key) : std::span<const Value>();
}

ObjectReader ObjectReader::object(std::string_view key) {
    return {require(key), in_quotes(key)};
}

std::optional<ObjectReader> ObjectReader::optional_object(std::string_view key) {
    if (!has(key)) return std::nullopt;
    return object(key);
}

Error ObjectReader::unknown_key(const Member& member, std::span<const std::string_view> known) const {
    const std::string_view nearest = nearest_name(member.name(), known);
    std::string text = "unknown key " + in_quotes(member.name()) + " in " + what_;
    if (!nearest.empty()) text += ", did you mean " + in_quotes(nearest) + "?";
    return member.key().error(text);
}

void ObjectReader::only(std::span<const std::string_view> keys) const {
    for (const Member& member : value_->object()) {
        if (member.name() == "$schema" || std::find(keys.begin(), keys.end(), member.name()) != keys.end())
            continue;
        throw unknown_key(member, keys);
    }
}

void ObjectReader::finish() const {
    only(std::vector<std::string_view>(asked_.begin(), asked_.end()));
}

Error ObjectReader::error(std::string_view text) const {
    return value_->error(what_ + ": " + std::string(text));
}

namespace {

// Edit distance of neighbours swapped, inserted, deleted and replaced (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> two_above(b.size() + 1);
    std::vector<std::size_t> above(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        above[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], two_above[j - 2] + 1);
            }
        }
        std::swap(two_above, above);
        std::swap(above, row);
    }
    return above[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
    if (word.size() > 64) return {};  // nobody mistypes that
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(word.size() / 3, 1) + 1;
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace seaglare::json
