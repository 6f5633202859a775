/* Seaglare: how navigation lights look through a human eye, added to a finished 8-bit picture.
 *
 * SPDX-License-Identifier: MIT
 *
 * One exported symbol, seaglare_get_api(), fills a table of functions. A *context* holds what every channel
 * shares (lights, eye, glare pattern); a *view* holds what belongs to one GL context. Draw your picture, tone map it,
 * then call render() on the view as the last thing in the frame.
 *
 * The numbered rules a host and the plug-in hold each other to are in CONTRACT.md.
 *
 * Thread tags, a closed vocabulary:
 *   [any]  from any thread, at any time; calls are serialised inside.
 *   [gl]   on a thread where the view's GL context is current; one thread at a time per view. Different views may run
 *          in parallel.
 *
 * Every struct begins with struct_size, which the caller sets to sizeof(the struct) as its compiler sees it. Structs
 * grow only at their end; a smaller struct_size than today's is an older caller, and the missing fields are zero.
 * A zeroed field means "default"; where zero is a value of its own, a bit in `flags` says that the field is set.
 *
 * A larger struct_size than the library's is refused: the header is newer than the library. Unknown bits in `flags` and
 * reserved fields that are not 0 are refused, so that they can come to mean something. A NaN or an infinity is refused in
 * every double, set or not.
 *
 * Strings are UTF-8 and null-terminated; those handed in are copied before the call returns. Matrices are column-major (as glUniformMatrix takes them) and named
 * destination_from_source. Angles are degrees where the name says _deg.
 */
#ifndef SEAGLARE_H
#define SEAGLARE_H
/* The tables below are set by hand: */
/* clang-format off */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SEAGLARE_ABI_MAJOR 1
#define SEAGLARE_ABI_MINOR 0

#if defined(_WIN32)
#define SEAGLARE_CALL __cdecl
#else
#define SEAGLARE_CALL
#endif

/* ---- results ------------------------------------------------------------------------------------------------- */

/* Negative: an error, nothing was changed and the target was not touched; each says what to do. Zero or positive:
 * success, with something worth knowing. result_string() puts a code into words; copy_last_error() has the details. */
typedef int32_t seaglare_result;
enum {
    SEAGLARE_OK = 0,
    SEAGLARE_NOTHING_TO_DRAW = 1,          /* no light is visible: the target is unchanged */
    SEAGLARE_DEGRADED = 2,                 /* drawn, or loaded, with less than asked for: see copy_last_error */
    SEAGLARE_ERROR_INVALID_ARGUMENT = -1,  /* fix the argument that copy_last_error names */
    SEAGLARE_ERROR_STRUCT_SIZE = -2,       /* set struct_size = sizeof(the struct) */
    SEAGLARE_ERROR_STALE_ID = -3,          /* the light or body was removed: forget the id */
    SEAGLARE_ERROR_FILE = -4,              /* make the file that copy_last_error names readable */
    SEAGLARE_ERROR_PARSE = -5,             /* correct the file at the line and column given; the old data stay */
    SEAGLARE_ERROR_OUT_OF_MEMORY = -6,     /* free memory and call again */
    SEAGLARE_ERROR_GL = -7,                /* check the GL objects named; then call again */
    SEAGLARE_ERROR_CONTEXT_LOST = -8,      /* destroy_view(view, 1), make a new GL context and a new view */
    SEAGLARE_ERROR_UNSUPPORTED = -9,       /* this machine or build cannot do it: do without */
    SEAGLARE_ERROR_BUSY = -10,             /* the view is in use on another thread, or views still exist: call later */
    SEAGLARE_ERROR_INTERNAL = -11,         /* a defect in Seaglare: report it, with the text of copy_last_error */
    SEAGLARE_ERROR_VERSION = -12           /* load a library of the ABI major version you compiled against */
};

/* ---- the world, declared once --------------------------------------------------------------------------------- */

/* What the host's x, y and z axes mean. Positions are metres in double precision. */
enum {
    SEAGLARE_AXES_EAST_NORTH_UP = 0,   /* right-handed, z up */
    SEAGLARE_AXES_EAST_UP_SOUTH = 1,   /* right-handed, y up, -z north: the OpenGL habit */
    SEAGLARE_AXES_EAST_UP_NORTH = 2,   /* left-handed, y up, z north */
    SEAGLARE_AXES_NORTH_EAST_DOWN = 3, /* right-handed, z down */
    SEAGLARE_AXES_EARTH_CENTRED = 4    /* WGS 84 Earth-centred, Earth-fixed */
};
/* The frames of bodies and lights have the same axes, with ahead for north and starboard for east: NORTH_EAST_DOWN gives
 * ahead-starboard-down, EAST_UP_SOUTH starboard-up-astern. The identity quaternion is upright and heads north. In an
 * EARTH_CENTRED world a body is starboard-ahead-up, and its quaternion turns that to the Earth's axes. */

/* How lat/lon/height of charted lights become positions. Flat: height above the plane z = 0. Round: on the
 * ellipsoid, so that distant lights sink below the tangent plane. */
enum { SEAGLARE_EARTH_FLAT = 0, SEAGLARE_EARTH_ROUND = 1 };

enum { SEAGLARE_LOG_DEBUG = 0, SEAGLARE_LOG_INFO = 1, SEAGLARE_LOG_WARNING = 2, SEAGLARE_LOG_ERROR = 3 };

/* Called on the thread that makes the API call; must not call Seaglare. `message` lives until it returns. */
typedef void(SEAGLARE_CALL* seaglare_log_fn)(void* user, int32_t level, const char* message);

