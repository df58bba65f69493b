// Leaf blades against things: where a triangle is nearest, what its corners get of that, and that a
// ball that veins let through pushes the leaf. BladeSource.HowFarABallSinks makes the table of the
// manual's page Measurements.
#include "plugins/coupling/blade_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider_source.h"
#include "plugins/plant/leaf_template.h"
#include "tests/support/places.h"

namespace pedicel::coupling {
namespace {

using cosserat::ContactPoint;
using cosserat::RodModel;

struct GrownLeaf {
  RodModel model;
  std::vector<BladeFace> faces;
};

// Level at the origin, its midrib along x, clamped at its foot.
GrownLeaf level_leaf(const std::string& name, double size) {
  Diagnostics diagnostics;
  const auto leaf = plant::read_leaf_template(
      pedicel::test::source_folder() / "assets/leaves" / (name + ".leaf.yaml"), diagnostics);
  if (!leaf) throw UsageError(diagnostics.text());
  GrownLeaf grown;
  grown.model.organs = {"p/leaf"};
  std::vector<plant::BladeTriangle> triangles;
  grow_leaf(grown.model, -1, Vec3::Zero(), Mat3::Identity(), size, *leaf, 0, triangles);
  finish(grown.model);
  for (const plant::BladeTriangle& triangle : triangles) {
    BladeFace face;
    for (int i = 0; i < 3; ++i) face[i] = {triangle.corners[i].element, triangle.corners[i].back};
    grown.faces.push_back(face);
  }
  return grown;
}

Vec3 drawn(const RodModel& model, const BladeCorner& corner) {
  const cosserat::Element& element = model.elements[corner.element];
  return element.drawn_position - corner.back * (element.drawn_rotation * Vec3::UnitZ());
}

// m: how much higher than on a blade a ball's middle stands on the veins at (x, y), below 0: how
// far it sinks. Where it touches none it falls through.
double stands_at(const RodModel& model, double x, double y, double radius) {
  double height = -std::numeric_limits<double>::infinity();
  for (const cosserat::CollisionShape& shape : model.shapes) {
    // Level axes: the highest middle over this one is where the two are nearest in plan, but for
    // the taper.
    const Vec3 a = drawn(model, {shape.element, shape.back_near}),
               b = drawn(model, {shape.element, shape.back_far});
    for (int i = 0; i <= 50; ++i) {
      const double t = i / 50.0;
      const Vec3 place = a + t * (b - a);
      const double r = shape.radius_near + t * (shape.radius_far - shape.radius_near) + radius;
      const double plan = std::hypot(place.x() - x, place.y() - y);
      if (plan < r) height = std::max(height, std::sqrt(r * r - plan * plan));
    }
  }
  return height - radius - blade_half_thickness;
}

// m, and where on the blade that is.
struct Hole {
  double sinks = std::numeric_limits<double>::infinity();
  Vec3 place = Vec3::Zero();
};
Hole deepest_hole(const GrownLeaf& leaf, double radius) {
  Hole hole;
  hole.sinks = 0.0;
  constexpr int parts = 24;
  for (const BladeFace& face : leaf.faces)
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; j <= parts - i; ++j) {
        const double u = i / double(parts), v = j / double(parts);
        const Vec3 place = u * drawn(leaf.model, face[0]) + v * drawn(leaf.model, face[1]) +
                           (1.0 - u - v) * drawn(leaf.model, face[2]);
        const double sinks = -stands_at(leaf.model, place.x(), place.y(), radius);
        if (sinks > hole.sinks) hole = {sinks, place};
      }
  return hole;
}

TEST(BladeSource, HowFarABallSinks) {
  struct One {
    const char* name;
    double size;
  };
  for (const One& one : {One{"tomato", 0.15}, One{"apple", 0.10}, One{"maize", 0.65}}) {
    const GrownLeaf leaf = level_leaf(one.name, one.size);
    double last = std::numeric_limits<double>::infinity();
    for (const double radius : {0.005, 0.01, 0.02, 0.04}) {
      const double sinks = deepest_hole(leaf, radius).sinks;
      std::printf("| %s, %.0f mm | %.0f | %s | %.2f |\n", one.name, 1e3 * one.size, 1e3 * radius,
                  std::isinf(sinks) ? "falls through" : std::to_string(1e3 * sinks).c_str(),
                  1e3 * blade_half_thickness);
      EXPECT_LE(sinks, last);  // a larger ball sinks less
      last = sinks;
    }
    EXPECT_TRUE(std::isinf(deepest_hole(leaf, 0.003).sinks)) << one.name;
  }
}

// The nearest place of a triangle to a ball is that to its middle; in exact numbers.
TEST(BladeSource, FindsTheNearestPlaceOfATriangle) {
  Random random(7);
  const auto point = [&](double size) {
    return Vec3(random.uniform(-size, size), random.uniform(-size, size),
                random.uniform(-size, size));
  };
  for (int i = 0; i < 400; ++i) {
    const std::array<Vec3, 3> corners{point(0.03), point(0.03), point(0.03)};
    const geometry::SphereDistance ball(0.004);
    const auto at = nearest_on_triangle(ball, corners, 1.0);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->sum(), 1.0, 1e-12);
    EXPECT_GE(at->minCoeff(), 0.0);
    double least = 1.0;
    constexpr int parts = 200;
    for (int k = 0; k <= parts; ++k)
      for (int l = 0; l <= parts - k; ++l) {
        const double u = k / double(parts), v = l / double(parts);
        least = std::min(
            least, ball.distance(u * corners[0] + v * corners[1] + (1.0 - u - v) * corners[2]));
      }
    const double found =
        ball.distance((*at)[0] * corners[0] + (*at)[1] * corners[1] + (*at)[2] * corners[2]);
    EXPECT_LT(found - least, 1.0e-4) << i;
    EXPECT_FALSE(nearest_on_triangle(ball, corners, least - 1e-3)) << i;
  }
}

