#pragma once

#include "plugins/cosserat/model/rotation.h"
#include "tests/analytic/rod_cases.h"

/// A rod of one segment on its joint: one angle phi about the y axis, so that what a joint's law
/// says can be compared with an ordinary differential equation.
namespace pedicel::cosserat::cases {

/// Length 0.2 m along x, hinged at the origin; bends by phi about y, towards -z. Stretch and shear
/// are a thousand times as stiff as the section's: a start without the shear that goes with it
/// would ring by 2e-4 rad.
struct Joint {
  static constexpr double length = 0.2, radius = 0.004;
  static Section section() { return circle_section(radius, {1.0e8, 0.3, 700.0, 0.0}); }
  static RodModel model(double damping_time = 0.0) {
    RodModel one = straight_rod(length, 1, section(), Vec3::UnitX(), Vec3::Zero(), damping_time);
    one.elements[0].stretch_stiffness *= 1.0e3;
    return one;
  }
  /// kg m2 about the joint.
  static double inertia(const RodModel& model) {
    const Element& e = model.elements[0];
    const double arm = e.length - e.com_back;
    return e.inertia.y() + e.mass * arm * arm;
  }
  static double stiffness(const RodModel& model) { return model.elements[0].bend_stiffness.y(); }
  static double frequency(const RodModel& model) {
    return std::sqrt(stiffness(model) / inertia(model)) / (2.0 * pi);
  }
  static Quat turned(double phi) { return Quat(Eigen::AngleAxisd(phi, Vec3::UnitY())); }
  static double angle(const RodState& state) {
    const Vec3 along = state.orientation[0] * Vec3::UnitZ();
    return std::atan2(-along.z(), along.x());
  }
  static void bend(const RodModel& model, RodState& state, double phi) {
    state.orientation[0] = turned(phi) * model.elements[0].drawn_rotation;
    state.position[0] = model.elements[0].length * (state.orientation[0] * Vec3::UnitZ());
  }
  static double moment(const RodModel& model, const RodState& state) {
    return joint_load(model, state, 0).moment.norm() *
           (joint_load(model, state, 0)
                        .moment.dot(state.orientation[0].conjugate() * Vec3::UnitY()) < 0.0
                ? -1.0
                : 1.0);
  }
};

/// Holds the segment's direction by a rotational spring a thousand times as stiff as the joint.
inline void hold_direction(RodModel& model) {
  Support support;
  support.position_stiffness = 0.0;
  support.rotation_stiffness = 1.0e6 * model.elements[0].bend_stiffness;
  support.rotation = model.elements[0].drawn_rotation;
  model.supports.push_back(support);
}

/// Turns the held direction to an angle (rad).
inline void hold_at(RodModel& model, double phi) {
  model.supports[0].rotation = Joint::turned(phi) * model.elements[0].drawn_rotation;
}

/// phi(t) by the classical Runge-Kutta method, I phi'' = moment(t, phi, phi').
template <class Moment>
double runge_kutta(double inertia, double phi, double rate, double time, int steps,
                   const Moment& moment) {
  const double h = time / steps;
  const auto slope = [&](double t, double x, double v) {
    return std::pair(v, moment(t, x, v) / inertia);
  };
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const auto [x1, v1] = slope(t, phi, rate);
    const auto [x2, v2] = slope(t + h / 2, phi + h / 2 * x1, rate + h / 2 * v1);
    const auto [x3, v3] = slope(t + h / 2, phi + h / 2 * x2, rate + h / 2 * v2);
    const auto [x4, v4] = slope(t + h, phi + h * x3, rate + h * v3);
    phi += h / 6 * (x1 + 2 * x2 + 2 * x3 + x4);
    rate += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
  }
  return phi;
}

/// Every joint of a model gets the law that `make(element)` returns.
template <class Make>
void set_laws(RodModel& model, const Make& make) {
  model.laws.clear();
  for (int e = 0; e < model.size(); ++e) model.laws.push_back(make(e));
}

}  // namespace pedicel::cosserat::cases