typedef struct seaglare_context seaglare_context;
typedef struct seaglare_view seaglare_view;
typedef uint64_t seaglare_light_id; /* carries a generation; 0 is never a light */

typedef struct seaglare_create_info {
    uint32_t struct_size;
    uint32_t flags; /* SEAGLARE_CREATE_* */
    int32_t axes;   /* SEAGLARE_AXES_* */
    int32_t earth;  /* SEAGLARE_EARTH_* */
    /* Where the world's origin lies, for lights given by latitude and longitude, and its height above the water. In an
     * Earth-centred world: a point near the scene. All zero: local positions in light files are taken as they are. */
    double origin_latitude_deg;
    double origin_longitude_deg;
    double origin_height_m;
    uint64_t seed;           /* of the eye's structure and of rhythms' phases: give all channels of a bridge the same */
    const char* config_path; /* a quality file or a folder with quality/default.json; NULL: built-in defaults */
    seaglare_log_fn log;     /* may be NULL */
    void* log_user;
} seaglare_create_info;
enum {
    SEAGLARE_CREATE_NO_OPENCL = 1u << 0 /* do not look for OpenCL: work degraded on the CPU */
};

/* ---- lights --------------------------------------------------------------------------------------------------- */

enum {
    SEAGLARE_COLOUR_WHITE = 0,
    SEAGLARE_COLOUR_RED = 1,
    SEAGLARE_COLOUR_GREEN = 2,
    SEAGLARE_COLOUR_YELLOW = 3,
    SEAGLARE_COLOUR_BLUE = 4,
    SEAGLARE_COLOUR_ORANGE = 5,
    SEAGLARE_COLOUR_VIOLET = 6
};

/* One all-round light of one colour. Lights with sectors and profiles come from files (load_lights). */
typedef struct seaglare_light {
    uint32_t struct_size;
    uint32_t flags;        /* SEAGLARE_LIGHT_* */
    double position_m[3];  /* world, or body frame when body_id is not 0 */
    double intensity_cd;   /* fixed intensity while lit; or set nominal_range_nm */
    double nominal_range_nm; /* used when intensity_cd is 0 (IALA, night, 10 nm visibility) */
    double radius_m;       /* of the luminous surface; 0: default 0.05 */
    const char* character; /* chart notation such as "Fl(2) 10s"; NULL: fixed. Copied. */
    const char* name;      /* may be NULL. Copied. */
    uint32_t body_id;      /* 0: fixed to the world */
    int32_t colour;        /* SEAGLARE_COLOUR_* */
    /* Its lamp, as in a light file: "led_white", "tungsten", "planck:2700" … (`seaglare-lights spectra` lists them); NULL or
     * empty: the colour's own. A light of one colour has the colour of its lamp; one whose character names several has the
     * lamp behind the glass of each colour but white. Copied. */
    const char* spectrum;
} seaglare_light;

/* One entry of update_lights. Only what `set` names is changed. */
typedef struct seaglare_light_update {
    uint32_t struct_size;
    uint32_t set; /* SEAGLARE_SET_* */
    seaglare_light_id id;
    double position_m[3];
    double orientation[4]; /* quaternion x, y, z, w: world (or body) from light frame; normalised on entry */
    double intensity_cd;   /* replaces the intensity of every colour that the light has */
    float visibility;      /* 0 hidden … 1 free, multiplies */
    int32_t on;            /* 0 or 1 */
} seaglare_light_update;
enum {
    SEAGLARE_SET_POSITION = 1u << 0,
    SEAGLARE_SET_ORIENTATION = 1u << 1,
    SEAGLARE_SET_INTENSITY = 1u << 2,
    SEAGLARE_SET_VISIBILITY = 1u << 3,
    SEAGLARE_SET_ON = 1u << 4
};

/* ---- views and frames ------------------------------------------------------------------------------------------ */

/* Returns a GL function's address, as eglGetProcAddress does. Called only inside create_view. */
typedef void*(SEAGLARE_CALL* seaglare_get_proc_fn)(void* user, const char* name);

typedef struct seaglare_view_info {
    uint32_t struct_size;
    uint32_t flags; /* SEAGLARE_VIEW_* */
    seaglare_get_proc_fn get_proc;
    void* get_proc_user;
    const char* channel_name; /* for messages and statistics; may be NULL */
} seaglare_view_info;
enum {
    SEAGLARE_VIEW_HOST_RESTORES_STATE = 1u << 0, /* the host sets all GL state anew after render(): skip saving it */
    SEAGLARE_VIEW_NO_GPU_TIMES = 1u << 1 /* no timestamp queries and no debug groups: gpu_frames_ago stays 0 */
};

/* What the bytes of the target mean. */
enum {
    SEAGLARE_TARGET_SRGB_VALUES = 0, /* a plain format (RGBA8) holding sRGB-encoded values: the usual window */
    SEAGLARE_TARGET_SRGB_FORMAT = 1, /* an sRGB format: GL encodes when FRAMEBUFFER_SRGB is on */
    SEAGLARE_TARGET_LINEAR = 2       /* linear values */
};

