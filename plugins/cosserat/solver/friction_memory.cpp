#include "plugins/cosserat/solver/friction_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pedicel::cosserat {

namespace {

// m. Places of one collider on a shape lie further apart; a place that stays moves by rounding.
constexpr double same_place = 1.0e-6;

}  // namespace

void FrictionMemory::resize(const RodModel& model) {
  if (last_of_shape_.size() == model.shapes.size()) return;
  last_of_shape_.assign(model.shapes.size(), -1);
  stem_of_element_.assign(model.elements.size(), -1);
  for (std::size_t s = 0; s < model.shapes.size(); ++s)
    if (model.shapes[s].fruit < 0) stem_of_element_[model.shapes[s].element] = static_cast<int>(s);
  first_child_.assign(model.elements.size(), -1);
  next_child_ = first_child_;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    if (const int parent = model.elements[e].parent; parent >= 0)
      next_child_[e] = std::exchange(first_child_[parent], static_cast<int>(e));
}

const FrictionMemory::Spring* FrictionMemory::find(const ContactPoint& point, int shape) const {
  for (int i = last_of_shape_[shape]; i >= 0; i = before_[i])
    if (springs_[i].collider == point.collider && springs_[i].place == point.place &&
        springs_[i].normal != 0.0)
      return &springs_[i];
  return nullptr;
}

const FrictionMemory::Spring* FrictionMemory::find_beyond_node(const ContactPoint& point,
                                                               const RodModel& model) const {
  const CollisionShape& shape = model.shapes[point.shape];
  if (shape.fruit >= 0) return nullptr;
  const auto on = [&](int element) -> const Spring* {
    const int stem = element < 0 ? -1 : stem_of_element_[element];
    return stem < 0 ? nullptr : find(point, stem);
  };
  const double thickness = 2.0 * point.radius;
  if (shape.back_near - point.back < thickness)
    if (const Spring* spring = on(model.elements[shape.element].parent)) return spring;
  if (point.back - shape.back_far >= thickness) return nullptr;
  for (int child = first_child_[shape.element]; child >= 0; child = next_child_[child])
    if (const Spring* spring = on(child)) return spring;
  return nullptr;
}

const FrictionMemory::Spring* FrictionMemory::find_by_back(const ContactPoint& point) const {
  for (int i = last_of_shape_[point.shape]; i >= 0; i = before_[i]) {
    const Spring& spring = springs_[i];
    if (spring.collider == point.collider && spring.normal != 0.0 &&
        std::abs(spring.back - point.back) < same_place)
      return &spring;
  }
  return nullptr;
}

void FrictionMemory::index(const ContactLists& contacts) {
  forget();
  before_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    before_[i] = std::exchange(last_of_shape_[contacts[i].shape], static_cast<int>(i));
}

void FrictionMemory::forget() {
  std::fill(last_of_shape_.begin(), last_of_shape_.end(), -1);
}

}  // namespace pedicel::cosserat
