#include <epoxy/gl.h>
// GLFW must see that GL's declarations are there already.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include "host_stub/commands.h"
#include "host_stub/image_files.h"
#include "host_stub/plugin.h"

namespace seaglare::host {
namespace {

constexpr const char* help = R"(  mouse, left button held   look around
  arrows, or W A S D        sail ahead, astern, to port, to starboard; Shift: ten times as fast
  R / F                     eye up / down
  , / .                     time of day: ten minutes back / on
  - / +                     clock slower / faster (1, 10, 100, 1000 times)
  Space                     stop and start time
  G                         glare on and off
  P                         screenshot to seaglare.png
  H                         this help
  Esc                       close
)";

struct GlfwLibrary {
    GlfwLibrary() {
        glfwSetErrorCallback([](int, const char* text) { std::cerr << "GLFW: " << text << "\n"; });
        if (!glfwInit()) throw GlFailure("no window system: GLFW does not start (is DISPLAY set?)");
    }
    ~GlfwLibrary() { glfwTerminate(); }
    GlfwLibrary(const GlfwLibrary&) = delete;
    GlfwLibrary& operator=(const GlfwLibrary&) = delete;
};

using Window = std::unique_ptr<GLFWwindow, decltype(&glfwDestroyWindow)>;

Window open_window(const Channel& channel, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    Window window(glfwCreateWindow(channel.width_px, channel.height_px, title.c_str(), nullptr, nullptr),
                  glfwDestroyWindow);
    if (!window) throw GlFailure("cannot open a window with GL 3.3 core");
    glfwMakeContextCurrent(window.get());
    glfwSwapInterval(1);
    return window;
}

void* SEAGLARE_CALL window_proc(void*, const char* name) {
    return reinterpret_cast<void*>(glfwGetProcAddress(name));
}

// What keys and mouse have asked for.
class Controls {
  public:
    explicit Controls(Simulation& simulation) : simulation_(simulation) {}

    bool glare = true, paused = false, screenshot = false;
    double clock_rate() const { return std::pow(10.0, clock_power_); }

    void attach(GLFWwindow* window) {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
            if (action != GLFW_RELEASE) static_cast<Controls*>(glfwGetWindowUserPointer(w))->key(w, key);
        });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
            static_cast<Controls*>(glfwGetWindowUserPointer(w))->cursor(w, x, y);
        });
    }

    // Keys that act as long as they are held.
    void hold(GLFWwindow* window, double dt) {
        const auto down = [&](int a, int b) {
            return glfwGetKey(window, a) == GLFW_PRESS || glfwGetKey(window, b) == GLFW_PRESS ? 1.0 : 0.0;
        };
        constexpr double speed_m_s = 15, climb_m_s = 5;
        const double fast = 1 + 9 * down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
        const double ahead = down(GLFW_KEY_W, GLFW_KEY_UP) - down(GLFW_KEY_S, GLFW_KEY_DOWN);
        const double right = down(GLFW_KEY_D, GLFW_KEY_RIGHT) - down(GLFW_KEY_A, GLFW_KEY_LEFT);
        const double h = simulation_.observer().heading_deg * std::numbers::pi / 180;
        Observer& o = simulation_.observer();
        o.position_m +=
            (glm::dvec2(std::sin(h), std::cos(h)) * ahead + glm::dvec2(std::cos(h), -std::sin(h)) * right) *
            (speed_m_s * fast * dt);
        o.eye_height_m += climb_m_s * fast * dt *
                          (down(GLFW_KEY_R, GLFW_KEY_PAGE_UP) - down(GLFW_KEY_F, GLFW_KEY_PAGE_DOWN));
        o.eye_height_m = std::clamp(o.eye_height_m, 1.0, 500.0);
    }

  private:
    void key(GLFWwindow* window, int key) {
        switch (key) {
            case GLFW_KEY_ESCAPE:
                glfwSetWindowShouldClose(window, GLFW_TRUE);
                break;
            case GLFW_KEY_COMMA:
                simulation_.set_local_time_h(simulation_.local_time_h() - 1.0 / 6);
                break;
            case GLFW_KEY_PERIOD:
                simulation_.set_local_time_h(simulation_.local_time_h() + 1.0 / 6);
                break;
            case GLFW_KEY_MINUS:
                clock_power_ = std::max(clock_power_ - 1, 0);
                break;
            case GLFW_KEY_EQUAL:
                clock_power_ = std::min(clock_power_ + 1, 3);
                break;
            case GLFW_KEY_SPACE:
                paused = !paused;
                break;
            case GLFW_KEY_G:
                glare = !glare;
                break;
            case GLFW_KEY_P:
                screenshot = true;
                break;
            case GLFW_KEY_H:
                std::cout << help;
                break;
            default:
                break;
        }
    }

    void cursor(GLFWwindow* window, double x, double y) {
        if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS && seen_cursor_) {
            const Channel& c = simulation_.channel();
            const double deg_per_px = (c.up_deg - c.down_deg) / c.height_px;
            Observer& o = simulation_.observer();
            o.heading_deg = std::fmod(o.heading_deg - (x - x_) * deg_per_px + 360, 360);
            o.pitch_deg = std::clamp(o.pitch_deg + (y - y_) * deg_per_px, -80.0, 80.0);
        }
        x_ = x;
        y_ = y;
        seen_cursor_ = true;
    }

    Simulation& simulation_;
    int clock_power_ = 0;
    double x_ = 0, y_ = 0;
    bool seen_cursor_ = false;
};

