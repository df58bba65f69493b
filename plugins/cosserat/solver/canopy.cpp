#include "plugins/cosserat/solver/canopy.h"

#include <algorithm>
#include <array>

#include "engine/core/check.h"
#include "plugins/cosserat/contact/blade_contact.h"

namespace pedicel::cosserat {

namespace {

std::vector<const RodModel*> models_of(std::span<const Canopy::PlantStep> plants) {
  std::vector<const RodModel*> models;
  for (const Canopy::PlantStep& plant : plants) models.push_back(plant.model);
  return models;
}

std::vector<int> first_elements(const JoinedModel& joined) {
  std::vector<int> first;
  for (const JoinedModel::Part& part : joined.parts()) first.push_back(part.first_element);
  return first;
}

// Two plants that lean on each other move together, which is what contact's own iterations are slow
// to find: at the tolerance of self-contact a branch that lies on another one never comes to rest.
// At this one (as RodSettings::self_contact_tolerance) it does within 0.1 mm.
constexpr double leaning_tolerance = 1.0e-4;

RodSettings settings_for_leaning(RodSettings settings) {
  settings.self_contact_tolerance = std::min(settings.self_contact_tolerance, leaning_tolerance);
  return settings;
}

// Null where no plant has blades.
std::unique_ptr<BladeContact> blade_contact_of(const JoinedModel& joined,
                                               std::span<const Canopy::PlantStep> plants,
                                               const SelfContactSettings& settings) {
  std::vector<BladeContact::Plant> all;
  bool any = false;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const JoinedModel::Part& part = joined.parts()[p];
    all.push_back({part.first_element, part.elements, nullptr});
    for (ContactSource* source : plants[p].contacts)
      if (auto* blades = dynamic_cast<PlantBlades*>(source)) {
        blades->change_settings(settings);
        all.back().blades = blades;
        any = true;
      }
  }
  if (!any) return nullptr;
  return std::make_unique<BladeContact>(joined.model(), std::move(all));
}

// Whether a plant is not where the last step left it: its state was set from outside.
bool any_was_moved(const JoinedModel& joined, std::span<const Canopy::PlantStep> plants,
                   const RodState& left) {
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const RodState& state = *plants[p].state;
    const int first = joined.parts()[p].first_element;
    if (left.size() < first + state.size()) return true;
    for (int e = 0; e < state.size(); ++e)
      if (state.position[e] != left.position[first + e] ||
          state.orientation[e].coeffs() != left.orientation[first + e].coeffs())
        return true;
  }
  return false;
}

// Their joints' memory starts where the plant stands, as DirectSolver has it.
void begin_memory(const RodModel& model, RodState& state) {
  const std::size_t joints = model.laws.size();
  if (joints == 0 || (state.joint_bias.size() == joints &&
                      state.joint_memory.size() == joints * branch_count(model)))
    return;
  state.joint_bias.clear();
  start_memory(model, state);
}

}  // namespace

/// What the sources of all plants find, each asked about its own plant: those of a plant with
/// itself, or all others.
class Canopy::Sources : public ContactSource {
 public:
  explicit Sources(bool within) : within_(within) {}
  bool is_within_plant() const override { return within_; }

  /// Contacts of the plants' blades with each other's plants; null: none has any.
  std::unique_ptr<BladeContact> blades;

  // The plants of the step that begins.
  void take(const JoinedModel& joined, std::span<const PlantStep> plants) {
    joined_ = &joined;
    parts_.resize(plants.size());
    for (std::size_t p = 0; p < plants.size(); ++p) {
      Part& part = parts_[p];
      part.model = plants[p].model;
      part.sources.clear();
      for (ContactSource* source : plants[p].contacts)
        if (source->is_within_plant() == within_) part.sources.push_back(source);
      const RodState& state = *plants[p].state;
      part.start.alive = part.iterate.alive = state.alive;
      part.start.fruit_gone = part.iterate.fruit_gone = state.fruit_gone;
      part.start.root = part.iterate.root = state.root;
      part.start.time = part.iterate.time = state.time;
    }
  }

  void use(ThreadPool* pool) override { pool_ = pool; }
  void cover(double from, double to) override {
    for_each_source([&](Part&, ContactSource& source) { source.cover(from, to); });
  }

