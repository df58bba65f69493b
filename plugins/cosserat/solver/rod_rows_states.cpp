// The part of RodRows that reads plants into its rows and writes their states.
#include <algorithm>

#include "pedicel/cosserat/lanes/lane_access.h"
#include "pedicel/cosserat/solver/rod_rows.h"

namespace pedicel::cosserat {

void RodRows::read_model(int plant, const RodModel& model) {
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    const auto [row, lane] = layout_.slot(plant, e);
    ElementRow& out = element_[row];
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
    out.alive[lane] = 1.0;
  }
  for (const int c : layout_.chains_of_plant(plant)) {
    const auto& elements = layout_.chains()[c].elements;
    if (std::any_of(elements.begin(), elements.end(),
                    [&](int e) { return model.elements[e].damping_time > 0.0; }))
      make_viscous(c);
  }
  read_extensions(plant, model);
}

void RodRows::make_viscous(int chain) {
  packs_[layout_.chains()[chain].pack].viscous = true;
  if (!previous_strain_.empty()) return;
  const auto rows = static_cast<std::size_t>(layout_.rows());
  previous_strain_.resize(rows, StrainRow{});
  if (scratch_->strain.size() < rows) {
    scratch_->strain.resize(rows);
    scratch_->viscous.resize(rows);
  }
}

void RodRows::read_states(int pack, std::span<const RodState* const> states) {
  const int begin = packs_[pack].begin;
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto [plant, parent] = anchors_[pack][lane];
    PoseRow& start = scratch_->start[begin];
    if (plant < 0)
      put(start, lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
    else if (parent < 0)  // strains of the start are against the clamp of the start
      put(start, lane, states[plant]->previous_root.position,
          states[plant]->previous_root.rotation);
    else
      put(start, lane, states[plant]->position[parent], states[plant]->orientation[parent]);
  }
  for (int row = begin + 1; row < packs_[pack].end; ++row) {
    if (ahead_) ahead_->some();
    PoseRow& start = scratch_->start[row];
    RateRow& rate = scratch_->rate[row];
    for (int lane = 0; lane < lane_count; ++lane) {
      const int e = layout_.elements(row)[lane];
      if (e < 0) {  // whatever the scratch held must not reach a lane's sums
        put(start, lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
        put(rate.velocity, lane, Vec3(0, 0, 0));
        put(rate.angular_velocity, lane, Vec3(0, 0, 0));
        continue;
      }
      const int plant = anchors_[pack][lane].plant;
      const RodState& state = *states[plant];
      put(start, lane, state.position[e], state.orientation[e]);
      put(rate.velocity, lane, state.velocity[e]);
      put(rate.angular_velocity, lane, state.angular_velocity[e]);
      if (extended_[plant].branches > 0) read_memory(plant, state, e, row, lane);
      if (state.alive[e] || element_[row].alive[lane] == 0.0) continue;
      // It came off: nothing ties it to its parent any more.
      element_[row].alive[lane] = 0.0;
      put(element_[row].stretch_stiffness, lane, Vec3(0, 0, 0));
      put(element_[row].bend_stiffness, lane, Vec3(0, 0, 0));
      if (extension_.empty()) continue;
      ExtensionRow& extension = extension_[row];
      extension.drag[lane] = extension.plate_normal[lane] = extension.plate_tangential[lane] = 0.0;
    }
  }
}

void RodRows::read_iterate(int plant, const RodState& state) {
  for (int e = 0; e < state.size(); ++e) {
    const Slot slot = layout_.slot(plant, e);
    put(scratch_->iterate[slot.row], slot.lane, state.position[e], state.orientation[e]);
  }
  for (const LaneRun& run : layout_.lanes_of_plant(plant))
    place_anchors(run.pack, scratch_->iterate);
}

void RodRows::set_history(int plant, const RodHistory& history) {
  const int n = static_cast<int>(history.position.size());
  for (int e = 0; e < n; ++e) {
    const auto [row, lane] = layout_.slot(plant, e);
    put(previous_[row], lane, history.position[e], history.orientation[e]);
    put(previous_rate_[row].velocity, lane, history.velocity[e]);
    put(previous_rate_[row].angular_velocity, lane, history.angular_velocity[e]);
    if (previous_strain_.empty()) continue;
    put(previous_strain_[row].stretch, lane, history.stretch[e]);
    put(previous_strain_[row].bend, lane, history.bend[e]);
  }
}

// write(state, element, row, lane) for all whose plant has a state, row by row, as the rows lie: a
// lane at a time would fetch each of them eight times.
template <class Write>
void RodRows::for_each_element(int pack, std::span<RodState* const> states,
                               const Write& write) const {
  const auto has_state = [&](const Anchor& anchor) {
    return anchor.plant >= 0 && states[anchor.plant];
  };
  if (!std::ranges::any_of(anchors_[pack], has_state)) return;
  for (int row = packs_[pack].begin + 1; row < packs_[pack].end; ++row) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const int e = layout_.elements(row)[lane];
      if (e < 0) continue;
      if (RodState* const state = states[anchors_[pack][lane].plant]) write(*state, e, row, lane);
    }
  }
}

void RodRows::write_pack(int pack, std::span<RodState* const> states) const {
  for_each_element(pack, states, [&](RodState& state, int e, int row, int lane) {
    state.position[e] = vector_at(scratch_->iterate[row].position, lane);
    state.orientation[e] = rotation_at(scratch_->iterate[row].orientation, lane);
  });
}

void RodRows::write_end(int pack, std::span<RodState* const> states) const {
  for_each_element(pack, states, [&](RodState& state, int e, int row, int lane) {
    if (!state.alive[e]) return;
    state.position[e] = vector_at(scratch_->iterate[row].position, lane);
    state.orientation[e] = rotation_at(scratch_->iterate[row].orientation, lane);
    state.velocity[e] = vector_at(previous_rate_[row].velocity, lane);
    state.angular_velocity[e] = vector_at(previous_rate_[row].angular_velocity, lane);
    const int branches = extended_[anchors_[pack][lane].plant].branches;
    for (int j = 0; j < branches; ++j)
      state.joint_memory[e * branches + j] =
          vector_at(branch_[row * branches_a_row_ + j].value, lane);
  });
}

}  // namespace pedicel::cosserat
