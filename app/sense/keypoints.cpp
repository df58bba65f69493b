#include "app/sense/keypoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "plugins/simulation/place.h"

namespace pedicel::app {

namespace {

using Kind = Keypoint::Kind;

Keypoint keypoint(render::Label thing, Kind kind, const Vec3& position, double radius) {
  Keypoint one;
  one.thing = thing;
  one.kind = kind;
  one.position = position;
  one.radius = radius;
  return one;
}

/// Foot and tip of what is left of every stem, branch and stalk.
void add_stems(std::vector<Keypoint>& all, const simulation::Simulation& simulation,
               const NamedThings& things, int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const cosserat::RodState& state = simulation.rods().state(plant);
  std::vector<std::optional<Keypoint>> foot(model.organs.size()), tip(model.organs.size());
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    const cosserat::Element& element = model.elements[e];
    const render::Label label = things.organ(plant, element.organ);
    if (things.of(label).kind == ThingClass::leaf) continue;
    if (!foot[element.organ])
      foot[element.organ] =
          keypoint(label, Kind::foot, cosserat::start_of(model, state, e), element.radius_near);
    // Elements stand in the order of the curve, so the last one is its end.
    tip[element.organ] = keypoint(label, Kind::tip, state.position[e], element.radius_far);
  }
  for (std::size_t o = 0; o < foot.size(); ++o)
    if (foot[o]) all.push_back(*foot[o]), all.push_back(*tip[o]);
}

void add_fruits(std::vector<Keypoint>& all, const simulation::Simulation& simulation,
                const NamedThings& things, int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const cosserat::RodState& state = simulation.rods().state(plant);
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
    const cosserat::Fruit& fruit = model.fruits[f];
    const double stalk = model.elements[fruit.element].radius_near;
    Vec3 centre, attachment;
    if (!state.fruit_gone[f]) {
      centre = cosserat::point_on(model, state, fruit.element, fruit.back);
      attachment = cosserat::start_of(model, state, fruit.element);
    } else if (const auto fallen = simulation::fallen_fruit(simulation, plant, f);
               fallen && fallen->cut) {
      // It still hangs on its stalk, which is a part of the body that was cut off.
      centre = fallen->centre;
      const Pose body = simulation.world().body_pose(fallen->body);
      const auto carried = simulation.cutting().carried(plant, f);
      attachment = body * carried->stalk_B;
    } else {
      const auto& detached = simulation.plant_step().detached();
      const auto found = std::ranges::find_if(detached, [&](const simulation::Detached& one) {
        return one.plant == plant && one.event.fruit == f;
      });
      if (found == detached.end() || found->body < 0) continue;
      const Pose pose = simulation.world().body_pose(found->body);
      centre = pose.position;
      attachment = pose * Vec3(0, 0, -std::max(found->event.stub_length, fruit.radius));
    }
    all.push_back(keypoint(things.fruit(plant, f), Kind::centre, centre, fruit.radius));
    all.push_back(keypoint(things.fruit(plant, f), Kind::attachment, attachment, stalk));
  }
}

}  // namespace

std::string_view name_of(Keypoint::Kind kind) {
  constexpr std::array<std::string_view, 4> names = {"centre", "attachment", "foot", "tip"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<Keypoint> keypoints_of(const simulation::Simulation& simulation,
                                   const NamedThings& things) {
  std::vector<Keypoint> all;
  for (int p = 0; p < simulation.rods().size(); ++p) {
    add_stems(all, simulation, things, p);
    add_fruits(all, simulation, things, p);
  }
  std::ranges::stable_sort(all, {}, &Keypoint::thing);
  return all;
}

void look_at(std::vector<Keypoint>& keypoints, const CameraMatrices& camera,
             const render::LabelMap& map) {
  for (Keypoint& one : keypoints) {
    const Vec3 seen = camera.project(one.position);
    one.u = seen.x(), one.v = seen.y(), one.depth = seen.z();
    one.visibility = Keypoint::Visibility::outside;
    const double x = std::floor(one.u), y = std::floor(one.v);
    if (!(one.depth > 0.0) || !(x >= 0.0 && x < map.width && y >= 0.0 && y < map.height)) continue;
    const double surface = map.depth[map.index(static_cast<int>(x), static_cast<int>(y))];
    const bool clear = surface >= one.depth - 1.1 * one.radius - keypoint_slack;
    one.visibility = clear ? Keypoint::Visibility::seen : Keypoint::Visibility::hidden;
  }
}

}  // namespace pedicel::app
