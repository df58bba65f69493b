#include "app/draw/plant_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/render/colormap.h"

namespace pedicel::app {

namespace {

using cosserat::Element;
using cosserat::RodModel;
using cosserat::RodState;
using render::Colour;
using render::DrawList;
using render::TubePoint;

constexpr double knuckle_size = 1.5;   // of the stalk's radius
constexpr double knuckle_limit = 0.4;  // of the fruit's radius: thicker is a stem, not a stalk

Colour mean(const Colour& a, const Colour& b) {
  return {0.5f * (a.r + b.r), 0.5f * (a.g + b.g), 0.5f * (a.b + b.b)};
}

/// The element that goes on with the same organ from an element's child node; -1: none does. Other
/// elements that start there begin a tube of their own.
std::vector<int> continuations(const RodModel& model, const RodState& state) {
  std::vector<int> next(model.elements.size(), -1);
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    if (element.parent < 0 || !state.alive[e] || !state.alive[element.parent]) continue;
    int& place = next[element.parent];
    if (place < 0 && model.elements[element.parent].organ == element.organ) place = e;
  }
  return next;
}

/// The centreline of a tube: where `first` starts, then one point a child node.
std::vector<TubePoint> chain(const RodModel& model, const RodState& state, int first,
                             const std::vector<int>& next, const std::vector<Colour>& colours) {
  std::vector<TubePoint> points = {
      {start_of(model, state, first), model.elements[first].radius_near, colours[first]}};
  for (int e = first; e >= 0; e = next[e]) {
    TubePoint point{state.position[e], model.elements[e].radius_far, colours[e]};
    if (const int after = next[e]; after >= 0) {
      point.radius = 0.5 * (point.radius + model.elements[after].radius_near);
      point.colour = mean(point.colour, colours[after]);
    }
    points.push_back(point);
  }
  return points;
}

/// Half extents of a flat bar in its element's frame, m; nothing where it is round. A rectangle's
/// radius is half of its smaller extent, which lies along axis 1; a round stem's moment of inertia
/// is another one.
std::optional<Vec3> bar_of(const Element& element) {
  constexpr double slack = 1e-6;  // of the radius
  const double radius = element.radius_near;
  if (!(radius > 0.0) || element.radius_far != radius || !(element.section.mass > 0.0)) return {};
  const double half1 = std::sqrt(3.0 * element.section.inertia2 / element.section.mass);
  if (std::abs(half1 - radius) > slack * radius) return {};
  const double half2 = std::sqrt(3.0 * element.section.inertia1 / element.section.mass);
  return Vec3(half1, half2, 0.5 * element.length);
}

/// Whether it was one.
bool add_bar(DrawList& list, const RodModel& model, const RodState& state, int e,
             const render::Shading& material, const Colour& colour) {
  const auto half = bar_of(model.elements[static_cast<std::size_t>(e)]);
  if (!half) return false;
  render::Shading look = material;
  look.colour = colour;
  const Vec3 middle = 0.5 * (start_of(model, state, e) + state.position[e]);
  list.boxes.push_back({{middle, state.orientation[e]}, *half, look});
  return true;
}

}  // namespace

PlantLook PlantLook::apple() {
  PlantLook look;
  look.stem = render::shadings::wood;
  look.blade.colour = Colour::hex(0x47763a);
  look.vein = {Colour::hex(0x6b7d45), 0.7f, 0.25f};
  look.fruit = FruitLook::apple();
  return look;
}

PlantLook PlantLook::of(plant::Look look) {
  return look == plant::Look::apple ? apple() : tomato();
}

PlantDrawing::PlantDrawing(const RodModel& model, std::vector<simulation::Blade> blades,
                           const PlantLook& look)
    : model_(model),
      blades_(std::move(blades)),
      organ_labels_(model.organs.size(), 0),
      fruit_labels_(model.fruits.size(), 0),
      is_leaf_(model.organs.size(), 0),
      look_(look) {
  for (const simulation::Blade& blade : blades_)
    for (const simulation::BladeCorner& corner : blade)
      is_leaf_[model.elements[corner.element].organ] = 1;
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    fruits_.push_back(fruit_shape(look.fruit, static_cast<int>(f), model.fruits[f].radius));
}