std::string title_of(const Simulation& s, const Controls& controls, double frame_ms) {
    char text[160];
    const int minutes = static_cast<int>(s.local_time_h() * 60);
    std::snprintf(text, sizeof text, "%s  %02d:%02d x%.0f%s  heading %03.0f  %.0f ms%s",
                  s.scene().name.c_str(), minutes / 60, minutes % 60, controls.clock_rate(),
                  controls.paused ? " (stopped)" : "", s.observer().heading_deg, frame_ms,
                  controls.glare ? "" : "  glare off");
    return text;
}

}  // namespace

int window_command(const WindowOptions& options) {
    Simulation simulation(options.scene);
    std::optional<Plugin> plugin;
    if (!options.without_plugin) plugin.emplace(options.scene.plugin);
    const GlfwLibrary library;
    const Window window = open_window(simulation.channel(), "seaglare-host: " + simulation.scene().name);
    // The window shows 8-bit sRGB values, whatever the channel says.
    simulation.channel().target = TargetFormat::rgba8_srgb_values;
    NightScene picture(simulation.scene());
    std::optional<Glare> glare;
    if (plugin)
        glare.emplace(*plugin, simulation.scene(), simulation.channel(), simulation.observer(), window_proc,
                      [](int level, std::string_view text) {
                          if (level >= SEAGLARE_LOG_WARNING) std::cerr << text << "\n";
                      });
    Controls controls(simulation);
    controls.attach(window.get());
    std::cout << help << std::flush;

    std::optional<RenderTarget> target;
    const double start_s = simulation.time_s(), opened_s = glfwGetTime();
    double last_s = opened_s, titled_s = opened_s;
    // A run of a given number of frames is for tests: its clock counts frames, so that it always shows the same.
    const bool counted = options.frames > 0;
    for (int frame = 0; !glfwWindowShouldClose(window.get()) && (!counted || frame < options.frames);
         ++frame) {
        glfwPollEvents();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window.get(), &width, &height);
        if (width < 1 || height < 1) {  // minimised
            glfwWaitEventsTimeout(0.1);
            continue;
        }
        if (!target || target->width_px() != width || target->height_px() != height) {
            simulation.channel().resize(width, height);
            target.emplace(width, height, simulation.channel().target);
        }
        const double now_s = glfwGetTime(), dt = counted ? 1.0 / 60 : now_s - last_s;
        last_s = now_s;
        controls.hold(window.get(), dt);
        simulation.time_of_day_rate = controls.clock_rate();
        if (!controls.paused)
            simulation.go_to(counted ? start_s + (frame + 1) * dt : simulation.time_s() + dt);

        picture.set_moment(simulation.moment());
        const Camera camera = simulation.camera();
        glBindFramebuffer(GL_FRAMEBUFFER, target->multisampled_fbo());
        picture.draw(camera, simulation.channel());
        target->resolve();
        if (glare && controls.glare) {
            glare->move_lights(simulation.time_s());
            const seaglare_result result = glare->render(
                make_frame(simulation, camera, *target, picture.adaptation_luminance_cd_m2(), 1.0 / 60));
            if (result < 0)
                throw PluginError(std::string("rendering: ") + plugin->api().result_string(result) + ": " +
                                  glare->last_error());
        }
        glBindFramebuffer(GL_READ_FRAMEBUFFER, target->fbo());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        const bool last = counted && frame + 1 == options.frames;
        if (controls.screenshot || (last && !options.screenshot.empty())) {
            const std::filesystem::path path =
                options.screenshot.empty() ? "seaglare.png" : options.screenshot;
            write_png(path, width, height, target->read_srgb_rgba8());
            std::cout << "wrote " << path.string() << "\n" << std::flush;
            controls.screenshot = false;
        }
        glfwSwapBuffers(window.get());
        if (now_s - titled_s > 0.5) {
            glfwSetWindowTitle(window.get(), title_of(simulation, controls, dt * 1000).c_str());
            titled_s = now_s;
        }
    }
    return 0;
}

}  // namespace seaglare::host
