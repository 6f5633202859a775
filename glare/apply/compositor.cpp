#include "glare/apply/compositor.h"

#include <algorithm>
#include <cmath>

#include "glare/tone/operators.h"

namespace seaglare::glare {

Compositor::Compositor(const Gl& gl)
    : gl_(gl),
      program_(gl, "composite", {"screen.vert.glsl"}, {"tone.glsl", "composite.frag.glsl"}),
      reader_(gl) {
    program_.use();
    program_.set("hdr", 0);
    program_.set("coarse", 1);
    program_.set("background", 2);
}

std::uint32_t Compositor::draw(const Frame& frame, const ToneSettings& tone, const HdrSum& sum,
                               const PixelRect& touched) {
    const int width_px = sum.full.width_px();
    const int height_px = sum.full.height_px();
    const int cell = sum.cell_px;
    const int left = std::clamp(static_cast<int>(std::floor(touched.left)) - cell, 0, width_px);
    const int bottom = std::clamp(static_cast<int>(std::floor(touched.bottom)) - cell, 0, height_px);
    const int right = std::clamp(static_cast<int>(std::ceil(touched.right)) + cell, 0, width_px);
    const int top = std::clamp(static_cast<int>(std::ceil(touched.top)) + cell, 0, height_px);

    program_.use();
    const ToneCurve curve = tone_curve(tone, frame.adaptation_luminance_cd_m2);
    program_.set("tone_scale", curve.scale);
    program_.set("tone_inverse_white2", curve.inverse_white2);
    program_.set("ldr_white", std::max(frame.ldr_white_luminance_cd_m2, 0.0));
    program_.set("blue_shift", tone.blue_shift ? 1 : 0);
    program_.set("difference_mode", tone.mode == CompositeMode::difference ? 1 : 0);
    program_.set("cell_px", static_cast<double>(cell));
    program_.set("hdr_rows", sum.full.first_row(), sum.full.rows());
    program_.set("viewport_origin", frame.viewport_px[0], frame.viewport_px[1]);
    program_.set("encoding", static_cast<int>(frame.target_encoding));
    const bool dither = tone.dither && !target_.floating && target_.red_bits > 0 && target_.red_bits <= 10;
    program_.set("dither_step", dither ? 1 / (std::exp2(target_.red_bits) - 1) : 0.0);
    bind(GL_TEXTURE0, sum.full.texture());
    if (cell > 0) bind(GL_TEXTURE1, sum.coarse.texture());
    gl_.Viewport(frame.viewport_px[0], frame.viewport_px[1], width_px, height_px);
    // Only the colour that fragment output 0 goes to, and no alpha: the host's other buffers are not ours.
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl_.ColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    gl_.Enable(GL_BLEND);
    std::uint32_t draw_calls = 0;
    for (int row = bottom; row < top; row += TargetReader::band_rows) {
        const int rows = std::min(TargetReader::band_rows, top - row);
        reader_.copy_background(frame, target_, left, row, right - left, rows);
        bind(GL_TEXTURE2, reader_.background());
        gl_.BindFramebuffer(GL_FRAMEBUFFER, frame.target_fbo);
        if (frame.target_encoding == TargetEncoding::srgb_format)
            gl_.Enable(GL_FRAMEBUFFER_SRGB);
        else
            gl_.Disable(GL_FRAMEBUFFER_SRGB);
        gl_.Enable(GL_SCISSOR_TEST);
        gl_.Scissor(frame.viewport_px[0] + left, frame.viewport_px[1] + row, right - left, rows);
        program_.set("background_bottom", row);
        gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        ++draw_calls;
    }
    return draw_calls;
}

void Compositor::forget() {
    program_.forget();
    reader_.forget();
}

}  // namespace seaglare::glare
