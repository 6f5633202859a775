#include "host_stub/report/frame_knobs.h"

namespace seaglare::report {

namespace {

// Pinned costs are those of the named keys and defaults for the rest.
constexpr const char* no_gather = "\"cl_pass_ns\": 1e12";
constexpr const char* no_billboards =
    "\"gl_skirt_px_ns\": 1e6, \"gl_core_px_ns\": 1e6, \"gl_tail_cell_ns\": 1e6";

Knob method(const std::string& name, const std::string& costs) {
    return {"accumulation", name, {{"device_costs", "{" + costs + "}"}}, true, true};
}

}  // namespace

std::vector<Knob> accumulation_knobs() {
    return {method("GL billboards", no_gather), method("OpenCL tiles", no_billboards)};
}

std::vector<Knob> frame_knobs(KnobRange range) {
    std::vector<Knob> knobs = {{"default", "as shipped", {}, true, true}};
    const bool all = range == KnobRange::all;
    const auto add = [&](const char* name, const std::string& value, Changes changes, bool wanted,
                         bool same = false) {
        if (wanted) knobs.push_back({name, value, std::move(changes), true, same});
    };
    const bool few = range == KnobRange::few;
    for (const char* const codes : {"0", "0.25", "0.5", "1", "2", "4"})
        add("budget", std::string(codes) + " codes", {{"budget.max_error_codes", codes}},
            all || std::string(few ? "0 1 4" : "0 0.5 1 2 4").find(codes) != std::string::npos, true);
    if (few) return knobs;
    for (const char* const ms : {"8", "33"})
        add("time budget", std::string(ms) + " ms", {{"budget.time_ms", ms}}, all || ms[0] == '8', true);
    for (const char* const size : {"256", "1024", "2048"})
        add("transform", std::string(size) + " and 4096", {{"pattern.transform_size", size}}, all);
    for (const char* const size : {"512", "1024", "2048", "4096"})
        add("transform", std::string(size) + " alone",
            {{"pattern.transform_size", size}, {"pattern.wide_field", ""}}, all || size[0] != '2');
    for (const char* const count : {"8", "15", "60"})
        add("wavelengths", count, {{"pattern.wavelengths", count}}, all || count[0] != '1');
    add("layers", "1", {{"pattern.layer_radii_px", "[0]"}}, true);
    add("layers", "3", {{"pattern.layer_radii_px", "[0, 3, 12]"}}, all);
    add("layers", "8", {{"pattern.layer_radii_px", "[0, 0.8, 1.6, 2.6, 4, 6, 8.5, 12]"}}, true);
    add("spectra", "filter", {{"pattern.spectra", "\"filter\""}}, true);
    for (const char* const nodes : {"32", "64", "128"})
        add("radius", std::string(nodes) + " nodes", {{"pattern.max_radius_nodes", nodes}},
            all || nodes[0] == '3');
    add("motion", "every frame", {{"pattern.motion.mode", "\"every_frame\""}}, all);
    add("motion", "5 Hz", {{"pattern.motion.rate_hz", "5"}}, true);
    add("motion", "book of 8", {{"pattern.motion.mode", "\"flip_book\""}, {"pattern.motion.frames", "8"}},
        all);
    knobs.push_back({"device", "no OpenCL", {}, false, false});
    if (!all) return knobs;
    for (Knob& knob : accumulation_knobs())
        knobs.push_back(std::move(knob));
    return knobs;
}

}  // namespace seaglare::report
