#include "host_stub/report/billboard_yardstick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "glare/reference/frame_footprint.h"
#include "host_stub/gl_objects.h"
#include "host_stub/report/frame_subject.h"
#include "host_stub/timing.h"

namespace seaglare::report {

namespace {

constexpr int square_px = 512;
constexpr std::size_t few_squares = 16;

constexpr const char* vertex_source = R"(#version 330 core
layout(location = 0) in vec2 place_px;
layout(location = 1) in vec4 illuminance;
layout(location = 2) in float slot;
uniform vec2 target_px;
out vec3 texel;
flat out vec4 colour;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    texel = vec3(corner, slot);
    colour = illuminance;
    // Texel 256 stands on the light.
    vec2 px = place_px + corner * 512.0 - 256.5;
    gl_Position = vec4(px / target_px * 2.0 - 1.0, 0.0, 1.0);
}
)";

constexpr const char* fragment_source = R"(#version 330 core
uniform sampler2DArray pattern;
in vec3 texel;
flat in vec4 colour;
out vec4 glare;
void main() { glare = colour * texture(pattern, texel); }
)";

struct Instance {
    float x, y;
    std::array<float, 4> lux;
    float slot;
};

// The pattern of one lamp around a light on a pixel's middle, on the picture's axis.
std::vector<float> square_of(const reference::GlareShape& shape, const reference::LampShape& lamp) {
    std::vector<float> texels;
    texels.reserve(4UL * square_px * square_px);
    constexpr int middle_px = square_px / 2;
    for (int y = 0; y < square_px; ++y) {
        for (int x = 0; x < square_px; ++x) {
            const double dx = x - middle_px;
            const double dy = y - middle_px;
            const double sine = std::min(std::hypot(dx, dy) * shape.pitch, 1.0);
            const double window = (sine - shape.window_inner) / (shape.window_outer - shape.window_inner);
            const double tail =
                window > 0 && shape.tail_scale > 0
                    ? shape.tail_scale * (0.5 - 0.5 * std::cos(std::numbers::pi * std::min(window, 1.0))) *
                          reference::cie_curve_sr(std::asin(sine) * 180 / std::numbers::pi,
                                                  shape.tail_age_years, shape.tail_pigmentation)
                    : 0;
            const double core =
                reference::footprint(dx) * reference::footprint(dy) / (shape.pitch * shape.pitch);
            reference::Rgbv value{};
            for (const reference::SkirtLevel& level : lamp.levels) {
                const reference::Rgbv part = level.at(dx, dy);
                for (std::size_t c = 0; c < 4; ++c)
                    value[c] += part[c];
            }
            for (std::size_t c = 0; c < 4; ++c)
                texels.push_back(static_cast<float>(value[c] + tail + core * lamp.core[c]));
        }
    }
    return texels;
}

}  // namespace

BillboardRun draw_billboards(const reference::FrameScreen& screen, const reference::GlareShape& shape,
                             std::span<const glare::PointSource> lights, bool half, int frames) {
    std::vector<Instance> instances;
    for (const glare::PointSource& light : lights) {
        const reference::Vector direction = reference::unit({static_cast<double>(light.position_view_m[0]),
                                                             static_cast<double>(light.position_view_m[1]),
                                                             static_cast<double>(light.position_view_m[2])});
        std::array<double, 2> place{};
        if (!screen.place_px(direction, place)) continue;
        instances.push_back({static_cast<float>(place[0]),
                             static_cast<float>(place[1]),
                             {light.illuminance_rgb_lx[0], light.illuminance_rgb_lx[1],
                              light.illuminance_rgb_lx[2], light.illuminance_scotopic_lx},
                             static_cast<float>(shape.shape_of_lamp.at(light.lamp))});
    }
    const GLint format = half ? GL_RGBA16F : GL_RGBA32F;
    const host::GlName pattern = host::make_texture();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_ARRAY, pattern);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, format, square_px, square_px,
                 static_cast<GLsizei>(shape.lamps.size()), 0, GL_RGBA, GL_FLOAT, nullptr);
    for (std::size_t l = 0; l < shape.lamps.size(); ++l)
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(l), square_px, square_px, 1, GL_RGBA,
                        GL_FLOAT, square_of(shape, shape.lamps[l]).data());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

    const host::GlName sum = host::make_texture();
    glBindTexture(GL_TEXTURE_2D, sum);
    glTexImage2D(GL_TEXTURE_2D, 0, format, screen.width_px(), screen.height_px(), 0, GL_RGBA, GL_FLOAT,
                 nullptr);
    const host::GlName framebuffer = host::make_framebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, sum, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw host::GlFailure("the yardstick's framebuffer is not complete");

    const host::GlName program = host::make_program(vertex_source, fragment_source, "billboards");
    const host::GlName buffer = host::make_buffer();
    const host::GlName array = host::make_vertex_array();
    glBindVertexArray(array);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size() * sizeof(Instance)),
                 instances.data(), GL_STATIC_DRAW);
    const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
        glEnableVertexAttribArray(index);
        glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(Instance),
                              reinterpret_cast<const void*>(offset));
        glVertexAttribDivisor(index, 1);
    };
    attribute(0, 2, offsetof(Instance, x));
    attribute(1, 4, offsetof(Instance, lux));
    attribute(2, 1, offsetof(Instance, slot));
    glUseProgram(program);
    glUniform2f(glGetUniformLocation(program, "target_px"), static_cast<float>(screen.width_px()),
                static_cast<float>(screen.height_px()));
    glUniform1i(glGetUniformLocation(program, "pattern"), 0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glViewport(0, 0, screen.width_px(), screen.height_px());

    BillboardRun run;
    for (int i = -1; i < frames; ++i) {
        glFinish();
        const host::Stopwatch watch;
        const double cpu_before = process_cpu_ms();
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        // To compile the shaders a few squares will do.
        const std::size_t drawn = i < 0 ? std::min(instances.size(), few_squares) : instances.size();
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(drawn));
        glFinish();
        if (i < 0) continue;
        run.wall_ms.push_back(watch.ms());
        run.cpu_ms.push_back(process_cpu_ms() - cpu_before);
    }
    run.hdr.resize(4UL * static_cast<std::size_t>(screen.width_px()) *
                   static_cast<std::size_t>(screen.height_px()));
    glReadPixels(0, 0, screen.width_px(), screen.height_px(), GL_RGBA, GL_FLOAT, run.hdr.data());
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_BLEND);
    host::check_gl("drawing the yardstick's billboards");
    return run;
}

}  // namespace seaglare::report
