#include "host_stub/night_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <string>

#include "host_stub/gl_objects.h"
#include "host_stub/land_mesh.h"
#include "host_stub/night_scene_shaders.h"
#include "host_stub/sky.h"
#include "host_stub/waves.h"

namespace seaglare::host {
namespace {

constexpr double deg = std::numbers::pi / 180;

// Koschmieder: contrast falls to 5 % at the meteorological visibility.
double extinction_per_m(const Scene& scene) {
    return scene.visibility_m ? -std::log(0.05) / *scene.visibility_m : 0;
}

void set(GLuint program, const char* name, float v) {
    glUniform1f(glGetUniformLocation(program, name), v);
}
void set(GLuint program, const char* name, double v) {
    set(program, name, static_cast<float>(v));
}
void set(GLuint program, const char* name, int v) {
    glUniform1i(glGetUniformLocation(program, name), v);
}
void set(GLuint program, const char* name, glm::dvec2 v) {
    glUniform2f(glGetUniformLocation(program, name), static_cast<float>(v.x), static_cast<float>(v.y));
}
void set(GLuint program, const char* name, glm::dvec3 v) {
    glUniform3f(glGetUniformLocation(program, name), static_cast<float>(v.x), static_cast<float>(v.y),
                static_cast<float>(v.z));
}
template <class V>
void set(GLuint program, const std::string& name, int index, V v) {
    set(program, (name + "[" + std::to_string(index) + "]").c_str(), v);
}

// Direct light reddens as its path through the air grows: transmission of clear air per channel, optical
// depths 0.07, 0.12, 0.28 at the zenith (Rayleigh plus a little haze), at unit luminance.
glm::dvec3 colour_through_air(double elevation_deg) {
    const double air_mass = 1 / (std::sin(std::max(elevation_deg, 0.0) * deg) + 0.06);
    const glm::dvec3 c(std::exp(-0.07 * air_mass), std::exp(-0.12 * air_mass), std::exp(-0.28 * air_mass));
    return c / (0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
}

}  // namespace

double exposure_per_cd_m2(double adaptation_cd_m2) {
    const double key = 1.002 - 2 / (2 + std::log10(adaptation_cd_m2 + 1));
    return key / adaptation_cd_m2;
}

struct NightScene::Impl {
    explicit Impl(const Scene& from) : scene(from), sea(make_sea(from.wind_speed_m_s, from.wind_from_deg)) {}

    Scene scene;
    Sea sea;
    Moment moment;
    std::unique_ptr<SkyTable> table;
    SkyConditions conditions;  // of the table
    GlName backdrop, land, sky_texture, no_vertices, land_vertices, vertex_buffer, index_buffer;
    GLsizei index_count = 0;

    SkyConditions conditions_at(const Moment& m) const {
        SkyConditions c;
        const double hours = m.local_time_h - scene.local_time_h;
        c.sun = after_hours(scene.sky.sun, scene.origin.latitude_deg, hours);
        if (scene.sky.moon) c.moon = after_hours(*scene.sky.moon, scene.origin.latitude_deg, hours);
        c.moon_phase_angle_deg = std::acos(std::clamp(2 * scene.sky.moon_illuminated - 1, -1.0, 1.0)) / deg;
        c.night_luminance_cd_m2 = scene.sky.night_luminance_cd_m2;
        for (const Town& t : scene.towns)
            c.towns.push_back(
                {bearing_deg(t.position_m - m.position_m), t.luminance_cd_m2, t.width_deg, t.height_deg});
        return c;
    }

    bool moved_enough(const SkyConditions& c) const {
        constexpr double enough_deg = 0.02;
        const auto far = [&](SkyDirection a, SkyDirection b) {
            return std::abs(a.elevation_deg - b.elevation_deg) > enough_deg ||
                   std::abs(std::remainder(a.azimuth_deg - b.azimuth_deg, 360)) > enough_deg;
        };
        if (!table || far(c.sun, conditions.sun) || (c.moon && far(*c.moon, *conditions.moon))) return true;
        for (std::size_t i = 0; i < c.towns.size(); ++i)
            if (std::abs(std::remainder(c.towns[i].azimuth_deg - conditions.towns[i].azimuth_deg, 360)) > 0.1)
                return true;
        return false;
    }

