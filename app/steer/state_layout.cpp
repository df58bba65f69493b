#include "app/steer/state_layout.h"

#include <algorithm>

#include "engine/core/check.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

namespace {

std::vector<std::string>& names_of(StateLayout& layout, Rows kind) {
  return layout.names[static_cast<int>(kind)];
}

void add_plant(StateLayout& layout, const cosserat::RodModel& model) {
  const int segments = layout.rows(Rows::segment), organs = layout.rows(Rows::organ);
  layout.first_segment.push_back(segments);
  layout.first_organ.push_back(organs);
  layout.first_fruit.push_back(layout.rows(Rows::fruit));
  for (const cosserat::Element& element : model.elements) {
    layout.segment_organ.push_back(organs + element.organ);
    layout.segment_parent.push_back(element.parent < 0 ? -1 : segments + element.parent);
    names_of(layout, Rows::segment).push_back(model.organs[element.organ]);
  }
  for (const std::string& organ : model.organs) names_of(layout, Rows::organ).push_back(organ);
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    names_of(layout, Rows::fruit).push_back(simulation::fruit_name(model, static_cast<int>(f)));
}

// Colliders of one link or body are one row. Fruits that fall become colliders later on.
void add_touching(StateLayout& layout, const coupling::ColliderSet& colliders) {
  std::vector<std::string>& names = names_of(layout, Rows::touching);
  for (int c = 0; c < colliders.size(); ++c) {
    const std::string& name = colliders.collider(c).name;
    const auto found = std::ranges::find(names, name);
    layout.touching_of.push_back(static_cast<int>(found - names.begin()));
    if (found == names.end()) names.push_back(name);
  }
}

}  // namespace

StateLayout::StateLayout(const simulation::Simulation& simulation) {
  names_of(*this, Rows::one).emplace_back();
  for (int p = 0; p < simulation.rods().size(); ++p) add_plant(*this, simulation.rods().model(p));
  first_segment.push_back(rows(Rows::segment));
  first_fruit.push_back(rows(Rows::fruit));
  first_organ.push_back(rows(Rows::organ));
  if (const simulation::RobotControl* robot = simulation.robot()) {
    names_of(*this, Rows::joint) = robot->robot().model().joint_names();
    for (const robot::Link& link : robot->description().links)
      names_of(*this, Rows::link).push_back(link.name);
  }
  for (const world::BodyDescription& body : simulation.scene().bodies)
    names_of(*this, Rows::body).push_back(body.name);
  add_touching(*this, simulation.colliders());
}

}  // namespace pedicel::app
