// What the work of a frame costs on this device: nanoseconds per unit. Measured when a view is made and kept true by what
// frames take, or pinned by the configuration so that every channel of a bridge makes the same plan. Pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace seaglare::glare {

// One number for each kind of work.
enum class Work : std::uint8_t {
    light_evaluated,  // a light of the database, and its culling
    frame_planned,    // a frame, whatever is in it: its plan
    light_uploaded,   // a light drawn: its instance, upload and visibility test
    gl_draw,          // a draw call, whatever it draws
    gl_core_px,       // a pixel of a billboard's core
    gl_skirt_px,
    gl_tail_cell,        // a cell of the coarse grid
    cl_pass,             // a gather, whatever it gathers: launch and transfer
    cl_screen_px,        // a pixel of the picture that goes to GL
    cl_light,            // a light gathered: its lists, and its tail on coarse grids
    cl_light_px,         // a light in a pixel of the gather
    composite_px,        // a pixel tone mapped and added
    pattern_sample,      // a sample of the pupil's transform, for each log2 of the side
    pattern_node,        // a node of the pattern, for each wavelength
    pattern_disc_node,   // a node of a disc layer
    pattern_mixed_node,  // of one that is mixed from two, for each layer
    pattern_upload_node,
};
inline constexpr std::size_t work_kinds = 17;

struct DeviceCosts {
    // Orders of magnitude of Mesa's llvmpipe and PoCL on two cores, for a view that has measured nothing yet.
    std::array<double, work_kinds> ns = {150,  100e3, 400, 60e3, 60, 45, 30, 600e3, 8,
                                         10e3, 3.5,   25,  0.35, 3,  60, 4,  12};
    bool pinned = false;  // by the configuration: measurements change nothing

    double of(Work work) const { return ns[static_cast<std::size_t>(work)]; }
    double& of(Work work) { return ns[static_cast<std::size_t>(work)]; }
    friend bool operator==(const DeviceCosts&, const DeviceCosts&) = default;
};

// As configuration files name them, without the unit: "gl_skirt_px" for gl_skirt_px_ns.
std::string_view name_of(Work work);

// A pass took `measured_ms`, predicted as `predicted_ms` from costs of these kinds: they all grow by the same factor, a part
// of the way at each frame, so that one hitch does not count for much. Does nothing to pinned costs, nor with numbers that are
// not positive and finite. Costs stay within a millionth and a million times their defaults.
void learn(DeviceCosts& costs, std::initializer_list<Work> kinds, double predicted_ms, double measured_ms);

// What a few small pictures took on a device, ms; 0: not measured. All of them without tails, and the same but for what is
// named (apply/cost_probe.h).
struct ProbeTimes {
    double core = 0;         // one light of which no more than the core is drawn
    double skirt = 0;        // its skirt over the whole picture
    double many_skirts = 0;  // of so many lights
    double gather = 0;       // one light, gathered over the whole picture
    double many_gathered = 0;
    double picture_px = 0;
    double draws = 0;  // draw calls of `core`
    double lights = 0;
};

// Costs as the probe has them: what it measured, and the rest in proportion to its like. What makes no sense, as on a
// machine that was busy with something else, is left as usual; nothing is more than 100 times off the usual.
DeviceCosts measured_costs(const ProbeTimes& times);

}  // namespace seaglare::glare
