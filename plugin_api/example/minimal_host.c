/* A complete host: a dark picture, one lighthouse, its glare. Needs EGL; says what it saw. Without a display:
 *
 *   EGL_PLATFORM=surfaceless minimal_host [path of libseaglare.so]
 *
 * A library that was linked (find_package(seaglare)) needs no dlopen: call seaglare_get_api directly.
 */
/* Laid out to fit on one page of README.md. */
/* clang-format off */
/* README begin */
#include <EGL/egl.h>
#include <dlfcn.h>
#include <math.h>
#include <seaglare.h>
#include <stdio.h>

static void* get_proc(void* user, const char* name) { (void)user; return (void*)eglGetProcAddress(name); }
typedef void (*get_fn)(int x, int y, int w, int h, unsigned format, unsigned type, void* pixels);

int main(int argc, char** argv) {
    /* A GL context, as every host has one already. Its framebuffer 0 is the finished picture: black. */
    const EGLint surface[] = {EGL_WIDTH, 640, EGL_HEIGHT, 360, EGL_NONE};
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_NONE};
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLConfig config;
    EGLint found = 0;
    if (!eglInitialize(display, NULL, NULL) || !eglChooseConfig(display, wanted, &config, 1, &found) || found == 0) return 2;
    eglBindAPI(EGL_OPENGL_API);
    EGLSurface window = eglCreatePbufferSurface(display, config, surface);
    if (!eglMakeCurrent(display, window, window, eglCreateContext(display, config, NULL, version))) return 2;

    /* 1. Load the library and fill the table. */
    void* library = dlopen(argc > 1 ? argv[1] : "libseaglare.so.1", RTLD_NOW | RTLD_LOCAL);
    seaglare_get_api_fn get_api = library ? (seaglare_get_api_fn)dlsym(library, "seaglare_get_api") : NULL;
    seaglare_api api = {sizeof api};
    if (!get_api || get_api(SEAGLARE_ABI_MAJOR, &api) < 0) return printf("no seaglare: %s\n", dlerror()), 1;

    /* 2. A context for the world and its lights; a view for this GL context. */
    seaglare_create_info info = {sizeof info, .axes = SEAGLARE_AXES_EAST_UP_SOUTH};
    seaglare_view_info channel = {sizeof channel, .get_proc = get_proc};
    seaglare_light lighthouse = {sizeof lighthouse, .position_m = {0, 20, -1000}, .intensity_cd = 10000, .character = "Iso 4s"};
    seaglare_context* context = NULL;
    seaglare_view* view = NULL;
    seaglare_result result = api.create(&info, &context);
    if (result >= 0) result = api.add_light(context, &lighthouse, NULL);
    if (result >= 0) result = api.create_view(context, &channel, &view);

    /* 3. Every frame, after the picture is drawn and tone mapped: the eye 20 m up, looking north, in starlight. */
    const double f = 1 / tan(0.3927), far_m = 1e5, near_m = 0.5; /* 45 degrees */
    seaglare_frame frame = {sizeof frame, SEAGLARE_FRAME_HAS_ADAPTATION, .viewport_px = {0, 0, 640, 360},
        .view_from_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -20, 0, 1},
        .clip_from_view = {f * 360 / 640, 0, 0, 0, 0, f, 0, 0, 0, 0, (far_m + near_m) / (near_m - far_m), -1,
                           0, 0, 2 * far_m * near_m / (near_m - far_m), 0},
        .adaptation_luminance_cd_m2 = 0.001};
    unsigned char centre[4] = {0}, text[512] = "";
    for (int i = 0; i < 240 && result >= 0 && centre[0] == 0; ++i, frame.time_s += 1.0 / 60) {
        result = api.render(view, &frame);
        ((get_fn)eglGetProcAddress("glReadPixels"))(320, 180, 1, 1, 0x1908 /* GL_RGBA */, 0x1401 /* bytes */, centre);
    }
    if (result < 0) api.copy_last_error(context, (char*)text, sizeof text);
    printf("%s %s\nthe lighthouse is %d %d %d\n", api.result_string(result), (char*)text, centre[0], centre[1], centre[2]);
    api.destroy_view(view, 0);
    api.destroy(context);
    return result < 0 || centre[0] == 0;
}
/* README end */
