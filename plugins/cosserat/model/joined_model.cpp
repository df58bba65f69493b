#include "plugins/cosserat/model/joined_model.h"

#include <algorithm>
#include <iterator>

#include "engine/core/check.h"

namespace pedicel::cosserat {

namespace {

// The part that a number belongs to, where each part begins with the number in its field `first`.
int part_with(const std::vector<JoinedModel::Part>& parts, int number,
              int JoinedModel::Part::*first) {
  const auto behind = std::ranges::upper_bound(parts, number, {}, first);
  return static_cast<int>(std::distance(parts.begin(), behind)) - 1;
}

// What a model has one of, for all of its extensions.
struct Shared {
  const char* name;
  double RodModel::*value;
};
constexpr Shared shared_values[] = {{"gust frequency", &RodModel::gust_frequency},
                                    {"stiffness drift", &RodModel::stiffness_drift},
                                    {"clock", &RodModel::clock}};

}  // namespace

JoinedModel::JoinedModel(std::span<const RodModel* const> plants) {
  model_.name = "canopy";
  for (const RodModel* plant : plants) add(*plant);
  add_air_and_laws(plants);
  add_shapes(plants);
  branches_ = branch_count(model_);
}

void JoinedModel::add(const RodModel& plant) {
  Part part;
  part.first_element = model_.size();
  part.elements = plant.size();
  part.first_organ = static_cast<int>(model_.organs.size());
  part.first_fruit = static_cast<int>(model_.fruits.size());
  part.fruits = static_cast<int>(plant.fruits.size());
  part.branches = branch_count(plant);
  const int e = part.first_element;
  for (Element element : plant.elements) {
    if (element.parent >= 0) element.parent += e;
    element.organ += part.first_organ;
    model_.elements.push_back(element);
  }
  model_.organs.insert(model_.organs.end(), plant.organs.begin(), plant.organs.end());
  for (PointMass mass : plant.masses) {
    mass.element += e;
    model_.masses.push_back(mass);
  }
  for (Fruit fruit : plant.fruits) {
    fruit.element += e;
    model_.fruits.push_back(fruit);
  }
  for (Weld weld : plant.welds) {
    weld.a += e;
    weld.b += e;
    model_.welds.push_back(weld);
  }
  parts_.push_back(part);
}

void JoinedModel::add_air_and_laws(std::span<const RodModel* const> plants) {
  const RodModel* first = nullptr;
  bool laws = false, air = false;
  for (const RodModel* plant : plants) {
    laws = laws || !plant->laws.empty();
    air = air || !plant->air.empty();
    if (!is_extended(*plant)) continue;
    if (!first) first = plant;
    for (const Shared& one : shared_values)
      if (plant->*one.value != first->*one.value)
        throw UsageError("plants that touch or hold each other: the " + std::string(one.name) +
                         " of \"" + plant->name + "\" is not that of \"" + first->name +
                         "\": must be the same");
  }
  if (first)
    for (const Shared& one : shared_values) model_.*one.value = first->*one.value;
  for (const RodModel* plant : plants) {
    const auto count = plant->elements.size();
    if (laws && plant->laws.empty()) model_.laws.resize(model_.laws.size() + count);
    if (air && plant->air.empty()) model_.air.resize(model_.air.size() + count);
    model_.laws.insert(model_.laws.end(), plant->laws.begin(), plant->laws.end());
    model_.air.insert(model_.air.end(), plant->air.begin(), plant->air.end());
  }
}

// The first shapes of a plant are those of its elements (RodModel::shapes).
void JoinedModel::add_shapes(std::span<const RodModel* const> plants) {
  const auto take = [&](std::size_t p, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      CollisionShape shape = plants[p]->shapes[i];
      shape.element += parts_[p].first_element;
      if (shape.fruit >= 0) shape.fruit += parts_[p].first_fruit;
      model_.shapes.push_back(shape);
    }
  };
  for (std::size_t p = 0; p < plants.size(); ++p) take(p, 0, plants[p]->elements.size());
  for (std::size_t p = 0; p < plants.size(); ++p)
    take(p, plants[p]->elements.size(), plants[p]->shapes.size());
}

