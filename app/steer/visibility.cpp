#include "app/steer/visibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/check.h"
#include "engine/geometry/closest_point.h"
#include "plugins/simulation/place.h"
#include "plugins/simulation/plants/organ_places.h"

namespace pedicel::app {

namespace {

/// A line of sight: from the eye to a point of the fruit's near side.
struct Sight {
  Vec3 eye, to;
};

double distance_of(const Sight& sight, const Vec3& a, const Vec3& b, double& along) {
  const geometry::SegmentPair pair = geometry::closest_on_segments(sight.eye, sight.to, a, b);
  along = pair.t;
  return pair.distance;
}

bool meets_triangle(const Sight& sight, const Vec3& a, const Vec3& b, const Vec3& c) {
  // Moeller, Trumbore 1997.
  const Vec3 way = sight.to - sight.eye, e1 = b - a, e2 = c - a, p = way.cross(e2);
  const double det = e1.dot(p);
  if (std::abs(det) < 1e-15) return false;
  const Vec3 t = sight.eye - a, q = t.cross(e1);
  const double u = t.dot(p) / det, v = way.dot(q) / det, s = e2.dot(q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && s > 0.0 && s < 1.0;
}

struct Capsule {
  Vec3 a, b;
  double radius_a, radius_b;  // m
};
using Triangle = std::array<Vec3, 3>;

/// What may stand before a fruit: only what comes near the way to it.
class Obstacles {
 public:
  Obstacles(const simulation::Simulation& simulation, const Sight& axis, double radius)
      : simulation_(simulation), axis_(axis), radius_(radius) {}

  void add_plant(int plant, int own_fruit) {
    const cosserat::RodModel& model = simulation_.rods().model(plant);
    const cosserat::RodState& state = simulation_.rods().state(plant);
    for (int e = 0; e < model.size(); ++e) {
      // The stalk that carries the fruit ends in it.
      const bool carries = own_fruit >= 0 && model.fruits[own_fruit].element == e;
      if (state.alive[e] && !carries)
        add({cosserat::start_of(model, state, e), state.position[e], model.elements[e].radius_near,
             model.elements[e].radius_far});
    }
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      if (f == own_fruit || state.fruit_gone[f]) continue;
      const Vec3 centre =
          cosserat::point_on(model, state, model.fruits[f].element, model.fruits[f].back);
      add({centre, centre, model.fruits[f].radius, model.fruits[f].radius});
    }
    for (const simulation::Blade& blade : simulation_.plants()[plant].blades)
      add_blade(model, state, blade);
  }

  bool hide(const Sight& sight) const {
    for (const Capsule& one : capsules_) {
      double along = 0.0;
      const double distance = distance_of(sight, one.a, one.b, along);
      if (distance < one.radius_a + along * (one.radius_b - one.radius_a)) return true;
    }
    for (const Triangle& one : triangles_)
      if (meets_triangle(sight, one[0], one[1], one[2])) return true;
    return hidden_by_rigid(sight);
  }

  void leave_out(const std::string& body) { left_out_ = body; }

 private:
  void add(const Capsule& one) {
    double along = 0.0;
    if (distance_of(axis_, one.a, one.b, along) < radius_ + std::max(one.radius_a, one.radius_b))
      capsules_.push_back(one);
  }

  void add_blade(const cosserat::RodModel& model, const cosserat::RodState& state,
                 const simulation::Blade& blade) {
    Triangle one;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!state.alive[blade[i].element]) return;
      one[i] = cosserat::point_on(model, state, blade[i].element, blade[i].back);
    }
    const Vec3 middle = (one[0] + one[1] + one[2]) / 3.0;
    double reach = 0.0, along = 0.0;
    for (const Vec3& corner : one) reach = std::max(reach, (corner - middle).norm());
    if (distance_of(axis_, middle, middle, along) < radius_ + reach) triangles_.push_back(one);
  }

  // Sphere tracing through the distance fields that the plants feel.
  bool hidden_by_rigid(const Sight& sight) const {
    const Vec3 way = sight.to - sight.eye;
    const double length = way.norm();
    const coupling::ColliderSet& colliders = simulation_.colliders();
    for (int c = 0; c < colliders.size(); ++c) {
      if (colliders.collider(c).name == left_out_) continue;
      const coupling::Placement& at = colliders.placement(c);
      const Pose back = at.X_WC.inverse();
      const Vec3 origin = back * sight.eye, direction = back.rotation * way / length;
      const geometry::SignedDistance& shape = *colliders.collider(c).shape;
      for (double depth = 0.0; depth < length;) {
        const double clear = shape.distance(origin + depth * direction);
        if (clear < 2.0e-4) return true;  // m
        depth += clear;
      }
    }
    return false;
  }

  const simulation::Simulation& simulation_;
  Sight axis_;
  double radius_;
  std::string left_out_;
  std::vector<Capsule> capsules_;
  std::vector<Triangle> triangles_;
};

struct FruitPlace {
  int plant = 0, fruit = 0;
};

FruitPlace find_fruit_of(const simulation::Simulation& simulation, const std::string& name) {
  std::vector<std::string> names;
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      names.push_back(simulation::fruit_name(model, f));
      if (names.back() == name) return {p, f};
    }
  }
  throw UsageError("no fruit " + in_quotes(name) +
                   ", expected one of: " + simulation::list_of(names));
}

}  // namespace

double visible_share(const simulation::Simulation& simulation, const std::string& fruit,
                     const Vec3& eye_W) {
  const FruitPlace found = find_fruit_of(simulation, fruit);
  const cosserat::Fruit& one = simulation.rods().model(found.plant).fruits[found.fruit];
  world::Anchor anchor;
  anchor.kind = world::Anchor::Kind::fruit;
  anchor.name = fruit;
  const Vec3 centre = *simulation::place_of(simulation, anchor);
  Obstacles obstacles(simulation, {eye_W, centre}, one.radius);
  const bool off = simulation.rods().state(found.plant).fruit_gone[found.fruit];
  if (off) obstacles.leave_out(fruit);
  for (int p = 0; p < simulation.rods().size(); ++p)
    obstacles.add_plant(p, p == found.plant ? found.fruit : -1);

  const Vec3 view = (centre - eye_W).normalized();
  const Vec3 across = view.unitOrthogonal(), up = view.cross(across);
  constexpr int rays = 64;
  int seen = 0;
  for (int i = 0; i < rays; ++i) {
    // Even over the disc (a sunflower's seeds), lifted onto the near side of the sphere.
    const double distance = std::sqrt((i + 0.5) / rays);
    const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vec3 at = one.radius * (distance * (std::cos(turn) * across + std::sin(turn) * up) -
                                  std::sqrt(1.0 - distance * distance) * view);
    seen += !obstacles.hide({eye_W, centre + at});
  }
  return static_cast<double>(seen) / rays;
}

Vec3 camera_place(const simulation::Simulation& simulation, const std::string& camera) {
  std::vector<std::string> names;
  for (const world::SceneCamera& one : simulation.scene().cameras) {
    names.push_back(one.name);
    if (!camera.empty() && one.name != camera) continue;
    if (one.follow.kind == world::Anchor::Kind::none) return one.eye;
    return one.eye + simulation::place_of(simulation, one.follow).value_or(Vec3::Zero());
  }
  throw UsageError("no camera " + in_quotes(camera) +
                   ", expected one of: " + simulation::list_of(names));
}

}  // namespace pedicel::app
