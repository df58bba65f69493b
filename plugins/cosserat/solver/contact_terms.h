#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/lanes/diagonal_blocks.h"
#include "plugins/cosserat/lanes/parted_loop.h"
#include "plugins/cosserat/solver/contact_lanes.h"
#include "plugins/cosserat/solver/driven_contacts.h"
#include "plugins/cosserat/solver/friction_memory.h"

namespace pedicel::cosserat {

/// Contact and Coulomb friction as terms of the incremental potential.
///
/// Normal: 1/2 k max(0, margin - gap)^2, with the gap taken as linear around the iterate at which
/// the contact was found. Tangential: a spring of the same stiffness whose stretch is the
/// displacement of the plant's surface against the collider's since they met, and which slides
/// where it would carry more than mu N: a Huber potential in the step, with a stretch that is
/// remembered between steps (Cundall & Strack, Geotechnique 29, 1979). So a held fruit sticks
/// without creeping. N is that of the step before, as in Li et al., Incremental Potential Contact
/// (2020), and so the first step of a contact is without friction: taken from the iterate, which
/// may lie millimetres inside of a moving collider, N tears thin stems about and Newton does not
/// converge. A contact that passes a node, or begins beside one, goes on with the spring of the
/// segment before (FrictionMemory::find_beyond_node()).
///
/// A collider that gives way (ContactPoint::give, its inverse mass times dt^2) is one more spring
/// in series: backward Euler for the collider's own motion, so that light links and stiff stems do
/// not push each other to and fro. Gaps are reported as they are after it gave way; stretches are
/// kept as they were before, and colliders' motions are those between poses before, too, so that
/// what sticks does not creep.
///
/// Colliders that a joint presses with a limited force: DrivenContacts.
class ContactTerms {
 public:
  /// The threads that the calls below share out to until told otherwise, without a trace in the
  /// bits; null: the caller's alone.
  void use(ThreadPool* pool) { loop_.pool = pool; }

  /// Collects the contacts of an iterate, with the potential's value, gradient and Hessian there.
  /// `start` is the state at the start of the step.
  void find(const RodModel& model, const RodState& start, const RodState& iterate, double dt,
            std::span<ContactSource* const> sources);

  /// Goes on with the contacts of a plant with itself at another iterate nearby: of those that were
  /// found there, or that it came near, normals and places on the segments are kept.
  void follow(const RodState& iterate);

  /// J, at the iterate for which find() or follow() was called.
  double energy() const { return energy_; }
  /// What the contacts add there, at most one each. Valid until the next call of them.
  ElementBlocks blocks() const { return {block_elements_, blocks_}; }
  /// Whether they stand where they stood before, for the same elements: after follow(), mostly.
  bool blocks_stay() const { return blocks_stay_; }
  double potential(const RodModel& model, const RodState& state) const;

  /// Ends the step: forces for the report, and the friction memory for the next step.
  void finish(const RodModel& model, const RodState& end);

  /// Of a step that has ended, until the next one begins; listed when they are first asked for.
  const std::vector<ContactForce>& forces() const;
  /// How many there are.
  int carrying() const { return carrying_; }
  int size() const { return static_cast<int>(found_.size()); }
  /// m, where they overlap most, or 0.
  double deepest() const { return deepest_; }
  /// Whether all that was found is the plant's contact with itself.
  bool only_with_itself() const { return sides_ == found_.size(); }
  void forget() { memory_.forget(); }
  /// Adds its forces to those of a longer step of which its own was this share: springs of that
  /// share of the stiffness, whose impulse, work and energy are a part's of the longer step.
  void add_to(std::vector<ContactForce>& forces, double share) const;
  /// Reports these in place of its own.
  void report(const std::vector<ContactForce>& forces);

 private:
  // What some contacts carry at a step's end.
  struct Carried {
    int contacts = 0;
    double deepest = 0.0;  // m
  };
  void share_gives();
  void make_rows(const RodModel& model);
  void fetch_poses(std::size_t end, const RodState& state) const;
  void put(std::size_t contact, const RodModel& model);
  void push(std::size_t first, std::size_t end, const RodState& iterate);
  void sum_energy();
  Carried remember(std::size_t first, std::size_t end);
  double gap_of(std::size_t contact) const;
  void list_forces() const;
  template <class Task>
  void for_each_stretch(const Task& task) const;
  std::span<ContactRow> stretch(std::size_t first, std::size_t end) {
    return std::span(rows_).subspan(first, end - first);
  }

  PartedLoop loop_;
  ContactLists found_;
  std::size_t sides_ = 0;      // the first ones are where the plant touches itself
  std::vector<double> gives_;  // m/N, of the colliders, with what pushes them beside each contact
  DrivenContacts driven_;
  std::vector<ContactRow> rows_;
  std::vector<int> block_elements_;   // eight a row
  std::vector<ElementBlock> blocks_;  // likewise
  std::vector<ContactEndRow> ends_;   // by row
  bool blocks_stay_ = false;
  std::vector<char> stay_;            // likewise, by stretch
  double energy_ = 0.0;               // J, of them all
  mutable std::vector<double> sums_;  // scratch, J, by stretch
  FrictionMemory memory_;             // of the step before
  std::vector<Carried> carried_;      // by stretch
  int carrying_ = 0;
  double deepest_ = 0.0;
  mutable std::vector<ContactForce> forces_;
  mutable bool forces_listed_ = true;
};

}  // namespace pedicel::cosserat
