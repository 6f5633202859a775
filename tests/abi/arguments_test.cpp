// What a host may hand in by mistake: each mistake has its code, its words and no effect.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class Arguments : public ::testing::Test {
  protected:
    std::vector<seaglare_light_id> ids() const {
        std::uint32_t count = 0;
        EXPECT_EQ(plugin_->list_lights(context_, nullptr, 0, &count), SEAGLARE_OK);
        std::vector<seaglare_light_id> all(count);
        EXPECT_EQ(plugin_->list_lights(context_, all.data(), count, &count), SEAGLARE_OK);
        return all;
    }
    seaglare_light_id add(double east_m = 0) const {
        auto light = sized<seaglare_light>();
        light.position_m[0] = east_m;
        light.position_m[1] = 1000;
        light.intensity_cd = 100;
        seaglare_light_id id = 0;
        EXPECT_EQ(plugin_->add_light(context_, &light, &id), SEAGLARE_OK) << plugin_.last_error(context_);
        return id;
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
};

TEST(GetApi, RefusesAnotherMajorAndLeavesTheTableAlone) {
    const LoadedPlugin plugin;
    seaglare_api api;
    std::memset(&api, 0x5A, sizeof api);
    api.struct_size = sizeof api;
    const seaglare_api before = api;
    EXPECT_EQ(plugin.get_api()(SEAGLARE_ABI_MAJOR + 1, &api), SEAGLARE_ERROR_VERSION);
    EXPECT_EQ(std::memcmp(&api, &before, sizeof api), 0);
}

TEST(GetApi, FillsNoFieldThatAnOlderCallerDoesNotHave) {
    const LoadedPlugin plugin;
    seaglare_api api;
    std::memset(&api, 0x5A, sizeof api);
    api.struct_size = offsetof(seaglare_api, render);
    EXPECT_EQ(plugin.get_api()(SEAGLARE_ABI_MAJOR, &api), SEAGLARE_OK);
    EXPECT_EQ(api.struct_size, offsetof(seaglare_api, render));
    seaglare_api untouched;
    std::memset(&untouched, 0x5A, sizeof untouched);
    EXPECT_EQ(std::memcmp(&api.render, &untouched.render, sizeof api - offsetof(seaglare_api, render)), 0);
    EXPECT_NE(api.create, nullptr);
}

