// Wires: a chain hangs as a catenary, and a stretched wire has its frequency.
//
// Catenary (Irvine, Cable Structures, section 1.1): of a chain of length S and weight w (N/m)
// between two points of one height, D apart, with 2 a sinh(D / 2a) = S, the place at the length s
// from its lowest point is (a asinh(s / a), sqrt(a^2 + s^2) - a), and its horizontal force is w a.
//
// A stiff wire of length L under the tension T, clamped at both ends, has the first frequency
//   f = 1/(2L) sqrt(T/m) (1 + 2 e + (4 + pi^2/2) e^2),  e = sqrt(E I / (T L^2))
// (Morse, Vibration and Sound, 2nd ed., section 16; m is the mass per metre).
#include <gtest/gtest.h>

#include "plugins/cosserat/solver/rod_system.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double wire_radius = 5.0e-4;  // m

Section wire_section(double youngs_modulus) {
  return circle_section(wire_radius, {youngs_modulus, 0.3, 7850.0, 0.0});
}

// Held at its last node as well.
Support post_at_the_end(const RodModel& model, double stiffness) {
  Support post;
  post.element = model.size() - 1;
  post.position = model.elements.back().drawn_position;
  post.position_stiffness = stiffness;
  return post;
}

void damp(RodModel& model, double rate) {
  for (Element& element : model.elements) element.mass_damping = rate;
}

// N, on the post.
Vec3 force_on_post(const RodSystem& system) {
  const Support& post = system.model(0).supports[0];
  return post.position_stiffness * (system.state(0).position.back() - post.position);
}

// The root of a function that rises between two bounds.
template <class Function>
double root_of(const Function& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

// Drawn as an arc, 5 cm from where it comes to rest. Its bending stiffness is next to none, as a
// chain's.
TEST(RodWire, AChainHangsAsACatenary) {
  constexpr double span = 0.5, length = 1.0;
  constexpr int links = 80;
  const double half_angle =
      root_of([](double a) { return span / length - std::sin(a) / a; }, 0.1, 3.1);
  const double radius = 0.5 * length / half_angle;
  Section section = wire_section(1.0e9);
  section.bend1 *= 1.0e-3, section.bend2 *= 1.0e-3, section.twist *= 1.0e-3;
  RodModel model;
  const auto on_arc = [&](int link) {
    const double angle = half_angle * (2.0 * link / links - 1.0);
    return Vec3(radius * std::sin(angle) + 0.5 * span, 0,
                radius * (std::cos(half_angle) - std::cos(angle)));
  };
  model.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), on_arc(1));
  for (int e = 0; e < links; ++e) add_element(model, e - 1, on_arc(e + 1), section);
  finish(model);
  model.supports.push_back(post_at_the_end(model, 1.0e5));
  damp(model, 6.0);
  RodSystem system(settings_with(Integrator::bdf2));
  system.add_plant(std::move(model));
  for (int i = 0; i < 1500; ++i) system.step(1.0 / 240.0, gravity);

  const double u = root_of([](double v) { return std::sinh(v) / v - length / span; }, 0.1, 10.0);
  const double a = 0.5 * span / u, sag = a * (std::cosh(u) - 1.0);
  double worst = 0.0, drawn = 0.0;
  for (int e = 0; e < links; ++e) {
    const double s = length * (e + 1.0) / links - 0.5 * length;
    const Vec3 place(0.5 * span + a * std::asinh(s / a), 0, std::hypot(a, s) - a - sag);
    worst = std::max(worst, (system.state(0).position[e] - place).norm());
    drawn = std::max(drawn, (on_arc(e + 1) - place).norm());
  }
  RecordProperty("catenary_off_m", std::to_string(worst));
  EXPECT_GT(drawn, 0.1 * sag) << "it had a way to go";
  // Links are straight: of the order of 1 / links^2, and what its weight stretches it.
  EXPECT_LT(worst, 0.003 * sag);
  const double weight = section.mass * 9.81;
  const Vec3 force = force_on_post(system);
  EXPECT_NEAR(-force.x(), weight * a, 0.01 * weight * a);
  EXPECT_NEAR(-force.z(), 0.5 * weight * length, 0.01 * weight * length);
}

TEST(RodWire, AStretchedWireHasItsFrequency) {
  constexpr double length = 1.0, youngs_modulus = 2.0e11;
  const Section section = wire_section(youngs_modulus);
  for (const double pull : {20.0, 80.0}) {
    RodModel model = straight_rod(length, 40, section, Vec3::UnitX());
    Support post = post_at_the_end(model, 1.0e8);
    post.rotation = model.elements.back().drawn_rotation;
    post.rotation_stiffness = Vec3::Constant(1.0e3);
    post.position.x() += length * pull / section.axial;
    model.supports.push_back(post);
    damp(model, 50.0);
    RodSystem system(settings_with(Integrator::bdf2));
    system.add_plant(std::move(model));
    const double dt = 1.0 / 8000.0;
    for (int i = 0; i < 4000; ++i) system.step(dt, no_gravity);
    const double tension = -force_on_post(system).x();
    EXPECT_NEAR(tension, pull, 0.02 * pull);
    damp(system.edit_model(0), 0.0);
    for (int e = 0; e < 40; ++e)
      system.edit_state(0).velocity[e].z() += 0.01 * std::sin(pi * (e + 1.0) / 40.0);
    system.edit_state(0).previous_dt = 0.0;
    Oscillation signal;
    for (int i = 0; signal.crossings() < 13 && i < 20000; ++i) {
      system.step(dt, no_gravity);
      signal.add(system.state(0).time, system.state(0).position[19].z());
    }
    // The post holds the last element from turning: the wire is clamped at that one's middle.
    const double between = length * (1.0 - 0.5 / 40.0);
    const double e = std::sqrt(section.bend1 / tension) / between;
    const double exact = 0.5 / between * std::sqrt(tension / section.mass) *
                         (1.0 + 2.0 * e + (4.0 + 0.5 * pi * pi) * e * e);
    RecordProperty("wire_frequency_off_" + std::to_string(static_cast<int>(pull)),
                   std::to_string(signal.frequency() / exact - 1.0));
    EXPECT_NEAR(signal.frequency() / exact, 1.0, 0.005) << pull << " N";
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