  void begin_step(const RodModel&, const RodState& start, double dt) override {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (!parts_[p].sources.empty())
        joined_->scatter_poses(static_cast<int>(p), start, parts_[p].start);
    for_each_source(
        [&](Part& part, ContactSource& source) { source.begin_step(*part.model, part.start, dt); });
  }

  // Each plant has a list of its own, so that several threads may look at once.
  void find(const RodModel&, const RodState& state, double dt,
            std::vector<ContactPoint>& found) override {
    const auto look = [&](int p) {
      Part& part = parts_[p];
      part.found.clear();
      part.driven.clear();
      if (part.sources.empty()) return;
      joined_->scatter_poses(p, state, part.iterate);
      for (ContactSource* source : part.sources) {
        const std::size_t first = part.found.size();
        source->find(*part.model, part.iterate, dt, part.found);
        const auto driven = source->driven();
        part.driven.insert(part.driven.end(), driven.begin(), driven.end());
        // What no joint presses is no joint's.
        if (driven.empty()) part.driven.resize(part.driven.size() + part.found.size() - first);
      }
      for (ContactPoint& point : part.found) {
        point.shape = joined_->shape(p, point.shape);
        if (within_)
          point.collider =
              self_contact_base + joined_->shape(p, point.collider - self_contact_base);
      }
    };
    const int count = static_cast<int>(parts_.size());
    if (pool_)
      pool_->for_each(count, look);
    else
      for (int p = 0; p < count; ++p) look(p);
    driven_.clear();
    for (const Part& part : parts_) {
      found.insert(found.end(), part.found.begin(), part.found.end());
      driven_.insert(driven_.end(), part.driven.begin(), part.driven.end());
    }
  }

  // All plants are pressed by the same joints.
  std::span<const ContactDrive> drives() const override {
    for (const Part& part : parts_)
      for (const ContactSource* source : part.sources)
        if (!source->drives().empty()) return source->drives();
    return {};
  }
  std::span<const DrivenContact> driven() const override {
    return drives().empty() ? std::span<const DrivenContact>() : driven_;
  }
  // Who adds up what the joints bear must find it once.
  void end_drives(std::span<const DriveEnd> ends) override {
    std::vector<DriveEnd> borne(ends.begin(), ends.end());
    for_each_source([&](Part&, ContactSource& source) {
      if (source.drives().empty()) return;
      source.end_drives(borne);
      for (DriveEnd& end : borne) end.load = 0.0;
    });
  }

 private:
  struct Part {
    const RodModel* model = nullptr;
    std::vector<ContactSource*> sources;
    RodState start, iterate;  // poses, and what is there
    std::vector<ContactPoint> found;
    std::vector<DrivenContact> driven;
  };
  template <class Task>
  void for_each_source(const Task& task) {
    for (Part& part : parts_)
      for (ContactSource* source : part.sources) task(part, *source);
  }

  bool within_ = false;
  const JoinedModel* joined_ = nullptr;
  ThreadPool* pool_ = nullptr;
  std::vector<Part> parts_;
  std::vector<DrivenContact> driven_;
};

Canopy::Canopy(const RodSettings& settings, const std::optional<SelfContactSettings>& contact,
               std::span<const PlantStep> plants, int threads, std::span<const PlantString> strings)
    : sources_(std::make_unique<Sources>(false)),
      strings_(strings.begin(), strings.end()),
      forces_(plants.size()) {
  join(plants);
  solver_ = std::make_unique<DirectSolver>(settings_for_leaning(settings),
                                           std::array{&joined_->model()}, threads);
  if (contact) {
    contact_ = std::make_unique<SelfContact>(joined_->model(), *contact, first_elements(*joined_));
    sources_->blades = blade_contact_of(*joined_, plants, *contact);
  } else {
    own_ = std::make_unique<Sources>(true);
  }
}

void Canopy::join(std::span<const PlantStep> plants) {
  joined_ = std::make_unique<JoinedModel>(models_of(plants));
  const auto element = [&](const PlantString::End& end) {
    return joined_->parts()[end.plant].first_element + end.element;
  };
  std::vector<Strand> strands;
  for (const PlantString& one : strings_)
    strands.push_back(
        {element(one.a), element(one.b), one.a.back, one.b.back, one.length, one.stiffness});
  joined_->set_strands(std::move(strands));
}

Canopy::~Canopy() = default;

