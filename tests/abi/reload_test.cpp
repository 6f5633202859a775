// A light file that changes while the host runs: ids stay, the host's word stays, frames see the old or the new lights, and
// a bad file changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "lightdb/light_file.h"
#include "plugin_api/context.h"
#include "tests/abi/loaded_plugin.h"

namespace {

using namespace seaglare::test;
using Ids = std::vector<seaglare_light_id>;

std::string light(const std::string& name, double east_m, double intensity_cd, const std::string& more = "") {
    return R"({"name": ")" + name + R"(", "position": [)" + std::to_string(east_m) +
           R"(, 1000, 10], "intensity_cd": )" + std::to_string(intensity_cd) + more + "}";
}

std::string file_of(const std::vector<std::string>& lights, const std::string& before = "") {
    std::string text = "{" + before + "\"lights\": [\n";
    for (const std::string& one : lights)
        text += one + (&one == &lights.back() ? "\n" : ",\n");
    return text + "]}\n";
}

class Reload : public ::testing::Test {
  protected:
    Ids ids() const {
        std::uint32_t count = 0;
        plugin_->list_lights(context_, nullptr, 0, &count);
        Ids all(count);
        plugin_->list_lights(context_, all.data(), count, &count);
        return all;
    }
    void write(const std::string& text) const { std::ofstream(file_.path(), std::ios::trunc) << text; }
    Ids load(const std::vector<std::string>& lights) const {
        write(file_of(lights));
        EXPECT_EQ(plugin_->load_lights(context_, file_.path()), SEAGLARE_OK) << plugin_.last_error(context_);
        return ids();
    }
    // Expects "unchanged changed added removed".
    void reload(const std::vector<std::string>& lights, const std::vector<std::uint32_t>& expected) const {
        write(file_of(lights));
        auto counts = sized<seaglare_reload_counts>();
        ASSERT_EQ(api_->reload(context_, file_.path(), &counts), SEAGLARE_OK) << plugin_.last_error(context_);
        EXPECT_EQ((std::vector{counts.unchanged, counts.changed, counts.added, counts.removed}), expected);
    }
    // The light as the context has it, by saving.
    std::vector<seaglare::lightdb::Light> saved() const {
        const TemporaryFile target("saved.json", "");
        EXPECT_EQ(api_->save(context_, target.path()), SEAGLARE_OK) << plugin_.last_error(context_);
        return seaglare::lightdb::load_light_file(target.path()).lights;
    }

