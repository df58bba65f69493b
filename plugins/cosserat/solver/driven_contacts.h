#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/solver/contact_lanes.h"

namespace pedicel::cosserat {

/// Those of a plant's contacts whose colliders a joint presses with a limited force (ContactDrive).
/// Such a joint stands, for each iterate, where its force balances its contacts: the potential is
/// minimised over the plant and the joint in turns.
class DrivenContacts {
 public:
  /// None, until the next list().
  void clear();
  /// Those of a source, whose contacts begin with number `first`. At most one source has any.
  void list(ContactSource& source, std::size_t first);
  bool any() const { return source_ != nullptr; }

  /// Moves each joint to where it stands with the plant at the iterate. `gives`: m/N, of all
  /// contacts' colliders.
  void move(const ContactLists& contacts, std::span<const double> gives);
  /// Whether a joint presses the collider of a contact.
  bool presses(std::size_t contact) const { return find(contact) != nullptr; }
  /// m, of a contact that a joint presses: how much nearer its collider is than where it was found.
  double nearer(std::size_t contact) const { return nearer(*find(contact)); }

  /// The joints follow to where the step ended, so that none presses with more than it can. Sets
  /// gaps and normal forces of their contacts, and tells their source.
  void end(const ContactLists& contacts, std::span<ContactRow> rows, std::span<ContactEndRow> ends);

 private:
  const DrivenContact* find(std::size_t contact) const;
  double nearer(const DrivenContact& driven) const;

  ContactSource* source_ = nullptr;
  std::size_t first_ = 0;
  std::span<const DrivenContact> driven_;  // by contact, from `first_` on
  std::vector<DriveEnd> stands_;           // of the joints
  std::vector<DriveLoad> loads_;           // scratch
};

/// N/m, of a contact and a collider that gives way, in series.
inline double series_stiffness(const ContactPoint& point, double give) {
  return point.stiffness / (1.0 + point.stiffness * give);
}

}  // namespace pedicel::cosserat