/* Where the host's depth is. The frame names it: nothing is guessed from what is bound. */
enum {
    SEAGLARE_DEPTH_NONE = 0,       /* no occlusion */
    SEAGLARE_DEPTH_TEXTURE = 1,    /* depth_object is a GL_TEXTURE_2D with the target's viewport layout */
    SEAGLARE_DEPTH_TEXTURE_MS = 2, /* depth_object is a GL_TEXTURE_2D_MULTISAMPLE */
    SEAGLARE_DEPTH_FBO = 3         /* depth_object is a framebuffer whose depth is copied (0: the window's) */
};
enum {
    SEAGLARE_DEPTH_STANDARD = 0,      /* 0 near … 1 far, clip z -w … w */
    SEAGLARE_DEPTH_ZERO_TO_ONE = 1,   /* 0 near … 1 far, or reversed: clip z 0 … w (glClipControl) */
    SEAGLARE_DEPTH_LOGARITHMIC = 2    /* depth = log(c w + 1) / log(c far + 1) */
};
/* Reversed and infinite depth need no constant of their own: the projection matrix says it. */

/* One entry of a visibility query. */
typedef struct seaglare_visibility_query {
    seaglare_light_id id;
    double position_m[3]; /* world */
    float visibility;     /* in: 1; out: 0 hidden … 1 free */
    uint32_t reserved;
} seaglare_visibility_query;
/* Asked at most once per render(), in bulk, only about lights that could matter. Must not call Seaglare. Answers are smoothed
 * over the frames' time_s as what depth hides is ("occlusion.smoothing_s" of the quality file). */
typedef void(SEAGLARE_CALL* seaglare_visibility_fn)(void* user, seaglare_visibility_query* queries, uint32_t count);

typedef struct seaglare_frame {
    uint32_t struct_size;
    uint32_t flags;            /* SEAGLARE_FRAME_*: which optional fields are set */
    uint32_t target_fbo;       /* draw framebuffer that holds the finished picture; 0: the window */
    int32_t target_encoding;   /* SEAGLARE_TARGET_* */
    int32_t viewport_px[4];    /* x, y, width, height inside the target, as glViewport */
    int32_t depth_source;      /* SEAGLARE_DEPTH_NONE … */
    uint32_t depth_object;
    int32_t depth_convention;  /* SEAGLARE_DEPTH_STANDARD … */
    int32_t depth_origin_px[2]; /* where the viewport's lower left pixel lies in the depth image */
    uint32_t reserved;
    double depth_log_c;        /* logarithmic depth only */
    double depth_log_far_m;    /* logarithmic depth only */
    double view_from_world[16]; /* rigid; column-major */
    double clip_from_view[16];  /* perspective, any handedness, asymmetric frusta allowed; column-major; as for
                                 * glClipControl's GL_LOWER_LEFT */
    double time_s;             /* absolute; rhythms and the eye's motion are pure functions of it */
    double frame_interval_s;   /* nominal; 0: 1/60. Rhythms are averaged over it, at most 50 ms */
    double adaptation_luminance_cd_m2;  /* SEAGLARE_FRAME_HAS_ADAPTATION; else from local_time_of_day_h */
    double local_time_of_day_h;         /* SEAGLARE_FRAME_HAS_TIME_OF_DAY; else the configuration's default */
    double ldr_white_luminance_cd_m2;   /* luminance the host draws as 1.0; 0: as our own tone curve has it */
    double meteorological_visibility_m; /* SEAGLARE_FRAME_HAS_FOG; else clear air */
    seaglare_visibility_fn visibility;  /* may be NULL */
    void* visibility_user;
    /* SEAGLARE_FRAME_HAS_HEAD_RATE; else the head is still. How fast the viewer's head turns in the world, about its axes
     * right, up and backwards, right-handed whatever the host's axes; at most 1000 rad/s. The particles in the eye's
     * vitreous body lag behind it. Give all views of an instant the same. */
    double head_rate_rad_s[3];
} seaglare_frame;
enum {
    SEAGLARE_FRAME_HAS_ADAPTATION = 1u << 0,
    SEAGLARE_FRAME_HAS_TIME_OF_DAY = 1u << 1,
    SEAGLARE_FRAME_HAS_FOG = 1u << 2,
    SEAGLARE_FRAME_HAS_HEAD_RATE = 1u << 3,
    /* Determinism: the glare pattern is that of this very instant, a pure function of the frame, the configuration and the
     * seed, and render() waits until it is made. Without it the pattern is made beside the frames by a thread of the
     * library, render() never waits for it, and takes the newest that is finished; a change too large for one frame
     * (adaptation set to another value, a lamp that comes into view) fades in over 0.15 s. How much of a light the depth
     * hides is waited for, too, where OpenCL has to know it; without this flag it comes a frame or two late. And nothing
     * that was measured decides what the frame leaves out. */
    SEAGLARE_FRAME_WAIT = 1u << 4
};

/* What accumulates in the eye. All else that moves is a function of absolute time and the seed: a context that is given the
 * state of another goes on as that one would, to the last bit. */
