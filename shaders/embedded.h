// The shaders and kernels of this folder, embedded at build time.
#pragma once

#include <string_view>

namespace seaglare::shaders {

// The text of shaders/NAME, null-terminated; empty when there is no such file.
std::string_view source(std::string_view name);

}  // namespace seaglare::shaders