void Canopy::step(std::span<PlantStep> plants, double dt, const Vec3& gravity, ThreadPool& pool) {
  const auto any = [&](bool PlantStep::*changed) {
    return fresh_ || std::ranges::any_of(plants, changed);
  };
  const bool model_changed = any(&PlantStep::model_changed);
  const bool state_changed = any(&PlantStep::state_changed);
  fresh_ = false;
  if (model_changed) join(plants);
  // Into the list that is there: a step does not allocate.
  models_.clear();
  for (const PlantStep& plant : plants) models_.push_back(plant.model);
  joined_->read_supports(models_);
  read(plants);
  if (state_changed) {
    // On which side of a blade things were says nothing of where they have been put.
    if (sources_->blades && any_was_moved(*joined_, plants, state_)) sources_->blades->forget();
    gather(plants);
  }
  sources_->take(*joined_, plants);
  if (own_) own_->take(*joined_, plants);
  ContactSource* const within = own_ ? static_cast<ContactSource*>(own_.get()) : contact_.get();
  const std::array<ContactSource*, 3> all_contacts{within, sources_.get(), sources_->blades.get()};
  const std::span<ContactSource* const> contacts(all_contacts.data(), sources_->blades ? 3 : 2);
  PlantStep all{&joined_->model(), &state_, loads_,  contacts, model_changed,
                state_changed,     {},      clamps_, ties_,    air_};
  solver_->step({&all, 1}, dt, gravity, pool);
  for (std::size_t p = 0; p < plants.size(); ++p)
    joined_->scatter(static_cast<int>(p), state_, *plants[p].state);
  share_out(plants, all.report);
}

// What may be another in each step.
void Canopy::read(std::span<const PlantStep> plants) {
  clamps_.clear();
  loads_.clear();
  ties_.clear();
  air_.clear();
  for (std::size_t p = 0; p < plants.size(); ++p) {
    const int first = joined_->parts()[p].first_element;
    clamps_.push_back(own_clamp(*plants[p].state));
    clamps_.back().first_element = first;
    for (Load load : plants[p].loads) {
      load.element += first;
      loads_.push_back(load);
    }
    for (Tie tie : plants[p].ties) {
      tie.element += first;
      ties_.push_back(tie);
    }
    // A field of the wind has a value for all plants, or for none.
    air_.insert(air_.end(), plants[p].air.begin(), plants[p].air.end());
  }
}

// A step of second order needs a past of all plants.
void Canopy::gather(std::span<const PlantStep> plants) {
  state_.time = plants.front().state->time;
  state_.previous_dt = plants.front().state->previous_dt;
  for (std::size_t p = 0; p < plants.size(); ++p) {
    RodState& state = *plants[p].state;
    begin_memory(*plants[p].model, state);
    joined_->gather(static_cast<int>(p), state, state_);
    state_.previous_dt = std::min(state_.previous_dt, state.previous_dt);
  }
}

void Canopy::share_out(std::span<PlantStep> plants, const StepReport& report) {
  for (std::vector<ContactForce>& forces : forces_) forces.clear();
  for (ContactForce force : solver_->contact_forces()) {
    const JoinedModel::Shape own = joined_->part_of_shape(force.point.shape);
    if (is_self_contact(force.point.collider)) {
      const int number = force.point.collider - self_contact_base;
      const JoinedModel::Shape other = joined_->part_of_shape(number);
      force.point.collider =
          other.plant == own.plant ? self_contact_base + other.shape : other_plant_base + number;
    }
    force.point.shape = own.shape;
    forces_[own.plant].push_back(force);
  }
  const int culprit = report.element < 0 ? -1 : joined_->part_of_element(report.element);
  for (int p = 0; p < static_cast<int>(plants.size()); ++p) {
    StepReport& own = plants[p].report;
    own = report;
    own.element = p == culprit ? report.element - joined_->parts()[p].first_element : -1;
    if (culprit >= 0 && p != culprit) own.errors = none;
    own.contacts = static_cast<int>(forces_[p].size());
    own.deepest = 0.0;
    for (const ContactForce& force : forces_[p])
      own.deepest = std::max(own.deepest, -force.point.gap);
  }
}

void Canopy::change_settings(const RodSettings& settings) {
  solver_->change_settings(settings_for_leaning(settings));
}

JoinedModel::Shape Canopy::touched(int collider) const {
  PEDICEL_ASSERT(is_other_plant(collider));
  return joined_->part_of_shape(collider - other_plant_base);
}

}  // namespace pedicel::cosserat