// Flat on a plate, all of a triangle is equally near: the middle is taken.
TEST(BladeSource, TouchesAPlateInTheMiddle) {
  const geometry::BoxDistance plate(Vec3(1, 1, 0.02));
  const auto at = nearest_on_triangle(
      plate, {Vec3(0, 0, 0.0102), Vec3(0.03, 0, 0.0102), Vec3(0, 0.02, 0.0102)}, 1e-3);
  ASSERT_TRUE(at);
  EXPECT_LT((*at - Vec3::Constant(1.0 / 3.0)).norm(), 0.02);
}

// The three parts are one force at the nearest place.
TEST(BladeSource, SharesAForceOutToTheCorners) {
  const GrownLeaf leaf = level_leaf("ovate", 0.1);
  const auto state = drawn_state(leaf.model);
  const CouplingSettings settings;
  for (int f = 0; f < static_cast<int>(leaf.faces.size()); ++f) {
    const Vec3 place = 0.5 * drawn(leaf.model, leaf.faces[f][0]) +
                       0.2 * drawn(leaf.model, leaf.faces[f][1]) +
                       0.3 * drawn(leaf.model, leaf.faces[f][2]);
    ColliderSet set;
    Collider ball;
    ball.name = "ball";
    ball.shape = std::make_shared<geometry::SphereDistance>(0.002);
    const Pose pose{place + Vec3(0, 0, 0.00205), Quat::Identity()};
    set.add(std::move(ball), pose);
    BladeSource source(set, settings, {leaf.faces[f]});
    source.begin_step(leaf.model, state, 0.004);
    std::vector<ContactPoint> found;
    source.find(leaf.model, state, 0.004, found);
    ASSERT_EQ(found.size(), 3u);
    double stiffness = 0.0;
    Vec3 middle = Vec3::Zero();
    for (const ContactPoint& point : found) {
      stiffness += point.stiffness;
      middle +=
          point.stiffness * drawn(leaf.model, {leaf.model.shapes[point.shape].element, point.back});
      EXPECT_NEAR(point.gap, 0.00205 - 0.002 - blade_half_thickness, 1e-6);
      EXPECT_NEAR(point.normal_W.z(), -1.0, 0.01);  // the ball is above: the leaf goes down
    }
    EXPECT_NEAR(stiffness, settings.contact_stiffness, 1e-9 * stiffness);
    EXPECT_LT((middle / stiffness - place).norm(), 2e-4);
  }
}