    double adaptation() const {
        if (scene.adaptation_cd_m2) return *scene.adaptation_cd_m2;
        return std::max(table->adaptation_luminance_cd_m2(), 1e-4);
    }

    void set_light(GLuint program, TargetFormat target) const {
        const double la = adaptation();
        set(program, "u_exposure", exposure_per_cd_m2(la));
        set(program, "u_rods", 0.04 / (0.04 + la));
        set(program, "u_target", static_cast<int>(target));
        set(program, "u_sky", 0);
        set(program, "u_sky_size", glm::dvec2(SkyTable::azimuths, SkyTable::elevations));
        set(program, "u_extinction_per_m", extinction_per_m(scene));
        set(program, "u_dome_lx", table->illuminance_lx());
        const Luminary* bodies[] = {&table->sun(), &table->moon()};
        for (int i = 0; i < 2; ++i) {
            set(program, "u_luminary", i, unit_vector(bodies[i]->direction));
            set(program, "u_luminary_light", i,
                glm::dvec2(bodies[i]->disc_luminance_cd_m2, bodies[i]->normal_illuminance_lx));
            set(program, "u_luminary_colour", i, colour_through_air(bodies[i]->direction.elevation_deg));
        }
    }

    void draw_backdrop(const Camera& camera, const Channel& channel) const {
        glUseProgram(backdrop);
        set_light(backdrop, channel.target);
        // Rays are linear in the pixel before they are normalised.
        const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(camera.view_from_world));
        const glm::dmat4& p = camera.clip_from_view;
        const auto ray = [&](double column, double row) {
            const double x = 2 * column / channel.width_px - 1, y = 2 * row / channel.height_px - 1;
            return world_from_view * glm::dvec3((x + p[2][0]) / p[0][0], (y + p[2][1]) / p[1][1], -1);
        };
        set(backdrop, "u_ray_origin", ray(0, 0));
        set(backdrop, "u_ray_x", ray(1, 0) - ray(0, 0));
        set(backdrop, "u_ray_y", ray(0, 1) - ray(0, 0));
        set(backdrop, "u_ahead", world_from_view * glm::dvec3(0, 0, -1));
        set(backdrop, "u_depth_terms", glm::dvec2(p[2][2], p[3][2]));
        set(backdrop, "u_eye_height_m", camera.eye_m.z);
        set(backdrop, "u_far_m", Camera::far_m);
        set(backdrop, "u_pixel_rad", 2 / (channel.height_px * p[1][1]));
        set(backdrop, "u_slope_variance", sea.slope_variance);
        for (int i = 0; i < wave_count; ++i) {
            const Wave& w = sea.waves[static_cast<std::size_t>(i)];
            // The phase at the eye in double: a float of position or time would make the sea stutter.
            const double phase = w.phase_rad + w.wave_vector_rad_m.x * camera.eye_m.x +
                                 w.wave_vector_rad_m.y * camera.eye_m.y - w.frequency_rad_s * moment.time_s;
            glUniform4f(glGetUniformLocation(backdrop, ("u_wave[" + std::to_string(i) + "]").c_str()),
                        static_cast<float>(w.wave_vector_rad_m.x), static_cast<float>(w.wave_vector_rad_m.y),
                        static_cast<float>(w.slope),
                        static_cast<float>(std::remainder(phase, 2 * std::numbers::pi)));
        }
        set(backdrop, "u_moon_lit_from", unit_vector(table->sun().direction));
        // Stars turn with the hours about the pole.
        const auto turned = [&](SkyDirection d) {
            return unit_vector(after_hours(d, scene.origin.latitude_deg, -moment.local_time_h));
        };
        const glm::dmat3 stars(turned({0, 90}), turned({0, 0}), turned({90, 0}));
        const glm::mat3 stars_f(stars);
        glUniformMatrix3fv(glGetUniformLocation(backdrop, "u_stars_from_world"), 1, GL_FALSE,
                           glm::value_ptr(stars_f));
        set(backdrop, "u_star_gain", scene.sky.stars ? 1.0 : 0.0);
        glBindVertexArray(no_vertices);
        glDepthFunc(GL_ALWAYS);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    void draw_land(const Camera& camera, const Channel& channel) const {
        if (index_count == 0) return;
        glUseProgram(land);
        set_light(land, channel.target);
        const glm::mat4 clip_from_offset(camera.clip_from_view *
                                         glm::dmat4(glm::dmat3(camera.view_from_world)));
        glUniformMatrix4fv(glGetUniformLocation(land, "u_clip_from_offset"), 1, GL_FALSE,
                           glm::value_ptr(clip_from_offset));
        set(land, "u_eye_m", camera.eye_m);
        const auto up = table->radiance({60, 0});
        const double y = table->luminance({60, 0});
        set(land, "u_dome_colour", glm::dvec3(up[0], up[1], up[2]) / y);
        glBindVertexArray(land_vertices);
        glDepthFunc(GL_LESS);
        glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
    }
};

NightScene::NightScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {
    Impl& s = *impl_;
    s.backdrop = make_program(backdrop_vertex_shader(), backdrop_fragment_shader(), "sky and sea");
    s.land = make_program(land_vertex_shader(), land_fragment_shader(), "land");
    s.sky_texture = make_texture();
    s.no_vertices = make_vertex_array();

    const LandMesh mesh = make_land(scene);
    s.index_count = static_cast<GLsizei>(mesh.indices.size());
    s.land_vertices = make_vertex_array();
    s.vertex_buffer = make_buffer();
    s.index_buffer = make_buffer();
    glBindVertexArray(s.land_vertices);
    glBindBuffer(GL_ARRAY_BUFFER, s.vertex_buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(LandVertex)),
                 mesh.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, s.index_buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LandVertex), nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, sizeof(LandVertex),
                          reinterpret_cast<const void*>(offsetof(LandVertex, albedo)));
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    check_gl("making the night scene");
    set_moment({scene.start_s, scene.local_time_h, scene.observers.front().position_m});
}

