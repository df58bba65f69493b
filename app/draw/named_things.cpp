#include "app/draw/named_things.h"

#include <array>

namespace pedicel::app {

namespace {

/// The leaf that a blade belongs to: two of its corners lie on it, since one may lie on what the
/// leaf grows from.
int leaf_of(const cosserat::RodModel& model, const simulation::Blade& blade) {
  const int a = model.elements[static_cast<std::size_t>(blade[0].element)].organ;
  const int b = model.elements[static_cast<std::size_t>(blade[1].element)].organ;
  const int c = model.elements[static_cast<std::size_t>(blade[2].element)].organ;
  return b == c ? b : a;
}

std::vector<ThingClass> classes_of(const cosserat::RodModel& model,
                                   const std::vector<simulation::Blade>& blades) {
  std::vector<ThingClass> kinds(model.organs.size(), ThingClass::branch);
  std::vector<char> carries_organ(model.organs.size(), 0), clamped(model.organs.size(), 0);
  for (const cosserat::Element& element : model.elements) {
    const auto organ = static_cast<std::size_t>(element.organ);
    if (element.parent < 0) {
      clamped[organ] = 1;
      continue;
    }
    const int below = model.elements[static_cast<std::size_t>(element.parent)].organ;
    if (below != element.organ) carries_organ[static_cast<std::size_t>(below)] = 1;
  }
  for (const cosserat::Support& support : model.supports)
    clamped[static_cast<std::size_t>(
        model.elements[static_cast<std::size_t>(support.element)].organ)] = 1;
  for (const cosserat::Fruit& fruit : model.fruits) {
    const auto organ =
        static_cast<std::size_t>(model.elements[static_cast<std::size_t>(fruit.element)].organ);
    if (!carries_organ[organ]) kinds[organ] = ThingClass::stalk;
  }
  for (std::size_t o = 0; o < kinds.size(); ++o)
    if (clamped[o]) kinds[o] = ThingClass::stem;
  for (const simulation::Blade& blade : blades)
    kinds[static_cast<std::size_t>(leaf_of(model, blade))] = ThingClass::leaf;
  return kinds;
}

}  // namespace

std::string_view name_of(ThingClass kind) {
  constexpr std::array<std::string_view, thing_classes> names = {
      "background", "stem", "branch", "leaf", "fruit", "stalk", "robot", "body", "ground"};
  return names[static_cast<std::size_t>(kind)];
}

NamedThings::NamedThings(const simulation::Simulation& simulation) {
  add("background", ThingClass::background);
  for (int p = 0; p < simulation.rods().size(); ++p) add_plant(simulation, p);
  first_link_ = static_cast<render::Label>(things_.size());
  if (const simulation::RobotControl* robot = simulation.robot())
    for (const robot::Link& link : robot->description().links)
      add(robot->name() + "/" + link.name, ThingClass::robot);
  first_body_ = static_cast<render::Label>(things_.size());
  for (const world::BodyDescription& body : simulation.scene().bodies)
    add(body.name, ThingClass::body);
  ground_ = add("ground", ThingClass::ground);
}

void NamedThings::add_plant(const simulation::Simulation& simulation, int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const simulation::PlantInfo& info = simulation.plants()[static_cast<std::size_t>(plant)];
  const std::vector<ThingClass> kinds = classes_of(model, info.blades);
  first_organ_.push_back(static_cast<render::Label>(things_.size()));
  for (std::size_t o = 0; o < kinds.size(); ++o) add(model.organs[o], kinds[o], model.name);
  first_fruit_.push_back(static_cast<render::Label>(things_.size()));
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
    add(simulation::fruit_name(model, f), ThingClass::fruit, model.name);
}

render::Label NamedThings::add(std::string name, ThingClass kind, std::string plant) {
  things_.push_back({std::move(name), kind, std::move(plant)});
  return static_cast<render::Label>(things_.size() - 1);
}

render::Label NamedThings::stub(const cosserat::RodModel& model, int plant, int fruit) const {
  const int element = model.fruits[static_cast<std::size_t>(fruit)].element;
  const render::Label stalk = organ(plant, model.elements[static_cast<std::size_t>(element)].organ);
  return of(stalk).kind == ThingClass::stalk ? stalk : this->fruit(plant, fruit);
}

}  // namespace pedicel::app
