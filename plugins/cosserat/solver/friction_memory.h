#pragma once

#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/model/rod_model.h"

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

  /// For this plant, whose segments stay as they hang together.
  void resize(const RodModel& model);
  /// What is remembered of a contact; null: nothing.
  const Spring* find(const ContactPoint& point) const { return find(point, point.shape); }
  /// What is remembered of the same collider on the next segment, where the contact is new and near
  /// the node between the two: the place that is touched slides along the stem, or lies on the node
  /// and is found on either side. Null: nothing. The two sides of a contact of the plant with
  /// itself must not ask: they would pass a node one after the other.
  const Spring* find_beyond_node(const ContactPoint& point, const RodModel& model) const;
  /// The same of a collider that touches a shape in several places of one number, which stay.
  const Spring* find_by_back(const ContactPoint& point) const;

  /// The springs of a step that has ended, one for each of its contacts, to be filled in. Then
  /// index() makes them what is remembered.
  std::vector<Spring>& springs() { return springs_; }
  void index(const ContactLists& contacts);
  void forget();

 private:
  const Spring* find(const ContactPoint& point, int shape) const;

  std::vector<int> stem_of_element_;  // its shape; -1: none
  // Children of an element follow each other; -1: none, or no more.
  std::vector<int> first_child_, next_child_;
  std::vector<Spring> springs_;
  // Springs of a shape follow each other: its last one, and which one comes before it; -1: none.
  std::vector<int> last_of_shape_, before_;
};

}  // namespace pedicel::cosserat
