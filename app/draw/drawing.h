#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/render/draw_list.h"
#include "engine/robot/description.h"
#include "engine/world/bodies.h"
#include "plugins/plant/model/plant_model.h"
#include "plugins/simulation/plants/blade.h"

/// From the things of a simulation to the draw list of one picture. Rigid things are prepared once,
/// as a draw list in their own frame (a "shape" below), and added to every frame at their pose.
namespace pedicel::app {

/// A fruit's looks.
struct FruitLook {
  render::Shading skin = render::shadings::tomato;
  render::Colour unripe = render::Colour::hex(0xee7a22);
  double variety = 0.45;  ///< 1, how far a fruit's colour may go towards `unripe`
  render::Shading calyx = render::shadings::leaf;
  int sepals = 5;  ///< 0: no calyx
  render::Shading stalk = render::shadings::stem;

  static FruitLook tomato() { return {}; }
  static FruitLook apple();
  static FruitLook of(plant::Look look);
};

/// How what a body's `look` says takes the light; of another word, grey.
render::Shading shading_of(const std::string& look);

/// Adds a cylinder about Z of its own frame: radius and length in m.
void add_cylinder(render::DrawList& list, const Pose& pose, double radius, double length,
                  const render::Shading& shading);

/// Adds `shape`, which is given in its own frame, at X_WS. Its ground is left out.
void add_at(render::DrawList& list, const render::DrawList& shape, const Pose& X_WS);

/// A fruit about the origin of its own frame, whose stalk comes from -Z (the third axis of a rod's
/// frame points along it), with the stub that came off with it: `stub_length` from the centre (m),
/// 0: none. `number` picks the shade.
render::DrawList fruit_shape(const FruitLook& look, int number, double radius,
                             double stub_length = 0.0, double stub_radius = 0.0);

/// A body as its `look` says; empty for a hidden one.
render::DrawList body_shape(const world::BodyDescription& body);

/// The visuals of every link, in the links' frames and the order of the description.
std::vector<render::DrawList> robot_shapes(const robot::RobotDescription& robot);

inline constexpr double string_radius = 0.0012;  ///< m, as strings are drawn
inline constexpr int string_parts = 12;          ///< of one that sags
/// Where a string of `length` (m) runs from end to end (m, W), string_parts + 1 places evenly along
/// it. What is longer than the way sags; a taut one is straight.
std::array<Vec3, string_parts + 1> string_course(const Vec3& from_W, const Vec3& to_W,
                                                 double length);
/// The string of a tie so.
void add_string(render::DrawList& list, const Vec3& from_W, const Vec3& to_W, double length,
                const render::Colour& colour);
inline constexpr render::Colour twine = render::Colour::hex(0xcdb36b);

/// An arrow that ends at `point_W` (m) and shows a force (N).
void add_force(render::DrawList& list, const Vec3& point_W, const Vec3& force_W,
               double metres_per_newton, const render::Shading& material);

}  // namespace pedicel::app
