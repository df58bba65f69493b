#pragma once

#include <vector>

#include "plugins/cosserat/contact/contact.h"

namespace pedicel::cosserat {

/// What the contacts of one step leave to the next: the friction spring's stretch, and the normal
/// force that limits it (ContactTerms). A contact of the next step is known by its shape, its
/// collider and its place.
class FrictionMemory {
 public:
  struct Spring {
    Vec3 stretch_W;  // m
    double normal;   // N; 0: it carried nothing, which is no memory
    int collider;
    float back;  // m
    int place;   // ContactPoint::place
  };

  /// For plants of so many shapes.
  void resize(std::size_t shapes) { last_of_shape_.resize(shapes, -1); }
  /// What is remembered of a contact; null: nothing.
  const Spring* find(const ContactPoint& point) const;
  /// The same of a collider that touches a shape in several places of one number, which stay.
  const Spring* find_by_back(const ContactPoint& point) const;

  /// The springs of a step that has ended, one for each of its contacts, to be filled in. Then
  /// index() makes them what is remembered.
  std::vector<Spring>& springs() { return springs_; }
  void index(const ContactLists& contacts);
  void forget();

 private:
  std::vector<Spring> springs_;
  // Springs of a shape follow each other: its last one, and which one comes before it; -1: none.
  std::vector<int> last_of_shape_, before_;
};

}  // namespace pedicel::cosserat