typedef struct seaglare_eye_state {
    uint32_t struct_size;
    uint32_t flags;
    double adaptation_luminance_cd_m2; /* of the last frame; set it to share or resume. What adapts in time is on its way there */
    double time_s;
    int32_t is_day; /* SEAGLARE_EYE_HAS_DAY: 0 or 1, for photometers and lamps with an intensity by day */
    uint32_t reserved;
    double adapted_luminance_cd_m2;  /* SEAGLARE_EYE_HAS_ADAPTED: how far an eye that "adapts" has come */
    double vitreous_orientation[4];  /* SEAGLARE_EYE_HAS_VITREOUS: quaternion x, y, z, w: head from the cloud of particles */
    double vitreous_spin_rad_s[3];   /* likewise: of the cloud relative to the head, about right, up, backwards */
    double head_rate_rad_s[3];       /* likewise: that the last frame gave */
} seaglare_eye_state;
enum {
    /* Set by get_eye_state once a frame was drawn (never for a caller whose struct has no is_day). In set_eye_state: take
     * is_day; without it the context keeps its own. Between the adaptation luminances at which photometers switch, 15 and
     * 30 cd/m2, it stays day or night as it was: processes that show one scene hand it on, or lights differ at dusk. */
    SEAGLARE_EYE_HAS_DAY = 1u << 0,
    /* Set by get_eye_state once a frame was drawn or they were set (never for a caller whose struct has not their fields).
     * In set_eye_state: take these fields, as they stand at time_s; without them the context keeps its own. */
    SEAGLARE_EYE_HAS_ADAPTED = 1u << 1,
    SEAGLARE_EYE_HAS_VITREOUS = 1u << 2
};

/* ---- the table -------------------------------------------------------------------------------------------------- */

typedef struct seaglare_api {
    uint32_t struct_size;
    uint32_t abi_minor;

    /* [any] Makes a context. Precondition: info and out are not NULL. On success *out is owned by the caller until
     * destroy(). OK; DEGRADED (no OpenCL device: the pattern is computed once on the CPU and does not move);
     * INVALID_ARGUMENT, STRUCT_SIZE, FILE, PARSE, OUT_OF_MEMORY: *out is NULL. */
    seaglare_result(SEAGLARE_CALL* create)(const seaglare_create_info* info, seaglare_context** out);
    /* [any] Frees the context. NULL is allowed. BUSY while a view exists: nothing is freed. */
    seaglare_result(SEAGLARE_CALL* destroy)(seaglare_context* context);

    /* [gl] Makes a view for the GL context that is current: compiles shaders and OpenCL kernels. OK; INVALID_ARGUMENT;
     * STRUCT_SIZE; GL (a function is missing or a shader does not compile); UNSUPPORTED (GL below 3.3). */
    seaglare_result(SEAGLARE_CALL* create_view)(seaglare_context* context, const seaglare_view_info* info,
                                                seaglare_view** out);
    /* [gl] Frees the view and its GL objects; NULL is allowed. With context_lost != 0 makes no GL call and may run on any
     * thread. OK; BUSY while another thread is in the view. */
    seaglare_result(SEAGLARE_CALL* destroy_view)(seaglare_view* view, int32_t context_lost);

    /* [any] Replaces eye, quality and display from a quality file. All or nothing. OK, DEGRADED, FILE, PARSE. */
    seaglare_result(SEAGLARE_CALL* load_config)(seaglare_context* context, const char* path);
    /* [any] Adds the lights of a file. All or nothing: after an error every light is as it was. OK, FILE, PARSE. */
    seaglare_result(SEAGLARE_CALL* load_lights)(seaglare_context* context, const char* path);
    /* [any] Removes every light, loaded or added, and forgets the poses of bodies. Old ids become stale. OK. */
    seaglare_result(SEAGLARE_CALL* clear_lights)(seaglare_context* context);
    /* [any] out_id may be NULL. OK, STRUCT_SIZE, INVALID_ARGUMENT (NaN, negative intensity, unreadable character, unknown
     * spectrum: the message names the field, and the name that was perhaps meant). */
    seaglare_result(SEAGLARE_CALL* add_light)(seaglare_context* context, const seaglare_light* light,
                                              seaglare_light_id* out_id);
    /* [any] `count` entries, `stride` bytes apart (0: the first entry's struct_size). All or nothing. OK,
     * INVALID_ARGUMENT, STRUCT_SIZE, STALE_ID. */
    seaglare_result(SEAGLARE_CALL* update_lights)(seaglare_context* context, const seaglare_light_update* updates,
                                                  uint32_t count, uint32_t stride);
    /* [any] OK, STALE_ID. */
    seaglare_result(SEAGLARE_CALL* remove_light)(seaglare_context* context, seaglare_light_id id);
    /* [any] Moves every light of a body. body_id is the host's own number, not 0. orientation: quaternion x, y, z, w,
     * world from body; normalised on entry. Until then the body lies at the world's origin. OK, INVALID_ARGUMENT. */
    seaglare_result(SEAGLARE_CALL* set_body_pose)(seaglare_context* context, uint32_t body_id,
                                                  const double position_m[3], const double orientation[4]);
    /* [any] Number of lights, and ids of the first `capacity` of them in load order. ids may be NULL. OK,
     * INVALID_ARGUMENT. */
    seaglare_result(SEAGLARE_CALL* list_lights)(seaglare_context* context, seaglare_light_id* ids, uint32_t capacity,
                                                uint32_t* out_count);

    /* [any] get: the adaptation and time of the last frame of any view, and what has accumulated. set: the adaptation for
     * frames that bring neither an adaptation luminance nor a time of day, and what the flags name. The next frame steps on
     * from time_s: a frame at that time or before it makes no step, nor does a second view of one instant. OK,
     * INVALID_ARGUMENT, STRUCT_SIZE. */
    seaglare_result(SEAGLARE_CALL* get_eye_state)(seaglare_context* context, seaglare_eye_state* state);
    seaglare_result(SEAGLARE_CALL* set_eye_state)(seaglare_context* context, const seaglare_eye_state* state);

    /* [gl] Adds the glare of every visible light to frame->target_fbo. Every GL state has its entry value again on
     * return, errors included. OK, NOTHING_TO_DRAW, DEGRADED, INVALID_ARGUMENT, STRUCT_SIZE, GL, CONTEXT_LOST, BUSY. */
    seaglare_result(SEAGLARE_CALL* render)(seaglare_view* view, const seaglare_frame* frame);

    /* [any] Copies this thread's last error or DEGRADED text, cut to `size` bytes with its null. context may be NULL: the
     * text of calls without a context, such as create. A success does not clear it. Returns OK, or INVALID_ARGUMENT when buffer is NULL or size is 0. */
    seaglare_result(SEAGLARE_CALL* copy_last_error)(seaglare_context* context, char* buffer, uint32_t size);
    /* [any] The code in words; static storage; never NULL. */
    const char*(SEAGLARE_CALL* result_string)(seaglare_result result);
    /* [any] A pointer to a static table such as seaglare_stats_api, or NULL when the name is not known. */
    const void*(SEAGLARE_CALL* get_extension)(const char* name);
} seaglare_api;

