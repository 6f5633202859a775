#include "plugin_api/eye_settings.h"

#include <string>

#include "lightdb/json/reader.h"

namespace seaglare::plugin {

namespace {

using json::ObjectReader;

glare::ParticleFamily read_particles(const json::Value& value, const std::string& what) {
    static constexpr json::Choice<glare::ParticleSite> sites[] = {
        {"cornea", glare::ParticleSite::cornea},
        {"lens", glare::ParticleSite::lens},
        {"vitreous", glare::ParticleSite::vitreous}};
    ObjectReader reader(value, what);
    glare::ParticleFamily family;
    family.count = static_cast<int>(reader.integer("count", 0, 100000));
    family.min_diameter_um = reader.number("min_diameter_um", 1, 2000);
    family.max_diameter_um = reader.number("max_diameter_um", 1, 2000);
    if (family.max_diameter_um < family.min_diameter_um)
        throw reader.require("max_diameter_um")
            .error("max_diameter_um is smaller than min_diameter_um in " + what);
    family.exponent = reader.number("exponent", 0, 6, family.exponent);
    family.field_radius_mm = reader.number("field_radius_mm", 0.1, 8, family.field_radius_mm);
    family.drift_um = reader.number("drift_um", 0, 5000, family.drift_um);
    family.drift_period_s = reader.number("drift_period_s", 0.1, 3600, family.drift_period_s);
    family.site = reader.choice("site", sites, family.site);
    reader.finish();
    return family;
}

void read_gratings(ObjectReader& reader, glare::LensGratings& gratings) {
    gratings.count = static_cast<int>(reader.integer("count", 0, 10000, gratings.count));
    gratings.inner_radius_mm = reader.number("inner_radius_mm", 0, 8, gratings.inner_radius_mm);
    gratings.outer_radius_mm = reader.number("outer_radius_mm", 0, 8, gratings.outer_radius_mm);
    if (gratings.outer_radius_mm < gratings.inner_radius_mm)
        throw reader.error("outer_radius_mm is smaller than inner_radius_mm");
    gratings.duty = reader.number("duty", 0, 1, gratings.duty);
    gratings.depth = reader.number("depth", 0, 1, gratings.depth);
}

void read_eyelashes(ObjectReader& reader, glare::Eyelashes& lashes) {
    lashes.count = static_cast<int>(reader.integer("count", 0, 64, lashes.count));
    lashes.mean_angle_deg = reader.number("mean_angle_deg", -60, 60, lashes.mean_angle_deg);
    lashes.spread_deg = reader.number("spread_deg", 0, 60, lashes.spread_deg);
    lashes.width_um = reader.number("width_um", 1, 1000, lashes.width_um);
    lashes.length_mm = reader.number("length_mm", 0.1, 20, lashes.length_mm);
    lashes.curvature_per_mm = reader.number("curvature_per_mm", 0, 1, lashes.curvature_per_mm);
    lashes.seed = static_cast<std::uint64_t>(
        reader.integer("seed", 0, std::int64_t{1} << 53, static_cast<std::int64_t>(lashes.seed)));
    lashes.streak_turn_deg = reader.number("streak_turn_deg", 0, 45, lashes.streak_turn_deg);
    lashes.streak_bend_per_rad = reader.number("streak_bend_per_rad", -5, 5, lashes.streak_bend_per_rad);
}

void read_lids(ObjectReader& reader, glare::Lids& lids) {
    glare::LidMotion& motion = lids.motion;
    lids.closure = reader.number("closure", 0, 1, lids.closure);
    motion.blink_interval_s = reader.number("blink_interval_s", 0, 3600, motion.blink_interval_s);
    motion.blink_duration_s = reader.number("blink_duration_s", 0.01, 10, motion.blink_duration_s);
    motion.squint = reader.number("squint", 0, 1, motion.squint);
    motion.squint_half_cd_m2 = reader.number("squint_half_cd_m2", 1e-6, 1e6, motion.squint_half_cd_m2);
    lids.upper_margin_mm = reader.number("upper_margin_mm", 0, 10, lids.upper_margin_mm);
    lids.lower_margin_mm = reader.number("lower_margin_mm", 0, 10, lids.lower_margin_mm);
    lids.lower_share = reader.number("lower_share", 0, 1, lids.lower_share);
    lids.edge_radius_mm = reader.number("edge_radius_mm", 2, 1e6, lids.edge_radius_mm);
}

void read_accommodation(ObjectReader& reader, glare::EyeModel& eye) {
    glare::AccommodationMotion& motion = eye.accommodation;
    motion.slow_dioptre = reader.number("slow_dioptre", 0, 2, motion.slow_dioptre);
    motion.quick_dioptre = reader.number("quick_dioptre", 0, 2, motion.quick_dioptre);
    motion.lens_strain_per_dioptre =
        reader.number("lens_strain_per_dioptre", 0, 0.1, motion.lens_strain_per_dioptre);
    eye.accommodation_moves_focus = reader.boolean("moves_focus", eye.accommodation_moves_focus);
}

}  // namespace

glare::EyeModel read_eye(const json::Value& value, glare::EyeModel eye) {
    ObjectReader reader(value, "eye");
    reader.optional_string("name");
    reader.optional_string("source");
    eye.age_years = reader.number("age_years", 5, 100, eye.age_years);
    eye.pigmentation = reader.number("pigmentation", 0, 1.2, eye.pigmentation);
    eye.fixed_pupil_mm = reader.number("fixed_pupil_mm", 0, 8.5, eye.fixed_pupil_mm);
    if (eye.fixed_pupil_mm > 0 && eye.fixed_pupil_mm < 1.5)
        throw reader.require("fixed_pupil_mm")
            .error("fixed_pupil_mm is 0 (from the adaptation) or 1.5 to 8.5");
    eye.pupil_shrinks_with_age = reader.boolean("pupil_shrinks_with_age", eye.pupil_shrinks_with_age);
    eye.hippus_amplitude_mm = reader.number("hippus_amplitude_mm", 0, 1, eye.hippus_amplitude_mm);
    eye.hippus_period_s = reader.number("hippus_period_s", 0.05, 600, eye.hippus_period_s);
    eye.cie_tail = reader.boolean("cie_tail", eye.cie_tail);
    static constexpr json::Choice<bool> calibrations[] = {{"none", false}, {"cie_1999", true}};
    eye.cie_calibrated = reader.choice("calibrate", calibrations, eye.cie_calibrated);
    eye.defocus_dioptre = reader.number("defocus_dioptre", -3, 3, eye.defocus_dioptre);
    eye.vitreous_drag_per_s = reader.number("vitreous_drag_per_s", 0, 1000, eye.vitreous_drag_per_s);
    eye.adapts = reader.boolean("adapts", eye.adapts);
    const auto part = [&reader](std::string_view key, auto&& read) {
        auto child = reader.optional_object(key);
        if (!child) return;
        read(*child);
        child->finish();
    };
    part("gratings", [&](ObjectReader& child) { read_gratings(child, eye.gratings); });
    part("eyelashes", [&](ObjectReader& child) { read_eyelashes(child, eye.eyelashes); });
    part("lids", [&](ObjectReader& child) { read_lids(child, eye.lids); });
    part("accommodation", [&](ObjectReader& child) { read_accommodation(child, eye); });
    if (reader.has("particles")) {
        eye.particles.clear();
        for (const json::Value& family : reader.array("particles"))
            eye.particles.push_back(read_particles(family, "particles of the eye"));
    }
    reader.finish();
    return eye;
}

}  // namespace seaglare::plugin
