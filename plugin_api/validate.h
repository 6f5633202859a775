// Everything a host hands in is copied and checked here, before any of it is used. Each check names the field.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "plugin_api/failure.h"

namespace seaglare::plugin {

// Throws STRUCT_SIZE unless `size` can be this struct: at least up to its flags, in whole fours, no larger than today's.
// A larger one comes from a newer header, whose fields this library could only ignore.
void check_struct_size(std::uint32_t size, std::size_t todays_size, const char* name);

// A copy of the caller's struct with the fields it does not have yet zeroed. Reads no byte past its struct_size.
template <class Struct>
Struct copy_struct(const Struct* from, const char* name) {
    if (from == nullptr) invalid_argument(std::string(name) + " is NULL");
    std::uint32_t size = 0;
    std::memcpy(&size, from, sizeof size);
    check_struct_size(size, sizeof(Struct), name);
    Struct copy;
    std::memset(static_cast<void*>(&copy), 0, sizeof copy);
    std::memcpy(static_cast<void*>(&copy), from, size);
    return copy;
}

// Writes our struct into the caller's, as much of it as the caller has. struct_size keeps the caller's value.
template <class Struct>
void copy_struct_out(const Struct& from, Struct* to, const char* name) {
    if (to == nullptr) invalid_argument(std::string(name) + " is NULL");
    std::uint32_t size = 0;
    std::memcpy(&size, to, sizeof size);
    check_struct_size(size, sizeof(Struct), name);
    std::memcpy(static_cast<void*>(to), &from, size);
    std::memcpy(static_cast<void*>(to), &size, sizeof size);
}

// A field's name, put together only when a check fails: most calls check thousands of numbers and fail none.
struct Field {
    Field(const char* name_in, int component_in = -1,
          std::int64_t entry_in = -1)  // NOLINT: implicit on purpose
        : name(name_in), component(component_in), entry(entry_in) {}
    std::string text() const;  // "frame.viewport_px[2]", "updates[7].position_m[0]"

    const char* name;
    int component;       // of an array; -1: none
    std::int64_t entry;  // of update_lights; -1: none
};

// Throw INVALID_ARGUMENT naming the field.
void check_finite(double value, const Field& field);
void check_finite(const double* values, int count, const Field& field);
void check_range(double value, double low, double high, const Field& field);
void check_flags(std::uint32_t flags, std::uint32_t known, const Field& field);
void check_enumerator(std::int32_t value, std::int32_t last, const Field& field);
// A quaternion of any length but zero.
void check_quaternion(const double* xyzw, const Field& field);

void check(const seaglare_create_info& info);
void check(const seaglare_view_info& info);
void check(const seaglare_light& light);
void check(const seaglare_light_update& update, std::int64_t entry);
void check(const seaglare_eye_state& state);
// The flags that an eye state of this struct_size has fields for.
std::uint32_t eye_state_flags(std::uint32_t struct_size);
// All but the perspective, which glare::screen_geometry checks.
void check(const seaglare_frame& frame);

}  // namespace seaglare::plugin
