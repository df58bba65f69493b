#include "app/session/live/organ_place.h"

#include <algorithm>

#include "app/session/live/pull.h"

namespace pedicel::app {

namespace {

std::optional<PullPlace> place_in_stem(const cosserat::RodModel& model, int plant, int organ,
                                       double at) {
  double length = 0.0;
  for (const cosserat::Element& e : model.elements)
    if (e.organ == organ) length += e.length;
  std::optional<PullPlace> place;
  double left = std::clamp(at, 0.0, 1.0) * length;
  for (int e = 0; e < model.size(); ++e) {
    if (model.elements[e].organ != organ) continue;
    const double here = model.elements[e].length;
    place = PullPlace{plant, e, std::max(0.0, here - left)};
    if (left <= here) break;
    left -= here;
  }
  return place;
}

}  // namespace

std::optional<PullPlace> find_organ(const Snapshot& snapshot, const std::string& organ, double at) {
  for (std::size_t p = 0; p < snapshot.plants.size(); ++p) {
    const cosserat::RodModel& model = *snapshot.plants[p].model;
    for (const cosserat::Fruit& fruit : model.fruits)
      if (model.name + "/" + fruit.name == organ)
        return PullPlace{static_cast<int>(p), fruit.element, fruit.back};
    const auto found = std::find(model.organs.begin(), model.organs.end(), organ);
    if (found == model.organs.end()) continue;
    return place_in_stem(model, static_cast<int>(p), static_cast<int>(found - model.organs.begin()),
                         at);
  }
  return std::nullopt;
}

std::optional<Vec3> place_of(const Snapshot& snapshot, const world::Anchor& anchor) {
  using Kind = world::Anchor::Kind;
  if (anchor.kind == Kind::tool && snapshot.robot.present) return snapshot.robot.tool.position;
  // A fruit that has come off is a body.
  if (anchor.kind == Kind::body || anchor.kind == Kind::fruit)
    for (const BodySnapshot& body : snapshot.bodies)
      if (body.info->description.name == anchor.name) return body.pose.position;
  for (const PlantSnapshot& plant : snapshot.plants) {
    if (anchor.kind == Kind::plant && plant.model->name == anchor.name)
      return plant.model->root.position;
    if (anchor.kind != Kind::fruit) continue;
    for (const cosserat::Fruit& fruit : plant.model->fruits)
      if (plant.model->name + "/" + fruit.name == anchor.name)
        return point_on(*plant.model, plant.state, fruit.element, fruit.back);
  }
  return std::nullopt;
}

std::optional<Vec3> place_of_break(const Snapshot& snapshot, const world::Event& event) {
  for (const PlantSnapshot& plant : snapshot.plants) {
    const cosserat::RodModel& model = *plant.model;
    for (const cosserat::Fruit& fruit : model.fruits) {
      if (model.name + "/" + fruit.name != event.organ) continue;
      int e = fruit.element;
      while (e >= 0 && !plant.state.alive[static_cast<std::size_t>(e)])
        e = model.elements[static_cast<std::size_t>(e)].parent;
      if (e < 0) return model.root.position;
      return plant.state.position[static_cast<std::size_t>(e)];
    }
  }
  return std::nullopt;
}

std::string organ_names(const Snapshot& snapshot) {
  constexpr std::size_t shown = 12;
  std::vector<std::string> names;
  for (const PlantSnapshot& plant : snapshot.plants) {
    for (const cosserat::Fruit& fruit : plant.model->fruits)
      names.push_back(plant.model->name + "/" + fruit.name);
    names.insert(names.end(), plant.model->organs.begin(), plant.model->organs.end());
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    text += (i ? ", " : "") + names[i];
  return text + (names.size() > shown ? ", ..." : "");
}

}  // namespace pedicel::app
