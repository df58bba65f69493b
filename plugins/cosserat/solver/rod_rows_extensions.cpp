// The part of RodRows that reads joint laws, air and drift (lanes.h: ExtensionRow, BranchRow).
#include <algorithm>
#include <cmath>

#include "pedicel/cosserat/lanes/lane_access.h"
#include "pedicel/cosserat/solver/rod_rows.h"

namespace pedicel::cosserat {

namespace {

constexpr double pi = 3.14159265358979323846;

ExtensionRow plain_row() {
  ExtensionRow row{};
  std::fill(std::begin(row.elastic), std::end(row.elastic), 1.0);
  return row;
}

BranchRow no_branch() {
  BranchRow row{};
  std::fill(std::begin(row.limit), std::end(row.limit), JointBranch::never);
  return row;
}

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

void RodRows::make_extension_rows(int branches) {
  extension_.resize(layout_.rows(), plain_row());
  extension_term_.resize(layout_.rows(), ExtensionTermRow{});
  if (branches <= branches_a_row_) return;
  branches_a_row_ = branches;
  branch_.assign(static_cast<std::size_t>(layout_.rows()) * branches, no_branch());
  for (Extended& plant : extended_) plant.fresh = true;
}

void RodRows::read_extensions(int plant, const RodModel& model) {
  Extended& extended = extended_[plant];
  const bool before = extended.any;
  extended.any = is_extended(model);
  extended.fresh = true;
  extended.branches = branch_count(model);
  if (!extended.any && !before) return;
  make_extension_rows(extended.branches);
  for (int e = 0; e < model.size(); ++e) {
    const auto [row, lane] = layout_.slot(plant, e);
    ExtensionRow& out = extension_[row];
    const SegmentAir air = model.air.empty() ? SegmentAir{} : model.air[e];
    out.drag[lane] = 0.5 * SegmentAir::density * air.drag_area * model.elements[e].length *
                     element_[row].alive[lane];
    const double blown =
        0.5 * SegmentAir::density * model.elements[e].length * element_[row].alive[lane];
    out.plate_normal[lane] = blown * air.plate_normal;
    out.plate_tangential[lane] = blown * air.plate_tangential;
    put(out.plate, lane, air.plate);
    put(out.velocity, lane, air.velocity);
    put(out.gust, lane, air.gust);
  }
  mark_extended(plant, model);
}

// A pack does what any of its plants needs.
void RodRows::mark_extended(int plant, const RodModel& model) {
  int sliders = 0;
  unsigned terms = 0;
  bool hysteretic = false;
  for (const JointLaw& law : model.laws) {
    for (const JointBranch& branch : law.branches) hysteretic = hysteretic || branch.exponent > 0.0;
    terms |= law.terms_there();
    sliders = std::max(sliders, static_cast<int>(std::count_if(law.branches.begin(),
                                                               law.branches.end(), has_slider)));
  }
  if (terms != 0) joint_term_.resize(layout_.rows(), JointTermRow{});
  for (const int c : layout_.chains_of_plant(plant)) {
    Pack& pack = packs_[layout_.chains()[c].pack];
    pack.extended = true;
    make_viscous(c);
    pack.windy = pack.windy || !model.air.empty();
    pack.plated = pack.plated || std::ranges::any_of(model.air, &SegmentAir::has_plate);
    pack.terms |= terms;
    pack.branches = std::max(pack.branches, extended_[plant].branches);
    pack.sliders = std::max(pack.sliders, sliders);
    pack.hysteretic = pack.hysteretic || hysteretic;
  }
}

void RodRows::set_extensions(int plant, const RodModel& model, double time, double dt,
                             bool settled) {
  Extended& extended = extended_[plant];
  if (!extended.any && !extended.fresh) return;
  const double end = settled ? time : time + dt;
  const double gust = settled ? 0.0 : std::sin(2.0 * pi * model.gust_frequency * end);
  const double modulus = stiffness_factor(model, end);
  for (const auto [p, begin, behind] : layout_.lanes_of_plant(plant)) {
    std::fill(packs_[p].modulus + begin, packs_[p].modulus + behind, modulus);
    std::fill(packs_[p].gust_now + begin, packs_[p].gust_now + behind, gust);
  }
  if (!extended.fresh && extended.dt == dt && extended.settled == settled) return;
  extended.fresh = false;
  extended.dt = dt;
  extended.settled = settled;
  if (!extension_.empty()) read_branches(plant, model);
}

void RodRows::read_branches(int plant, const RodModel& model) {
  const Extended& extended = extended_[plant];
  const JointLaw plain;
  JointLaw settled;
  for (int e = 0; e < model.size(); ++e) {
    const auto [row, lane] = layout_.slot(plant, e);
    ExtensionRow& out = extension_[row];
    const JointLaw& given = model.laws.empty() ? plain : model.laws[e];
    if (extended.settled) settled = settled_law(given);
    const JointLaw& law = extended.settled ? settled : given;
    out.lawful[lane] = model.laws.empty() ? 0.0 : 1.0;
    out.bend_excess[lane] = law.elastic + law.deviation - 1.0;
    out.twist_excess[lane] = out.bend_excess[lane] + held_twist(given, law);
    out.elastic[lane] = law.elastic;
    if (!joint_term_.empty()) read_terms(law, row, lane);
    put(extension_term_[row].bias, lane, Vec3(0, 0, 0));
    for (int j = 0; j < branches_a_row_; ++j) {
      BranchRow& to = branch_[row * branches_a_row_ + j];
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

void RodRows::read_terms(const JointLaw& law, int row, int lane) {
  for (int i = 0; i < effects::joint_term_numbers; ++i)
    joint_term_[row].number[i][lane] = law.terms.empty() ? 0.0 : law.terms[i];
}

void RodRows::read_memory(int plant, const RodState& state, int e, int row, int lane) {
  const Extended& extended = extended_[plant];
  put(extension_term_[row].bias, lane, state.joint_bias[e]);
  for (int j = 0; j < extended.branches; ++j)
    put(branch_[row * branches_a_row_ + j].value, lane,
        state.joint_memory[e * extended.branches + j]);
}

}  // namespace pedicel::cosserat
