#include "plugins/discrepancy/simulate/root_wrench.h"

#include "plugins/cosserat/model/rotation.h"

namespace pedicel::discrepancy {

namespace {

constexpr double same_moment = 1.0e-12;  // s

Eigen::Matrix<double, 6, 1> rate_of(const cosserat::RodModel& model,
                                    const cosserat::RodState& state, int e,
                                    const RootMotion& root) {
  const cosserat::Element& element = model.elements[e];
  const Quat& q = state.orientation[e];
  const Vec3& own = state.angular_velocity[e];
  const Vec3 along = (state.position[e] - state.root.position) / element.length;
  const Vec3 grows = (cosserat::velocity_on(model, state, e, 0.0) - root.velocity) / element.length;
  const Vec3 turns = own - q.conjugate() * root.turning;
  Eigen::Matrix<double, 6, 1> rate;
  rate << q.conjugate() * Vec3(grows - (q * own).cross(along)),
      cosserat::inverse_right_jacobian(cosserat::strain_of(model, state, e).bend) * turns;
  return rate;
}

}  // namespace

RootWrench::Wrench RootWrench::begin(const cosserat::RodModel& model,
                                     const cosserat::RodState& state, double t,
                                     const RootMotion* root) {
  elements_.clear();
  for (int e = 0; e < model.size(); ++e)
    if (model.elements[e].parent < 0) elements_.push_back(e);
  last_ = strains(model, state);
  rate_.assign(elements_.size(), Wrench::Zero());
  for (std::size_t i = 0; root && i < elements_.size(); ++i)
    rate_[i] = rate_of(model, state, elements_[i], *root);
  time_ = t;
  step_ = 0.0;
  return sum(model, state);
}

// BDF2's derivative, as the step has it.
RootWrench::Wrench RootWrench::after(const cosserat::RodModel& model,
                                     const cosserat::RodState& state, double t, bool restarted) {
  const double h = t - time_;
  if (h <= same_moment) return sum(model, state);
  const Strains now = strains(model, state);
  const bool first_order = restarted || step_ == 0.0;
  const double r = first_order ? 0.0 : h / step_;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    rate_[i] = ((1.0 + 2.0 * r) / (1.0 + r) * now[i] - (1.0 + r) * last_[i]) / h;
    if (!first_order) rate_[i] += r * r / (1.0 + r) / h * before_[i];
  }
  before_ = last_;
  last_ = now;
  time_ = t;
  step_ = h;
  return sum(model, state);
}

RootWrench::Strains RootWrench::strains(const cosserat::RodModel& model,
                                        const cosserat::RodState& state) const {
  Strains all;
  for (const int e : elements_) {
    const cosserat::Strain strain = cosserat::strain_of(model, state, e);
    all.emplace_back() << strain.stretch, strain.bend;
  }
  return all;
}

RootWrench::Wrench RootWrench::sum(const cosserat::RodModel& model,
                                   const cosserat::RodState& state) const {
  Wrench wrench = Wrench::Zero();
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const int e = elements_[i];
    if (!state.alive[e]) continue;
    const cosserat::Element& element = model.elements[e];
    const Vec3 bend = cosserat::strain_of(model, state, e).bend;
    cosserat::JointLoad load = cosserat::joint_load(model, state, e);
    const Vec3 stretching = rate_[i].head<3>(), bending = rate_[i].tail<3>();
    load.force += element.damping_time * element.stretch_stiffness.cwiseProduct(stretching);
    load.moment += element.damping_time * (cosserat::inverse_right_jacobian(bend).transpose() *
                                           element.bend_stiffness.cwiseProduct(bending));
    wrench.head<3>() -= state.orientation[e] * load.force;
    wrench.tail<3>() -= state.orientation[e] * load.moment;
  }
  return wrench;
}

}  // namespace pedicel::discrepancy
