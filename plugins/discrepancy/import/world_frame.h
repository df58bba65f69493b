#pragma once

#include <string>
#include <string_view>

#include "engine/core/frames.h"

/// How the axes of a file lie in the world, from words of the command line. `option` names it in
/// what is thrown: UsageError.
namespace pedicel::discrepancy {

/// "x", "-z", or three numbers "0.6,0,0.8": a unit vector.
Vec3 direction_of_text(std::string_view text, const std::string& option);

/// "x,-z,y": which axis of the file each axis of the world is; turns the file's axes into the
/// world's. Right-handed: what mirrors is refused.
Mat3 turn_of_axes(std::string_view text, const std::string& option);

/// The least turn for a file whose axis 'x', 'y' or 'z' points up.
Mat3 turn_of_up(char axis);

/// "x,y,z"; "u,v": finite numbers.
Vec3 numbers3_of_text(std::string_view text, const std::string& option);
Eigen::Vector2d numbers2_of_text(std::string_view text, const std::string& option);

}  // namespace pedicel::discrepancy