    LoadedPlugin plugin_;
    QuickContext context_{plugin_};
    TemporaryFile file_{"lights.json", ""};
    const seaglare_lights_api* api_ = plugin_.extension<seaglare_lights_api>("seaglare.lights/1");
};

TEST_F(Reload, IdsStayWhateverTheOrder) {
    const Ids first = load({light("a", 1, 10), light("b", 2, 10), light("c", 3, 10)});
    reload({light("c", 3, 10), light("a", 1, 10), light("b", 2, 10)}, {3, 0, 0, 0});
    EXPECT_EQ(ids(), first);
}

TEST_F(Reload, AChangedLightKeepsItsIdAndTakesTheFilesData) {
    const Ids first = load({light("a", 1, 10), light("b", 2, 10)});
    reload({light("a", 1, 10), light("b", 2, 77)}, {1, 1, 0, 0});
    EXPECT_EQ(ids(), first);
    EXPECT_EQ(saved()[1].intensity_cd[0], 77);
    reload({light("a", 500, 10), light("b", 2, 77)}, {1, 1, 0, 0});  // moved
    EXPECT_EQ(ids(), first);
    EXPECT_EQ(saved()[0].position_m[0], 500);
}

TEST_F(Reload, WhatIsGoneBecomesStaleAndWhatIsNewComesLast) {
    const Ids first = load({light("a", 1, 10), light("b", 2, 10)});
    reload({light("new", 9, 10), light("b", 2, 10)}, {1, 0, 1, 1});
    const Ids now = ids();
    ASSERT_EQ(now.size(), 2U);
    EXPECT_EQ(now[0], first[1]);
    EXPECT_EQ(plugin_->remove_light(context_, first[0]), SEAGLARE_ERROR_STALE_ID);
}

TEST_F(Reload, LightsThatAreAlikeKeepTheirIdsOnceEach) {
    const Ids first = load({light("a", 1, 10), light("a", 1, 10), light("a", 1, 10)});
    reload({light("a", 1, 10), light("a", 1, 10)}, {2, 0, 0, 1});
    EXPECT_EQ(ids(), (Ids{first[0], first[1]}));
    reload({light("a", 1, 10), light("a", 1, 10), light("a", 1, 10), light("a", 1, 10)}, {2, 0, 2, 0});
    EXPECT_EQ(ids().size(), 4U);
}

TEST_F(Reload, OtherLightsStayAsTheyAre) {
    const TemporaryFile other("other.json", file_of({light("x", 8, 10)}));
    ASSERT_EQ(plugin_->load_lights(context_, other.path()), SEAGLARE_OK);
    auto given = sized<seaglare_light>();
    given.intensity_cd = 5;
    ASSERT_EQ(plugin_->add_light(context_, &given, nullptr), SEAGLARE_OK);
    const Ids both = ids();
    load({light("x", 8, 10)});
    reload({}, {0, 0, 0, 1});
    EXPECT_EQ(ids(), both);
}

TEST_F(Reload, WhatTheHostHasSetOnAnUnchangedLightStays) {
    const Ids first = load({light("a", 1, 10), light("b", 2, 10)});
    auto update = sized<seaglare_light_update>();
    update.id = first[0];
    update.set = SEAGLARE_SET_POSITION | SEAGLARE_SET_INTENSITY;
    update.position_m[0] = 123;
    update.intensity_cd = 44;
    ASSERT_EQ(plugin_->update_lights(context_, &update, 1, 0), SEAGLARE_OK);
    reload({light("a", 1, 10), light("b", 2, 11)}, {1, 1, 0, 0});
    EXPECT_EQ(saved()[0].position_m[0], 123);
    EXPECT_EQ(saved()[0].intensity_cd[0], 44);
    reload({light("a", 1, 12), light("b", 2, 11)}, {1, 1, 0, 0});  // now the file has a newer word
    EXPECT_EQ(saved()[0].position_m[0], 1);
    EXPECT_EQ(saved()[0].intensity_cd[0], 12);
}

TEST_F(Reload, ARemovedLightComesAnewWithAnotherId) {
    const Ids first = load({light("a", 1, 10)});
    ASSERT_EQ(plugin_->remove_light(context_, first[0]), SEAGLARE_OK);
    reload({light("a", 1, 10)}, {0, 0, 1, 0});
    ASSERT_EQ(ids().size(), 1U);
    EXPECT_NE(ids()[0], first[0]);
}

TEST_F(Reload, AFileNeverLoadedIsLoadedAndAnyPathToItIsTheSameFile) {
    reload({light("a", 1, 10)}, {0, 0, 1, 0});
    const std::filesystem::path path = file_.path();
    const std::string other_way = (path.parent_path() / "." / path.filename()).string();
    auto counts = sized<seaglare_reload_counts>();
    ASSERT_EQ(api_->reload(context_, other_way.c_str(), &counts), SEAGLARE_OK);
    EXPECT_EQ(counts.unchanged, 1U);
    ASSERT_EQ(plugin_->clear_lights(context_), SEAGLARE_OK);
    reload({light("a", 1, 10)}, {0, 0, 1, 0});
}

TEST_F(Reload, ABadFileLeavesTheOldLightsAndSaysWhere) {
    const Ids first = load({light("a", 1, 10), light("b", 2, 10)});
    const std::string good = file_of({light("a", 1, 99), light("b", 2, 10)});
    const std::string whole_path = file_.path();
    for (std::size_t length = 0; length + 2 < good.size(); length += 7) {  // torn while it is written
        write(good.substr(0, length));
        EXPECT_EQ(api_->reload(context_, file_.path(), nullptr), SEAGLARE_ERROR_PARSE) << length;
        EXPECT_EQ(ids(), first);
        EXPECT_EQ(plugin_.last_error(context_).rfind(whole_path + ":", 0), 0U)
            << plugin_.last_error(context_);
    }
    write(file_of({light("a", 1, 99), light("b", 2, 10, R"(, "heigth_m": 3)")}));
    EXPECT_EQ(api_->reload(context_, file_.path(), nullptr), SEAGLARE_ERROR_PARSE);
    EXPECT_EQ(plugin_.last_error(context_).rfind(whole_path + ":3:", 0), 0U) << plugin_.last_error(context_);
    EXPECT_EQ(saved()[0].intensity_cd[0], 10);
    std::remove(file_.path());
    EXPECT_EQ(api_->reload(context_, file_.path(), nullptr), SEAGLARE_ERROR_FILE);
    EXPECT_EQ(ids(), first);
    write(good);
    EXPECT_EQ(api_->reload(context_, file_.path(), nullptr), SEAGLARE_OK);
    EXPECT_EQ(ids(), first);
}

TEST_F(Reload, ArgumentsAreCheckedBeforeAnythingIsDone) {
    const Ids first = load({light("a", 1, 10)});
    write(file_of({}));
    auto counts = sized<seaglare_reload_counts>();
    counts.struct_size = 3;
    EXPECT_EQ(api_->reload(context_, file_.path(), &counts), SEAGLARE_ERROR_STRUCT_SIZE);
    EXPECT_EQ(api_->reload(nullptr, file_.path(), nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->reload(context_, nullptr, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->save(context_, nullptr), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->save(nullptr, file_.path()), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(api_->save(context_, "/nonexistent/lights.json"), SEAGLARE_ERROR_FILE);
    EXPECT_EQ(ids(), first);
}

TEST_F(Reload, WhatIsSavedLoadsAsTheSameLightsAndSavesAsTheSameBytes) {
    load({light("a", 1, 10, R"(, "character": "Fl(2) R 10s")"), light("b", 2, 0.1)});
    auto given = sized<seaglare_light>();
    given.position_m[1] = 3;
    given.nominal_range_nm = 7.5;
    given.colour = SEAGLARE_COLOUR_GREEN;
    given.name = "added";
    ASSERT_EQ(plugin_->add_light(context_, &given, nullptr), SEAGLARE_OK);
    given.character = "Fl 5s";
    given.body_id = 9;
    ASSERT_EQ(plugin_->add_light(context_, &given, nullptr), SEAGLARE_OK);
    const TemporaryFile first("first.json", "");
    const TemporaryFile second("second.json", "");
    ASSERT_EQ(api_->save(context_, first.path()), SEAGLARE_OK) << plugin_.last_error(context_);
    const QuickContext other(plugin_);
    ASSERT_EQ(plugin_->load_lights(other, first.path()), SEAGLARE_OK) << plugin_.last_error(other);
    ASSERT_EQ(api_->save(other, second.path()), SEAGLARE_OK);
    const auto text = [](const char* path) {
        std::ifstream file(path);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_EQ(text(first.path()), text(second.path()));
    EXPECT_NE(text(first.path()).find(R"("nominal_range_nm": {"G": 7.5})"), std::string::npos)
        << text(first.path());
}

TEST_F(Reload, ALightThatNoFileMayHoldIsNamedAndNothingIsSaved) {
    auto given = sized<seaglare_light>();
    given.intensity_cd = 1e11;
    given.name = "sun";
    ASSERT_EQ(plugin_->add_light(context_, &given, nullptr), SEAGLARE_OK);
    EXPECT_EQ(api_->save(context_, file_.path()), SEAGLARE_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(plugin_.last_error(context_).find("'sun'"), std::string::npos) << plugin_.last_error(context_);
    EXPECT_EQ(std::filesystem::file_size(file_.path()), 0U);
}

// The parts of the library, without GL: what a frame takes from the lights while another thread reads the file again.
class ReloadInside : public ::testing::Test {
  protected:
    static seaglare_create_info info() {
        auto info = sized<seaglare_create_info>();
        info.flags = SEAGLARE_CREATE_NO_OPENCL;
        return info;
    }
    double red_lx(double time_s) {
        seaglare_frame frame = looking_north(640, 360);
        frame.time_s = time_s;
        seaglare::glare::Frame picture;
        picture.viewport_px = {0, 0, 640, 360};
        std::copy(std::begin(frame.clip_from_view), std::end(frame.clip_from_view),
                  picture.clip_from_view.begin());
        context_.evaluate(frame, picture, 0, evaluated_);
        double sum_lx = 0;
        for (const auto& source : evaluated_.sources)
            sum_lx += static_cast<double>(source.illuminance_rgb_lx[0]);
        return sum_lx;
    }

    seaglare::plugin::Context context_{info()};
    seaglare::lightdb::Evaluated evaluated_;
};

TEST_F(ReloadInside, AFrameSeesAllOfTheOldLightsOrAllOfTheNewOnes) {
    std::vector<std::string> dim;
    std::vector<std::string> bright;
    for (int i = 0; i < 60; ++i) {
        dim.push_back(light("l" + std::to_string(i), i - 30, 10));
        bright.push_back(light("l" + std::to_string(i), i - 30, 20));
    }
    const TemporaryFile file("lights.json", file_of(dim));
    context_.load_lights(file.path());
    const double dim_lx = red_lx(0);
    ASSERT_GT(dim_lx, 0);
    std::atomic<bool> done{false};
    std::thread changer([&] {
        for (int round = 0; round < 40; ++round) {
            std::ofstream(file.path(), std::ios::trunc) << file_of(round % 2 == 0 ? bright : dim);
            EXPECT_EQ(context_.reload_lights(file.path()).changed, 60U);
        }
        done = true;
    });
    int frames = 0;
    while (!done || frames < 50) {
        const double seen = red_lx(0) / dim_lx;
        EXPECT_TRUE(std::abs(seen - 1) < 1e-5 || std::abs(seen - 2) < 1e-5) << seen;
        EXPECT_EQ(evaluated_.sources.size(), 60U);
        ++frames;
    }
    changer.join();
}

TEST_F(ReloadInside, RhythmsGoOn) {
    const std::string flashing = R"(, "character": "Iso 4s")";
    const TemporaryFile file("lights.json", file_of({light("a", 0, 10, flashing)}));
    context_.load_lights(file.path());
    std::vector<double> before;
    for (double time_s = 0; time_s < 8; time_s += 0.05)
        before.push_back(red_lx(time_s));
    std::ofstream(file.path(), std::ios::trunc) << file_of({light("b", 3, 0), light("a", 0, 10, flashing)});
    EXPECT_EQ(context_.reload_lights(file.path()).unchanged, 1U);
    std::size_t i = 0;
    for (double time_s = 0; time_s < 8; time_s += 0.05)
        EXPECT_EQ(red_lx(time_s), before[i++]);
}

TEST_F(ReloadInside, ALightThatIsOffStaysOffWhenItsDataChange) {
    const TemporaryFile file("lights.json", file_of({light("a", 0, 10)}));
    context_.load_lights(file.path());
    seaglare_light_id id = 0;
    ASSERT_EQ(context_.list_lights(&id, 1), 1U);
    auto update = sized<seaglare_light_update>();
    update.id = id;
    update.set = SEAGLARE_SET_ON;
    context_.update_lights(&update, 1, 0);
    EXPECT_EQ(red_lx(0), 0);
    std::ofstream(file.path(), std::ios::trunc) << file_of({light("a", 0, 99)});
    EXPECT_EQ(context_.reload_lights(file.path()).changed, 1U);
    EXPECT_EQ(red_lx(0), 0);
}

TEST_F(ReloadInside, ABuoyTheHostHasTakenOverStaysSoWhileTheFileSaysTheSame) {
    const std::string buoy = R"("buoys": [{"name": "S", "position": [0, 500], "body": 5, "lights":
        [{"name": "S", "position": [0, 0, 4], "intensity_cd": 50}]}], )";
    const TemporaryFile file("lights.json", file_of({}, buoy));
    context_.load_lights(file.path());
    EXPECT_NO_THROW(context_.buoy_pose(5, 0));
    const double at[3] = {0, 900, 0};
    const double upright[4] = {0, 0, 0, 1};
    context_.set_body_pose(5, at, upright);
    EXPECT_ANY_THROW(context_.buoy_pose(5, 0));
    EXPECT_EQ(context_.reload_lights(file.path()).unchanged, 1U);
    EXPECT_ANY_THROW(context_.buoy_pose(5, 0));
    std::string heavier = buoy;
    heavier.replace(heavier.find("\"body\""), 0, "\"roll_period_s\": 6, ");
    std::ofstream(file.path(), std::ios::trunc) << file_of({}, heavier);
    context_.reload_lights(file.path());
    EXPECT_NO_THROW(context_.buoy_pose(5, 0));
    std::ofstream(file.path(), std::ios::trunc) << file_of({});
    EXPECT_EQ(context_.reload_lights(file.path()).removed, 1U);
    EXPECT_ANY_THROW(context_.buoy_pose(5, 0));
}

}  // namespace