TEST(GetApi, RefusesNullAndImpossibleSizes) {
    const LoadedPlugin plugin;
    EXPECT_EQ(plugin.get_api()(SEAGLARE_ABI_MAJOR, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    seaglare_api api{};
    for (const std::uint32_t size : {0U, 4U, 151U, 160U, 0xFFFFFFFFU}) {
        api.struct_size = size;
        EXPECT_EQ(plugin.get_api()(SEAGLARE_ABI_MAJOR, &api), SEAGLARE_ERROR_STRUCT_SIZE) << size;
    }
}

TEST_F(Arguments, NullIsRefusedEverywhere) {
    auto info = sized<seaglare_create_info>();
    seaglare_context* context = nullptr;
    EXPECT_EQ(plugin_->create(nullptr, &context), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->create(&info, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    auto view_info = sized<seaglare_view_info>();
    seaglare_view* view = nullptr;
    EXPECT_EQ(plugin_->create_view(nullptr, &view_info, &view), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->create_view(context_, nullptr, &view), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->create_view(context_, &view_info, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->create_view(context_, &view_info, &view), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_.last_error(context_), "view_info.get_proc is NULL");
    EXPECT_EQ(plugin_->load_config(nullptr, "x"), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->load_config(context_, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->load_lights(nullptr, "x"), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->load_lights(context_, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->clear_lights(nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    auto light = sized<seaglare_light>();
    EXPECT_EQ(plugin_->add_light(nullptr, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->add_light(context_, nullptr, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->update_lights(nullptr, nullptr, 0, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->update_lights(context_, nullptr, 1, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->remove_light(nullptr, 1), SEAGLARE_ERROR_INVALID_ARGUMENT);
    const double position[3] = {0, 0, 0};
    const double upright[4] = {0, 0, 0, 1};
    EXPECT_EQ(plugin_->set_body_pose(nullptr, 1, position, upright), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_body_pose(context_, 1, nullptr, upright), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_body_pose(context_, 1, position, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    std::uint32_t count = 0;
    EXPECT_EQ(plugin_->list_lights(nullptr, nullptr, 0, &count), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->list_lights(context_, nullptr, 0, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    auto state = sized<seaglare_eye_state>();
    EXPECT_EQ(plugin_->get_eye_state(nullptr, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->get_eye_state(context_, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_eye_state(nullptr, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_eye_state(context_, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    const seaglare_frame frame = looking_north(64, 64);
    EXPECT_EQ(plugin_->render(nullptr, &frame), SEAGLARE_ERROR_INVALID_ARGUMENT);
    char buffer[8];
    EXPECT_EQ(plugin_->copy_last_error(context_, nullptr, 8), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->copy_last_error(context_, buffer, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->get_extension(nullptr), nullptr);
    EXPECT_EQ(plugin_->get_extension("seaglare.unheard_of/1"), nullptr);
    const auto* stats = plugin_.extension<seaglare_stats_api>("seaglare.stats/1");
    const auto* hdr = plugin_.extension<seaglare_hdr_api>("seaglare.hdr/1");
    ASSERT_NE(stats, nullptr);
    ASSERT_NE(hdr, nullptr);
    EXPECT_EQ(stats->get_stats(nullptr, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(stats->copy_plan(nullptr, buffer, 8, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(hdr->read(nullptr, nullptr, 0, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

TEST_F(Arguments, NullIsNothingToDestroy) {
    EXPECT_EQ(plugin_->destroy(nullptr), SEAGLARE_OK);
    EXPECT_EQ(plugin_->destroy_view(nullptr, 0), SEAGLARE_OK);
}

TEST_F(Arguments, AFailedCreateLeavesNoPointerBehind) {
    seaglare_create_info info{};
    auto* context = reinterpret_cast<seaglare_context*>(&info);
    EXPECT_EQ(plugin_->create(&info, &context), SEAGLARE_ERROR_STRUCT_SIZE);
    EXPECT_EQ(context, nullptr);
    EXPECT_NE(plugin_.last_error(nullptr).find("create_info.struct_size is 0"), std::string::npos);
}

TEST_F(Arguments, OnlyStructSizesOfThisStructAreTaken) {
    auto light = sized<seaglare_light>();
    for (const std::uint32_t size : {0U, 3U, 4U, 7U, 78U, 81U, 84U, 92U, 392U, 0xFFFFFFFFU}) {
        light.struct_size = size;
        EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_STRUCT_SIZE) << size;
    }
    EXPECT_EQ(ids().size(), 0U);
}

TEST_F(Arguments, AnOlderCallersStructIsReadNoFurtherThanItsSize) {
    // What lies behind the older struct is not the library's: here it would be a wild name and a wrong colour.
    auto light = sized<seaglare_light>();
    light.struct_size = offsetof(seaglare_light, character);
    light.intensity_cd = 10;
    light.character = reinterpret_cast<const char*>(std::uintptr_t{8});
    light.name = reinterpret_cast<const char*>(std::uintptr_t{16});
    light.colour = 99;
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK);
    // The struct of a caller from before lamps had names.
    light = sized<seaglare_light>();
    light.struct_size = 80;
    light.intensity_cd = 10;
    light.spectrum = reinterpret_cast<const char*>(std::uintptr_t{8});
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK);
    EXPECT_EQ(ids().size(), 2U);
}

TEST_F(Arguments, AStateIsWrittenNoFurtherThanItsSize) {
    auto state = sized<seaglare_eye_state>();
    state.time_s = 123;
    state.struct_size = offsetof(seaglare_eye_state, time_s);
    EXPECT_EQ(plugin_->get_eye_state(context_, &state), SEAGLARE_OK);
    EXPECT_EQ(state.time_s, 123);
    EXPECT_EQ(state.struct_size, offsetof(seaglare_eye_state, time_s));
    EXPECT_GT(state.adaptation_luminance_cd_m2, 0);
}

TEST_F(Arguments, UnknownFlagsAndEnumeratorsAreRefused) {
    seaglare_context* context = nullptr;
    auto info = sized<seaglare_create_info>();
    info.flags = 1U << 31;
    EXPECT_EQ(plugin_->create(&info, &context), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_.last_error(nullptr), "create_info.flags has unknown bits 0x80000000");
    info = sized<seaglare_create_info>();
    info.axes = 5;
    EXPECT_EQ(plugin_->create(&info, &context), SEAGLARE_ERROR_INVALID_ARGUMENT);
    info.axes = -1;
    EXPECT_EQ(plugin_->create(&info, &context), SEAGLARE_ERROR_INVALID_ARGUMENT);
    auto light = sized<seaglare_light>();
    light.colour = SEAGLARE_COLOUR_VIOLET + 1;
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_.last_error(context_), "light.colour is 7: it must be 0 to 6");
}

TEST_F(Arguments, ALightWithANumberThatIsNoneIsRefusedByName) {
    const auto refuse = [&](auto set, const char* field) {
        for (const double bad : {nan, infinity, -infinity}) {
            auto light = sized<seaglare_light>();
            light.intensity_cd = 1;
            set(light, bad);
            EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT)
                << field;
            EXPECT_EQ(plugin_.last_error(context_).rfind(field, 0), 0U) << plugin_.last_error(context_);
        }
    };
    refuse([](seaglare_light& light, double bad) { light.position_m[1] = bad; }, "light.position_m[1]");
    refuse([](seaglare_light& light, double bad) { light.intensity_cd = bad; }, "light.intensity_cd");
    refuse([](seaglare_light& light, double bad) { light.nominal_range_nm = bad; }, "light.nominal_range_nm");
    refuse([](seaglare_light& light, double bad) { light.radius_m = bad; }, "light.radius_m");
    EXPECT_TRUE(ids().empty());
}

TEST_F(Arguments, AnUnreadableCharacterIsRefusedInWords) {
    auto light = sized<seaglare_light>();
    light.intensity_cd = 1;
    light.character = "Blinking merrily";
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_.last_error(context_).rfind("light.character \"Blinking merrily\"", 0), 0U)
        << plugin_.last_error(context_);
    light.character = "Fl(2) 10s";
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK) << plugin_.last_error(context_);
}

TEST_F(Arguments, ASpectrumIsTheNameOfALampAndAnUnknownOneIsRefusedWithWhatWasPerhapsMeant) {
    auto light = sized<seaglare_light>();
    light.intensity_cd = 1;
    for (const char* name : {"led_white", "tungsten", "planck:2700", "d65", "led_red", ""}) {
        light.spectrum = name;
        EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK) << plugin_.last_error(context_);
    }
    const std::size_t lights = ids().size();
    EXPECT_EQ(lights, 6U);
    const auto refused = [&](const char* name) {
        light.spectrum = name;
        EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT) << name;
        return plugin_.last_error(context_);
    };
    EXPECT_EQ(refused("led_whit"), "light.spectrum: unknown spectrum 'led_whit', did you mean 'led_white'?");
    EXPECT_NE(refused("planck:99").find("1000 to 25000 K"), std::string::npos);
    EXPECT_NE(refused("zzzzzzzz").find("d65, a, e, tungsten"), std::string::npos);
    EXPECT_NE(refused("lamp.spdx").find("is a file"), std::string::npos);
    // Several colours by one lamp: behind glasses; there is none for violet.
    light.character = "Al WR 4s";
    light.spectrum = "a";
    EXPECT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_OK) << plugin_.last_error(context_);
    EXPECT_EQ(ids().size(), lights + 1);
}

TEST_F(Arguments, AStaleIdIsRefusedAlsoWhenItsPlaceIsTakenAgain) {
    const seaglare_light_id first = add();
    EXPECT_EQ(plugin_->remove_light(context_, first), SEAGLARE_OK);
    EXPECT_EQ(plugin_->remove_light(context_, first), SEAGLARE_ERROR_STALE_ID);
    const seaglare_light_id second = add();
    EXPECT_NE(first, second);
    EXPECT_EQ(plugin_->remove_light(context_, first), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(plugin_->remove_light(context_, 0), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(plugin_->remove_light(context_, ~seaglare_light_id{0}), SEAGLARE_ERROR_STALE_ID);
    EXPECT_EQ(ids(), std::vector<seaglare_light_id>{second});
    EXPECT_EQ(plugin_->clear_lights(context_), SEAGLARE_OK);
    EXPECT_EQ(plugin_->remove_light(context_, second), SEAGLARE_ERROR_STALE_ID);
}

TEST_F(Arguments, UpdatesMayStandApartByAStride) {
    struct HostsOwn {
        seaglare_light_update update;
        double more[5];
    };
    std::vector<HostsOwn> entries(3);
    for (HostsOwn& entry : entries) {
        entry.update = sized<seaglare_light_update>();
        entry.update.id = add();
        entry.update.set = SEAGLARE_SET_ON;
        for (double& value : entry.more)
            value = nan;
    }
    EXPECT_EQ(plugin_->update_lights(context_, &entries[0].update, 3, sizeof(HostsOwn)), SEAGLARE_OK)
        << plugin_.last_error(context_);
    EXPECT_EQ(plugin_->update_lights(context_, &entries[0].update, 3, 8), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->update_lights(context_, &entries[0].update, 0, 0), SEAGLARE_OK);
}

TEST_F(Arguments, ABadUpdateNamesItsEntryAndField) {
    std::array<seaglare_light_update, 2> updates = {sized<seaglare_light_update>(),
                                                    sized<seaglare_light_update>()};
    updates[0].id = add();
    updates[1].id = add();
    updates[1].set = SEAGLARE_SET_POSITION;
    updates[1].position_m[2] = nan;
    EXPECT_EQ(plugin_->update_lights(context_, updates.data(), 2, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_.last_error(context_), "updates[1].position_m[2] is not a number");
    updates[1].set = SEAGLARE_SET_ORIENTATION;  // all zero
    EXPECT_EQ(plugin_->update_lights(context_, updates.data(), 2, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    updates[1].set = SEAGLARE_SET_VISIBILITY;
    updates[1].visibility = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(plugin_->update_lights(context_, updates.data(), 2, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    updates[1].set = 1U << 20;
    EXPECT_EQ(plugin_->update_lights(context_, updates.data(), 2, 0), SEAGLARE_ERROR_INVALID_ARGUMENT);
    updates[1].set = 0;
    updates[1].id = 0;
    EXPECT_EQ(plugin_->update_lights(context_, updates.data(), 2, 0), SEAGLARE_ERROR_STALE_ID);
}

TEST_F(Arguments, ABodyNeedsANumberAPlaceAndAnAttitude) {
    const double position[3] = {0, 0, 0}, upright[4] = {0, 0, 0, 1}, zero[4] = {0, 0, 0, 0},
                 lost[3] = {0, nan, 0};
    EXPECT_EQ(plugin_->set_body_pose(context_, 7, position, upright), SEAGLARE_OK);
    EXPECT_EQ(plugin_->set_body_pose(context_, 0, position, upright), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_body_pose(context_, 7, lost, upright), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(plugin_->set_body_pose(context_, 7, position, zero), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

TEST_F(Arguments, TheEyeStateComesBackAsItWasSet) {
    auto state = sized<seaglare_eye_state>();
    state.adaptation_luminance_cd_m2 = 0.25;
    state.time_s = 42;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    auto read = sized<seaglare_eye_state>();
    EXPECT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(read.adaptation_luminance_cd_m2, 0.25);
    EXPECT_EQ(read.time_s, 42);
    state.adaptation_luminance_cd_m2 = nan;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

// Whether it is day is handed on, too; a host whose struct ends before it keeps working, and changes nothing.
TEST_F(Arguments, TheEyeStateKnowsWhetherItIsDay) {
    auto read = sized<seaglare_eye_state>();
    EXPECT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(read.flags, 0U) << "no frame has been drawn";
    auto state = sized<seaglare_eye_state>();
    state.flags = SEAGLARE_EYE_HAS_DAY;
    state.is_day = 1;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_OK);
    auto older = sized<seaglare_eye_state>();
    older.struct_size = offsetof(seaglare_eye_state, is_day);
    EXPECT_EQ(plugin_->get_eye_state(context_, &older), SEAGLARE_OK);
    EXPECT_EQ(older.flags, 0U);
    EXPECT_EQ(plugin_->set_eye_state(context_, &older), SEAGLARE_OK);
    EXPECT_EQ(plugin_->get_eye_state(context_, &read), SEAGLARE_OK);
    EXPECT_EQ(read.flags, static_cast<std::uint32_t>(SEAGLARE_EYE_HAS_DAY));
    EXPECT_EQ(read.is_day, 1);
    state.is_day = 2;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
    state.is_day = 0;
    state.reserved = 1;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
    state.reserved = 0;
    state.flags = 1U << 3;
    EXPECT_EQ(plugin_->set_eye_state(context_, &state), SEAGLARE_ERROR_INVALID_ARGUMENT);
}

TEST_F(Arguments, ErrorTextIsCutAtAWholeCharacter) {
    auto light = sized<seaglare_light>();
    light.character = "\xC3\xA6\xC3\xB8\xC3\xA5";  // aeoeaa
    ASSERT_EQ(plugin_->add_light(context_, &light, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    const std::string whole = plugin_.last_error(context_);
    for (std::uint32_t size = 1; size < 30; ++size) {
        std::array<char, 32> text{};
        text.fill('!');
        ASSERT_EQ(plugin_->copy_last_error(context_, text.data(), size), SEAGLARE_OK);
        const std::string cut = text.data();
        EXPECT_LT(cut.size(), size);
        EXPECT_EQ(whole.rfind(cut, 0), 0U);
        EXPECT_TRUE(cut.size() == whole.size() ||
                    (static_cast<unsigned char>(whole[cut.size()]) & 0xC0U) != 0x80U)
            << "cut inside a character";
    }
}

TEST_F(Arguments, EveryResultHasWords) {
    for (seaglare_result code = SEAGLARE_ERROR_VERSION; code <= SEAGLARE_DEGRADED; ++code)
        EXPECT_STRNE(plugin_->result_string(code), "unknown result code") << code;
    EXPECT_STREQ(plugin_->result_string(1000), "unknown result code");
}

}  // namespace