/* [any] Fills `api`, whose struct_size the caller has set; fields past it are not touched. OK, VERSION (another ABI
 * major: *api is unchanged), INVALID_ARGUMENT, STRUCT_SIZE. The table's pointers live as long as the library. */
#if defined(SEAGLARE_BUILD)
#if defined(_WIN32)
__declspec(dllexport)
#else
__attribute__((visibility("default")))
#endif
#endif
seaglare_result SEAGLARE_CALL seaglare_get_api(uint32_t abi_major, seaglare_api* api);
typedef seaglare_result(SEAGLARE_CALL* seaglare_get_api_fn)(uint32_t abi_major, seaglare_api* api);

/* ---- extension "seaglare.stats/1": what the last frame did ------------------------------------------------------ */

/* How lights were added up. */
enum {
    SEAGLARE_ACCUMULATION_GL_BILLBOARDS = 0, /* a cropped rectangle a light */
    SEAGLARE_ACCUMULATION_CL_TILES = 1       /* a gather in OpenCL */
};

/* What a time budget gives up, each gradually: bits of a set. */
enum {
    SEAGLARE_GIVEN_UP_ERROR_BUDGET = 1, /* max_error_codes has grown towards most_error_codes */
    SEAGLARE_GIVEN_UP_MOTION = 2,       /* the pattern follows the eye less often */
    SEAGLARE_GIVEN_UP_DISCS = 4,        /* near lamps' skirts draw nearer to a point's */
    SEAGLARE_GIVEN_UP_OWN_PATTERNS = 8  /* coloured lamps' patterns draw nearer to the white one */
};

/* A pass of the plan. */
enum {
    SEAGLARE_PASS_NONE = 0,
    SEAGLARE_PASS_EVALUATE = 1,
    SEAGLARE_PASS_VISIBILITY = 2,
    SEAGLARE_PASS_PATTERN = 3,
    SEAGLARE_PASS_UPLOAD = 4,
    SEAGLARE_PASS_OCCLUSION = 5,
    SEAGLARE_PASS_ACCUMULATE = 6,
    SEAGLARE_PASS_COMPOSITE = 7
};

typedef struct seaglare_stats {
    uint32_t struct_size;
    uint32_t degraded;            /* 1: no OpenCL */
    uint32_t lights_total;
    uint32_t lights_drawn;        /* billboards drawn */
    uint32_t lights_dark;         /* off, eclipsed, out of sector or profile */
    uint32_t lights_horizon;      /* below the geographical horizon */
    uint32_t lights_outside;      /* behind, or too far off screen for their glare to reach in */
    uint32_t lights_below_threshold; /* would change no display code */
    uint32_t draw_calls;
    uint32_t kernel_launches;
    uint32_t pattern_size;        /* samples per side of the transform */
    uint32_t pattern_radius_px;
    uint32_t pattern_layers;
    uint32_t pattern_wavelengths;
    double pattern_angular_scale; /* 1: physical */
    double pupil_mm;
    double adaptation_luminance_cd_m2;
    double device_memory_bytes;   /* GL and OpenCL objects held for this view and its context */
    double evaluate_ms;           /* CPU times of the stages, of this frame */
    double pattern_ms;
    double upload_ms;
    double accumulate_ms;
    double composite_ms;
    double render_ms;             /* the whole call */
    double occlusion_ms;          /* CPU time, as those above */
    /* GPU times of the passes, of the frame `gpu_frames_ago` calls of render() that drew before this one: timestamps are
     * read when they have come in, nothing waits for them. Of large pictures, drawn band by band, not every frame is timed. */
    double gpu_upload_ms;
    double gpu_occlusion_ms;
    double gpu_accumulate_ms;
    double gpu_composite_ms;
    double gpu_ms;                /* from the first timestamp of that frame to its last */
    uint32_t gpu_frames_ago;      /* 0: none has come in yet, or the GPU has no clock */
    uint32_t reserved;
    /* The plan (copy_plan has it in full), and what it predicted of this frame beside the times above. */
    double max_error_codes;       /* the budget that the frame kept: more than configured where time was short */
    double error_bound_codes;     /* what all that was left out can change together, at most, in 8-bit codes */
    double time_budget_ms;        /* 0: none */
    double taken_ms;              /* what counted against it: with pinned costs the prediction */
    double quality_loss;          /* 0 ... 1: what the time budget has given up */
    double predicted_ms;          /* without the pattern, which is made beside the frames */
    double predicted_evaluate_ms;
    double predicted_pattern_ms;
    double predicted_upload_ms;
    double predicted_occlusion_ms;
    double predicted_accumulate_ms;
    double predicted_composite_ms;
    uint32_t accumulation;        /* SEAGLARE_ACCUMULATION_... */
    uint32_t omissions;           /* kinds of things left out: entries of the plan */
    /* What the time budget has given up, and what that buys; predicted, of a frame. What would buy next to nothing is never
     * given up. Where frames take longer than the budget and could_save_ms is 0, it cannot be kept. */
    double saved_ms;
    double could_save_ms;
    uint32_t given_up;            /* SEAGLARE_GIVEN_UP_..., all that are given up in part or whole */
    uint32_t limiting_pass;       /* SEAGLARE_PASS_...: the dearest, where the time budget cannot be kept */
} seaglare_stats;