void PlantDrawing::set_labels(std::vector<render::Label> organs,
                              std::vector<render::Label> fruits) {
  organ_labels_ = std::move(organs);
  fruit_labels_ = std::move(fruits);
}

void PlantDrawing::add_to(DrawList& list, const RodState& state,
                          std::optional<double> strain_scale) const {
  add_to(list, state, colours(state, strain_scale));
}

void PlantDrawing::add_to(DrawList& list, const RodState& state, const std::vector<Colour>& colours,
                          bool blades) const {
  add_chains(list, state, colours);
  if (blades) add_blades(list, state);
  add_fruits(list, state);
}

std::vector<Colour> PlantDrawing::plain_colours() const {
  std::vector<Colour> result(model_.elements.size());
  for (int e = 0; e < model_.size(); ++e) result[e] = material_of(e).colour;
  return result;
}

const render::Shading& PlantDrawing::material_of(int element) const {
  return is_leaf_[model_.elements[element].organ] ? look_.vein : look_.stem;
}

std::vector<Colour> PlantDrawing::colours(const RodState& state,
                                          std::optional<double> strain_scale) const {
  std::vector<Colour> result(model_.elements.size());
  for (int e = 0; e < model_.size(); ++e)
    result[e] =
        strain_scale && state.alive[e]
            ? render::strain_colour(simulation::surface_strain(model_, state, e) / *strain_scale)
            : material_of(e).colour;
  return result;
}

void PlantDrawing::add_chains(DrawList& list, const RodState& state,
                              const std::vector<Colour>& colours_of) const {
  const std::vector<int> next = continuations(model_, state);
  for (int e = 0; e < model_.size(); ++e) {
    const int parent = model_.elements[e].parent;
    const bool goes_on = parent >= 0 && next[parent] == e;
    if (!state.alive[e] || goes_on) continue;
    const render::Shading& material = material_of(e);
    const DrawList::Counts before = list.counts();
    if (bar_of(model_.elements[e])) {
      for (int k = e; k >= 0; k = next[k]) add_bar(list, model_, state, k, material, colours_of[k]);
    } else {
      list.add_tube(chain(model_, state, e, next, colours_of), material.roughness,
                    material.specular);
    }
    list.label_since(before, label_of(e));
  }
}

void PlantDrawing::add_fruits(DrawList& list, const RodState& state) const {
  for (std::size_t f = 0; f < fruits_.size(); ++f) {
    const cosserat::Fruit& fruit = model_.fruits[f];
    if (state.fruit_gone[f] || !state.alive[fruit.element]) continue;
    const DrawList::Counts before = list.counts();
    add_at(list, fruits_[f],
           {point_on(model_, state, fruit.element, fruit.back), state.orientation[fruit.element]});
    list.label_since(before, fruit_labels_[f]);
    // The knuckle of the stalk, where it will break.
    const double radius = knuckle_size * model_.elements[fruit.element].radius_near;
    if (radius < knuckle_limit * fruit.radius)
      list.spheres.push_back(
          {start_of(model_, state, fruit.element), radius, look_.stem, label_of(fruit.element)});
  }
}

void PlantDrawing::add_blades(DrawList& list, const RodState& state) const {
  for (const simulation::Blade& blade : blades_) {
    std::array<Vec3, 3> corner;
    bool whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
      whole = whole && state.alive[blade[k].element];
      corner[k] = point_on(model_, state, blade[k].element, blade[k].back);
    }
    // Its first corner may lie on what the leaf grows from.
    if (whole)
      list.blades.push_back(
          {corner[0], corner[1], corner[2], look_.blade, label_of(blade[1].element)});
  }
}

}  // namespace pedicel::app
