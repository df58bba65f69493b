#pragma once

#include <cmath>
#include <complex>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/rod_solver.h"

/// What the rod tests share: straight rods, a solver with its state, and signals.
namespace pedicel::cosserat::cases {

inline constexpr double pi = 3.14159265358979323846;
inline const Vec3 no_gravity = Vec3::Zero();
inline const Vec3 gravity(0, 0, -9.81);

/// A straight rod of equal segments from the clamp at the origin along the unit vector `along`; its
/// first section axis is `normal` where given. Kelvin-Voigt `damping_time` in s.
inline RodModel straight_rod(double length, int elements, const Section& section, const Vec3& along,
                             const Vec3& normal = Vec3::Zero(), double damping_time = 0.0) {
  RodModel model;
  model.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), along);
  for (int e = 0; e < elements; ++e) {
    add_element(model, e - 1, length * (e + 1) / elements * along, section, normal);
    model.elements[e].damping_time = damping_time;
  }
  finish(model);
  return model;
}

/// The heavy cantilever of the peers: L 0.4 m, r 3 mm, E 20 MPa, nu 0.3, 450 kg/m3.
struct PeerCantilever {
  static constexpr double length = 0.4, radius = 0.003, youngs_modulus = 2.0e7, density = 450.0;
  static constexpr double bending = youngs_modulus * pi * radius * radius * radius * radius / 4;
  static constexpr double mass_per_length = density * pi * radius * radius;
  static Material material() { return {youngs_modulus, 0.3, density, 0.0}; }
  static RodModel model(int elements) {
    return straight_rod(length, elements, circle_section(radius, material()), Vec3::UnitX());
  }
};

/// One plant with its solver.
struct Simulation {
  RodModel model;
  RodState state;
  std::unique_ptr<RodSolver> solver;
  std::vector<Load> loads;
  std::vector<ContactSource*> contacts;

  explicit Simulation(RodModel plant, const RodSettings& settings = {})
      : model(std::move(plant)), state(drawn_state(model)), solver(make_solver(settings, model)) {}

  StepReport step(double dt, const Vec3& acceleration) {
    return solver->step(model, state, {dt, acceleration, loads, contacts});
  }
  const Vec3& tip() const { return state.position.back(); }
};

inline RodSettings settings_with(Integrator integrator) {
  RodSettings settings;
  settings.integrator = integrator;
  settings.newton_iterations = 10;
  settings.tolerance = 1.0e-12;
  return settings;
}

/// Bending modes of a clamped-free Euler-Bernoulli beam (Timoshenko, Vibration Problems in
/// Engineering, 5th ed., section 5.11): cosh(bL) cos(bL) = -1,
/// w = cosh bs - cos bs - sigma (sinh bs - sin bs), omega = (bL)^2 sqrt(EI / (rho A L^4)).
struct CantileverMode {
  double beta = 0.0, sigma = 0.0;  // 1/m, 1

  /// `number` 1 or 2.
  CantileverMode(int number, double length) {
    double low = number == 1 ? 1.0 : 4.0, high = number == 1 ? 2.5 : 5.5;
    const auto f = [](double x) { return std::cosh(x) * std::cos(x) + 1.0; };
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      ((f(middle) > 0.0) == (f(low) > 0.0) ? low : high) = middle;
    }
    beta = low / length;
    sigma = (std::cosh(low) + std::cos(low)) / (std::sinh(low) + std::sin(low));
  }
  double shape(double s) const {
    const double x = beta * s;
    return std::cosh(x) - std::cos(x) - sigma * (std::sinh(x) - std::sin(x));
  }
  double slope(double s) const {
    const double x = beta * s;
    return beta * (std::sinh(x) + std::sin(x) - sigma * (std::cosh(x) - std::cos(x)));
  }
  /// rad/s
  double angular_frequency(double bending, double mass_per_length) const {
    return beta * beta * std::sqrt(bending / mass_per_length);
  }
};

/// Bends a straight rod, at rest, into `amplitude` (m) times a mode towards `side`: each segment
/// keeps its length and takes the slope in its middle.
inline void set_mode_shape(const RodModel& model, RodState& state, const CantileverMode& mode,
                           double amplitude, const Vec3& side) {
  double s = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const double length = model.elements[e].length;
    const Vec3 along = model.elements[e].drawn_rotation * Vec3::UnitZ();
    const double angle = amplitude * mode.slope(s + 0.5 * length);
    const Quat turn(Eigen::AngleAxisd(angle, along.cross(side).normalized()));
    state.orientation[e] = turn * model.elements[e].drawn_rotation;
    state.position[e] = start_of(model, state, e) + length * (state.orientation[e] * Vec3::UnitZ());
    s += length;
  }
}

/// What BDF2 makes of an undamped oscillation, with y = omega dt: a step multiplies it by
/// xi = exp(growth), where 3/2 - 2/xi + 1/(2 xi^2) = i y, that is 1/xi = 2 - sqrt(1 + 2 i y). The
/// real part of the growth is the damping, the imaginary one the angle that a step covers.
inline std::complex<double> bdf2_growth(double y) {
  return -std::log(2.0 - std::sqrt(std::complex<double>(1.0, 2.0 * y)));
}

/// The order of convergence that the errors of a step (or length) and of its half show.
inline double order(double error, double error_of_half) {
  return std::log2(error / error_of_half);
}

/// How much of a mode is in the deflection towards `side`: the modes of a uniform beam are
/// orthogonal, so this signal holds (nearly) one frequency.
inline double modal_amplitude(const RodModel& model, const RodState& state,
                              const CantileverMode& mode, const Vec3& side) {
  double sum = 0.0, norm = 0.0, s = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    s += model.elements[e].length;
    const double shape = mode.shape(s);
    sum += shape * side.dot(state.position[e] - model.elements[e].drawn_position);
    norm += shape * shape;
  }
  return sum / norm;
}

/// A decaying oscillation about zero, from evenly spaced samples.
class Oscillation {
 public:
  void add(double time, double value) {
    if (!time_.empty() && (value_.back() < 0.0) != (value < 0.0)) {
      const double share = value_.back() / (value_.back() - value);
      crossings_.push_back(time_.back() + share * (time - time_.back()));
    }
    time_.push_back(time);
    value_.push_back(value);
  }
  int crossings() const { return static_cast<int>(crossings_.size()); }

  /// Hz, from the first to the last zero crossing.
  double frequency() const {
    return (crossings() - 1) / (2.0 * (crossings_.back() - crossings_.front()));
  }

  /// Damping ratio from the first and the last extreme between crossings (parabola through the
  /// three highest samples of each).
  double damping_ratio() const {
    const double first = extreme(0), last = extreme(crossings() - 2);
    return std::log(first / last) / (pi * (crossings() - 2));
  }

 private:
  double extreme(int interval) const {
    std::size_t best = 0;
    double largest = -1.0;
    for (std::size_t i = 1; i + 1 < time_.size(); ++i) {
      if (time_[i] < crossings_[interval] || time_[i] > crossings_[interval + 1]) continue;
      if (std::abs(value_[i]) > largest) largest = std::abs(value_[best = i]);
    }
    const double a = std::abs(value_[best - 1]), b = largest, c = std::abs(value_[best + 1]);
    return b + (a - c) * (a - c) / (8.0 * (2.0 * b - a - c));
  }

  std::vector<double> time_, value_, crossings_;
};

}  // namespace pedicel::cosserat::cases
