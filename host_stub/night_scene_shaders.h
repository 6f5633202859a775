// GLSL of the stub host's night scene.
#pragma once

#include <string>

namespace seaglare::host {

std::string backdrop_vertex_shader();    // one triangle over the picture
std::string backdrop_fragment_shader();  // sky, moon, stars, sea
std::string land_vertex_shader();
std::string land_fragment_shader();

}  // namespace seaglare::host
