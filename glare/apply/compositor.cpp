#include "glare/apply/compositor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "glare/tone/operators.h"

namespace seaglare::glare {

Compositor::Compositor(const Gl& gl) : gl_(gl), reader_(gl) {
    compile(codes);
}

// With and without a grid at once: a plan may change from one to the other in any frame.
void Compositor::compile(Adds adds) {
    const auto program = [&](bool grid) {
        const std::string defines =
            "#define ADDS " + std::to_string(adds) + "\n#define GRID " + (grid ? "1\n" : "0\n");
        GlProgram made(gl_, "composite", {"screen.vert.glsl"}, {"tone.glsl", "composite.frag.glsl"}, defines);
        made.use();
        made.set("hdr", 0);
        made.set("coarse", 3);
        made.set("background", 2);
        return made;
    };
    programs_.at(adds) = Programs{program(false), program(true)};
}

void Compositor::begin(const Frame& frame) {
    target_ = reader_.inspect(frame);
    const bool coarse_codes = !target_.floating && target_.red_bits > 0 && target_.red_bits <= 10;
    code_ = coarse_codes ? 1 / (std::exp2(target_.red_bits) - 1) : 0.0;
    if (frame.target_encoding == TargetEncoding::srgb_values)
        adds_ = codes;
    else if (frame.target_encoding == TargetEncoding::srgb_format && coarse_codes)
        adds_ = dithered_light;
    else
        adds_ = light;
    if (!programs_.at(adds_)) compile(adds_);
}

PixelBox box_of(const PixelRect& touched, int cell_px, int width_px, int height_px) {
    const auto clamped = [](double px, int margin, int most) {
        return std::clamp(static_cast<int>(px) + margin, 0, most);
    };
    return {clamped(std::floor(touched.left), -cell_px, width_px),
            clamped(std::floor(touched.bottom), -cell_px, height_px),
            clamped(std::ceil(touched.right), cell_px, width_px),
            clamped(std::ceil(touched.top), cell_px, height_px)};
}

void Compositor::draw(const Frame& frame, const ToneSettings& tone, const HdrSum& sum, const PixelBox& box) {
    const int width = box.right - box.left;
    const int rows = box.top - box.bottom;
    const GlProgram& program = programs_.at(adds_)->at(sum.cell_px() > 0 ? 1 : 0);
    program.use();
    const ToneCurve curve = tone_curve(tone, frame.adaptation_luminance_cd_m2);
    program.set("tone_scale", curve.scale);
    program.set("tone_inverse_white2", curve.inverse_white2);
    program.set("ldr_white", curve.scale * std::max(frame.ldr_white_luminance_cd_m2, 0.0));
    program.set("rod_light", tone.blue_shift ? curve.scale * half_rods_cd_m2 : 0.0);
    program.set("difference", tone.mode == CompositeMode::difference ? 1.0 : 0.0);
    program.set("cell_px", static_cast<double>(sum.cell_px()));
    program.set("hdr_first_row", sum.band().first_row());
    program.set("background_bottom", box.bottom);
    program.set("viewport_origin", frame.viewport_px[0], frame.viewport_px[1]);
    program.set("dither_step", tone.dither ? code_ : 0.0);
    reader_.copy_background(frame, target_, box.left, box.bottom, width, rows);
    bind(GL_TEXTURE0, sum.band().texture());
    if (sum.cell_px() > 0) bind(GL_TEXTURE3, sum.grid().texture());
    bind(GL_TEXTURE2, reader_.background());
    gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.target_fbo);
    gl_.Viewport(frame.viewport_px[0], frame.viewport_px[1], sum.band().width_px(), sum.band().height_px());
    // Only the colour that fragment output 0 goes to, and no alpha: the host's other buffers are not ours.
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl_.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    gl_.Enable(GL_BLEND);
    if (frame.target_encoding == TargetEncoding::srgb_format)
        gl_.Enable(GL_FRAMEBUFFER_SRGB);
    else
        gl_.Disable(GL_FRAMEBUFFER_SRGB);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(frame.viewport_px[0] + box.left, frame.viewport_px[1] + box.bottom, width, rows);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Compositor::forget() {
    for (std::optional<Programs>& programs : programs_) {
        if (!programs) continue;
        for (GlProgram& program : *programs)
            program.forget();
    }
    reader_.forget();
}

}  // namespace seaglare::glare