typedef struct seaglare_stats_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [gl] Statistics of the view's last render(). */
    seaglare_result(SEAGLARE_CALL* get_stats)(seaglare_view* view, seaglare_stats* stats);
    /* [gl] The plan of the last render() as JSON text. *out_size is the size needed with its null. */
    seaglare_result(SEAGLARE_CALL* copy_plan)(seaglare_view* view, char* buffer, uint32_t size, uint32_t* out_size);
} seaglare_stats_api;

/* ---- extension "seaglare.hdr/1": the glare itself, for tools and tests; it waits for the GPU --------------------- */

typedef struct seaglare_hdr_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [gl] Reads the HDR buffer of the last render(): width*height*4 floats, lower left pixel first: linear sRGB
     * luminance in cd/m2 (signed: colours outside sRGB) and scotopic luminance. The buffer is zero after
     * NOTHING_TO_DRAW. With rgba NULL and capacity_floats 0 it only asks for the size. OK; INVALID_ARGUMENT when
     * capacity_floats is too small, *out_size_px is set all the same; GL, CONTEXT_LOST, BUSY. */
    seaglare_result(SEAGLARE_CALL* read)(seaglare_view* view, float* rgba, uint64_t capacity_floats,
                                         int32_t out_size_px[2]);
} seaglare_hdr_api;

/* ---- extension "seaglare.vessels/1": the lights of ships by COLREG 1972, Rules 20 to 30 -------------------------- */

/* What a vessel is or does, and the rule that gives her lights. */
enum {
    SEAGLARE_VESSEL_POWER_DRIVEN = 0,            /* under way: 23(a), (d); a composite unit: 24(b) */
    SEAGLARE_VESSEL_AIR_CUSHION = 1,             /* in the non-displacement mode: 23(b) */
    SEAGLARE_VESSEL_TOWING = 2,                  /* astern: 24(a), 27(c) */
    SEAGLARE_VESSEL_PUSHING = 3,                 /* ahead, or towing alongside: 24(c) */
    SEAGLARE_VESSEL_TOWED = 4,                   /* 24(e) */
    SEAGLARE_VESSEL_PUSHED_AHEAD = 5,            /* 24(f)(i) */
    SEAGLARE_VESSEL_TOWED_ALONGSIDE = 6,         /* 24(f)(ii) */
    SEAGLARE_VESSEL_TOWED_SUBMERGED = 7,         /* inconspicuous, partly submerged: 24(g) */
    SEAGLARE_VESSEL_SAILING = 8,                 /* 25 */
    SEAGLARE_VESSEL_TRAWLING = 9,                /* 26(b) */
    SEAGLARE_VESSEL_FISHING = 10,                /* other than trawling: 26(c) */
    SEAGLARE_VESSEL_NOT_UNDER_COMMAND = 11,      /* 27(a) */
    SEAGLARE_VESSEL_RESTRICTED = 12,             /* in her ability to manoeuvre: 27(b), (d) */
    SEAGLARE_VESSEL_MINE_CLEARANCE = 13,         /* 27(f) */
    SEAGLARE_VESSEL_CONSTRAINED_BY_DRAUGHT = 14, /* 28 */
    SEAGLARE_VESSEL_PILOT = 15,                  /* 29 */
    SEAGLARE_VESSEL_AT_ANCHOR = 16,              /* 30(a) to (c) */
    SEAGLARE_VESSEL_AGROUND = 17                 /* 30(d) */
};
enum { SEAGLARE_SIDE_NONE = 0, SEAGLARE_SIDE_PORT = 1, SEAGLARE_SIDE_STARBOARD = 2 };
/* Annex II; the first three are trawlers', the last is for SEAGLARE_VESSEL_FISHING. */
enum {
    SEAGLARE_FISHING_NO_SIGNAL = 0,
    SEAGLARE_FISHING_SHOOTING_NETS = 1,
    SEAGLARE_FISHING_HAULING_NETS = 2,
    SEAGLARE_FISHING_NETS_FAST = 3,
    SEAGLARE_FISHING_PURSE_SEINE = 4
};

/* Her lights stand in the frame of her body by Annex I; set_body_pose() moves them. Metres. What a kind does not know is
 * refused: a tricolour lantern on a ship of 20 m, say. */
