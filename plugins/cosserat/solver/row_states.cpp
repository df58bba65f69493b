#include "plugins/cosserat/solver/row_states.h"

#include <algorithm>

#include "plugins/cosserat/lanes/lane_access.h"
#include "plugins/cosserat/lanes/lane_kernels.h"

namespace pedicel::cosserat {

void RowStates::read_model(int plant, const RodModel& model) {
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    const auto [row, lane] = store_.layout.slot(plant, e);
    ElementRow& out = store_.element[row];
    out.length[lane] = element.length;
    put(out.stretch_stiffness, lane, element.stretch_stiffness);
    put(out.bend_stiffness, lane, element.bend_stiffness);
    put(out.rest_strain, lane, element.rest_strain);
    put(out.rest_rotation, lane, element.rest_rotation);
    out.mass[lane] = element.mass;
    out.com_back[lane] = element.com_back;
    put(out.inertia, lane, element.inertia);
    out.damping_time[lane] = element.damping_time;
    out.mass_damping[lane] = element.mass_damping;
    // Rows read anew take everything as alive. What came off is found when the state is read, in
    // read_element(), which takes its stiffness out again; so a model that is read must be followed
    // by its state.
    out.alive[lane] = 1.0;
  }
  // Viscous rows are made for packs that need them only: memory limits the kernels, and without
  // damping these rows would hold constants.
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const Chain& chain = store_.layout.chains()[c];
    if (std::any_of(chain.elements.begin(), chain.elements.end(),
                    [&](int e) { return model.elements[e].damping_time > 0.0; }))
      store_.make_viscous(chain.pack);
    read_welds(model, chain);
  }
  // Last: drag is zero where nothing is alive, and that was put just above.
  extensions_.read_model(plant, model);
}

// Those that the rows solve.
void RowStates::read_welds(const RodModel& model, const Chain& chain) {
  int row = store_.packs[chain.pack].first_weld;
  for (const int w : chain.welds) {
    const Weld& weld = model.welds[w];
    WeldRow& out = store_.weld[row++];
    out.position_stiffness[chain.lane] = weld.position_stiffness;
    put(out.bend_stiffness, chain.lane, weld.bend_stiffness);
    put(out.rest_rotation, chain.lane, weld.rest_rotation);
  }
}

// Variable-step BDF2 (Hairer, Norsett & Wanner, Solving ODEs I, section III.5).
void RowStates::set_scheme(int plant, double dt, double previous_dt, std::span<const Clamp> clamps,
                           bool accelerate) {
  // Before the early return below. A clamp moves in every step, while the scheme mostly stays.
  store_.clamps[plant].assign(clamps.begin(), clamps.end());
  const Scheme scheme{dt, previous_dt, accelerate};
  if (scheme == schemes_[plant]) return;  // mostly; see RowStore::set_active()
  schemes_[plant] = scheme;
  // At the end x' = (x - (past_now x_n - past_before x_n-1)) / effective_step.
  // A ratio of 0 makes the same formula backward Euler: weights 1 and 0, and the effective step dt.
  // With equal steps the ratio is 1, and they are 4/3, 1/3 and 2/3 dt.
  const bool first_order = previous_dt == 0.0;
  const double ratio = first_order ? 0.0 : dt / previous_dt;
  const double divisor = 1.0 + 2.0 * ratio;
  for (const auto [p, begin, end] : store_.layout.lanes_of_plant(plant)) {
    Pack& pack = store_.packs[p];
    for (int lane = begin; lane < end; ++lane) {
      pack.past_now[lane] = (1.0 + ratio) * (1.0 + ratio) / divisor;
      pack.past_before[lane] = ratio * ratio / divisor;
      pack.effective_step[lane] = dt * ((1.0 + ratio) / divisor);
      // By lane, since plants in one pack may have had different pasts. What the kernels do is then
      // the same for all lanes, without a branch.
      pack.accelerate[lane] = accelerate ? dt : 0.0;
    }
  }
}

void RowStates::set_history(int plant, const RodHistory& history) {
  const int n = static_cast<int>(history.position.size());
  for (int e = 0; e < n; ++e) {
    const auto [row, lane] = store_.layout.slot(plant, e);
    put(store_.previous[row], lane, history.position[e], history.orientation[e]);
    put(store_.previous_rate[row].velocity, lane, history.velocity[e]);
    put(store_.previous_rate[row].angular_velocity, lane, history.angular_velocity[e]);
    // Rows of strains are there only where some plant is viscous: without damping no rate of strain
    // is wanted.
    if (store_.previous_strain.empty()) continue;
    // Strain rates are differences of strains, and not strains of a difference of poses: only so do
    // they vanish under rigid motion.
    put(store_.previous_strain[row].stretch, lane, history.stretch[e]);
    put(store_.previous_strain[row].bend, lane, history.bend[e]);
  }
}

