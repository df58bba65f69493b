#include "plugins/cosserat/model/joint_law.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "plugins/cosserat/laws/hysteresis-inl.h"
#include "plugins/cosserat/laws/internal_friction-inl.h"
#include "plugins/cosserat/laws/joint_terms-inl.h"
#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double least_stiffness = 0.01;  // 1, that drift leaves

double softer(const Vec3& stiffness) {
  return std::max(std::min(stiffness.x(), stiffness.y()), 1.0e-300);
}

const Vec3& memory_of(const RodState& state, int element, std::size_t branch) {
  return state
      .joint_memory[element * (state.joint_memory.size() / state.joint_bias.size()) + branch];
}

bool has_memory(const RodModel& model, const RodState& state) {
  return !model.laws.empty() && state.joint_bias.size() == model.laws.size();
}

double hung_share(const JointLaw& law) {
  double sum = 0.0;
  for (const JointBranch& branch : law.branches)
    if (branch.hung) sum += branch.share;
  return sum;
}

}  // namespace

double& JointLaw::term(std::string_view effect, int number) {
  const int first = laws::first_number(effect);
  PEDICEL_ASSERT(first >= 0);
  terms.resize(laws::joint_term_numbers, 0.0);
  return terms[first + number];
}

unsigned JointLaw::terms_there() const {
  unsigned bits = 0;
  for (const laws::JointTerm& one : laws::joint_terms)
    if (!terms.empty() && terms[one.first] != 0.0) bits |= one.bit;
  return bits;
}

void sort_branches(JointLaw& law) {
  std::stable_sort(law.branches.begin(), law.branches.end(),
                   [](const JointBranch& a, const JointBranch& b) {
                     return std::isfinite(a.limit) && !std::isfinite(b.limit);
                   });
}

void add_relaxation(JointLaw& law, double fraction, double time, RelaxationStart start) {
  const bool settled = start == RelaxationStart::settled;
  law.deviation -= fraction;
  if (settled) law.anchored += fraction;
  law.branches.push_back(
      {fraction, time, JointBranch::never, !settled, false, start == RelaxationStart::hung});
}

bool is_hung(const RodModel& model) {
  return std::ranges::any_of(model.laws, [](const JointLaw& law) {
    return std::ranges::any_of(law.branches, &JointBranch::hung);
  });
}

RodModel relaxed_for_long(RodModel model) {
  for (JointLaw& law : model.laws) {
    law.relaxed -= hung_share(law);
    std::erase_if(law.branches, [](const JointBranch& branch) { return branch.hung; });
  }
  return model;
}

void keep_hung_shape(RodModel& model, const RodState& state) {
  for (int e = 0; e < static_cast<int>(model.laws.size()); ++e)
    model.laws[e].hung = strain_of(model, state, e).bend;
}

void add_friction(JointLaw& law, double share, double limit) {
  law.elastic -= share;
  law.branches.push_back({share, JointBranch::never, limit, false, false});
  sort_branches(law);
}

void add_hysteresis(JointLaw& law, double share, double limit, double exponent) {
  add_friction(law, share, limit);
  // It is the last of those with a slider.
  const auto dashpots = std::ranges::find_if(
      law.branches, [](const JointBranch& branch) { return !std::isfinite(branch.limit); });
  std::prev(dashpots)->exponent = exponent;
}

void add_yield(JointLaw& law, double limit) {
  const double share = law.elastic + law.deviation;
  law.branches.push_back({share, JointBranch::never, share * limit, true, true});
  law.elastic = law.deviation = 0.0;
  sort_branches(law);
}

// Weights of log-spaced branches by least squares on eta(f)/g = 1 over the band: with weights e_j
// per long-term modulus, sum e_j (loss_j - g storage_j) = g is linear in them.
void add_structural_damping(JointLaw& law, double g, double frequency) {
  if (g <= 0.0) return;
  constexpr int count = 8, samples = 81;
  constexpr double low = 0.007, high = 280.0, band_low = 0.01, band_high = 200.0;  // Hz
  std::vector<double> times;
  for (int j = 0; j < count; ++j)
    times.push_back(1.0 / (2.0 * pi * low * std::pow(high / low, j / (count - 1.0))));
  Eigen::MatrixXd rows(samples, count);
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < count; ++j) {
      const double w = 2.0 * pi * band_low * std::pow(band_high / band_low, i / (samples - 1.0));
      const double x = w * times[j];
      rows(i, j) = (x - g * x * x) / (1.0 + x * x) / g;
    }
  const Eigen::VectorXd weights =
      rows.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(samples)).cwiseMax(0.0);
  double storage = 1.0;
  for (int j = 0; j < count; ++j) {
    const double x = 2.0 * pi * frequency * times[j];
    storage += weights[j] * x * x / (1.0 + x * x);
  }
  law.deviation += 1.0 / storage - 1.0;
  law.anchored += 1.0 - 1.0 / storage;
  for (int j = 0; j < count; ++j)
    law.branches.push_back({weights[j] / storage, times[j], JointBranch::never, false, false});
}