typedef struct seaglare_vessel {
    uint32_t struct_size;
    uint32_t flags;   /* SEAGLARE_VESSEL_STOPPED … */
    int32_t kind;     /* SEAGLARE_VESSEL_POWER_DRIVEN … */
    uint32_t body_id; /* not 0 */
    double length_m;  /* over all; 1 to 1000 */
    double breadth_m; /* greatest; 0.2 to 300 */
    double tow_length_m;      /* towing: from her stern to the after end of the tow; above 200 a third masthead light */
    double gear_extent_m;     /* fishing: outlying gear; above 150 a white light towards it */
    double gear_bearing_deg;  /* of that gear, clockwise from ahead */
    double deck_lights_cd;    /* at anchor, aground: each of her working lights; 0: none, though 30(c) asks for them from
                               * 100 m of length on */
    double deck_height_m;     /* uppermost continuous deck above the water; 0: 0.5 m + 4 % of the length, at most 15 */
    double mast_height_m;     /* forward masthead light (sailing: masthead) above that deck; 0: the least allowed */
    double mast_separation_m; /* between two masthead lights, horizontally; 0: the least allowed */
    double amidships_m[3];    /* half her length, centreline, waterline, in the body's frame */
    double intensity_factor;  /* of her lamps over the least allowed, 1 to 100; 0: 1 */
    double radius_m;          /* of each lamp; 0: 0.05 */
    const char* name;         /* may be NULL. Copied. */
    int32_t obstruction_side; /* restricted, under-water work: SEAGLARE_SIDE_*, where others must not pass */
    int32_t fishing_signal;   /* SEAGLARE_FISHING_* */
} seaglare_vessel;
enum {
    SEAGLARE_VESSEL_STOPPED = 1u << 0,             /* makes no way through the water: 26, 27 */
    SEAGLARE_VESSEL_ANCHORED = 1u << 1,            /* restricted, mine clearance, pilot */
    SEAGLARE_VESSEL_RESTRICTED_BY_TOW = 1u << 2,   /* 27(c) */
    SEAGLARE_VESSEL_SECOND_MASTHEAD = 1u << 3,     /* also under 50 m */
    SEAGLARE_VESSEL_ALL_ROUND_WHITE = 1u << 4,     /* under 12 m: 23(d)(i) */
    SEAGLARE_VESSEL_NO_SIDELIGHTS = 1u << 5,       /* under 7 m: 23(d)(ii) */
    SEAGLARE_VESSEL_COMBINED_SIDELIGHTS = 1u << 6, /* under 20 m: 21(b) */
    SEAGLARE_VESSEL_TRICOLOUR = 1u << 7,           /* sailing, under 20 m: 25(b) */
    SEAGLARE_VESSEL_RED_OVER_GREEN = 1u << 8,      /* sailing: 25(c) */
    SEAGLARE_VESSEL_TWO_ANCHOR_LIGHTS = 1u << 9,   /* also under 50 m */
    SEAGLARE_VESSEL_DAY_OFF = 1u << 10             /* a photometer switches her lights off by day */
};

typedef struct seaglare_vessels_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [any] Adds all lights of a vessel and writes their ids: masthead lights, sidelights, sternlight, then what tells her
     * kind, from the highest down. *out_count is their number, also when capacity is too small. With ids NULL and capacity
     * 0 it only counts. All or nothing. A vessel that changes is removed and added anew. Other files and calls may name
     * her body, too. OK; STRUCT_SIZE; OUT_OF_MEMORY; INVALID_ARGUMENT (capacity too small, a NaN, a length out of range,
     * an option that her kind or length does not have: the message names the field and the rule). */
    seaglare_result(SEAGLARE_CALL* add_vessel)(seaglare_context* context, const seaglare_vessel* vessel,
                                               seaglare_light_id* ids, uint32_t capacity, uint32_t* out_count);
    /* [any] Removes these lights; all or nothing. OK; STALE_ID (the message says which); INVALID_ARGUMENT (ids is NULL). */
    seaglare_result(SEAGLARE_CALL* remove_vessel)(seaglare_context* context, const seaglare_light_id* ids,
                                                  uint32_t count);
} seaglare_vessels_api;

/* ---- extension "seaglare.waves/1": buoys that swing on the host's sea --------------------------------------------- */

/* One sinusoid of the sea's surface: amplitude cos(k . x - w t + phase), x horizontally from the world's origin (in an
 * Earth-centred world: from the origin of create_info), t the frame's time_s. Frequency and length follow from each other
 * by the dispersion of linear waves. An amplitude beyond breaking, 0.142 of the length from trough to crest, less in
 * shallow water, is cut to it. */
typedef struct seaglare_wave {
    uint32_t struct_size;
    uint32_t flags;       /* 0 */
    double amplitude_m;   /* 0 to 50 */
    double direction_deg; /* towards which it runs, true, clockwise */
    double wavelength_m;  /* either this … */
    double angular_frequency_rad_s; /* … or this */
    double phase_rad;
    double depth_m;       /* of the water; 0: deep */
} seaglare_wave;

/* A body that swings: heave follows the elevation of the sea at its mooring, roll and pitch its slope, as damped linear
 * oscillators in their steady state. A pure function of time: every channel has the same pose. */
typedef struct seaglare_buoy {
    uint32_t struct_size;
    uint32_t flags;        /* 0 */
    uint32_t body_id;      /* not 0; the frame of the body has its origin at the waterline, upright when at rest */
    uint32_t reserved;
    double position_m[3];  /* of the mooring at the still water's surface; world */
    double focal_height_m; /* of its light; 0: 4. Gives what is 0 below: */
    double heave_period_s; /* natural; 0: that of a pendulum half as long as the focal height */
    double heave_damping;  /* share of the critical; 0: 0.3 */
    double roll_period_s;  /* of roll and pitch; 0: that of a pendulum as long as the focal height */
    double roll_damping;   /* 0: 0.1 */
    double max_tilt_deg;   /* never leans further; 0: 60 */
} seaglare_buoy;