void JoinedModel::read_supports(std::span<const RodModel* const> plants) {
  model_.supports.clear();
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (Support support : plants[p]->supports) {
      support.element += parts_[p].first_element;
      model_.supports.push_back(support);
    }
}

int JoinedModel::part_of_element(int element) const {
  return part_with(parts_, element, &Part::first_element);
}

JoinedModel::Shape JoinedModel::part_of_shape(int shape) const {
  if (shape < model_.size()) {
    const int plant = part_of_element(shape);
    return {plant, shape - parts_[plant].first_element};
  }
  // One a fruit. A part without fruits begins with the number of the next one, which is taken.
  const int fruit = shape - model_.size();
  const int plant = part_with(parts_, fruit, &Part::first_fruit);
  return {plant, parts_[plant].elements + fruit - parts_[plant].first_fruit};
}

int JoinedModel::shape(int plant, int shape) const {
  const Part& part = parts_[plant];
  return shape < part.elements ? part.first_element + shape
                               : model_.size() + part.first_fruit + shape - part.elements;
}

void JoinedModel::gather(int plant, const RodState& from, RodState& joined) const {
  const Part& part = parts_[plant];
  const auto n = model_.elements.size();
  joined.position.resize(n);
  joined.orientation.resize(n, Quat::Identity());
  joined.velocity.resize(n);
  joined.angular_velocity.resize(n);
  joined.alive.resize(n);
  joined.fruit_gone.resize(model_.fruits.size());
  const auto at = [&](auto& values) { return values.begin() + part.first_element; };
  std::ranges::copy(from.position, at(joined.position));
  std::ranges::copy(from.orientation, at(joined.orientation));
  std::ranges::copy(from.velocity, at(joined.velocity));
  std::ranges::copy(from.angular_velocity, at(joined.angular_velocity));
  std::ranges::copy(from.alive, at(joined.alive));
  std::copy(from.fruit_gone.begin(), from.fruit_gone.end(),
            joined.fruit_gone.begin() + part.first_fruit);
  if (model_.laws.empty()) return;
  joined.joint_bias.resize(n, Vec3::Zero());
  joined.joint_memory.resize(n * branches_, Vec3::Zero());
  std::ranges::copy(from.joint_bias, at(joined.joint_bias));
  for (int e = 0; e < part.elements && !from.joint_memory.empty(); ++e)
    std::copy_n(from.joint_memory.begin() + e * part.branches, part.branches,
                joined.joint_memory.begin() + (part.first_element + e) * branches_);
}

void JoinedModel::scatter_poses(int plant, const RodState& joined, RodState& to) const {
  const Part& part = parts_[plant];
  to.position.resize(part.elements);
  to.orientation.resize(part.elements, Quat::Identity());
  std::copy_n(joined.position.begin() + part.first_element, part.elements, to.position.begin());
  std::copy_n(joined.orientation.begin() + part.first_element, part.elements,
              to.orientation.begin());
}

void JoinedModel::scatter(int plant, const RodState& joined, RodState& to) const {
  const Part& part = parts_[plant];
  scatter_poses(plant, joined, to);
  std::copy_n(joined.velocity.begin() + part.first_element, part.elements, to.velocity.begin());
  std::copy_n(joined.angular_velocity.begin() + part.first_element, part.elements,
              to.angular_velocity.begin());
  for (int e = 0; e < part.elements && !to.joint_memory.empty(); ++e)
    std::copy_n(joined.joint_memory.begin() + (part.first_element + e) * branches_, part.branches,
                to.joint_memory.begin() + e * part.branches);
  to.time = joined.time;
  to.previous_dt = joined.previous_dt;
  to.previous_root = to.root;
}

}  // namespace pedicel::cosserat
