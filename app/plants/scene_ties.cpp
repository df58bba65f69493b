#include "pedicel/app/plants/scene_ties.h"

#include <charconv>

#include "pedicel/app/plants/organ_places.h"
#include "pedicel/core/check.h"

namespace pedicel::app {

namespace {

// The number behind the name of a plant of the grid `name`; empty where it is none of it.
std::string number_in_grid(const std::string& plant, const std::string& name) {
  if (!plant.starts_with(name + "_")) return {};
  const std::string number = plant.substr(name.size() + 1);
  const bool digits = number.find_first_not_of("0123456789") == std::string::npos;
  return digits ? number : std::string();
}

}  // namespace

SceneTies::SceneTies(const std::vector<world::SceneTie>& ties, cosserat::RodSystem& rods,
                     Diagnostics& diagnostics)
    : rods_(rods) {
  if (!ties.empty() && rods_.solver() != cosserat::SolverKind::direct) {
    diagnostics.error(ties.front().where,
                      "ties with the position-based solver: expected the direct solver, "
                      "which alone has strings");
    return;
  }
  for (std::size_t i = 0; i < ties.size(); ++i) {
    const world::SceneTie& tie = ties[i];
    One one;
    one.name = "tie_" + std::to_string(i + 1);
    one.number = static_cast<int>(i);
    const std::size_t slash = tie.organ.find('/');
    const std::string plant = tie.organ.substr(0, slash);
    try {
      bool in_grid = false;
      for (int p = 0; p < rods_.size(); ++p) {
        const std::string number = number_in_grid(rods_.model(p).name, plant);
        if (number.empty()) continue;
        in_grid = true;
        One numbered = one;
        numbered.name.append("_").append(number);
        add(tie, rods_.model(p).name + tie.organ.substr(slash), numbered);
      }
      if (!in_grid) add(tie, tie.organ, one);
    } catch (const UsageError& error) {
      diagnostics.error(tie.where, error.what());
    }
  }
}

void SceneTies::add(const world::SceneTie& tie, const std::string& organ, One one) {
  const PlaceOnPlant place = find_organ_place(rods_, organ, tie.at);
  const Vec3 from = cosserat::point_on(rods_.model(place.plant), rods_.state(place.plant),
                                       place.element, place.back);
  cosserat::Tie held;
  held.element = place.element;
  held.back = place.back;
  held.anchor_W = tie.is_offset ? Vec3(from + tie.to) : tie.to;
  held.length = tie.length.value_or((held.anchor_W - from).norm());
  held.stiffness = tie.stiffness;
  one.plant = place.plant;
  one.slot = rods_.ties(place.plant).size();
  all_.push_back(std::move(one));
  rods_.ties(place.plant).push_back(held);
}

double SceneTies::tension(const One& one) const {
  return cosserat::tension(rods_.state(one.plant), rods_.ties(one.plant)[one.slot]);
}

std::optional<SceneTies::Course> SceneTies::course(const One& one) const {
  const cosserat::Tie& tie = rods_.ties(one.plant)[one.slot];
  const cosserat::RodState& state = rods_.state(one.plant);
  if (!state.alive[tie.element]) return {};
  Course course;
  course.from_W = cosserat::point_on(rods_.model(one.plant), state, tie.element, tie.back);
  course.to_W = tie.anchor_W;
  course.length = tie.length;
  course.tension = tension(one);
  return course;
}

}  // namespace pedicel::app
