#pragma once

#include <string>

/// The GLSL 3.30 sources. Vertex stages serve the picture and the depth passes alike; the light
/// model is in one place, the lit fragment stage (README.md, "Light").
namespace pedicel::render::shaders {

std::string tube_vertex();
std::string sphere_vertex();
std::string mesh_vertex();
std::string blade_vertex();
std::string line_vertex();
std::string ground_vertex();
std::string full_screen_vertex();

std::string lit_fragment();
std::string line_fragment();
std::string ground_fragment();
std::string sky_fragment();
std::string blur_fragment();
std::string label_fragment();
std::string ground_label_fragment();
std::string empty_fragment();

}  // namespace pedicel::render::shaders
