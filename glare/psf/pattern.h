// The glare pattern: how one point of light spreads over angles, ready to be drawn. What the pipeline
// aperture -> FFT -> power -> chromatic spread -> disc layers delivers, and what `apply` draws with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "glare/colour/lamp_list.h"
#include "glare/colour/navigation_colours.h"
#include "glare/device/device_memory.h"
#include "glare/eye/eye_model.h"

namespace seaglare::glare {

// Linear sRGB (signed) and scotopic, each relative to what reaches the eye in that channel: a white light's pattern
// integrates to (1, 1, 1, 1), and a light's glare is its own illuminance times the pattern, channel by channel.
using Rgbv = std::array<float, 4>;

// Angles are direction cosines in the plane perpendicular to the direction of the light: (u, v) = sin(theta) times the
// azimuth's unit vector, u to the right, v up. Nodes stand `pitch` apart, the light in the middle of node (R, R).
//
// The point spread function is split in three, and the three are drawn apart:
//   core   the energy inside about two nodes, drawn as a flat-topped footprint that does not flicker (apply/footprint);
//   skirt  the simulated structure outside the core, as layers convolved with discs of growing radius, each with the
//          same energy, and near the light finer nodes beside them; it fades to zero between window_inner and window_outer;
//   tail   the CIE 135/1 curve where the skirt fades, up to any angle.
// core + skirt + tail = transmitted_fraction(eye, pupil), 1 for a pupil that absorbs nothing. The skirt's energy is its
// sum times pitch^2: nodes are taken as pitch^2 steradian, which is 1/cos(theta) too few, 0.4 % at 5 degrees.
inline constexpr int fine_per_node = 3;
inline constexpr int fine_radius_nodes = 8;  // how far they reach
inline constexpr std::size_t fine_side = 2 * fine_per_node * fine_radius_nodes + 1;
inline constexpr std::size_t fine_floats = fine_side * fine_side * 4;

struct Pattern {
    // Of no other pattern in this process, whatever source it is from: who keeps a copy can tell that it is old. Grows
    // with every pattern of a source. 0: none yet.
    std::uint64_t generation = 0;
    int radius_nodes = 0;  // R; the table has (2R+1)^2 nodes
    double pitch = 0;      // direction cosine per node: 1/f_px of the channel
    // Lamps of different spectra have patterns of their own; slot s is the pattern of lamps[s] (lamp_list.h).
    std::vector<std::uint8_t> lamps = {0};
    // The slot that each lamp is drawn with: its own, or that of the lamp nearest to it where it has none.
    std::array<std::uint8_t, most_lamps> slot_of_lamp{};
    std::array<Rgbv, most_lamps>
        core_energy{};  // by slot: fraction of the light's energy in the core, per channel
    std::vector<float> layer_radius_nodes;  // disc radius of each layer, ascending; [0] = 0, the point layer
    // Slot by slot, layer by layer, then rows from -v to +v, then columns from -u to +u, then rgb + scotopic; sr^-1.
    std::vector<float> skirt;
    // What finer nodes near the light have beside straight lines between the skirt's nodes of the point layer (fine_nodes.h): slot by
    // slot, fine_side^2 nodes 1/fine_per_node apart, the light in the middle, in the skirt's order; sr^-1, of both signs, without energy.
    // Drawn with the core, of a disc less than the next layer in the proportion of the point layer. Empty: there are none.
    std::vector<float> fine;
    double window_inner = 0;  // direction cosine where the skirt starts to fade: w = 1 inside
    double window_outer = 0;  // w = 0 outside; in between w = (1 + cos(pi t))/2
    double tail_scale = 0;    // multiplies the CIE curve; 0: no tail
    double tail_age_years = 24;
    double tail_pigmentation = 0.5;
    // Lashes: how a light's place in the picture turns and bends its skirt (shaders/lash_warp.glsl). Both keep areas, so
    // energy too. 0: no lashes, and drawing costs nothing more.
    double lash_turn_rad = 0;
    double lash_bend_per_rad = 0;
    // What it was made from, for the statistics.
    int transform_size = 0;
    int wavelengths = 0;
    double pupil_mm = 0;
    double angular_scale = 1;
    double structure_scale =
        1;  // what the simulated energy was multiplied by to make core + skirt + tail right
    int kernel_launches = 0;
};

// What the shaders have room for.
inline constexpr int most_layers = 8;

// What gives the pattern of a coloured lamp its colours.
enum class SpectraMode : std::uint8_t {
    per_lamp,  // each lamp's spectrum, diffracted
    filter,    // every lamp has the white lamp's pattern, tinted: glare/colour/README.md has what that costs
};

// How the pattern follows the eye's motion: psf/motion_keys.h.
enum class MotionMode : std::uint8_t {
    every_frame,   // a new pattern for every instant
    interpolated,  // made at a rate of its own, and mixed in between
    flip_book,     // a loop of patterns that are made once, and mixed in between
};
inline constexpr int most_flip_book_frames = 256;
struct PatternMotion {
    MotionMode mode = MotionMode::every_frame;
    double rate_hz = 15;  // interpolated: patterns a second
    int frames = 32;      // flip_book: pages, each with the memory of a pattern
    double loop_s = 6;    // flip_book: after which the first page follows the last
    bool wait =
        false;  // frames wait for the pattern of their own instant, instead of taking the newest that is made
    friend bool operator==(const PatternMotion&, const PatternMotion&) = default;
};

// Quality of the pattern: read from config/quality.
struct PatternSettings {
    int transform_size = 4096;  // N: 256 ... 4096, a power of two
    double plane_width_mm = 9;  // S
    // Two scales (two_scale.h): transform_size is then the core's, made every frame, and this the wide field's, made once
    // per interval. 0: one transform for all. More than transform_size, at most 4096.
    int wide_field_size = 0;
    double wide_field_interval_s = 4;
    int wavelengths = 30;  // samples of the spectrum, 380 ... 780 nm
    // More of them where nodes are fine: so many that, half way to the rim, neighbours lie at most this many nodes apart.
    // Wider gaps break the needles into beads. 0: no more than `wavelengths`.
    double wavelength_step_px = 0;
    double angular_scale = 1;    // 1 is physics; the thesis preset magnifies
    int max_radius_nodes = 384;  // crop, whatever the field
    std::vector<float> layer_radii_px = {0.0F, 1.5F, 3.0F, 6.0F, 12.0F};  // at most most_layers
    double core_radius_nodes = 2;  // the core's window falls from 1 to 0 over this radius
    SpectraMode spectra = SpectraMode::per_lamp;
    // Lamps in view with a pattern of their own, 1 ... most_lamps; the others are drawn with that of the nearest. Bounds
    // the memory: each costs (2R+1)^2 nodes of 16 bytes for every layer, in the pattern and once more in GL.
    int max_lamps_in_view = 8;
    PatternMotion motion;  // of those who ask in every frame; a source makes what it is asked for
};

// The largest transform, which decides how far the structure reaches.
inline int field_transform_size(const PatternSettings& settings) {
    return settings.wide_field_size > 0 ? settings.wide_field_size : settings.transform_size;
}

// The 2012 look: 512 samples over 9 mm, magnified until one sample is one pixel of a 45 degree, 720 line picture at
// 575 nm. At 380 nm they reach over 338 pixels: beyond, colours would be missing. For thesis_eye(); both equal
// config/quality/thesis.json.
PatternSettings thesis_settings();

struct PatternRequest {
    double pupil_mm = 0;
    double resting_pupil_mm = 0;  // without hippus, for the wide field; 0: pupil_mm
    double time_s = 0;
    double pitch = 0;         // of the channel's screen
    std::uint32_t lamps = 1;  // bit l: a light with lamp l is in view; others are left out
    const LampList* lamp_list =
        nullptr;                   // what the bits mean; nullptr: navigation_lamps(). Read during make() only
    float largest_disc_nodes = 0;  // apparent radius of the largest light: layers beyond it are left out
    // What moves the eye and is no function of the time alone (glare/eye): for eyes that have it.
    LidPose lids;
    double vitreous_roll_rad = 0;
};

// Makes patterns. One per context; calls are serialised by the caller. Two implementations: OpenCL, and a plain CPU one
// for machines without it.
class PatternSource {
  public:
    virtual ~PatternSource() = default;
    // The pattern for this instant. The reference stays valid until the next call with the same pitch, or until
    // sixteen other pitches have been asked for. Throws std::invalid_argument for a pitch that is not positive, and
    // std::runtime_error naming the OpenCL call and its code when the device fails; the next call may then succeed.
    virtual const Pattern& make(const PatternRequest& request) = 0;
    // The same into a pattern of the caller's, whose memory is used again: no allocation once it is large enough. Throws as
    // make(); `pattern` is then good for nothing but another call. The default copies.
    virtual void make_into(const PatternRequest& request, Pattern& pattern) {
        const Pattern& made = make(request);
        if (pattern.generation != made.generation) pattern = made;
    }
    // Takes up the spectra of a list that requests will come with; else the first of them does. Throws as make().
    virtual void prepare(const LampList& lamps) = 0;
    // Compiles and runs everything once, so that no later frame pays for it, nor the first frames of this pupil for its
    // wide field.
    virtual void warm_up(double pitch, double pupil_mm) = 0;
    void warm_up(double pitch) { warm_up(pitch, 6); }
    virtual DeviceMemory device_memory() const = 0;
    double device_memory_bytes() const { return device_memory().total(); }
    virtual std::string device_name() const = 0;
};

// Throws std::runtime_error with what is missing when there is no OpenCL device or a kernel does not build.
std::unique_ptr<PatternSource> make_cl_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                      std::uint64_t seed);
// Never fails for want of a device. The pattern stands still: time does not move it, a blink dims it, and it is made anew only
// when the pupil, the squint, the lamps or the pitch change, from at most 1024 samples a side. Who asks for a pupil that
// swings pays for each swing.
std::unique_ptr<PatternSource> make_cpu_pattern_source(const EyeModel& eye, const PatternSettings& settings,
                                                       std::uint64_t seed);

}  // namespace seaglare::glare
