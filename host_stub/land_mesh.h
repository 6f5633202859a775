// Triangles of the land and of what people built, in world metres.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "host_stub/scene.h"

namespace seaglare::host {

struct LandVertex {
    float position_m[3];
    float albedo;
};

struct LandMesh {
    std::vector<LandVertex> vertices;
    std::vector<std::uint32_t> indices;
};

// Shores, hills and structures of the scene. The same scene gives the same bytes.
LandMesh make_land(const Scene& scene);

}  // namespace seaglare::host