typedef struct seaglare_waves_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [any] The sea from now on, instead of the one before; copied. `count` entries, at most 4096, `stride` bytes apart (0:
     * the first entry's struct_size). count 0: still water, as at the beginning. All or nothing. OK; STRUCT_SIZE;
     * INVALID_ARGUMENT (the message names entry and field). */
    seaglare_result(SEAGLARE_CALL* set_waves)(seaglare_context* context, const seaglare_wave* waves, uint32_t count,
                                              uint32_t stride);
    /* [any] Makes a body a buoy, or changes the one it is. Light files bring buoys of their own. set_body_pose() of the
     * same body ends that: the host moves it from then on. clear_lights() forgets buoys, not the sea. OK; STRUCT_SIZE;
     * INVALID_ARGUMENT (the message names the field). */
    seaglare_result(SEAGLARE_CALL* set_buoy)(seaglare_context* context, const seaglare_buoy* buoy);
    /* [any] The body stays where it was last drawn. OK; STALE_ID (no such buoy). */
    seaglare_result(SEAGLARE_CALL* remove_buoy)(seaglare_context* context, uint32_t body_id);
    /* [any] Where a buoy is at a time, as set_body_pose() takes it: for the host to draw its hull there. OK; STALE_ID (no
     * such buoy); INVALID_ARGUMENT. */
    seaglare_result(SEAGLARE_CALL* get_buoy_pose)(seaglare_context* context, uint32_t body_id, double time_s,
                                                  double position_m[3], double orientation[4]);
} seaglare_waves_api;

/* ---- extension "seaglare.lights/1": light files that change while the host runs ----------------------------------- */

/* What a reload did. */
typedef struct seaglare_reload_counts {
    uint32_t struct_size;
    uint32_t unchanged; /* the file says of them what it said before */
    uint32_t changed;   /* they kept their id and took the file's data */
    uint32_t added;
    uint32_t removed;   /* their ids are stale now */
    uint32_t reserved;
} seaglare_reload_counts;

typedef struct seaglare_lights_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [any] Reads a file that load_lights() or this function has loaded before, with all that it includes, and puts what it
     * says now in the place of the lights that came from it. A light of which it says the same as before keeps its id and
     * all that the host has set (update_lights). One that has changed keeps its id, and whether it is on and its visibility;
     * it is known again by its name and place, or, moved, by a name that no other light has that changed. One that is gone
     * becomes stale, what is new comes last in list_lights(); also a light that remove_light() has removed comes anew.
     * Rhythms go on: their phase hangs on the light's data. Lights of other files and those of add_light() stay as they are.
     * A file not loaded before is loaded. Frames are drawn meanwhile, each with all of the old lights or all of the new
     * ones. All or nothing: after an error the old lights shine on, and copy_last_error() says FILE:LINE:COLUMN: why. counts
     * may be NULL. OK, FILE, PARSE, STRUCT_SIZE, INVALID_ARGUMENT (NULL), OUT_OF_MEMORY. */
    seaglare_result(SEAGLARE_CALL* reload)(seaglare_context* context, const char* path, seaglare_reload_counts* counts);
    /* [any] Writes every light, loaded or added, as it is now, and the buoys of files, in the order of list_lights(), into
     * one light file, which replaces the file at `path` whole or not at all. What it reads back is the same light to the
     * last bit, with its phase; the same lights give the same bytes. Not saved: whether a light is on, its visibility, poses
     * of bodies. `path` does not become a file to reload by that. OK; FILE (it cannot be written); INVALID_ARGUMENT (NULL,
     * or a light that holds what no file may, such as an intensity above 1e8 cd: the message names it); OUT_OF_MEMORY. */
    seaglare_result(SEAGLARE_CALL* save)(seaglare_context* context, const char* path);
} seaglare_lights_api;

/* ---- extension "seaglare.memory/1": device memory by what it is for ----------------------------------------------- */

/* GL and OpenCL objects in bytes, as the library asked for them; a driver may round up. What views share is counted for each
 * of them. */
typedef struct seaglare_memory {
    uint32_t struct_size;
    uint32_t reserved;
    double hdr_bytes;                /* the sum of all lights: two bands of rows, at full resolution */
    double coarse_grid_bytes;        /* their far tails */
    double background_bytes;         /* copy of the host's pixels */
    double occlusion_bytes;          /* how much of each light is seen; a copy of the host's depth where one is needed */
    double lights_bytes;             /* the lights of a draw call */
    double pattern_layers_bytes;     /* the pattern as a texture */
    double accumulation_bytes;       /* of other ways to add lights up than drawing them */
    double pattern_core_bytes;       /* shared by the views of a context, as the rest: pupil plane and energy table */
    double pattern_wide_field_bytes; /* the same for wide angles, and tables of several instants */
    double pattern_screen_bytes;     /* the pattern on the grids of screens */
    double total_bytes;
} seaglare_memory;

typedef struct seaglare_memory_api {
    uint32_t struct_size;
    uint32_t reserved;
    /* [gl] What is held after the view's last render() that drew; zeros before the first. OK; STRUCT_SIZE;
     * INVALID_ARGUMENT (NULL); BUSY. */
    seaglare_result(SEAGLARE_CALL* get_memory)(seaglare_view* view, seaglare_memory* memory);
} seaglare_memory_api;

#ifdef __cplusplus
}
#endif
/* clang-format on */
#endif /* SEAGLARE_H */
