// Reads a JSON object as configuration: typed, range-checked members, and every key that nobody asked for is
// an error with the nearest known name. Used for every file an operator edits.
//
//     const json::Document document = json::parse_file(path);
//     json::ObjectReader reader(document.root(), "quality");
//     const double age = reader.number("age_years", 5, 100, 24);             // optional, default 24
//     const double focal = reader.number("focal_length_m", 1e-3, 1);         // required
//     static constexpr json::Choice<Tone> tones[] = {{"photographic", Tone::photographic}, {"linear",
//     Tone::linear}}; const Tone tone = reader.choice("tone", tones, Tone::photographic); if (auto child =
//     reader.optional_object("glare")) { …; child->finish(); } reader.finish(); // unknown keys
//
// The first error ends the reading: everything here throws json::Error, "FILE:LINE:COL: text".
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightdb/json/value.h"

namespace seaglare::json {

template <class E>
struct Choice {
    std::string_view name;
    E value;
};

class ObjectReader {
  public:
    // `what` names the object in messages: "light 'Halskov Rev'", "quality". Throws if `value` is not an
    // object or if one of its keys stands twice. The value's Document must outlive the reader. A member
    // "$schema" is always allowed and ignored: editors want it.
    ObjectReader(const Value& value, std::string_view what);

    // Required when without a default; then a missing member is an error at the object's place. `min` and
    // `max` are allowed values.
    double number(std::string_view key, double min, double max);
    double number(std::string_view key, double min, double max, double default_value);
    std::optional<double> optional_number(std::string_view key, double min, double max);
    std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max);  // |limits| <= 2^53
    std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max,
                         std::int64_t default_value);
    bool boolean(std::string_view key);
    bool boolean(std::string_view key, bool default_value);
    std::string string(std::string_view key);
    std::string string(std::string_view key, std::string_view default_value);
    std::optional<std::string> optional_string(std::string_view key);

    // An array of numbers, each from min to max; of exactly N, or of any length.
    template <std::size_t N>
    std::array<double, N> numbers(std::string_view key, double min, double max) {
        std::array<double, N> result{};
        read_numbers(require(key), key, min, max, result);
        return result;
    }
    template <std::size_t N>
    std::array<double, N> numbers(std::string_view key, double min, double max,
                                  const std::array<double, N>& default_value) {
        return has(key) ? numbers<N>(key, min, max) : default_value;
    }
    std::vector<double> number_list(std::string_view key, double min, double max);

    // One of a list of names, which the message of the error repeats.
    template <class E, std::size_t N>
    E choice(std::string_view key, const Choice<E> (&choices)[N]) {
        std::array<std::string_view, N> names;
        for (std::size_t i = 0; i < N; ++i)
            names[i] = choices[i].name;
        return choices[choose(require(key), key, names)].value;
    }
    template <class E, std::size_t N>
    E choice(std::string_view key, const Choice<E> (&choices)[N], E default_value) {
        return has(key) ? choice(key, choices) : default_value;
    }

    // Elements of an array, of whatever kind. Missing: an error, or empty.
    std::span<const Value> array(std::string_view key);
    std::span<const Value> optional_array(std::string_view key);
    // A child object; call its finish(), too.
    ObjectReader object(std::string_view key);
    std::optional<ObjectReader> optional_object(std::string_view key);

    // For what the above does not cover. Both make the key a known one.
    const Value* find(std::string_view key);  // nullptr: missing
    const Value& require(std::string_view key);
    bool has(std::string_view key) { return find(key) != nullptr; }

    // The keys that may stand here, said at once: any other is the error that finish() would give, before a member that
    // is missing because its key is mistyped is reported as missing. Optional.
    void only(std::span<const std::string_view> keys) const;

    // Every member must have been asked for by now; the first that was not is an error: "unknown key
    // 'nominal_rang_nm' in light, did you mean 'nominal_range_nm'?"
    void finish() const;

    const Value& value() const { return *value_; }
    const std::string& what() const { return what_; }
    Error error(std::string_view text) const;  // at the object's own place, prefixed with what()

  private:
    void read_numbers(const Value& value, std::string_view key, double min, double max,
                      std::span<double> out) const;
    Error unknown_key(const Member& member, std::span<const std::string_view> known) const;
    std::size_t choose(const Value& value, std::string_view key,
                       std::span<const std::string_view> names) const;

    const Value* value_;
    std::string what_;
    std::vector<std::string> asked_;  // keys, without repetition
};

// A number from min to max, or the Error that says what stands there instead. `name` is the key, for the
// message.
double checked_number(const Value& value, std::string_view name, double min, double max);
// A string, likewise.
std::string checked_string(const Value& value, std::string_view name);

// The candidate that `word` most likely meant, or empty when none is near: edit distance with transpositions,
// at most a third of the word's length.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace seaglare::json
