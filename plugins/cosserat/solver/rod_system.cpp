#include "plugins/cosserat/solver/rod_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/check.h"
#include "plugins/cosserat/contact/plant_blades.h"
#include "plugins/cosserat/solver/solver_work.h"

namespace pedicel::cosserat {

namespace {
// Elements. A bed of the first size stays in a core's own cache. Below the second, for each thread,
// full lanes and even shares count for more, as far as dividing would cost any.
constexpr int bed_size = 480, undivided = 2400, equal_undivided = 1100;
// Likewise: from here on rows stand on huge pages.
constexpr int large = 8000;

struct Share {
  int plants = 0, thread = 0;
};

// How many plants each bed takes, in order, and whose it is.
// One bed for all would run out of the cache between two phases of a step; one bed a plant would
// leave seven of eight lanes empty. The sizes below are between the two.
std::vector<Share> share_out(const std::vector<int>& elements, int threads) {
  const int plants = static_cast<int>(elements.size());
  const int total = std::accumulate(elements.begin(), elements.end(), 0);
  const int largest = *std::max_element(elements.begin(), elements.end());
  // Equal plants fill whole packs with their stems. They are worth dividing earlier, since a
  // division at a multiple of eight plants leaves no lane empty.
  const bool equal = std::count(elements.begin(), elements.end(), largest) == plants;
  const int together = threads * (equal ? equal_undivided : undivided);
  // A multiple of the number of threads, so that none waits for the last bed.
  const int rounds = total <= together ? 1 : total / (threads * bed_size);
  const double share = static_cast<double>(total) / (threads * rounds);
  // One bed, and then the threads share its packs. A plant larger than a share cannot be one
  // thread's without all others waiting for it.
  if (largest > share || total < bed_size) return {{plants, 0}};
  std::vector<Share> shares;
  if (equal && rounds > 1) {  // all lanes are full but in a thread's last bed
    const int in_lanes = lane_count * largest;
    const int full = lane_count * std::max(1, static_cast<int>(std::lround(share / in_lanes)));
    for (int thread = 0; thread < threads; ++thread) {
      // By thread and not by turns, so that a thread's plants lie side by side, and so do their
      // states.
      int left = plants / threads + (thread < plants % threads ? 1 : 0);
      for (; left > 0; left -= full) shares.push_back({std::min(left, full), thread});
    }
    return shares;
  }
  int filled = 0;
  for (const int count : elements) {
    // Compared with the sum so far and not with this bed alone: what one bed took too much the next
    // one takes less, and the number of beds comes out as planned.
    if (filled >= share * static_cast<double>(shares.size()))
      shares.push_back({0, static_cast<int>(shares.size()) % threads});
    ++shares.back().plants;
    filled += count;
  }
  return shares;
}

}  // namespace

RodSystem::RodSystem(const RodSettings& settings, int threads)
    : settings_(settings), pool_(threads), work_(std::make_unique<Work>()) {}
RodSystem::~RodSystem() = default;

JoinedModel::Shape RodSystem::touched(int collider) const {
  return work_->canopy->touched(collider);
}

int RodSystem::add_plant(RodModel model) {
  Plant plant;
  // The state before the model is moved from. Beds and canopy hold pointers into `plants_`, which
  // may have moved with this plant: they are made again by the next step.
  plant.state = drawn_state(model);
  if (settings_.solver == SolverKind::position_based) plant.solver = make_solver(settings_, model);
  plant.model = std::move(model);
  plants_.push_back(std::move(plant));
  work_->beds.clear();
  work_->canopy.reset();
  return size() - 1;
}

void RodSystem::add_contact_source(int plant, std::unique_ptr<ContactSource> source) {
  // Steps take plain pointers in a span, and must not allocate to make one.
  plants_[plant].source_pointers.push_back(source.get());
  plants_[plant].sources.push_back(std::move(source));
}

void RodSystem::step(double dt, const Vec3& gravity) {
  if (plants_.empty()) return;  // a world of robots and bodies alone
  // The position-based solver damps velocities and no strains.
  if (settings_.solver == SolverKind::direct)
    for (Plant& plant : plants_) begin_stalks(plant.model, plant.state, dt, plant.stalks);
  if (joint_)
    joint_->solve(*this, dt, gravity);
  else
    solve(dt, gravity);
  // In one thread and in the order of plants: what comes off makes bodies in the world, whose order
  // must not depend on threads.
  for (Plant& plant : plants_) {
    plant.detached.clear();
    detach(plant.model, plant.state, plant.detached, plant.stalks);
    // Both flags go down here and nowhere else: an edit between two steps holds until a step has
    // read it. What came off changes model and state, so both are read again.
    plant.model_changed = plant.state_changed = !plant.detached.empty();
  }
}

void RodSystem::solve(double dt, const Vec3& gravity) {
  // Plants that touch are solved as one, and beds would be of no use: each one's Newton would have
  // to wait for the others' contacts.
  if (touching_ || !strings_.empty()) {
    work_->step_canopy(*this, dt, gravity);
  } else if (settings_.solver == SolverKind::direct) {
    std::vector<Work::Bed>& beds = work_->beds;
    if (beds.empty()) work_->make_beds(*this);
    if (beds.size() == 1)
      beds[0].step(plants_, dt, gravity, &pool_, nullptr);
    else
      // A bed is stepped by the same thread in every step, whose cache has it still. Handing beds
      // out to whoever is free would balance better and move the memory to and fro. No bed looks at
      // another one, so the bits do not depend on the order.
      pool_.for_each(pool_.threads(), [&](int thread) {
        for (Work::Bed& bed : beds)
          if (bed.thread == thread)
            bed.step(plants_, dt, gravity, nullptr, work_->what_follows(plants_, bed));
      });
  } else {
    pool_.for_each(size(), [&](int i) {
      Plant& plant = plants_[i];
      plant.report = plant.solver->step(plant.model, plant.state,
                                        {dt, gravity, plant.loads, plant.source_pointers});
    });
  }
}

DirectSolver::PlantStep RodSystem::Work::step_of(Plant& plant) {
  DirectSolver::PlantStep step;
  step.model = &plant.model;
  step.state = &plant.state;
  step.loads = plant.loads;
  step.contacts = plant.source_pointers;
  step.model_changed = plant.model_changed;
  step.state_changed = plant.state_changed;
  step.ties = plant.ties;
  step.air = plant.air;
  return step;
}

void RodSystem::let_plants_touch(const SelfContactSettings& settings) {
  if (settings_.solver != SolverKind::direct)
    throw UsageError("RodSystem::let_plants_touch: position-based solver, must be the direct one");
  // A running canopy keeps what its contacts remember. A new one is made with these settings
  // anyway.
  if (work_->canopy && touching_) {
    work_->canopy->change_settings(settings);
    for (const Plant& plant : plants_)
      for (ContactSource* source : plant.source_pointers)
        if (auto* blades = dynamic_cast<PlantBlades*>(source)) blades->change_settings(settings);
  } else {
    work_->canopy.reset();
  }
  touching_ = settings;
  work_->beds.clear();
}

int RodSystem::add_string(const PlantString& string) {
  if (settings_.solver != SolverKind::direct)
    throw UsageError("RodSystem::add_string: position-based solver, must be the direct one");
  for (const PlantString::End& end : {string.a, string.b})
    if (end.plant < 0 || end.plant >= size() || end.element < 0 ||
        end.element >= model(end.plant).size())
      throw UsageError("RodSystem::add_string: an end on no element of a plant, must be on one");
  if (string.a.plant == string.b.plant && string.a.element == string.b.element)
    throw UsageError("RodSystem::add_string: both ends on one element, must be on two");
  strings_.push_back(string);
  work_->canopy.reset();
  work_->beds.clear();
  return static_cast<int>(strings_.size()) - 1;
}

void RodSystem::Work::step_canopy(RodSystem& system, double dt, const Vec3& gravity) {
  steps.clear();
  // Filled in each step: the flags, loads and spans are of this step only.
  for (Plant& plant : system.plants_) steps.push_back(step_of(plant));
  if (!canopy)
    canopy = std::make_unique<Canopy>(system.settings_, system.touching_, steps,
                                      system.pool_.threads(), system.strings_);
  canopy->step(steps, dt, gravity, system.pool_);
  for (int p = 0; p < system.size(); ++p) system.plants_[p].report = steps[p].report;
}

void RodSystem::Work::make_beds(RodSystem& system) {
  const int threads = system.pool_.threads();
  std::vector<Plant>& plants = system.plants_;
  std::vector<int> elements;
  for (const Plant& plant : plants) elements.push_back(plant.model.size());
  // The beds of a thread share the memory that a step needs.
  // On pages of 4 kB a large plant's rows miss the address cache at each of them.
  const bool is_large = std::accumulate(elements.begin(), elements.end(), 0) >= large;
  std::vector<std::shared_ptr<RowScratch>> scratch;
  for (int thread = 0; thread < threads; ++thread)
    scratch.push_back(std::make_shared<RowScratch>(is_large));
  const std::vector<Share> shares = share_out(elements, threads);
  int next = 0;
  for (const Share& share : shares) {
    Bed& bed = beds.emplace_back();
    bed.first = next;
    bed.thread = share.thread;
    std::vector<const RodModel*> models;
    for (int i = 0; i < share.plants; ++i, ++next) {
      plants[next].bed = static_cast<int>(beds.size()) - 1;
      // New rows are empty. Without this a plant added beside running ones would be solved beside
      // plants of zeros.
      plants[next].model_changed = plants[next].state_changed = true;
      models.push_back(&plants[next].model);
    }
    bed.solver = std::make_unique<DirectSolver>(
        system.settings_, models, shares.size() == 1 ? threads : 1, scratch[bed.thread]);
    bed.steps.resize(models.size());
  }
  ahead.resize(threads);
}

void RodSystem::Work::Bed::step(std::vector<Plant>& plants, double dt, const Vec3& gravity,
                                ThreadPool* pool, FetchAhead* next) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = step_of(plants[first + i]);
  if (pool)
    solver->step(steps, dt, gravity, *pool);
  else
    // A thread that works alone has memory to wait for, and asks meanwhile for that of its next
    // bed.
    solver->step(steps, dt, gravity, next);
  for (std::size_t i = 0; i < steps.size(); ++i) plants[first + i].report = steps[i].report;
}

