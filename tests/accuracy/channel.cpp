#include "tests/accuracy/channel.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace seaglare::test {

namespace {

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point unit(const Point& a) {
    const double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

std::string quality_text(const Quality& quality) {
    std::ostringstream text;
    text << std::boolalpha << R"({"pattern": {"transform_size": )" << quality.transform_size
         << R"(}, "eye": {"cie_tail": )" << quality.cie_tail;
    if (!quality.gratings) text << R"(, "gratings": {"count": 0})";
    text << R"(}, "display": {"dither": )" << quality.dither << R"(}, "tone": {"threshold_codes": )"
         << quality.threshold_codes << "}}";
    return text.str();
}

Channel::Channel(const ChannelOptions& options) : options_(options) {
    try {
        gl_ = std::make_unique<HeadlessContext>();
    } catch (const std::exception& error) {
        throw NotHere(error.what());
    }
    const TemporaryFile quality("quality.json", quality_text(options.quality));
    auto info = sized<seaglare_create_info>();
    info.flags = options.create_flags;
    info.origin_latitude_deg = options.origin_latitude_deg;
    info.origin_longitude_deg = options.origin_longitude_deg;
    info.seed = 1;
    info.config_path = quality.path();
    const seaglare_result created = plugin_->create(&info, &context_);
    if (created < 0) throw std::runtime_error("create: " + plugin_.last_error(nullptr));
    if (created == SEAGLARE_DEGRADED && (options.create_flags & SEAGLARE_CREATE_NO_OPENCL) == 0) {
        const std::string why = plugin_.last_error(nullptr);
        plugin_->destroy(context_);
        throw NotHere("no OpenCL: " + why);
    }
    auto view = sized<seaglare_view_info>();
    view.get_proc = &HeadlessContext::get_proc;
    if (plugin_->create_view(context_, &view, &view_) < 0) {
        const std::string why = last_error();
        plugin_->destroy(context_);
        throw std::runtime_error("create_view: " + why);
    }
    const glare::Gl& gl = gl_->gl();
    gl.GenTextures(1, &texture_);
    gl.GenFramebuffers(1, &framebuffer_);
    draw_black();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

Channel::~Channel() {
    gl_->make_current();
    plugin_->destroy_view(view_, 0);
    plugin_->destroy(context_);
}

void Channel::look_along(const Point& direction) {
    forward_ = unit(direction);
    right_ = unit(cross(forward_, {0, 0, 1}));
    up_ = cross(right_, forward_);
}

void Channel::look_at(const Point& p) {
    look_along({p[0] - eye_m_[0], p[1] - eye_m_[1], p[2] - eye_m_[2]});
}

Point Channel::at_px(double x_px, double y_px, double distance_m) const {
    const double x = (x_px - options_.width_px / 2.0) / options_.focal_px;
    const double y = (y_px - options_.height_px / 2.0) / options_.focal_px;
    const double scale = distance_m / std::sqrt(1 + x * x + y * y);
    Point p{};
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = eye_m_[i] + scale * (forward_[i] + x * right_[i] + y * up_[i]);
    return p;
}

bool Channel::in_picture(const Point& direction) const {
    const double ahead = dot(direction, forward_);
    if (ahead <= 0) return false;
    return std::abs(dot(direction, right_)) * options_.focal_px < ahead * options_.width_px / 2 &&
           std::abs(dot(direction, up_)) * options_.focal_px < ahead * options_.height_px / 2;
}

Point Channel::direction_around(double x_px, double y_px, double angle_rad, double azimuth_rad) const {
    const Point there = at_px(x_px, y_px, 1);
    const Point centre = {there[0] - eye_m_[0], there[1] - eye_m_[1], there[2] - eye_m_[2]};
    const Point u = unit(cross(centre, up_));
    const Point v = cross(u, centre);
    Point direction{};
    for (std::size_t i = 0; i < 3; ++i) {
        direction[i] = std::cos(angle_rad) * centre[i] +
                       std::sin(angle_rad) * (std::cos(azimuth_rad) * u[i] + std::sin(azimuth_rad) * v[i]);
    }
    return direction;
}

seaglare_light_id Channel::add(const seaglare_light& light) {
    seaglare_light_id id = 0;
    if (plugin_->add_light(context_, &light, &id) < 0) throw std::runtime_error("add_light: " + last_error());
    return id;
}

seaglare_frame Channel::frame() const {
    auto frame = sized<seaglare_frame>();
    frame.flags = SEAGLARE_FRAME_HAS_ADAPTATION | SEAGLARE_FRAME_WAIT;
    frame.adaptation_luminance_cd_m2 = 0.001;
    frame.target_encoding = SEAGLARE_TARGET_SRGB_VALUES;
    return frame;
}

seaglare_result Channel::render(seaglare_frame frame) {
    gl_->make_current();
    frame.target_fbo = framebuffer_;
    frame.viewport_px[2] = options_.width_px;
    frame.viewport_px[3] = options_.height_px;
    const double near_m = 0.1, far_m = 100000;
    frame.clip_from_view[0] = 2 * options_.focal_px / options_.width_px;
    frame.clip_from_view[5] = 2 * options_.focal_px / options_.height_px;
    frame.clip_from_view[10] = (far_m + near_m) / (near_m - far_m);
    frame.clip_from_view[11] = -1;
    frame.clip_from_view[14] = 2 * far_m * near_m / (near_m - far_m);
    const Point back = {-forward_[0], -forward_[1], -forward_[2]};
    const std::array<const Point*, 3> rows = {&right_, &up_, &back};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            frame.view_from_world[4 * column + row] = (*rows[row])[column];
        frame.view_from_world[12 + row] = -dot(*rows[row], eye_m_);
    }
    frame.view_from_world[15] = 1;
    return plugin_->render(view_, &frame);
}

seaglare_stats Channel::stats() const {
    gl_->make_current();
    auto stats = sized<seaglare_stats>();
    plugin_.extension<seaglare_stats_api>("seaglare.stats/1")->get_stats(view_, &stats);
    return stats;
}

void Channel::draw_background(const std::vector<std::uint8_t>& rgba) {
    gl_->make_current();
    const glare::Gl& gl = gl_->gl();
    gl.BindTexture(GL_TEXTURE_2D, texture_);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, options_.width_px, options_.height_px, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, rgba.data());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.BindTexture(GL_TEXTURE_2D, 0);
}

void Channel::draw_black() {
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(options_.width_px) * options_.height_px * 4, 0);
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        rgba[i] = 255;
    draw_background(rgba);
}

