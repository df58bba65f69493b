#include "plugins/cosserat/solver/friction_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pedicel::cosserat {

namespace {

// m. Places of one collider on a shape lie further apart; a place that stays moves by rounding.
constexpr double same_place = 1.0e-6;

}  // namespace

const FrictionMemory::Spring* FrictionMemory::find(const ContactPoint& point) const {
  for (int i = last_of_shape_[point.shape]; i >= 0; i = before_[i])
    if (springs_[i].collider == point.collider && springs_[i].place == point.place &&
        springs_[i].normal != 0.0)
      return &springs_[i];
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