// The bed that its thread steps next, in the next step the first one again; nullptr where that is
// the same.
FetchAhead* RodSystem::Work::what_follows(const std::vector<Plant>& plants, const Bed& bed) {
  const auto count = beds.size();
  auto after = static_cast<std::size_t>(&bed - beds.data());
  // Ends for certain: after a round it is at the bed itself, whose thread is its own.
  do after = (after + 1) % count;
  while (beds[after].thread != bed.thread);
  const Bed& next = beds[after];
  if (&next == &bed) return nullptr;
  FetchAhead& asked = ahead[bed.thread].next_bed;
  asked.clear();
  next.solver->add_to(asked);
  for (std::size_t i = 0; i < next.steps.size(); ++i) {
    // The vectors that a step reads, and no more: each line asked for pushes another one out.
    const RodState& state = plants[next.first + i].state;
    asked.add(state.position);
    asked.add(state.orientation);
    asked.add(state.velocity);
    asked.add(state.angular_velocity);
    asked.add(state.alive);
  }
  return &asked;
}

const std::vector<ContactForce>& RodSystem::contact_forces(int plant) const {
  // Beds are made by the first step, and a picture may be wanted before it.
  static const std::vector<ContactForce> none;
  if (joint_) return joint_->contact_forces(*this, plant);
  if (plants_[plant].solver) return plants_[plant].solver->contact_forces();
  if (work_->canopy) return work_->canopy->contact_forces(plant);
  if (work_->beds.empty()) return none;
  const Work::Bed& bed = work_->beds[plants_[plant].bed];
  return bed.solver->contact_forces(plant - bed.first);
}

