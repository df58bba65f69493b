#include "plugins/cosserat/solver/contact_terms.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "plugins/cosserat/lanes/lane_access.h"

namespace pedicel::cosserat {

namespace {

// Rows of contacts that are taken at a time. Sums are made by stretch and then added up in order,
// so that they do not depend on the number of threads.
constexpr std::size_t stretch_length = 2;
constexpr std::size_t grain_size = 2;  // stretches, a thread

}  // namespace

// task(first, end) for stretches of all rows, perhaps at once. Their length does not depend on the
// number of threads, and a thread gets the same ones each time, which lie in its core's cache.
template <class Task>
void ContactTerms::for_each_stretch(const Task& task) const {
  const std::size_t count = rows_.size();
  const std::size_t stretches = (count + stretch_length - 1) / stretch_length;
  // Below a few stretches a thread, waking the threads takes longer than the work.
  const int parts = loop_.parts(stretches, grain_size);
  loop_.each(parts, [&](int part) {
    const std::size_t end = stretches * (part + 1) / parts * stretch_length;
    for (std::size_t i = stretches * part / parts * stretch_length; i < std::min(count, end);
         i += stretch_length)
      task(i, std::min(count, i + stretch_length));
  });
}

// Which the stretch after the next one needs, from `end` of this one on, and another core may have
// moved: in its turn it would wait for them.
void ContactTerms::fetch_poses(std::size_t end, const RodState& state) const {
  const std::size_t first = end + stretch_length;
  for (std::size_t i = first; i < std::min(rows_.size(), first + stretch_length); ++i)
    for (const std::int64_t element : rows_[i].element) {
      __builtin_prefetch(&state.position[element]);
      __builtin_prefetch(&state.orientation[element]);
    }
}

void ContactTerms::find(const RodModel& model, const RodState& start, const RodState& iterate,
                        double dt, std::span<ContactSource* const> sources) {
  // What is found is a list, with the friction's springs of the last step in another one. A contact
  // finds its own spring by shape and collider, since its number in the list changes.
  found_.clear();
  report({});
  // Those of the plant with itself come first: their two sides then stand in lanes 2 i and 2 i + 1,
  // and a contact's number says which kind it is.
  for (ContactSource* source : sources)
    if (source->is_within_plant()) source->find_lists(model, iterate, dt, found_);
  sides_ = found_.size();
  // Contacts of a joint that presses with a limited force are listed with where they begin: how far
  // the joint has gone is one unknown for all of them.
  driven_.clear();
  for (ContactSource* source : sources) {
    if (source->is_within_plant()) continue;
    const std::size_t first = found_.size();
    source->find_lists(model, iterate, dt, found_);
    if (!source->drives().empty()) driven_.list(*source, first);
  }
  // In this order: the gives say how far each contact lets its link go, the joints are moved with
  // them, and only then are the overlaps known that go into the rows.
  share_gives();
  driven_.move(found_, gives_);
  make_rows(model);
  for_each_stretch([&](std::size_t first, std::size_t end) {
    for (std::size_t i = first * lane_count; i < std::min(found_.size(), end * lane_count); ++i)
      put(i, model);
    // From the start for friction's stretch, and from the iterate for the gap that the contact is
    // linearised about.
    place_contacts(stretch(first, end), start, iterate);
    push(first, end, iterate);
  });
  sum_energy();
  // Even the same elements may have been found in another order.
  blocks_stay_ = false;
}

// Contacts that push one collider together move it together: each one counts the others' share as
// if they carried what it carries.
void ContactTerms::share_gives() {
  const auto pushes = [](const ContactPoint& point) { return point.gap < point.margin; };
  const std::size_t count = found_.size();
  gives_.assign(count, 0.0);
  for (std::size_t i = sides_; i < count; ++i) {
    const ContactPoint& own = found_[i];
    // A fixed thing, or one-way coupling: it does not move, whoever else pushes it.
    if (own.give <= 0.0) continue;
    // One that does not push yet may do so in this step, and then counts, too.
    int together = pushes(own) ? 0 : 1;
    for (std::size_t k = 0; k < count; ++k)
      together += pushes(found_[k]) && found_[k].collider == own.collider;
    gives_[i] = together * own.give;
  }
}

void ContactTerms::make_rows(const RodModel& model) {
  const std::size_t rows = (found_.size() + lane_count - 1) / lane_count;
  rows_.resize(rows);
  // -1 for lanes beyond the last contact. push_contacts() sets those that push, and takes them out
  // again where they stop to.
  block_elements_.resize(rows * lane_count, -1);
  // Rows point to the blocks, which stay where they are while their number does not grow.
  blocks_.resize(rows * lane_count);
  ends_.resize(rows);
  stay_.resize((rows + stretch_length - 1) / stretch_length);
  memory_.resize(model);
  // The last row may be filled in part only, and had other contacts in it before. Its free lanes
  // must add nothing to the sums, which are made over whole rows.
  if (rows > 0) rows_.back() = empty_contact_row();
}

void ContactTerms::put(std::size_t contact, const RodModel& model) {
  const ContactPoint& point = found_[contact];
  ContactRow& row = rows_[contact / lane_count];
  const int lane = static_cast<int>(contact % lane_count);
  row.element[lane] = model.shapes[point.shape].element;
  row.collider[lane] = point.collider;
  row.back[lane] = point.back;
  row.radius[lane] = point.radius;
  cosserat::put(row.normal, lane, point.normal_W);
  // The overlap of a pressed contact is what it would be where the joint now stands in this step,
  // and not where the step began.
  const bool pressed = driven_.presses(contact);
  row.gap[lane] = pressed ? point.gap - driven_.nearer(contact) : point.gap;
  row.margin[lane] = point.margin;
  cosserat::put(row.surface_motion, lane, point.surface_motion_W);
  row.spring_stiffness[lane] = point.stiffening.stiffness;
  row.spring_margin[lane] = point.stiffening.margin;
  // 1/k' = 1/k + c: the link's own motion is backward Euler's, whatever its mass. An exchange of
  // force for pose between two solvers is stable only below dt^2 k W = 4.
  row.stiffness[lane] = series_stiffness(point, gives_[contact]);
  // The first step of a contact has no memory, and so no friction: see the head of this class.
  // A joint that presses may touch a shape with one collider in several places, which stay, so
  // these are told apart by where they are, too. All others have a number for each of their places.
  const FrictionMemory::Spring* memory =
      pressed ? memory_.find_by_back(point) : memory_.find(point);
  // N is of the step before and so a constant of this one. With N of the iterate the potential
  // would not be one, and a line search would have nothing to descend.
  double normal = memory ? memory->normal : 0.0;
  if (!memory && !pressed && contact >= sides_) {
    memory = memory_.find_beyond_node(point, model);
    // The segment before may still bear the collider: this one rubs by no more than it bears.
    const double bears = row.stiffness[lane] * std::max(0.0, point.margin - point.gap);
    if (memory) normal = std::min(memory->normal, bears);
  }
  cosserat::put(row.stretch, lane, memory ? memory->stretch_W : Vec3(0, 0, 0));
  row.limit[lane] = point.friction * normal;
}

void ContactTerms::push(std::size_t first, std::size_t end, const RodState& iterate) {
  stay_[first / stretch_length] =
      push_contacts(stretch(first, end), iterate, block_elements_.data() + first * lane_count,
                    blocks_.data() + first * lane_count);
}

void ContactTerms::sum_energy() {
  energy_ = 0.0;
  // One thread, from the first row to the last: sums of doubles depend on their order.
  for (const ContactRow& row : rows_)
    energy_ = std::accumulate(std::begin(row.energy), std::end(row.energy), energy_);
}

// Normals and places stay, so that the number of contacts does, too; a contact may stop to push or
// begin to, which changes the elements of the blocks.
void ContactTerms::follow(const RodState& iterate) {
  for_each_stretch([&](std::size_t first, std::size_t end) {
    fetch_poses(end, iterate);
    follow_contacts(stretch(first, end), iterate);
    push(first, end, iterate);
  });
  sum_energy();
  blocks_stay_ = std::ranges::all_of(stay_, [](char stays) { return stays; });
}

double ContactTerms::potential(const RodModel&, const RodState& state) const {
  // A number a stretch, then added in order. A sum by thread would give other bits with another
  // number of threads.
  sums_.assign((rows_.size() + stretch_length - 1) / stretch_length, 0.0);
  for_each_stretch([&](std::size_t first, std::size_t end) {
    fetch_poses(end, state);
    sums_[first / stretch_length] =
        potential_of_contacts(std::span(rows_).subspan(first, end - first), state);
  });
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

void ContactTerms::finish(const RodModel&, const RodState& end) {
  // The forces of a step are what its springs carry where it ended. Those of the iterations are of
  // no use: the last change has moved everything a little more.
  memory_.springs().resize(rows_.size() * lane_count);
  carried_.resize(stay_.size());
  for_each_stretch([&](std::size_t first, std::size_t last) {
    fetch_poses(last, end);
    // May be negative or larger than the stretch: the kernel takes it as the number of lanes, from
    // its own first one on, that are sides of self-contact.
    const int sides = static_cast<int>(sides_) - static_cast<int>(first * lane_count);
    end_contacts(stretch(first, last), sides, end, ends_.data() + first);
    if (!driven_.any()) carried_[first / stretch_length] = remember(first, last);
  });
  // What a joint presses with is known when the joint stands where the step ended. Only then are
  // these contacts remembered.
  if (driven_.any()) {
    driven_.end(found_, rows_, ends_);
    for_each_stretch([&](std::size_t first, std::size_t last) {
      carried_[first / stretch_length] = remember(first, last);
    });
  }
  // All threads have written their springs: now they can be found by shape.
  memory_.index(found_);
  carrying_ = 0;
  deepest_ = 0.0;
  for (const Carried& carried : carried_) {
    carrying_ += carried.contacts;
    deepest_ = std::max(deepest_, carried.deepest);
  }
  forces_listed_ = false;
}

// Of the rows `first` to `end`.
ContactTerms::Carried ContactTerms::remember(std::size_t first, std::size_t end) {
  Carried carried;
  for (std::size_t i = first * lane_count; i < std::min(found_.size(), end * lane_count); ++i) {
    const ContactRow& row = rows_[i / lane_count];
    const ContactEndRow& last = ends_[i / lane_count];
    const int lane = static_cast<int>(i % lane_count);
    const double normal = last.normal[lane];
    memory_.springs()[i] = {vector_at(last.stretch, lane), normal, row.collider[lane],
                            static_cast<float>(row.back[lane]), 0};
    // A spring of 0 N is no memory. It stands among the others all the same, so that springs and
    // contacts have the same numbers.
    if (normal == 0.0) continue;
    memory_.springs()[i].place = found_[i].place;
    ++carried.contacts;
    carried.deepest = std::max(carried.deepest, -gap_of(i));
  }
  return carried;
}

// As it is after the collider gave way.
double ContactTerms::gap_of(std::size_t contact) const {
  const std::size_t row = contact / lane_count, lane = contact % lane_count;
  // The gap of the row is against the link where it was. The link gives way by compliance times
  // force, and what is reported is the overlap that is left.
  return rows_[row].gap[lane] + gives_[contact] * ends_[row].normal[lane];
}

void ContactTerms::report(const std::vector<ContactForce>& forces) {
  forces_ = forces;
  forces_listed_ = true;
}

const std::vector<ContactForce>& ContactTerms::forces() const {
  if (!std::exchange(forces_listed_, true)) list_forces();
  return forces_;
}

// Only when somebody asks: most steps of most plants are never asked for their forces.
void ContactTerms::list_forces() const {
  forces_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const ContactEndRow& last = ends_[i / lane_count];
    const int lane = static_cast<int>(i % lane_count);
    const double normal = last.normal[lane];
    if (normal == 0.0) continue;
    ContactPoint point = found_[i];
    if (i < sides_) {  // they may have been followed
      const ContactRow& row = rows_[i / lane_count];
      point.margin = row.margin[lane];
      point.stiffness = row.stiffness[lane];
      point.surface_motion_W = vector_at(row.surface_motion, lane);
    }
    // The row's plane is where the last iteration left it; `found_` is where the contact was found.
    point.gap = gap_of(i);
    forces_.push_back({point, vector_at(last.place, lane), normal, vector_at(last.friction, lane),
                       last.slipping[lane] != 0.0});
  }
}

void ContactTerms::add_to(std::vector<ContactForce>& forces, double share) const {
  for (ContactForce force : this->forces()) {
    // Force times dt is the impulse, and the part lasted only its share of dt. Motion of the
    // surface is stretched to that of the whole step, so that work, force times motion, is the
    // part's own.
    force.normal *= share;
    force.tangential_W *= share;
    force.point.stiffness *= share;
    force.point.surface_motion_W /= share;
    forces.push_back(force);
  }
}

}  // namespace pedicel::cosserat