void RowStates::prepare(ThreadPool& pool, std::span<const RodState* const> states,
                        std::span<const char> unchanged) {
  // Without a list nothing is known of the states, and all are read.
  keeps_end_ = keeps_end_ && !unchanged.empty();
  const RowArrays rows = store_.arrays();
  store_.each_pack(pool, [&](int p) {
    // The parents of a pack may still be under way in another thread: they are fetched later.
    // For every pack, active or not: a pack that wakes later must not go on with its parents' poses
    // of an earlier step.
    store_.packs[p].anchored = false;
    if (!store_.packs[p].active) return;
    if (!has_states(p, unchanged)) read_states(p, states);
    cosserat::prepare(rows, store_.packs[p]);
  });
}

// Those of all its plants. What remembers more than poses and velocities is read.
// Rows that another solver shares do not keep what they held.
// The swap in end_step() has left the end of the last step where this one's start is expected.
bool RowStates::has_states(int pack, std::span<const char> unchanged) const {
  // A pack is read as a whole: one changed plant has its neighbours in the pack read, too.
  return keeps_end_ &&
         std::ranges::all_of(store_.anchors[pack], [&](const RowStore::Anchor& anchor) {
           const int plant = anchor.plant;
           return plant < 0 || (unchanged[plant] && extensions_.branches(plant) == 0);
         });
}

void RowStates::read_states(int pack, std::span<const RodState* const> states) {
  const int begin = store_.packs[pack].begin;
  // A lane without a plant gets a pose all the same. The kernels compute in it, and numbers that
  // are no numbers cost time in every operation, and trap in a build that looks for them.
  PoseRow& parents = store_.scratch->start[begin];
  for (int lane = 0; lane < lane_count; ++lane) {
    const RowStore::Anchor& anchor = store_.anchors[pack][lane];
    const auto& [plant, parent, first] = anchor;
    if (plant < 0) {
      put(parents, lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
    } else if (parent < 0) {  // strains of the start are against the clamp of the start
      const Pose& clamp = store_.clamp_of(anchor).before;
      put(parents, lane, clamp.position, clamp.rotation);
    } else {
      put(parents, lane, states[plant]->position[parent], states[plant]->orientation[parent]);
    }
  }
  for (int row = begin + 1; row < store_.packs[pack].end; ++row) {
    // The next bed's memory is asked for a few lines a row, between reads of this one's. All at
    // once would push out of the cache what this step needs.
    if (store_.ahead) store_.ahead->some();
    for (int lane = 0; lane < lane_count; ++lane) {
      const int e = store_.layout.elements(row)[lane];
      if (e < 0) {  // whatever the scratch held must not reach a lane's sums
        put(store_.scratch->start[row], lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
        put(store_.scratch->rate[row].velocity, lane, Vec3(0, 0, 0));
        put(store_.scratch->rate[row].angular_velocity, lane, Vec3(0, 0, 0));
        continue;
      }
      const int plant = store_.anchors[pack][lane].plant;
      read_element(*states[plant], plant, e, {row, lane});
    }
  }
}

void RowStates::read_element(const RodState& state, int plant, int e, Slot slot) {
  const auto [row, lane] = slot;
  put(store_.scratch->start[row], lane, state.position[e], state.orientation[e]);
  put(store_.scratch->rate[row].velocity, lane, state.velocity[e]);
  put(store_.scratch->rate[row].angular_velocity, lane, state.angular_velocity[e]);
  extensions_.read_memory(plant, state, e, slot);
  ElementRow& element = store_.element[row];
  if (state.alive[e] || element.alive[lane] == 0.0) return;
  // It came off: nothing ties it to its parent any more.
  // The row keeps its mass, so that its diagonal block stays positive definite and no pivot
  // vanishes. Only nothing pulls at it; its result is never written.
  element.alive[lane] = 0.0;
  put(element.stretch_stiffness, lane, Vec3(0, 0, 0));
  put(element.bend_stiffness, lane, Vec3(0, 0, 0));
  extensions_.remove(slot);
}

void RowStates::hold(int plant) {
  RowScratch& scratch = *store_.scratch;
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const Chain& chain = store_.layout.chains()[c];
    for (const int e : chain.elements) {
      // From `start` to `iterate` within the rows: the state itself is not read again, and other
      // plants in the pack keep their guess.
      const int row = store_.layout.slot(plant, e).row;
      put(scratch.iterate[row], chain.lane, vector_at(scratch.start[row].position, chain.lane),
          rotation_at(scratch.start[row].orientation, chain.lane));
    }
  }
  // Packs hold copies of their parents' poses, which have just changed.
  for (const LaneRun& run : store_.layout.lanes_of_plant(plant))
    store_.place_anchors(run.pack, scratch.iterate);
}

void RowStates::read_iterate(int plant, const RodState& state) {
  for (int e = 0; e < state.size(); ++e) {
    const Slot slot = store_.layout.slot(plant, e);
    put(store_.scratch->iterate[slot.row], slot.lane, state.position[e], state.orientation[e]);
  }
  // The same holds here: packs have copies of their parents' poses in their first rows.
  for (const LaneRun& run : store_.layout.lanes_of_plant(plant))
    store_.place_anchors(run.pack, store_.scratch->iterate);
}

// write(state, element, plant, slot) for all whose plant has a state, row by row, as the rows lie:
// a lane at a time would fetch each of them eight times.
template <class Write>
void RowStates::for_each_element(int pack, std::span<RodState* const> states,
                                 const Write& write) const {
  const auto& anchors = store_.anchors[pack];
  const auto has_state = [&](const RowStore::Anchor& anchor) {
    return anchor.plant >= 0 && states[anchor.plant];
  };
  // Most packs of an iteration have nobody who looks at a state. They are not even fetched.
  if (!std::ranges::any_of(anchors, has_state)) return;
  for (int row = store_.packs[pack].begin + 1; row < store_.packs[pack].end; ++row) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const int e = store_.layout.elements(row)[lane];
      if (e < 0) continue;
      const int plant = anchors[lane].plant;
      // Plants that nobody looks at have no state here, and cost a look at the pointer.
      if (RodState* const state = states[plant]) write(*state, e, plant, Slot{row, lane});
    }
  }
}

