#include "tests/abi/loaded_plugin.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace seaglare::test {

LoadedPlugin::LoadedPlugin() {
    library_ = dlopen(SEAGLARE_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    get_api_ = reinterpret_cast<seaglare_get_api_fn>(dlsym(library_, "seaglare_get_api"));
    if (get_api_ == nullptr) throw std::runtime_error(dlerror());
    api_.struct_size = sizeof api_;
    if (get_api_(SEAGLARE_ABI_MAJOR, &api_) != SEAGLARE_OK)
        throw std::runtime_error("seaglare_get_api failed");
}

LoadedPlugin::~LoadedPlugin() {
    dlclose(library_);
}

std::string LoadedPlugin::last_error(seaglare_context* context) const {
    std::array<char, 2048> text{};
    api_.copy_last_error(context, text.data(), static_cast<std::uint32_t>(text.size()));
    return text.data();
}

seaglare_frame looking_north(int width_px, int height_px) {
    auto frame = sized<seaglare_frame>();
    frame.flags = SEAGLARE_FRAME_HAS_ADAPTATION | SEAGLARE_FRAME_WAIT;
    frame.adaptation_luminance_cd_m2 = 0.001;
    frame.target_encoding = SEAGLARE_TARGET_SRGB_VALUES;
    frame.viewport_px[2] = width_px;
    frame.viewport_px[3] = height_px;
    const double f = 1 / std::tan(22.5 * std::numbers::pi / 180);
    const double near_m = 0.1, far_m = 100000;
    const std::array<double, 16> projection = {f * height_px / width_px,
                                               0,
                                               0,
                                               0,
                                               0,
                                               f,
                                               0,
                                               0,
                                               0,
                                               0,
                                               (far_m + near_m) / (near_m - far_m),
                                               -1,
                                               0,
                                               0,
                                               2 * far_m * near_m / (near_m - far_m),
                                               0};
    // Right is east, up is up, back is south; the eye at (0, 0, 5).
    const std::array<double, 16> view = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -5, 0, 1};
    for (std::size_t i = 0; i < 16; ++i) {
        frame.clip_from_view[i] = projection[i];
        frame.view_from_world[i] = view[i];
    }
    return frame;
}

TemporaryFile::TemporaryFile(const std::string& name, const std::string& text) {
    const auto folder = std::filesystem::temp_directory_path();
    static int serial = 0;
    path_ = (folder / ("seaglare_" + std::to_string(getpid()) + "_" + std::to_string(++serial) + "_" + name))
                .string();
    std::ofstream(path_) << text;
}

TemporaryFile::~TemporaryFile() {
    std::remove(path_.c_str());
}

QuickContext::QuickContext(const LoadedPlugin& plugin, std::uint32_t flags) : plugin_(plugin) {
    const TemporaryFile quality("quality.json", small_quality);
    auto info = sized<seaglare_create_info>();
    info.flags = flags;
    info.config_path = quality.path();
    created_ = plugin_->create(&info, &context_);
    if (created_ < 0) throw std::runtime_error("create: " + plugin_.last_error(nullptr));
}

QuickContext::~QuickContext() {
    plugin_->destroy(context_);
}

}  // namespace seaglare::test
