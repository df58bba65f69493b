#include "app/ui/selection_follow.h"

#include <algorithm>

#include "app/session/live/organ_place.h"
#include "app/ui/ui.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

bool same_models(const Snapshot& a, const Snapshot& b) {
  const auto same_model = [](const PlantSnapshot& p, const PlantSnapshot& q) {
    return p.model == q.model;
  };
  const auto same_body = [](const BodySnapshot& p, const BodySnapshot& q) {
    return p.info == q.info;
  };
  return a.assets == b.assets && std::ranges::equal(a.plants, b.plants, same_model) &&
         std::ranges::equal(a.bodies, b.bodies, same_body);
}

Selection element_again(Selection found, const Snapshot& before, const Snapshot& after) {
  const auto& model = *before.plants[static_cast<std::size_t>(found.plant)].model;
  const auto at =
      find_organ(after, describe(found, before), share_along(model, found.element, found.back));
  if (!at) return {};
  found.plant = at->plant, found.element = at->element, found.back = at->back;
  return found;
}

Selection fruit_on_plant(Selection found, const std::string& name, const Snapshot& after) {
  for (std::size_t p = 0; p < after.plants.size(); ++p) {
    const cosserat::RodModel& model = *after.plants[p].model;
    for (std::size_t f = 0; f < model.fruits.size(); ++f) {
      if (after.plants[p].state.fruit_gone[f] ||
          simulation::fruit_name(model, static_cast<int>(f)) != name)
        continue;
      found.kind = Kind::fruit;
      found.plant = static_cast<int>(p), found.fruit = static_cast<int>(f);
      found.element = model.fruits[f].element, found.back = model.fruits[f].back;
      found.body = -1;
      return found;
    }
  }
  return {};
}

Selection body_named(Selection found, const std::string& name, const Snapshot& after) {
  for (std::size_t b = 0; b < after.bodies.size(); ++b) {
    if (after.bodies[b].info->description.name != name) continue;
    found.kind = Kind::body;
    found.body = static_cast<int>(b);
    found.plant = found.fruit = found.element = -1;
    return found;
  }
  return {};
}

Selection link_named(Selection found, const std::string& name, const Snapshot& after) {
  if (!after.assets || !after.assets->robot) return {};
  const auto& links = after.assets->robot->links;
  const auto at = std::ranges::find_if(links, [&](const auto& one) { return one.name == name; });
  if (at == links.end()) return {};
  found.link = static_cast<int>(at - links.begin());
  return found;
}

bool names_an_element(const Selection& s, const Snapshot& snapshot) {
  return s.plant >= 0 && s.plant < static_cast<int>(snapshot.plants.size()) && s.element >= 0 &&
         s.element < snapshot.plants[static_cast<std::size_t>(s.plant)].model->size();
}

bool is_gone(const Selection& s, const Snapshot& snapshot) {
  if (s.plant < 0 || s.plant >= static_cast<int>(snapshot.plants.size())) return false;
  const auto& gone = snapshot.plants[static_cast<std::size_t>(s.plant)].state.fruit_gone;
  return s.fruit >= 0 && s.fruit < static_cast<int>(gone.size()) &&
         gone[static_cast<std::size_t>(s.fruit)];
}

}  // namespace

double share_along(const cosserat::RodModel& model, int element, double back) {
  const int organ = model.elements[static_cast<std::size_t>(element)].organ;
  double length = 0.0, before = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& one = model.elements[static_cast<std::size_t>(e)];
    if (one.organ != organ) continue;
    if (e <= element) before = length + one.length - (e == element ? back : 0.0);
    length += one.length;
  }
  return length > 0.0 ? std::clamp(before / length, 0.0, 1.0) : 0.0;
}

Selection follow_selection(const Selection& selection, const Snapshot& before,
                           const Snapshot& after) {
  const bool falls = selection.kind == Kind::fruit && is_gone(selection, after);
  if (!falls && same_models(before, after)) return selection;
  switch (selection.kind) {
    case Kind::element:
      return names_an_element(selection, before) ? element_again(selection, before, after)
                                                 : Selection{};
    case Kind::fruit:
    case Kind::body: {
      const std::string name = describe(selection, before);
      const Selection hanging = fruit_on_plant(selection, name, after);
      return hanging ? hanging : body_named(selection, name, after);
    }
    case Kind::link:
      return link_named(selection, describe(selection, before), after);
    default:
      return selection;  // of the document, by name
  }
}

Selection select_organ(const std::string& organ, const Snapshot& snapshot) {
  if (const Selection fruit = fruit_on_plant({}, organ, snapshot)) return fruit;
  if (const Selection body = body_named({}, organ, snapshot)) return body;
  const auto at = find_organ(snapshot, organ, 0.5);
  Selection found;
  if (!at) return found;
  found.kind = Kind::element;
  found.plant = at->plant, found.element = at->element, found.back = at->back;
  return found;
}

std::optional<Vec3> place_of(const Selection& s, const Snapshot& snapshot) {
  const auto on_plant = [&](int plant, int element, double back) {
    const PlantSnapshot& one = snapshot.plants[static_cast<std::size_t>(plant)];
    return point_on(*one.model, one.state, element, back);
  };
  switch (s.kind) {
    case Kind::fruit:
      if (!names_an_element(s, snapshot) || is_gone(s, snapshot)) return {};
      return on_plant(s.plant, s.element, s.back);
    case Kind::element:
      if (!names_an_element(s, snapshot)) return {};
      return on_plant(s.plant, s.element, s.back);
    case Kind::curve:
    case Kind::curve_point:
      if (const auto at = find_organ(snapshot, s.plant_name + "/" + s.curve, 0.5))
        return on_plant(at->plant, at->element, at->back);
      return {};
    case Kind::body:
      if (s.body < 0 || s.body >= static_cast<int>(snapshot.bodies.size())) return {};
      return snapshot.bodies[static_cast<std::size_t>(s.body)].pose.position;
    case Kind::link:
      if (s.link < 0 || s.link >= static_cast<int>(snapshot.robot.links.size())) return {};
      return snapshot.robot.links[static_cast<std::size_t>(s.link)].position;
    case Kind::tie:
      for (const TieSnapshot& tie : snapshot.ties)
        if (tie.number == s.tie) return tie.course.from_W;
      return {};
    default:
      return {};
  }
}

int chosen_organ(const Selection& s, const cosserat::RodModel& model, int plant) {
  if (s.kind == Kind::element && s.plant == plant && s.element >= 0 && s.element < model.size())
    return model.elements[static_cast<std::size_t>(s.element)].organ;
  if (s.kind != Kind::curve && s.kind != Kind::curve_point) return -1;
  if (s.plant_name != model.name) return -1;
  const auto found = std::ranges::find(model.organs, s.plant_name + "/" + s.curve);
  return found == model.organs.end() ? -1 : static_cast<int>(found - model.organs.begin());
}

}  // namespace pedicel::app