void RowStates::write_iterate(ThreadPool& pool, std::span<RodState* const> states) {
  store_.each_pack(pool, [&](int p) { write_pack(p, states); });
}

void RowStates::write_pack(int pack, std::span<RodState* const> states) const {
  const RowScratch& scratch = *store_.scratch;
  for_each_element(pack, states, [&](RodState& state, int e, int, Slot slot) {
    state.position[e] = vector_at(scratch.iterate[slot.row].position, slot.lane);
    state.orientation[e] = rotation_at(scratch.iterate[slot.row].orientation, slot.lane);
  });
}

void RowStates::finish(ThreadPool& pool, std::span<RodState* const> states) {
  const RowArrays rows = store_.arrays();
  store_.each_pack(pool, [&](int p) {
    // The new rates go where those of the step before stood: BDF2 has read them element by element,
    // and needs each only for its own. So no third array is kept.
    cosserat::finish(rows, store_.packs[p], store_.previous_rate.data());
    write_end(p, states);
  });
}

void RowStates::write_end(int pack, std::span<RodState* const> states) const {
  const RowScratch& scratch = *store_.scratch;
  for_each_element(pack, states, [&](RodState& state, int e, int plant, Slot slot) {
    // What came off is a rigid body elsewhere now. Its last pose stays in the state as it was.
    if (!state.alive[e]) return;
    const auto [row, lane] = slot;
    state.position[e] = vector_at(scratch.iterate[row].position, lane);
    state.orientation[e] = rotation_at(scratch.iterate[row].orientation, lane);
    state.velocity[e] = vector_at(store_.previous_rate[row].velocity, lane);
    state.angular_velocity[e] = vector_at(store_.previous_rate[row].angular_velocity, lane);
    extensions_.write_memory(plant, state, e, slot);
  });
}

// By swapping, where the scratch is its own: the end becomes the start, and the start the past.
// Nothing is copied: a step would else write all its rows a second time.
void RowStates::end_step() {
  RowScratch& scratch = *store_.scratch;
  keeps_end_ = store_.scratch.use_count() == 1;  // what a step leaves there is nobody else's
  if (keeps_end_) {
    // Two swaps turn three vectors round: the past gets the start, the start gets the end, and the
    // iterate is left with the old past, which the next prepare() overwrites.
    scratch.start.swap(store_.previous);
    scratch.start.swap(scratch.iterate);
    scratch.rate.swap(store_.previous_rate);
    scratch.strain.swap(store_.previous_strain);
    return;
  }
  // Beds that share the scratch would swap their past into each other's hands. They copy it, and
  // read their states anew in the next step.
  std::copy_n(scratch.start.begin(), store_.layout.rows(), store_.previous.begin());
  std::copy_n(scratch.rate.begin(), store_.layout.rows(), store_.previous_rate.begin());
  std::copy_n(scratch.strain.begin(), store_.previous_strain.size(),
              store_.previous_strain.begin());
}

}  // namespace pedicel::cosserat
