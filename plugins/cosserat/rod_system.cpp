#include "cosserat/rod_system.h"

#include <algorithm>

#include "core/check.h"

namespace pedicel::cosserat {

namespace {
// Elements. A bed of the first size stays in a core's own cache; below the second what is read
// again comes from the shared cache, and full lanes and even shares count for more.
constexpr int bed_size = 480, undivided = 2400;
}  // namespace

RodSystem::RodSystem(const RodSettings& settings, int threads)
    : settings_(settings), pool_(threads) {}

int RodSystem::add_plant(RodModel model) {
  Plant plant;
  plant.state = drawn_state(model);
  if (settings_.solver == SolverKind::position_based) plant.solver = make_solver(settings_, model);
  plant.model = std::move(model);
  plants_.push_back(std::move(plant));
  beds_.clear();
  return size() - 1;
}

void RodSystem::add_contact_source(int plant, std::unique_ptr<ContactSource> source) {
  plants_[plant].source_pointers.push_back(source.get());
  plants_[plant].sources.push_back(std::move(source));
}

void RodSystem::step(double dt, const Vec3& gravity) {
  if (settings_.solver == SolverKind::direct) {
    if (beds_.empty()) make_beds();
    if (beds_.size() == 1)
      step_bed(beds_[0], dt, gravity, &pool_);
    else
      pool_.for_each(pool_.threads(), [&](int thread) {
        for (std::size_t b = thread; b < beds_.size(); b += pool_.threads())
          step_bed(beds_[b], dt, gravity, nullptr);
      });
  } else {
    pool_.for_each(size(), [&](int i) {
      Plant& plant = plants_[i];
      plant.report = plant.solver->step(plant.model, plant.state,
                                        {dt, gravity, plant.loads, plant.source_pointers});
    });
  }
  for (Plant& plant : plants_) {
    plant.detached.clear();
    detach(plant.model, plant.state, plant.detached);
    plant.model_changed = !plant.detached.empty();
  }
}

void RodSystem::make_beds() {
  int total = 0, largest = 0;
  for (const Plant& plant : plants_) {
    total += plant.model.size();
    largest = std::max(largest, plant.model.size());
  }
  // A multiple of the number of threads, so that none waits for the last bed.
  const int threads = pool_.threads();
  const int rounds = total <= threads * undivided ? 1 : total / (threads * bed_size);
  double share = static_cast<double>(total) / (threads * rounds);
  if (largest > share || total < bed_size) share = total;
  int filled = 0;
  for (int p = 0; p < size(); ++p) {
    if (beds_.empty() || filled >= share * static_cast<double>(beds_.size()))
      beds_.emplace_back().first = p;
    plants_[p].bed = static_cast<int>(beds_.size()) - 1;
    plants_[p].model_changed = true;
    filled += plants_[p].model.size();
  }
  // The beds of a thread share the memory that a step needs.
  std::vector<std::shared_ptr<RowScratch>> scratch;
  for (int thread = 0; thread < threads; ++thread)
    scratch.push_back(std::make_shared<RowScratch>());
  for (std::size_t b = 0; b < beds_.size(); ++b) {
    const int end = b + 1 < beds_.size() ? beds_[b + 1].first : size();
    std::vector<const RodModel*> models;
    for (int p = beds_[b].first; p < end; ++p) models.push_back(&plants_[p].model);
    beds_[b].solver = std::make_unique<DirectSolver>(
        settings_, models, beds_.size() == 1 ? threads : 1, scratch[b % threads]);
    beds_[b].steps.resize(models.size());
  }
}

// Without a pool it is one of several beds, and a thread steps it alone.
void RodSystem::step_bed(Bed& bed, double dt, const Vec3& gravity, ThreadPool* pool) {
  for (std::size_t i = 0; i < bed.steps.size(); ++i) {
    Plant& plant = plants_[bed.first + i];
    bed.steps[i] = {&plant.model,          &plant.state,        plant.loads,
                    plant.source_pointers, plant.model_changed, {}};
  }
  if (pool)
    bed.solver->step(bed.steps, dt, gravity, *pool);
  else
    bed.solver->step(bed.steps, dt, gravity);
  for (std::size_t i = 0; i < bed.steps.size(); ++i)
    plants_[bed.first + i].report = bed.steps[i].report;
}

const std::vector<ContactForce>& RodSystem::contact_forces(int plant) const {
  static const std::vector<ContactForce> none;
  if (plants_[plant].solver) return plants_[plant].solver->contact_forces();
  if (beds_.empty()) return none;
  const Bed& bed = beds_[plants_[plant].bed];
  return bed.solver->contact_forces(plant - bed.first);
}

void RodSystem::set_state(int plant, const RodState& state) {
  plants_[plant].state = state;
  plants_[plant].state.previous_dt = 0.0;
  plants_[plant].state.previous_root = state.root;
  if (plants_[plant].solver) plants_[plant].solver->reset();
  if (beds_.empty() || settings_.solver != SolverKind::direct) return;
  Bed& bed = beds_[plants_[plant].bed];
  bed.solver->reset(plant - bed.first);
}

void RodSystem::change_constants(int plant, RodModel model) {
  Plant& held = plants_[plant];
  if (!differs_in_constants_only(held.model, model))
    throw UsageError("RodSystem::change_constants: \"" + model.name +
                     "\" has another shape than \"" + held.model.name +
                     "\", which is running: must have the same");
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    if (held.state.fruit_gone[f])
      lump_inertia(model, model.fruits[f].element, held.state.fruit_gone);
  // A velocity is that of the centre of mass, which may lie elsewhere now.
  for (int e = 0; e < model.size(); ++e) {
    const double shift = held.model.elements[e].com_back - model.elements[e].com_back;
    held.state.velocity[e] +=
        held.state.orientation[e] * held.state.angular_velocity[e].cross(Vec3(0, 0, shift));
  }
  held.model = std::move(model);
  held.model_changed = true;
  held.state.previous_dt = 0.0;
}

void RodSystem::change_settings(const RodSettings& settings) {
  if (settings.solver != settings_.solver)
    throw UsageError("RodSystem::change_settings: another solver, must be the same");
  settings_ = settings;
  for (Plant& plant : plants_)
    if (plant.solver) plant.solver->change_settings(settings);
  for (Bed& bed : beds_) bed.solver->change_settings(settings);
}

void RodSystem::add_to(StateHash& hash) const {
  for (const Plant& plant : plants_) {
    for (int e = 0; e < plant.state.size(); ++e) {
      hash.add(plant.state.position[e]);
      hash.add(plant.state.orientation[e]);
      hash.add(plant.state.velocity[e]);
      hash.add(plant.state.angular_velocity[e]);
      hash.add(static_cast<std::uint64_t>(plant.state.alive[e]));
    }
    for (const Vec3& z : plant.state.joint_memory) hash.add(z);
  }
}

}  // namespace pedicel::cosserat