NightScene::~NightScene() = default;

void NightScene::set_moment(const Moment& moment) {
    Impl& s = *impl_;
    s.moment = moment;
    const SkyConditions conditions = s.conditions_at(moment);
    if (!s.moved_enough(conditions)) return;
    s.conditions = conditions;
    s.table = std::make_unique<SkyTable>(conditions);
    glBindTexture(GL_TEXTURE_2D, s.sky_texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, SkyTable::azimuths, SkyTable::elevations, 0, GL_RGB, GL_FLOAT,
                 s.table->texels().data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
}

double NightScene::adaptation_luminance_cd_m2() const {
    return impl_->adaptation();
}
double NightScene::sun_elevation_deg() const {
    return impl_->conditions.sun.elevation_deg;
}
double NightScene::moon_elevation_deg() const {
    return impl_->conditions.moon ? impl_->conditions.moon->elevation_deg : -90;
}

void NightScene::draw(const Camera& camera, const Channel& channel) {
    const Impl& s = *impl_;
    glViewport(0, 0, channel.width_px, channel.height_px);
    glClearColor(0, 0, 0, 1);
    glClearDepth(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    if (channel.target == TargetFormat::srgb8_alpha8) glEnable(GL_FRAMEBUFFER_SRGB);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, s.sky_texture);
    s.draw_backdrop(camera, channel);
    s.draw_land(camera, channel);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace seaglare::host
