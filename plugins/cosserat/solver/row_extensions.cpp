#include "plugins/cosserat/solver/row_extensions.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/lanes/lane_access.h"

namespace pedicel::cosserat {

namespace {

constexpr double pi = 3.14159265358979323846;

bool has_slider(const JointBranch& branch) {
  return std::isfinite(branch.limit);
}

// As it is in the settled shape: of what has a memory only what can yield is there, and carries
// what the dashpots will later lack.
JointLaw settled_law(JointLaw law) {
  double lacking = law.anchored;
  for (JointBranch& branch : law.branches) {
    if (branch.plastic) continue;
    if (branch.from_unloaded) lacking += branch.share;
    branch.share = 0.0;
  }
  for (JointBranch& branch : law.branches) {
    if (!branch.plastic) continue;
    const double whole = branch.share + lacking;
    branch.limit *= whole / branch.share;
    branch.share = whole;
  }
  law.deviation = law.relaxed;
  return law;
}

// What the sliders of a law carry of the twist, which they leave elastic.
double held_twist(const JointLaw& law, const JointLaw& now) {
  double sum = 0.0;
  for (std::size_t j = 0; j < law.branches.size(); ++j)
    if (has_slider(law.branches[j]))
      sum += law.branches[j].plastic ? now.branches[j].share : law.branches[j].share;
  return sum;
}

}  // namespace

void RowExtensions::read_model(int plant, const RodModel& model) {
  Extended& extended = plants_[plant];
  const bool before = extended.any;
  extended.any = is_extended(model);
  extended.fresh = true;
  extended.branches = branch_count(model);
  if (!extended.any && !before) return;
  if (store_.make_extensions(extended.branches))
    for (Extended& any : plants_) any.fresh = true;
  for (int e = 0; e < model.size(); ++e) {
    const auto [row, lane] = store_.layout.slot(plant, e);
    ExtensionRow& out = store_.extension[row];
    const SegmentAir air = model.air.empty() ? SegmentAir{} : model.air[e];
    out.drag[lane] = 0.5 * SegmentAir::density * air.drag_area * model.elements[e].length *
                     store_.element[row].alive[lane];
    const double blown =
        0.5 * SegmentAir::density * model.elements[e].length * store_.element[row].alive[lane];
    out.plate_normal[lane] = blown * air.plate_normal;
    out.plate_tangential[lane] = blown * air.plate_tangential;
    put(out.plate, lane, air.plate);
    put(out.velocity, lane, air.velocity);
    put(out.gust, lane, air.gust);
  }
  mark_packs(plant, model);
}

// A pack does what any of its plants needs.
void RowExtensions::mark_packs(int plant, const RodModel& model) {
  int sliders = 0;
  unsigned terms = 0;
  bool hysteretic = false;
  for (const JointLaw& law : model.laws) {
    for (const JointBranch& branch : law.branches) hysteretic = hysteretic || branch.exponent > 0.0;
    terms |= law.terms_there();
    sliders = std::max(sliders, static_cast<int>(std::count_if(law.branches.begin(),
                                                               law.branches.end(), has_slider)));
  }
  if (terms != 0) store_.joint_term.resize(store_.layout.rows(), JointTermRow{});
  for (const int c : store_.layout.chains_of_plant(plant)) {
    const int number = store_.layout.chains()[c].pack;
    store_.make_viscous(number);
    Pack& pack = store_.packs[number];
    pack.extended = true;
    pack.windy = pack.windy || !model.air.empty();
    pack.plated = pack.plated || std::ranges::any_of(model.air, &SegmentAir::has_plate);
    pack.terms |= terms;
    pack.branches = std::max(pack.branches, plants_[plant].branches);
    pack.sliders = std::max(pack.sliders, sliders);
    pack.hysteretic = pack.hysteretic || hysteretic;
  }
}

void RowExtensions::begin_step(int plant, const RodModel& model, double time, double dt,
                               bool settled, std::span<const Vec3> air) {
  Extended& extended = plants_[plant];
  if (!extended.any && !extended.fresh) return;
  const double end = settled ? time : time + dt;
  const double gust =
      settled || !air.empty() ? 0.0 : std::sin(2.0 * pi * model.gust_frequency * end);
  const double modulus = stiffness_factor(model, end);
  for (const auto [p, begin, behind] : store_.layout.lanes_of_plant(plant)) {
    Pack& pack = store_.packs[p];
    std::fill(pack.modulus + begin, pack.modulus + behind, modulus);
    std::fill(pack.gust_now + begin, pack.gust_now + behind, gust);
  }
  if (!model.air.empty())
    for (std::size_t e = 0; e < air.size(); ++e) {
      const auto [row, lane] = store_.layout.slot(plant, static_cast<int>(e));
      put(store_.extension[row].velocity, lane, air[e]);
    }
  if (!extended.fresh && extended.dt == dt && extended.settled == settled) return;
  extended.fresh = false;
  extended.dt = dt;
  extended.settled = settled;
  if (!store_.extension.empty()) read_branches(plant, model);
}

void RowExtensions::read_branches(int plant, const RodModel& model) {
  const Extended& extended = plants_[plant];
  const JointLaw plain;
  JointLaw settled;
  for (int e = 0; e < model.size(); ++e) {
    const Slot slot = store_.layout.slot(plant, e);
    const auto [row, lane] = slot;
    ExtensionRow& out = store_.extension[row];
    const JointLaw& given = model.laws.empty() ? plain : model.laws[e];
    if (extended.settled) settled = settled_law(given);
    const JointLaw& law = extended.settled ? settled : given;
    out.lawful[lane] = model.laws.empty() ? 0.0 : 1.0;
    out.bend_excess[lane] = law.elastic + law.deviation - 1.0;
    out.twist_excess[lane] = out.bend_excess[lane] + held_twist(given, law);
    out.elastic[lane] = law.elastic;
    if (!store_.joint_term.empty()) read_terms(law, slot);
    put(store_.extension_term[row].bias, lane, Vec3(0, 0, 0));
    for (int j = 0; j < store_.law_branches_a_row; ++j) {
      BranchRow& to = store_.law_branch[row * store_.law_branches_a_row + j];
      const JointBranch branch =
          j < static_cast<int>(law.branches.size()) ? law.branches[j] : JointBranch{};
      const double x = extended.dt / branch.time;
      to.share[lane] = branch.share;
      to.limit[lane] = branch.limit;
      to.exponent[lane] = branch.exponent;
      to.decay[lane] = std::exp(-x);
      to.factor[lane] = x > 0.0 ? -std::expm1(-x) / x : 1.0;
    }
  }
}

void RowExtensions::read_terms(const JointLaw& law, Slot slot) {
  JointTermRow& out = store_.joint_term[slot.row];
  for (int i = 0; i < laws::joint_term_numbers; ++i)
    out.number[i][slot.lane] = law.terms.empty() ? 0.0 : law.terms[i];
}

void RowExtensions::read_memory(int plant, const RodState& state, int e, Slot slot) {
  const int branches = plants_[plant].branches;
  if (branches == 0) return;
  put(store_.extension_term[slot.row].bias, slot.lane, state.joint_bias[e]);
  for (int j = 0; j < branches; ++j)
    put(store_.law_branch[slot.row * store_.law_branches_a_row + j].value, slot.lane,
        state.joint_memory[e * branches + j]);
}

void RowExtensions::write_memory(int plant, RodState& state, int e, Slot slot) const {
  const int branches = plants_[plant].branches;
  for (int j = 0; j < branches; ++j)
    state.joint_memory[e * branches + j] =
        vector_at(store_.law_branch[slot.row * store_.law_branches_a_row + j].value, slot.lane);
}

void RowExtensions::remove(Slot slot) {
  if (store_.extension.empty()) return;
  ExtensionRow& out = store_.extension[slot.row];
  out.drag[slot.lane] = out.plate_normal[slot.lane] = out.plate_tangential[slot.lane] = 0.0;
}

}  // namespace pedicel::cosserat