std::vector<std::uint8_t> Channel::picture() const {
    gl_->make_current();
    const glare::Gl& gl = gl_->gl();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(options_.width_px) * options_.height_px * 4);
    gl.ReadPixels(0, 0, options_.width_px, options_.height_px, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return rgba;
}

std::vector<float> Channel::hdr() const {
    gl_->make_current();
    std::vector<float> rgbv(static_cast<std::size_t>(options_.width_px) * options_.height_px * 4);
    std::int32_t size_px[2] = {};
    const auto* api = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
    if (api->read(view_, rgbv.data(), rgbv.size(), size_px) < 0)
        throw std::runtime_error("read: " + last_error());
    return rgbv;
}

Rgbv64 Channel::energy_lx() const {
    const std::vector<float> rgbv = hdr();
    Rgbv64 sum{};
    const double f = options_.focal_px;
    std::size_t i = 0;
    for (int y = 0; y < options_.height_px; ++y) {
        for (int x = 0; x < options_.width_px; ++x, i += 4) {
            const double u = (x + 0.5 - options_.width_px / 2.0) / f;
            const double v = (y + 0.5 - options_.height_px / 2.0) / f;
            const double solid_angle_sr = std::pow(1 + u * u + v * v, -1.5) / (f * f);
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += static_cast<double>(rgbv[i + c]) * solid_angle_sr;
        }
    }
    return sum;
}

seaglare_light white_light(const Point& position_m, double intensity_cd, double radius_m) {
    auto light = sized<seaglare_light>();
    std::copy(position_m.begin(), position_m.end(), light.position_m);
    light.intensity_cd = intensity_cd;
    light.radius_m = radius_m;
    return light;
}

double radius_of_px(double radius_px, double distance_m, double focal_px) {
    return distance_m * std::sin(std::atan(radius_px / focal_px));
}

double luminance_of(const Rgbv64& rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

double distance(const Point& a, const Point& b) {
    return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                     (a[2] - b[2]) * (a[2] - b[2]));
}

std::array<double, 2> sub_pixel(int index) {
    const double x = 0.5 + index * 0.7548776662466927;
    const double y = 0.5 + index * 0.5698402909980532;
    return {x - std::floor(x), y - std::floor(y)};
}

}  // namespace seaglare::test
