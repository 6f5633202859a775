#include "glare/apply/compositor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "glare/tone/operators.h"

namespace seaglare::glare {

namespace {

constexpr std::size_t boxes_per_draw = 64;  // as in shaders/composite.vert.glsl
// With the dither, which moves what is added by less than itself, still less than half a code.
constexpr double unseen_part_of_code = 0.25;
constexpr double srgb_slope_at_black = 12.92;

PixelBox hull_of(const PixelBox& a, const PixelBox& b) {
    return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
            std::max(a.top, b.top)};
}

}  // namespace

Compositor::Compositor(const Gl& gl) : gl_(gl), reader_(gl) {
    compile(codes);
}

// With and without a grid at once: a plan may change from one to the other in any frame.
void Compositor::compile(Adds adds) {
    const auto program = [&](bool grid) {
        const std::string defines =
            "#define ADDS " + std::to_string(adds) + "\n#define GRID " + (grid ? "1\n" : "0\n");
        GlProgram made(gl_, "composite", {"composite.vert.glsl"}, {"tone.glsl", "composite.frag.glsl"},
                       defines);
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
    code_ = target_.floating || target_.red_bits <= 0 ? 0.0 : 1 / (std::exp2(target_.red_bits) - 1);
    if (frame.target_encoding == TargetEncoding::srgb_values)
        adds_ = codes;
    else if (frame.target_encoding == TargetEncoding::srgb_format && code_ > 0)
        adds_ = dithered_light;
    else
        adds_ = light;
    if (!programs_.at(adds_)) compile(adds_);
}

double Compositor::least_cd_m2(const Frame& frame, const ToneSettings& tone) const {
    // Below 1 of relative luminance the ratio of the curve to its argument grows: another's light would bring out the host's.
    if (tone.white < 1) return 0;
    const double least =
        threshold_luminance_cd_m2(tone, frame.adaptation_luminance_cd_m2, unseen_part_of_code * 255 * code_);
    return frame.target_encoding == TargetEncoding::linear ? least * srgb_slope_at_black : least;
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

std::uint32_t Compositor::draw(const Frame& frame, const ToneSettings& tone, HdrSum& sum,
                               const PixelBox& within) {
    const std::span<const PixelBox> boxes = sum.tiles().boxes_in(within);
    if (boxes.empty()) return 0;
    PixelBox box = boxes.front();
    for (const PixelBox& other : boxes)
        box = hull_of(box, other);
    const GlProgram& program = programs_.at(adds_)->at(sum.lit_cell_px() > 0 ? 1 : 0);
    program.use();
    const ToneCurve curve = tone_curve(tone, frame.adaptation_luminance_cd_m2);
    program.set("tone_scale", curve.scale);
    program.set("tone_inverse_white2", curve.inverse_white2);
    program.set("ldr_white", curve.scale * std::max(frame.ldr_white_luminance_cd_m2, 0.0));
    program.set("rod_light", tone.blue_shift ? curve.scale * half_rods_cd_m2 : 0.0);
    program.set("difference", tone.mode == CompositeMode::difference ? 1.0 : 0.0);
    program.set("cell_px", static_cast<double>(sum.lit_cell_px()));
    program.set("hdr_first_row", sum.band().first_row());
    program.set("background_bottom", box.bottom);
    program.set("viewport_origin", frame.viewport_px[0], frame.viewport_px[1]);
    program.set("dither_step", tone.dither && target_.red_bits <= 10 ? code_ : 0.0);
    reader_.copy_background(frame, target_, box.left, box.bottom, box.width(), box.height());
    bind(GL_TEXTURE0, sum.band().texture());
    if (sum.lit_cell_px() > 0) bind(GL_TEXTURE3, sum.grid().texture());
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
    const std::uint32_t draws = draw_boxes(program, sum.band().width_px(), sum.band().height_px(), boxes);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    return draws;
}

std::uint32_t Compositor::draw_boxes(const GlProgram& program, int width_px, int height_px,
                                     std::span<const PixelBox> boxes) const {
    std::array<std::array<float, 4>, boxes_per_draw> corners{};
    std::uint32_t draws = 0;
    for (std::size_t first = 0; first < boxes.size(); first += boxes_per_draw) {
        const std::size_t count = std::min(boxes_per_draw, boxes.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const PixelBox& box = boxes[first + i];
            const auto ndc = [](int px, int size_px) { return static_cast<float>(2.0 * px / size_px - 1); };
            corners[i] = {ndc(box.left, width_px), ndc(box.bottom, height_px), ndc(box.right, width_px),
                          ndc(box.top, height_px)};
        }
        program.set("boxes", std::span<const std::array<float, 4>>(corners).first(count));
        gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * count));
        ++draws;
    }
    return draws;
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
