#include "plugins/cosserat/solver/driven_contacts.h"

#include <algorithm>

#include "engine/core/check.h"
#include "plugins/cosserat/lanes/lane_access.h"

namespace pedicel::cosserat {

namespace {

DriveLoad load_at_end(const ContactPoint& point, const ContactRow& row, const ContactEndRow& end,
                      int lane, double lever) {
  const Vec3 move = vector_at(end.place, lane) - vector_at(row.place, lane);
  const double overlap = row.margin[lane] - point.gap - vector_at(row.normal, lane).dot(move);
  return {lever, row.stiffness[lane], overlap};
}

}  // namespace

void DrivenContacts::clear() {
  source_ = nullptr;
  driven_ = {};
}

// Until its contacts are known, a joint stands where it would go without them.
void DrivenContacts::list(ContactSource& source, std::size_t first) {
  PEDICEL_ASSERT(source_ == nullptr);
  source_ = &source;
  first_ = first;
  driven_ = source.driven();
  stands_.clear();
  for (const ContactDrive& drive : source.drives()) stands_.push_back({drive.aim, 0.0});
}

// Only joints that press on something are held back. The plant is held fixed meanwhile.
void DrivenContacts::move(const ContactLists& contacts, std::span<const double> gives) {
  for (std::size_t d = 0; source_ && d < stands_.size(); ++d) {
    loads_.clear();
    for (std::size_t i = 0; i < driven_.size(); ++i) {
      if (driven_[i].drive != static_cast<int>(d)) continue;
      const std::size_t contact = first_ + i;
      const ContactPoint& point = contacts[contact];
      loads_.push_back(
          {driven_[i].lever, series_stiffness(point, gives[contact]), point.margin - point.gap});
    }
    if (!loads_.empty()) stands_[d].position = stand(source_->drives()[d], loads_);
  }
}

const DrivenContact* DrivenContacts::find(std::size_t contact) const {
  if (contact < first_ || contact - first_ >= driven_.size()) return nullptr;
  const DrivenContact& driven = driven_[contact - first_];
  return driven.drive >= 0 ? &driven : nullptr;
}

double DrivenContacts::nearer(const DrivenContact& driven) const {
  return driven.lever *
         (stands_[driven.drive].position - source_->drives()[driven.drive].reference);
}

void DrivenContacts::end(const ContactLists& contacts, std::span<ContactRow> rows,
                         std::span<ContactEndRow> ends) {
  for (std::size_t d = 0; d < stands_.size(); ++d) {
    const auto each = [&](const auto& task) {  // task(contact, row, lane, driven) of the joint
      for (std::size_t i = 0; i < driven_.size(); ++i) {
        const std::size_t contact = first_ + i;
        if (driven_[i].drive == static_cast<int>(d))
          task(contact, contact / lane_count, static_cast<int>(contact % lane_count), driven_[i]);
      }
    };
    loads_.clear();
    each([&](std::size_t contact, std::size_t row, int lane, const DrivenContact& driven) {
      loads_.push_back(load_at_end(contacts[contact], rows[row], ends[row], lane, driven.lever));
    });
    if (loads_.empty()) continue;
    const ContactDrive& drive = source_->drives()[d];
    stands_[d].position = stand(drive, loads_);
    stands_[d].load = load_at(drive, loads_, stands_[d].position);
    // Gaps are reported from where the collider now is.
    auto load = loads_.begin();
    each([&](std::size_t contact, std::size_t row, int lane, const DrivenContact& driven) {
      rows[row].gap[lane] = contacts[contact].gap - nearer(driven);
      ends[row].normal[lane] = load->stiffness * std::max(0.0, load->overlap + nearer(driven));
      ++load;
    });
  }
  source_->end_drives(stands_);
}

}  // namespace pedicel::cosserat
