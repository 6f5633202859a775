#include "glare/apply/depth_model.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace seaglare::glare {

DepthModel depth_model(const Frame& frame) {
    const auto& m = frame.clip_from_view;
    DepthModel model;
    const Vec3 row_z = {m[2], m[6], m[10]};
    model.row_w = {m[3], m[7], m[11]};
    model.z_constant = m[14];
    model.w_constant = m[15];
    if (frame.depth_convention == DepthConvention::logarithmic) {
        model.logarithmic = true;
        model.log_c = frame.depth_log_c;
        model.log_range = std::log(frame.depth_log_c * frame.depth_log_far_m + 1);
        if (!(frame.depth_log_c > 0) || !(model.log_range > 0) || !std::isfinite(model.log_range)) {
            throw std::invalid_argument("depth_log_c and depth_log_far_m must be positive");
        }
        return model;
    }
    const bool standard = frame.depth_convention == DepthConvention::standard;
    model.scale = standard ? 2 : 1;
    // Depth of the infinitely far point: row_z . forward / row_w . forward, near one of -1, 0 and 1.
    const double far_z = std::round(dot(row_z, model.row_w) / dot(model.row_w, model.row_w));
    model.far_z = far_z > 0 ? 1 : (far_z < 0 && standard ? -1 : 0);
    if (standard && model.far_z == 0)
        model.anchor = 0.5;
    else
        model.anchor = model.far_z > 0 ? 1 : 0;
    model.offset = added(scaled(model.row_w, model.far_z), row_z, -1);
    if (!std::isfinite(model.z_constant) || model.z_constant == 0 || !std::isfinite(length(row_z))) {
        throw std::invalid_argument("clip_from_view maps every distance to the same depth");
    }
    return model;
}

double eye_distance_m(const DepthModel& model, double stored, const Vec3& ray) {
    const double w = dot(model.row_w, ray);
    double distance = 0;
    if (model.logarithmic) {
        distance = std::expm1(stored * model.log_range) / model.log_c / w;
    } else {
        const double step = model.scale * (stored - model.anchor);
        distance = (model.z_constant - (model.far_z + step) * model.w_constant) /
                   (step * w + dot(model.offset, ray));
    }
    return distance > 0 && distance < 1e30 ? distance : std::numeric_limits<double>::infinity();
}

}  // namespace seaglare::glare
