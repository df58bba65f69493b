#include "app/draw/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "engine/geometry/primitives_mesh.h"

namespace pedicel::app {

namespace {

using render::DrawList;
using render::Shading;

constexpr int round_segments = 40;

/// A sepal is a strip of four triangles and a tip, from the stalk down the fruit; its end stands
/// off. `t` runs along it, `side` across.
void add_sepal(DrawList& shape, const FruitLook& look, double radius, double azimuth,
               double reach) {
  const auto point = [&](double t, double side) {
    const double polar = 0.12 + reach * t;
    const double around = azimuth + side / std::sin(polar);
    const double distance = radius * (1.015 + 0.05 * std::sin(3.0 * t) + 0.16 * t * t * t);
    return Vec3(distance * std::sin(polar) * std::cos(around),
                distance * std::sin(polar) * std::sin(around), -distance * std::cos(polar));
  };
  constexpr std::array<double, 4> along = {0.0, 0.3, 0.65, 1.0};
  constexpr std::array<double, 4> half_width = {0.07, 0.13, 0.09, 0.0};
  for (std::size_t i = 0; i + 1 < along.size(); ++i) {
    const double w0 = half_width[i], w1 = half_width[i + 1];
    const Vec3 a = point(along[i], -w0), b = point(along[i], w0);
    const Vec3 c = point(along[i + 1], w1), d = point(along[i + 1], -w1);
    shape.blades.push_back({a, b, c, look.calyx});
    if (w1 > 0.0) shape.blades.push_back({a, c, d, look.calyx});
  }
}

/// Evenly spread over [0, 1), the same for the same number (golden ratio sequence).
double spread(int number) {
  return std::fmod(0.6180339887498949 * (number + 1), 1.0);
}

Shading skin_of(const FruitLook& look, int number) {
  const auto share = static_cast<float>(look.variety * std::pow(spread(number), 2.0));
  Shading skin = look.skin;
  skin.colour.r += share * (look.unripe.r - skin.colour.r);
  skin.colour.g += share * (look.unripe.g - skin.colour.g);
  skin.colour.b += share * (look.unripe.b - skin.colour.b);
  return skin;
}

/// A box, sphere, cylinder or capsule; false: another kind.
template <class Kind>
bool add_solid(DrawList& shape, Kind kind, const Pose& pose, const Vec3& half_extents,
               double radius, double length, const Shading& material) {
  const Vec3 end(0, 0, 0.5 * length);
  if (kind == Kind::box)
    shape.boxes.push_back({pose, half_extents, material});
  else if (kind == Kind::sphere)
    shape.spheres.push_back({pose.position, radius, material});
  else if (kind == Kind::cylinder)
    add_cylinder(shape, pose, radius, length, material);
  else if (kind == Kind::capsule)
    shape.capsules.push_back({pose * -end, pose * end, radius, radius, material});
  else
    return false;
  return true;
}

void add_part(DrawList& shape, const world::BodyPart& part, const Shading& material) {
  add_solid(shape, part.kind, part.pose, part.half_extents, part.radius, part.length, material);
}

void add_visual(DrawList& shape, const robot::Visual& visual) {
  const robot::Geometry& geometry = visual.geometry;
  const Eigen::Vector4f colour = visual.color.cast<float>();
  const Shading material{{colour[0], colour[1], colour[2]}, 0.4f, 0.5f};
  if (!add_solid(shape, geometry.kind, visual.X_LV, 0.5 * geometry.size, geometry.radius,
                 geometry.length, material) &&
      geometry.mesh)
    shape.meshes.push_back({geometry.mesh, visual.X_LV, material});
}

// A flat parabola of height h over the way d is longer than it by 8/3 h^2/d. Hung upright it only
// lies beside itself.
double sag_of(const Vec3& from_W, const Vec3& to_W, double length) {
  const double way = (to_W - from_W).norm();
  const double level = (to_W - from_W).head<2>().norm();
  if (!(level > 0.0 && length > way)) return 0.0;
  const double sag = std::min(std::sqrt(0.375 * way * (length - way)), 0.5 * length);
  return sag > string_radius ? sag : 0.0;
}

}  // namespace

void add_cylinder(DrawList& list, const Pose& pose, double radius, double length,
                  const Shading& shading) {
  auto mesh = std::make_shared<const geometry::TriangleMesh>(
      geometry::make_cylinder(radius, length, round_segments));
  list.meshes.push_back({std::move(mesh), pose, shading});
}

Shading shading_of(const std::string& look) {
  namespace shadings = render::shadings;
  static const std::map<std::string, Shading> known = {{"steel", shadings::steel},
                                                       {"wood", shadings::wood},
                                                       {"light", shadings::robot_light},
                                                       {"dark", shadings::robot_dark},
                                                       {"accent", shadings::accent}};
  const auto found = known.find(look);
  return found == known.end() ? Shading{} : found->second;
}

FruitLook FruitLook::apple() {
  FruitLook look;
  look.skin = render::shadings::apple;
  look.unripe = render::Colour::hex(0xb7b53e);
  look.sepals = 0;
  look.stalk = render::shadings::wood;
  return look;
}

FruitLook FruitLook::of(plant::Look look) {
  return look == plant::Look::apple ? apple() : tomato();
}

void add_at(DrawList& list, const DrawList& shape, const Pose& X_WS) {
  for (render::Capsule c : shape.capsules) {
    c.p0 = X_WS * c.p0, c.p1 = X_WS * c.p1;
    list.capsules.push_back(c);
  }
  for (render::TubeSegment t : shape.tubes) {
    t.p0 = X_WS * t.p0, t.p1 = X_WS * t.p1;
    for (Vec3* direction : {&t.tangent0, &t.tangent1, &t.side0, &t.side1})
      *direction = X_WS.rotation * *direction;
    list.tubes.push_back(t);
  }
  for (render::Sphere s : shape.spheres) {
    s.centre = X_WS * s.centre;
    list.spheres.push_back(s);
  }
  for (const render::Box& b : shape.boxes)
    list.boxes.push_back({X_WS * b.pose, b.half_extents, b.material, b.label});
  for (const render::MeshInstance& m : shape.meshes)
    list.meshes.push_back({m.mesh, X_WS * m.pose, m.material, m.label});
  for (const render::BladeFace& t : shape.blades)
    list.blades.push_back({X_WS * t.a, X_WS * t.b, X_WS * t.c, t.material, t.label});
  for (const render::Line& l : shape.lines)
    list.lines.push_back({X_WS * l.a, X_WS * l.b, l.colour, l.width});
}

DrawList fruit_shape(const FruitLook& look, int number, double radius, double stub_length,
                     double stub_radius) {
  DrawList shape;
  shape.spheres.push_back({Vec3::Zero(), radius, skin_of(look, number)});
  if (stub_length > radius)
    shape.capsules.push_back({Vec3(0, 0, -0.9 * radius), Vec3(0, 0, -stub_length), stub_radius,
                              stub_radius, look.stalk});
  for (int k = 0; k < look.sepals; ++k) {
    const double turn = spread(number) + 2.0 * M_PI * k / look.sepals;
    add_sepal(shape, look, radius, turn, 0.75 + 0.2 * spread(7 * number + k));
  }
  return shape;
}

DrawList body_shape(const world::BodyDescription& body) {
  DrawList shape;
  if (body.look == "hidden") return shape;
  for (const world::BodyPart& part : body.parts) add_part(shape, part, shading_of(body.look));
  return shape;
}

std::vector<DrawList> robot_shapes(const robot::RobotDescription& robot) {
  std::vector<DrawList> shapes;
  for (const robot::Link& link : robot.links) {
    DrawList& shape = shapes.emplace_back();
    for (const robot::Visual& visual : link.visuals) add_visual(shape, visual);
  }
  return shapes;
}

std::array<Vec3, string_parts + 1> string_course(const Vec3& from_W, const Vec3& to_W,
                                                 double length) {
  const double sag = sag_of(from_W, to_W, length);
  std::array<Vec3, string_parts + 1> places;
  for (int i = 0; i <= string_parts; ++i) {
    const double t = static_cast<double>(i) / string_parts;
    places[static_cast<std::size_t>(i)] =
        from_W + t * (to_W - from_W) - 4.0 * sag * t * (1.0 - t) * Vec3::UnitZ();
  }
  return places;
}

void add_string(DrawList& list, const Vec3& from_W, const Vec3& to_W, double length,
                const render::Colour& colour) {
  const Shading look{colour, 0.9f, 0.1f};
  const auto add = [&](const Vec3& from, const Vec3& to) {
    list.capsules.push_back({from, to, string_radius, string_radius, look});
  };
  if (sag_of(from_W, to_W, length) == 0.0) return add(from_W, to_W);
  const auto places = string_course(from_W, to_W, length);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) add(places[i], places[i + 1]);
}

void add_force(DrawList& list, const Vec3& point_W, const Vec3& force_W, double metres_per_newton,
               const Shading& material) {
  const Vec3 arrow = metres_per_newton * force_W;
  const double radius = std::clamp(0.02 * arrow.norm(), 4e-4, 2e-3);
  list.add_arrow(point_W - arrow, point_W, radius, material);
}

}  // namespace pedicel::app
