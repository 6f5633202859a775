// "seaglare.vessels/1": the lights of COLREG from what a vessel is.
#include "plugin_api/vessels.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lightdb/colreg.h"
#include "plugin_api/border.h"
#include "plugin_api/validate.h"

namespace seaglare::plugin {

namespace {

// The enumerations of the header are those inside.
static_assert(SEAGLARE_VESSEL_AGROUND == static_cast<int>(lightdb::VesselKind::aground));
static_assert(SEAGLARE_VESSEL_SAILING == static_cast<int>(lightdb::VesselKind::sailing));
static_assert(SEAGLARE_VESSEL_AGROUND + 1 == lightdb::vessel_kind_count);
static_assert(SEAGLARE_SIDE_STARBOARD == static_cast<int>(lightdb::Side::starboard));
static_assert(SEAGLARE_FISHING_PURSE_SEINE == static_cast<int>(lightdb::FishingSignal::purse_seine));

constexpr std::uint32_t all_vessel_flags = (SEAGLARE_VESSEL_DAY_OFF << 1) - 1;

Context& required(seaglare_context* context) {
    if (context == nullptr) invalid_argument("context is NULL");
    return context->context;
}

Context* inside(seaglare_context* context) {
    return context == nullptr ? nullptr : &context->context;
}

void check(const seaglare_vessel& vessel) {
    check_flags(vessel.flags, all_vessel_flags, "vessel.flags");
    check_enumerator(vessel.kind, SEAGLARE_VESSEL_AGROUND, "vessel.kind");
    if (vessel.body_id == 0) invalid_argument("vessel.body_id is 0: her lights move with a body");
    const std::pair<double, const char*> numbers[] = {{vessel.length_m, "vessel.length_m"},
                                                      {vessel.breadth_m, "vessel.breadth_m"},
                                                      {vessel.tow_length_m, "vessel.tow_length_m"},
                                                      {vessel.gear_extent_m, "vessel.gear_extent_m"},
                                                      {vessel.gear_bearing_deg, "vessel.gear_bearing_deg"},
                                                      {vessel.deck_lights_cd, "vessel.deck_lights_cd"},
                                                      {vessel.deck_height_m, "vessel.deck_height_m"},
                                                      {vessel.mast_height_m, "vessel.mast_height_m"},
                                                      {vessel.mast_separation_m, "vessel.mast_separation_m"},
                                                      {vessel.intensity_factor, "vessel.intensity_factor"},
                                                      {vessel.radius_m, "vessel.radius_m"}};
    for (const auto& [value, name] : numbers)
        check_finite(value, name);
    check_finite(vessel.amidships_m, 3, "vessel.amidships_m");
    check_enumerator(vessel.obstruction_side, SEAGLARE_SIDE_STARBOARD, "vessel.obstruction_side");
    check_enumerator(vessel.fishing_signal, SEAGLARE_FISHING_PURSE_SEINE, "vessel.fishing_signal");
}

lightdb::Vessel vessel_from(const seaglare_vessel& given, const World& world) {
    const auto has = [&](std::uint32_t flag) { return (given.flags & flag) != 0; };
    lightdb::Vessel vessel;
    vessel.name = given.name == nullptr ? "" : given.name;
    vessel.kind = static_cast<lightdb::VesselKind>(given.kind);
    vessel.length_m = given.length_m;
    vessel.breadth_m = given.breadth_m;
    vessel.body_id = given.body_id;
    vessel.making_way = !has(SEAGLARE_VESSEL_STOPPED);
    vessel.at_anchor = has(SEAGLARE_VESSEL_ANCHORED);
    vessel.tow_length_m = given.tow_length_m;
    vessel.restricted_by_tow = has(SEAGLARE_VESSEL_RESTRICTED_BY_TOW);
    vessel.obstruction_side = static_cast<lightdb::Side>(given.obstruction_side);
    vessel.gear_extent_m = given.gear_extent_m;
    vessel.gear_bearing_deg = given.gear_bearing_deg;
    vessel.fishing_signal = static_cast<lightdb::FishingSignal>(given.fishing_signal);
    vessel.second_masthead = has(SEAGLARE_VESSEL_SECOND_MASTHEAD);
    vessel.all_round_white = has(SEAGLARE_VESSEL_ALL_ROUND_WHITE);
    vessel.no_sidelights = has(SEAGLARE_VESSEL_NO_SIDELIGHTS);
    vessel.combined_sidelights = has(SEAGLARE_VESSEL_COMBINED_SIDELIGHTS);
    vessel.tricolour = has(SEAGLARE_VESSEL_TRICOLOUR);
    vessel.red_over_green = has(SEAGLARE_VESSEL_RED_OVER_GREEN);
    vessel.two_anchor_lights = has(SEAGLARE_VESSEL_TWO_ANCHOR_LIGHTS);
    vessel.day_off = has(SEAGLARE_VESSEL_DAY_OFF);
    if (given.deck_lights_cd != 0) vessel.deck_lights_cd = given.deck_lights_cd;
    vessel.deck_height_m = given.deck_height_m;
    vessel.mast_height_m = given.mast_height_m;
    vessel.mast_separation_m = given.mast_separation_m;
    vessel.amidships_m = world.body_from_host_body(given.amidships_m);
    if (given.intensity_factor != 0) vessel.intensity_factor = given.intensity_factor;
    if (given.radius_m != 0) vessel.radius_m = given.radius_m;
    return vessel;
}

seaglare_result SEAGLARE_CALL add_vessel(seaglare_context* context, const seaglare_vessel* vessel,
                                         seaglare_light_id* ids, uint32_t capacity, uint32_t* out_count) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        if (out_count == nullptr) invalid_argument("out_count is NULL");
        *out_count = 0;
        const seaglare_vessel copy = copy_struct(vessel, "vessel");
        check(copy);
        std::vector<lightdb::Light> lights;
        try {
            lights = lightdb::colreg_lights(vessel_from(copy, owner.world()));
        } catch (const lightdb::VesselError& error) {
            invalid_argument(std::string("vessel: ") + error.what());
        }
        const auto count = static_cast<uint32_t>(lights.size());
        *out_count = count;
        if (ids == nullptr && capacity == 0) return SEAGLARE_OK;
        if (ids == nullptr) invalid_argument("ids is NULL");
        if (capacity < count)
            invalid_argument("capacity is " + std::to_string(capacity) + ": this vessel has " +
                             std::to_string(count) + " lights");
        const std::vector<lightdb::LightId> added = owner.add_lights(std::move(lights));
        std::copy(added.begin(), added.end(), ids);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL remove_vessel(seaglare_context* context, const seaglare_light_id* ids,
                                            uint32_t count) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        if (count == 0) return SEAGLARE_OK;
        if (ids == nullptr) invalid_argument("ids is NULL");
        owner.remove_lights(ids, count);
        return SEAGLARE_OK;
    });
}

}  // namespace

constexpr seaglare_vessels_api vessels_api = {sizeof(seaglare_vessels_api), 0, add_vessel, remove_vessel};

}  // namespace seaglare::plugin