ComplexModulus modulus_at(const JointLaw& law, double frequency) {
  double storage = law.elastic + law.deviation, loss = 0.0;
  for (const JointBranch& branch : law.branches) {
    if (!std::isfinite(branch.time)) continue;
    const double x = 2.0 * pi * frequency * branch.time;
    storage += branch.share * x * x / (1.0 + x * x);
    loss += branch.share * x / (1.0 + x * x);
  }
  return {storage, loss / storage};
}

bool is_extended(const RodModel& model) {
  return !model.laws.empty() || !model.air.empty() || model.stiffness_drift != 0.0;
}

int branch_count(const RodModel& model) {
  std::size_t most = 0;
  for (const JointLaw& law : model.laws) most = std::max(most, law.branches.size());
  return static_cast<int>(most);
}

double stiffness_factor(const RodModel& model, double time) {
  return std::max(least_stiffness, 1.0 + model.stiffness_drift * (model.clock + time));
}

void start_settling(const RodModel& model, RodState& state) {
  if (model.laws.empty()) return;
  const std::size_t joints = model.laws.size(), all = joints * branch_count(model);
  if (!has_memory(model, state) || state.joint_memory.size() != all)
    state.joint_memory.assign(all, Vec3::Zero());
  state.joint_bias.resize(joints);
  for (std::size_t e = 0; e < joints; ++e)
    state.joint_bias[e] = -hung_share(model.laws[e]) * model.laws[e].hung;
}

void start_memory(const RodModel& model, RodState& state) {
  if (model.laws.empty()) return;
  const int count = branch_count(model);
  const bool begun = has_memory(model, state);
  if (!begun) state.joint_memory.assign(model.laws.size() * count, Vec3::Zero());
  state.joint_bias.assign(model.laws.size(), Vec3::Zero());
  for (int e = 0; e < model.size(); ++e) {
    const JointLaw& law = model.laws[e];
    const Vec3 phi = strain_of(model, state, e).bend;
    Vec3 given = Vec3::Zero();  // what yielded takes no part in what relaxes
    for (std::size_t j = 0; j < law.branches.size(); ++j) {
      Vec3& z = state.joint_memory[static_cast<std::size_t>(e) * count + j];
      const JointBranch& branch = law.branches[j];
      if (branch.plastic)
        given = z;
      else
        z = branch.hung ? law.hung : branch.from_unloaded ? Vec3(0, 0, 0) : phi;
    }
    state.joint_bias[e] = law.anchored * (phi - given);
  }
}

JointResponse joint_response(const RodModel& model, const RodState& state, int e, const Vec3& phi) {
  namespace formula = laws::HWY_NAMESPACE;
  const Vec3 k = stiffness_factor(model, state.time) * model.elements[e].bend_stiffness;
  if (model.laws.empty()) return {k.cwiseProduct(phi), 0.5 * phi.dot(k.cwiseProduct(phi))};
  const JointLaw& law = model.laws[e];
  const bool begun = has_memory(model, state);
  const Vec3 zero = Vec3::Zero();
  const Vec3& bias = begun ? state.joint_bias[e] : zero;
  const formula::BentJoint<double> joint{k.x(), k.y(), softer(k), law.elastic, phi.x(), phi.y()};
  formula::BendTerms<double> terms{};
  formula::add_joint_terms(law.terms_there(), law.terms.data(), joint, terms);
  Vec3 bend = (law.elastic + law.deviation) * phi + bias;
  double energy = 0.5 * (law.elastic + law.deviation) * phi.dot(k.cwiseProduct(phi)) +
                  bias.dot(k.cwiseProduct(phi));
  for (std::size_t j = 0; j < law.branches.size(); ++j) {
    const JointBranch& branch = law.branches[j];
    const Vec3 y = phi - (begun ? memory_of(state, e, j) : zero);
    if (!std::isfinite(branch.limit)) {
      bend += branch.share * y;
      energy += 0.5 * branch.share * y.dot(k.cwiseProduct(y));
      continue;
    }
    const double reach = branch.limit / (branch.share * joint.softer + 1.0e-300);
    if (branch.exponent > 0.0) {
      // On the way from where the joint is.
      const Vec3 start = strain_of(model, state, e).bend;
      const Vec3 before = start - (begun ? memory_of(state, e, j) : zero);
      formula::add_hysteresis(joint, branch.share, reach, branch.exponent, {before.x(), before.y()},
                              {start.x(), start.y()}, terms);
    } else {
      add_radial(joint, branch.share, y.x(), y.y(),
                 formula::slip(reach, bend_measure(joint, y.x(), y.y())), terms);
    }
    bend.z() += branch.share * phi.z();
    energy += 0.5 * branch.share * k.z() * phi.z() * phi.z();
  }
  return {k.cwiseProduct(bend) + Vec3(terms.moment1, terms.moment2, 0.0), energy + terms.energy};
}

}  // namespace pedicel::cosserat
