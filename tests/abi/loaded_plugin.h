// The library as a host has it: opened from its file, reached through the table alone.
#pragma once

#include <string>

#include "plugin_api/seaglare.h"

namespace seaglare::test {

class LoadedPlugin {
  public:
    // Throws std::runtime_error with the loader's words.
    LoadedPlugin();
    ~LoadedPlugin();
    LoadedPlugin(const LoadedPlugin&) = delete;
    LoadedPlugin& operator=(const LoadedPlugin&) = delete;

    const seaglare_api* operator->() const { return &api_; }
    seaglare_get_api_fn get_api() const { return get_api_; }
    std::string last_error(seaglare_context* context) const;
    template <class Extension>
    const Extension* extension(const char* name) const {
        return static_cast<const Extension*>(api_.get_extension(name));
    }

  private:
    void* library_ = nullptr;
    seaglare_get_api_fn get_api_ = nullptr;
    seaglare_api api_{};
};

// A struct with struct_size set and everything else zero.
template <class Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

// An eye 5 m above the origin of an East-North-Up world, looking north through 45 degrees; adapted to starlight.
seaglare_frame looking_north(int width_px, int height_px);

// A quality file with a small pattern, so that tests are quick; deleted with the object.
class TemporaryFile {
  public:
    TemporaryFile(const std::string& name, const std::string& text);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const char* path() const { return path_.c_str(); }

  private:
    std::string path_;
};
inline constexpr const char* small_quality =
    R"({"pattern": {"transform_size": 256, "wavelengths": 5, "max_radius_nodes": 24, "layer_radii_px": [0, 3]}})";

// A context without OpenCL and with the small pattern. Throws when create fails.
class QuickContext {
  public:
    explicit QuickContext(const LoadedPlugin& plugin, std::uint32_t flags = SEAGLARE_CREATE_NO_OPENCL);
    ~QuickContext();
    QuickContext(const QuickContext&) = delete;
    QuickContext& operator=(const QuickContext&) = delete;
    operator seaglare_context*() const { return context_; }  // NOLINT: stands for the handle
    seaglare_result created() const { return created_; }

  private:
    const LoadedPlugin& plugin_;
    seaglare_context* context_ = nullptr;
    seaglare_result created_ = SEAGLARE_OK;
};

}  // namespace seaglare::test
