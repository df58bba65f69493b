#include "plugins/simulation/plants/scene_ties.h"

#include <algorithm>
#include <limits>

#include "engine/core/check.h"
#include "plugins/simulation/plants/organ_places.h"

namespace pedicel::simulation {

namespace {

// The number behind the name of a plant of the grid `name`; empty where it is none of it.
std::string number_in_grid(const std::string& plant, const std::string& name) {
  if (!plant.starts_with(name + "_")) return {};
  const std::string number = plant.substr(name.size() + 1);
  const bool digits = number.find_first_not_of("0123456789") == std::string::npos;
  return digits ? number : std::string();
}

// "wire/wire" of the grid `wire` is "wire_3/wire" for what is tied to it with the number 3.
std::string of_number(const cosserat::RodSystem& rods, const std::string& organ,
                      const std::string& number) {
  const std::size_t slash = organ.find('/');
  const std::string numbered = organ.substr(0, slash) + "_" + number;
  for (int p = 0; p < rods.size() && !number.empty() && slash != std::string::npos; ++p)
    if (rods.model(p).name == numbered) return numbered + organ.substr(slash);
  return organ;
}

// Of an organ as it stands: the place nearest to a point.
PlaceOnPlant nearest_on(const cosserat::RodSystem& rods, const std::string& organ,
                        const Vec3& to_W) {
  PlaceOnPlant nearest = find_organ_place(rods, organ, 0.0);
  const cosserat::RodModel& model = rods.model(nearest.plant);
  const auto found = std::ranges::find(model.organs, organ);
  if (found == model.organs.end()) return nearest;  // a fruit has one place
  double least = std::numeric_limits<double>::infinity();
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[e];
    if (element.organ != found - model.organs.begin()) continue;
    const Vec3 end = rods.state(nearest.plant).position[e];
    const Vec3 axis = rods.state(nearest.plant).orientation[e] * Vec3::UnitZ();
    const double back = std::clamp((end - to_W).dot(axis), 0.0, element.length);
    const double off = (end - back * axis - to_W).norm();
    if (off >= least) continue;
    least = off;
    nearest.element = e, nearest.back = back;
  }
  return nearest;
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
        add(tie, rods_.model(p).name + tie.organ.substr(slash), number, numbered);
      }
      if (!in_grid) add(tie, tie.organ, "", one);
    } catch (const UsageError& error) {
      diagnostics.error(tie.where, error.what());
    }
  }
  if (rods_.strings().empty()) return;
  try {  // a step that joins them must not throw
    std::vector<const cosserat::RodModel*> models;
    for (int p = 0; p < rods_.size(); ++p) models.push_back(&rods_.model(p));
    const cosserat::JoinedModel joined(models);
  } catch (const UsageError& error) {
    diagnostics.error(ties.front().where, error.what());
  }
}

Vec3 SceneTies::now(const PlaceOnPlant& place) const {
  return cosserat::point_on(rods_.model(place.plant), rods_.state(place.plant), place.element,
                            place.back);
}

void SceneTies::add(const world::SceneTie& tie, const std::string& organ, const std::string& number,
                    One one) {
  const PlaceOnPlant place = find_organ_place(rods_, organ, tie.at);
  const Vec3 from = now(place);
  one.plant = place.plant;
  one.is_between = !tie.to_organ.empty();
  if (one.is_between) {
    const std::string other = of_number(rods_, tie.to_organ, number);
    const PlaceOnPlant end =
        tie.to_at ? find_organ_place(rods_, other, *tie.to_at) : nearest_on(rods_, other, from);
    if (end.plant == place.plant && end.element == place.element)
      throw UsageError("a tie from " + in_quotes(organ) + " to " + in_quotes(other) +
                       ": both ends are on one segment, expected two places");
    cosserat::PlantString string;
    string.a = {place.plant, place.element, place.back};
    string.b = {end.plant, end.element, end.back};
    const Vec3 way = *cosserat::place_of(rods_, string.b) - *cosserat::place_of(rods_, string.a);
    string.length = tie.length.value_or(way.norm());
    string.stiffness = tie.stiffness;
    one.slot = static_cast<std::size_t>(rods_.add_string(string));
  } else {
    cosserat::Tie held;
    held.element = place.element;
    held.back = place.back;
    held.anchor_W = tie.is_offset ? Vec3(from + tie.to) : tie.to;
    held.length = tie.length.value_or((held.anchor_W - from).norm());
    held.stiffness = tie.stiffness;
    one.slot = rods_.ties(place.plant).size();
    rods_.ties(place.plant).push_back(held);
  }
  all_.push_back(std::move(one));
}

double SceneTies::tension(const One& one) const {
  if (one.is_between) return cosserat::tension(rods_, rods_.strings()[one.slot]);
  return cosserat::tension(rods_.state(one.plant), rods_.ties(one.plant)[one.slot]);
}

std::optional<SceneTies::Course> SceneTies::course(const One& one) const {
  Course course;
  if (one.is_between) {
    const cosserat::PlantString& string = rods_.strings()[one.slot];
    const auto from = cosserat::place_of(rods_, string.a), to = cosserat::place_of(rods_, string.b);
    if (!from || !to) return {};
    course = {*from, *to, string.length, 0.0};
  } else {
    const cosserat::Tie& tie = rods_.ties(one.plant)[one.slot];
    if (!rods_.state(one.plant).alive[tie.element]) return {};
    course = {now({one.plant, tie.element, tie.back}), tie.anchor_W, tie.length, 0.0};
  }
  course.tension = tension(one);
  return course;
}

}  // namespace pedicel::simulation