// A ball that goes down between the veins: past the leaf without blades, and with them the leaf
// goes down before it.
TEST(BladeSource, ABallPushesABladeThatVeinsLetItThrough) {
  constexpr double radius = 0.005, dt = 1.0 / 240.0, speed = 0.1;
  const GrownLeaf leaf = level_leaf("tomato", 0.15);
  const Vec3 hole = deepest_hole(leaf, radius + 0.002).place;
  for (const bool blades : {false, true}) {
    cosserat::RodSystem system{cosserat::RodSettings{}};
    system.add_plant(leaf.model);
    ColliderSet set;
    Collider ball;
    ball.name = "ball";
    ball.shape = std::make_shared<geometry::SphereDistance>(radius);
    const auto pose_at = [&](double time) {
      return Pose{hole + Vec3(0, 0, 0.012 - speed * time), Quat::Identity()};
    };
    set.add(std::move(ball), pose_at(0.0));
    const CouplingSettings settings;
    system.add_contact_source(0, std::make_unique<ColliderSource>(set, settings));
    if (blades)
      system.add_contact_source(0, std::make_unique<BladeSource>(set, settings, leaf.faces));
    double deepest = 0.0, force = 0.0;
    for (int i = 1; i <= 84; ++i) {
      const Pose pose = pose_at(i * dt);
      set.update(std::span(&pose, 1));
      system.step(dt, Vec3::Zero());
      force = 0.0;
      for (const cosserat::ContactForce& one : system.contact_forces(0))
        force += one.normal * one.point.normal_W.z() + one.tangential_W.z();
      for (const BladeFace& face : leaf.faces) {
        std::array<Vec3, 3> corners;
        for (int k = 0; k < 3; ++k)
          corners[k] = pose.inverse() * cosserat::point_on(system.model(0), system.state(0),
                                                           face[k].element, face[k].back);
        const geometry::SphereDistance field(radius);
        if (const auto at = nearest_on_triangle(field, corners, 0.0))
          deepest =
              std::max(deepest, -field.distance((*at)[0] * corners[0] + (*at)[1] * corners[1] +
                                                (*at)[2] * corners[2]));
      }
    }
    double lowest = 0.0;
    for (const Vec3& p : system.state(0).position) lowest = std::min(lowest, p.z());
    if (blades) {
      EXPECT_LT(deepest, 2e-4);
      EXPECT_LT(force, -1e-4);
      EXPECT_LT(lowest, -0.01);
    } else {
      EXPECT_GT(deepest, 0.9 * radius);
      EXPECT_EQ(force, 0.0);
      EXPECT_GT(lowest, -1e-3);
    }
  }
}

// What overlaps as drawn is left alone for good.
TEST(BladeSource, WhatOverlapsFromTheStartIsLeftAlone) {
  const GrownLeaf leaf = level_leaf("tomato", 0.15);
  const auto state = drawn_state(leaf.model);
  ColliderSet set;
  Collider post;
  post.name = "post";
  post.shape = std::make_shared<geometry::CylinderDistance>(0.01, 0.5);
  set.add(std::move(post), Pose{Vec3(0.1, 0.02, 0), Quat::Identity()});
  BladeSource source(set, CouplingSettings{}, leaf.faces);
  std::vector<ContactPoint> found;
  source.find(leaf.model, state, 0.0, found);
  EXPECT_FALSE(found.empty());
  source.ignore_touching(leaf.model, state);
  found.clear();
  source.find(leaf.model, state, 0.0, found);
  for (const ContactPoint& point : found) EXPECT_GT(point.gap, CouplingSettings{}.margin);
}

}  // namespace
}  // namespace pedicel::coupling