void RodSystem::set_state(int plant, const RodState& state) {
  // The clamp is taken to have stood where it is: a jump of the root would else be a velocity of
  // the clamp, and shake the plant.
  edit_state(plant) = state;
  plants_[plant].state.previous_dt = 0.0;
  plants_[plant].state.previous_root = state.root;
  // Whichever solver has the plant: friction's springs and BDF2's past are of the old state.
  if (plants_[plant].solver) plants_[plant].solver->reset();
  if (work_->canopy) work_->canopy->reset();
  if (joint_) joint_->reset(*this, plant);
  if (work_->beds.empty() || settings_.solver != SolverKind::direct) return;
  Work::Bed& bed = work_->beds[plants_[plant].bed];
  bed.solver->reset(plant - bed.first);
}

void RodSystem::change_constants(int plant, RodModel model) {
  Plant& held = plants_[plant];
  // The rows, the contact lists and the friction memory are all by element and shape. Another shape
  // under them would be read with the old numbers.
  if (!differs_in_constants_only(held.model, model))
    throw UsageError("RodSystem::change_constants: \"" + model.name +
                     "\" has another shape than \"" + held.model.name +
                     "\", which is running: must have the same");
  // The new model was made whole, with all its fruits' masses. Those that have fallen are taken out
  // again before the centres of mass are compared.
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
  held.model_changed = held.state_changed = true;
  // With other constants the past is that of another plant, and the next step is of first order.
  held.state.previous_dt = 0.0;
}

void RodSystem::change_settings(const RodSettings& settings) {
  if (settings.solver != settings_.solver)
    throw UsageError("RodSystem::change_settings: another solver, must be the same");
  settings_ = settings;
  for (Plant& plant : plants_)
    if (plant.solver) plant.solver->change_settings(settings);
  for (Work::Bed& bed : work_->beds) bed.solver->change_settings(settings);
  if (work_->canopy) work_->canopy->change_settings(settings);
}

void RodSystem::add_to(StateHash& hash) const {
  for (const Plant& plant : plants_) {
    for (int e = 0; e < plant.state.size(); ++e) {
      hash.add(plant.state.position[e]);
      hash.add(plant.state.orientation[e]);
      // Rates stand beside poses: two runs that agree in poses at one time may part in the next
      // step.
      hash.add(plant.state.velocity[e]);
      hash.add(plant.state.angular_velocity[e]);
      hash.add(static_cast<std::uint64_t>(plant.state.alive[e]));
    }
    // What joints remember is state as well: two plants of one pose may go on differently.
    for (const Vec3& z : plant.state.joint_memory) hash.add(z);
  }
}

std::optional<Vec3> place_of(const RodSystem& system, const PlantString::End& end) {
  const RodState& held = system.state(end.plant);
  if (!held.alive[end.element]) return {};
  // On the segment's axis, where the solver has it, and not between its nodes, which strain parts.
  return held.position[end.element] - end.back * (held.orientation[end.element] * Vec3::UnitZ());
}

double tension(const RodSystem& system, const PlantString& string) {
  const auto a = place_of(system, string.a), b = place_of(system, string.b);
  if (!a || !b) return 0.0;
  return string.stiffness * std::max(0.0, (*b - *a).norm() - string.length);
}

}  // namespace pedicel::cosserat
