// What tests with the stub host share: the shipped scenes, how one of them is opened, a GL context to draw it in.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "host_stub/gl_objects.h"
#include "host_stub/headless.h"
#include "host_stub/simulation.h"

namespace seaglare::host {

// Null where there is none; `why_not` says why.
inline std::unique_ptr<HeadlessContext> headless_context(std::string& why_not) {
    try {
        return std::make_unique<HeadlessContext>();
    } catch (const GlFailure& error) {
        why_not = error.what();
        return nullptr;
    }
}

// Of config/scenes; `size` is "WxH".
inline SceneOptions scene_options(const std::string& scene, const std::string& size) {
    SceneOptions options;
    options.scene = std::filesystem::path(SEAGLARE_SOURCE_DIR) / "config" / "scenes" /
                    std::filesystem::path(scene + ".json");
    options.plugin = SEAGLARE_PLUGIN_FILE;
    options.size = size;
    return options;
}

// Those that are shipped, each in a size that is drawn in a moment.
struct ShippedScene {
    const char* name;
    const char* size;
};
inline constexpr std::array<ShippedScene, 5> shipped_scenes = {{{"great_belt_night", "480x270"},
                                                                {"ships_at_night", "480x270"},
                                                                {"sonderborg_leading_line", "480x270"},
                                                                {"storebaelt_dusk", "480x270"},
                                                                {"thesis_many_lights", "320x180"}}};
// For INSTANTIATE_TEST_SUITE_P.
inline std::string name_of(const testing::TestParamInfo<ShippedScene>& info) {
    return info.param.name;
}

}  // namespace seaglare::host
