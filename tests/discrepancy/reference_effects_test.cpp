// Every effect of the reference simulator against a closed form. Most stems here are one rigid
// segment on a hinge of stiffness K = 2EI/L (a clamp's half segment), so that each law shows alone;
// its curvature is phi / (L/2).
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/discrepancy/reference_plants.h"
#include "tests/discrepancy/reference_trial.h"

namespace pedicel::reference {
namespace {

constexpr double L = 0.2, r = 0.004, E = 1e8;
const double EI = E * M_PI * std::pow(r, 4) / 4, K = 2 * EI / L;
const double m = 700 * M_PI * r * r * L;
const double I = m * L * L / 3 + 700 * M_PI * std::pow(r, 4) / 4 * L;  // about the hinge
const std::vector<MarkerPlan> tip{{"tip", {"stem", 1.0, {}}}};

plant::Effect effect(const std::string& name, std::map<std::string, std::vector<double>> numbers,
                     std::optional<plant::CurvePlace> place = {}) {
  plant::Effect e;
  e.name = name;
  e.numbers = std::move(numbers);
  e.place = std::move(place);
  return e;
}

Subject hinge(const std::vector<plant::Effect>& effects, double stiffer = 1.0) {
  return {straight_stem(L, r, stiffer * E), effects, {}};
}

/// Turns the hinge by phi(t) about -x, the tip held rigidly on its circle.
template <class Angle>
TrialPlan turned(double duration, const Angle& phi) {
  TrialPlan t;
  t.duration = duration;
  t.interval = 0.005;
  t.gravity.setZero();
  t.measures_force = true;
  HoldPlan hold;
  hold.place = {"stem", 1.0, {}};
  for (int i = 0; i <= std::lround(duration / t.interval); ++i) {
    hold.path.time.push_back(i * t.interval);
    hold.path.position.push_back(
        L * Vec3(0, std::sin(phi(i * t.interval)), std::cos(phi(i * t.interval))));
  }
  t.holds = {hold};
  return t;
}

/// The holder's moment about the hinge over time, from its force and the tip's place.
std::vector<double> moments(const Subject& s, const TrialPlan& t) {
  const Record record = run_trial(s, t, tip, {1.0, 0.005});
  std::vector<double> out;
  for (int i = 0; i < record.force.rows(); ++i)
    out.push_back(-Vec3(record.markers.row(i)).cross(Vec3(record.force.row(i))).x());
  return out;
}

struct Extreme {
  double time, y;
};

/// Maxima and minima of the tip's y after it was let go at a small angle.
std::vector<Extreme> extremes(const Subject& s, double phi, double duration) {
  TrialPlan t;
  t.duration = duration;
  t.interval = 0.001;
  t.gravity.setZero();
  const double stiffer = *s.plant.material.youngs_modulus / E;
  t.loads = {{{"stem", 1.0, {}}, Vec3(0, stiffer * K * phi / L, 0), -1.0, t.interval}};
  const Record record = run_trial(s, t, tip, {1.0, 0.0005});
  std::vector<Extreme> out;
  for (int i = 2; i + 1 < record.markers.rows(); ++i) {
    const double a = record.markers(i - 1, 1), b = record.markers(i, 1),
                 c = record.markers(i + 1, 1);
    if ((b - a) * (c - b) > 0 || b == c) continue;
    const double u = 0.5 * (a - c) / (a - 2 * b + c);
    out.push_back({record.time[i] + u * t.interval, b - 0.25 * (a - c) * u});
  }
  return out;
}

std::vector<std::pair<double, double>> peaks(const Subject& s, double phi, double duration) {
  std::vector<std::pair<double, double>> out;
  for (const Extreme& e : extremes(s, phi, duration))
    if (e.y > 0) out.push_back({e.time, e.y});
  return out;
}

// M = K phi - f K q, q' = (phi - q)/tau under a step: K phi (1 - f (1 - e^(-t/tau))).
TEST(ReferenceEffects, RelaxationFollowsItsExponential) {
  const double f = 0.3, tau = 0.4, phi = 0.1;
  for (const char* name : {"relaxation", "creep"}) {
    const auto M = moments(hinge({effect(name, {{"fraction", {f}}, {"time", {tau}}})}),
                           turned(2.0, [&](double t) { return phi * std::min(1.0, t / 0.01); }));
    for (const int i : {40, 100, 200, 400}) {
      const double t = 0.005 * i - 0.005;  // from the middle of the ramp
      EXPECT_NEAR(M[i], K * phi * (1 - f * (1 - std::exp(-t / tau))), 1e-3 * K * phi) << name << i;
    }
  }
}

// A spring of ratio r that slips at phi_s: after the first quarter each cycle of amplitude A
// encloses 4 r K phi_s (A - phi_s), at any rate.
TEST(ReferenceEffects, FrictionEnclosesAParallelogram) {
  const double ratio = 0.4, slip = 0.02, A = 0.1;
  const std::map<std::string, std::vector<double>> by_curvature{{"ratio", {ratio}},
                                                                {"curvature", {slip / (L / 2)}}};
  const std::map<std::string, std::vector<double>> by_moment{{"ratio", {ratio}},
                                                             {"moment", {ratio * K * slip}}};
  for (const auto& numbers : {by_curvature, by_moment})
    for (const double T : {2.0, 4.0}) {
      const auto phi = [&](double t) { return A * std::sin(2 * M_PI * t / T); };
      const auto M = moments(hinge({effect("internal_friction", numbers)}), turned(1.5 * T, phi));
      double area = 0.0;
      for (int i = std::lround(0.25 * T / 0.005); i < std::lround(1.25 * T / 0.005); ++i)
        area += 0.5 * (M[i] + M[i + 1]) * (phi(0.005 * (i + 1)) - phi(0.005 * i));
      EXPECT_NEAR(area, 4 * ratio * K * slip * (A - slip), 0.01 * K * slip * A);
    }
}

// Elastic up to phi_y, then M = K phi_y; back at 0 the set phi_1 - phi_y pulls the other way.
TEST(ReferenceEffects, YieldLeavesASet) {
  const double limit = 0.06, far = 0.1;
  const auto M = moments(hinge({effect("yield", {{"curvature", {limit / (L / 2)}}})}),
                         turned(2.0, [&](double t) { return far * (1 - std::abs(1 - t)); }));
  EXPECT_NEAR(M[100], K * 0.05, 1e-3 * K * far);
  EXPECT_NEAR(M[180], K * limit, 1e-3 * K * far);
  EXPECT_NEAR(M[400], -K * (far - limit), 1e-3 * K * far);
}

// A slider of share r beside a spring of share 1 - r that yields: both at their limits on the way,
// and both pulling the other way back at 0.
TEST(ReferenceEffects, YieldBesideFriction) {
  const double limit = 0.06, far = 0.1, ratio = 0.4, slip = 0.02;
  const auto yield = effect("yield", {{"curvature", {limit / (L / 2)}}});
  const auto friction =
      effect("internal_friction", {{"ratio", {ratio}}, {"curvature", {slip / (L / 2)}}});
  const auto M = moments(hinge({yield, friction}),
                         turned(2.0, [&](double t) { return far * (1 - std::abs(1 - t)); }));
  EXPECT_NEAR(M[180], K * ((1 - ratio) * limit + ratio * slip), 1e-3 * K * far);
  EXPECT_NEAR(M[400], -K * ((1 - ratio) * (far - limit) + ratio * slip), 1e-3 * K * far);
}

// M = K phi (1 + b (kappa/k0)^2); E (1 + rate clock); a plain hinge beside them.
TEST(ReferenceEffects, NonlinearAndDriftingMoments) {
  const double phi = 0.1;
  TrialPlan still = turned(0.05, [&](double) { return phi; });
  still.clock = 1000;
  EXPECT_NEAR(moments(hinge({}), still)[5], K * phi, 1e-4 * K * phi);
  EXPECT_NEAR(moments(hinge({effect("stiffness_drift", {{"rate", {-2e-4}}})}), still)[5],
              0.8 * K * phi, 1e-4 * K * phi);
  const auto sided =
      effect("asymmetry", {{"coefficient", {0.5}}, {"axis", {1, 0, 0}}, {"k0", {2.0}}});
  // kappa is phi / (L / 2) = k0 / 2: 1 + 0.5 / sqrt(1 + 4), about +x or its opposite.
  const double side = 0.5 / std::sqrt(5.0), moment = moments(hinge({sided}), still)[5] / (K * phi);
  EXPECT_NEAR(std::abs(moment - 1.0), side, 1e-4);
  const auto bent = effect("material_nonlinearity", {{"coefficient", {-0.2}}, {"k0", {2.0}}});
  EXPECT_NEAR(moments(hinge({bent}), still)[5], (1 - 0.2 * 0.25) * K * phi, 1e-4 * K * phi);
}

// mass_damping: phi'' + rate phi' + w^2 phi = 0, amplitude e^(-rate t / 2).
// Kelvin-Voigt: I phi'' + K time phi' + K phi = 0, amplitude e^(-w^2 time t / 2).
TEST(ReferenceEffects, LinearDampersDecayExponentially) {
  const auto mass = peaks(hinge({effect("mass_damping", {{"rate", {1.5}}})}), 0.02, 1.5);
  ASSERT_GT(mass.size(), 6u);
  const double rate =
      std::log(mass.front().second / mass.back().second) / (mass.back().first - mass.front().first);
  EXPECT_NEAR(rate, 0.75, 0.01);
  Subject s = hinge({effect("damping_time", {{"factor", {2.0}}})});
  s.plant.material.damping_time = 5e-4;
  const auto kelvin = peaks(s, 0.02, 1.5);
  const double decay = std::log(kelvin.front().second / kelvin.back().second) /
                       (kelvin.back().first - kelvin.front().first);
  EXPECT_NEAR(decay, K / I * 1e-3 / 2, 0.02 * decay);
}

// The ladder's complex stiffness is K (1 + sum instant - g / (1 + i w t)): K at 3 Hz, and its
// imaginary part is eta K within 2 % from 0.7 to 30 Hz; a swing's amplitude falls by pi Im/Re in
// its logarithm a cycle.
// From maximum to minimum, since the slow springs still draw to where the hinge was held.
TEST(ReferenceEffects, StructuralDampingIsTheSameAtEveryFrequency) {
  const double eta = 0.04;
  const auto damping = effect("structural_damping", {{"loss_factor", {eta}}});
  const Subject plain = hinge({damping});
  const JointLaw law = build_tree(plain.plant, plain.effects, {}, 1.0).law;
  for (const double stiffer : {0.1, 0.4, 1.0, 6.0}) {
    const auto x = extremes(hinge({damping}, stiffer), 0.02, 2.0);
    ASSERT_GT(x.size(), 8u);
    const std::size_t n = x.size();
    const double cycles = 0.5 * static_cast<double>(n - 4);
    const double fall = std::log((x[2].y - x[3].y) / (x[n - 2].y - x[n - 1].y) * (n % 2 ? -1 : 1));
    const double w = 2 * M_PI * cycles / (x[n - 2].time - x[2].time);
    std::complex<double> stiffness = 1.0;
    for (const MemoryTerm& term : law.memory)
      stiffness += term.instant - term.share / std::complex(1.0, w * term.time);
    EXPECT_NEAR(stiffness.imag(), eta, 0.02 * eta) << w;
    // Between frequencies it changes by 2/pi eta a factor of e (Kramers and Kronig).
    EXPECT_NEAR(stiffness.real(), 1.0 + 2.0 / M_PI * eta * std::log(w / (6.0 * M_PI)), 0.05 * eta);
    EXPECT_NEAR(fall / cycles, M_PI * stiffness.imag() / stiffness.real(), 0.03 * M_PI * eta) << w;
  }
}

// Drag c |phi'| phi' with c = rho a L (L/2)^3 / 2 takes (8/3) c w^2 A^3 of energy a cycle, and so
// 1/A grows by 4 c w / (3 pi I) a second.
TEST(ReferenceEffects, LeafDragSlowsLargeSwingsMore) {
  const double area = 0.1, c = 0.5 * 1.2 * area * L * std::pow(L / 2, 3), w = std::sqrt(K / I);
  const auto p = peaks(hinge({effect("leaf_drag", {{"drag_area", {area}}})}), 0.2, 2.0);
  ASSERT_GT(p.size(), 10u);
  const double grown = L / p.back().second - L / p.front().second;
  EXPECT_NEAR(grown / (p.back().first - p.front().first), 4 * c * w / (3 * M_PI * I),
              0.03 * 4 * c * w / (3 * M_PI * I));
}

// A plate across the swing is such drag with its normal's area, one along it with the other's.
TEST(ReferenceEffects, APlateDragsByItsSides) {
  const auto last = [](const plant::Effect& e) {
    return peaks(hinge({e}), 0.2, 1.0).back().second;
  };
  const auto plate = [](const Vec3& n) {
    return effect(
        "plate_drag",
        {{"normal", {0.1}}, {"tangential", {0.02}}, {"direction", {n.x(), n.y(), n.z()}}});
  };
  const double wide = last(effect("leaf_drag", {{"drag_area", {0.1}}}));
  const double narrow = last(effect("leaf_drag", {{"drag_area", {0.02}}}));
  EXPECT_NEAR(last(plate(Vec3::UnitY())), wide, 1e-3 * wide);
  EXPECT_NEAR(last(plate(Vec3::UnitX())), narrow, 1e-3 * narrow);
  EXPECT_GT(narrow, 1.05 * wide);
}

// Dahl's first way: M = (1 - r) K phi + r K R (1 - exp(-phi/R)), and back by a from phi_1 with
// z = R - (R - z_1) ... of the other sign: dz = -(1 + z/R) da.
TEST(ReferenceEffects, HysteresisFollowsDahl) {
  const double ratio = 0.4, reach = 0.03, far = 0.1;
  const auto M =
      moments(hinge({effect("hysteresis",
                            {{"ratio", {ratio}}, {"moment", {K * reach}}, {"exponent", {1.0}}})}),
              turned(2.0, [&](double t) { return far * (1 - std::abs(1 - t)); }));
  const auto there = [&](double phi) { return reach * (1 - std::exp(-phi / reach)); };
  const auto back = [&](double a) { return (there(far) + reach) * std::exp(-a / reach) - reach; };
  for (const double phi : {0.02, 0.06, 0.1})
    EXPECT_NEAR(M[std::lround(phi / far / 0.005)], K * ((1 - ratio) * phi + ratio * there(phi)),
                2e-3 * K * far)
        << phi;
  for (const double a : {0.02, 0.06, 0.1})
    EXPECT_NEAR(M[std::lround((1 + a / far) / 0.005)],
                K * ((1 - ratio) * (far - a) + ratio * back(a)), 2e-3 * K * far)
        << a;
}

// Hung for hours it leans by w L/2 / ((1 - f) K); a load that comes then is answered by all of K.
TEST(ReferenceEffects, WhatHungLongAnswersALoadStiffly) {
  const double f = 0.4, tau = 0.5, g = 1.0, load = 0.01;
  plant::Effect hung = effect("relaxation", {{"fraction", {f}}, {"time", {tau}}});
  hung.words["start"] = "hung";
  TrialPlan t;
  t.gravity = Vec3(0, g, 0);
  const plant::CurvePlace end{"stem", 1.0, {}};
  const auto angle = [&](const TrialPlan& plan) {
    return std::asin(settled_point(hinge({hung}), plan, end, {1.0, 0.005}).y() / L);
  };
  const double leaning = m * g * L / 2 / ((1 - f) * K);
  EXPECT_NEAR(angle(t), leaning, 1e-3 * leaning);
  t.loads = {{end, Vec3(0, load, 0)}};
  EXPECT_NEAR(angle(t) - leaning, load * L / K, 0.01 * load * L / K);
}

// An arc: its tip lies (1 - cos(k L)) / k to the side.
TEST(ReferenceEffects, RestShapeIsAnArc) {
  const double k = 3.0;
  const plant::CurvePlace end{"stem", 1.0, {}};
  TrialPlan t;
  t.gravity.setZero();
  const auto tip_of = [&](std::vector<double> curvature) {
    return settled_point(
        hinge({effect("rest_shape",
                      {{"curvature", curvature}, {"gradient", {0, 0}}, {"normal", {0, 1, 0}}},
                      plant::CurvePlace{"stem", 0.5, {}})}),
        t, end, {0.002, 0.005});
  };
  const double side = (1 - std::cos(k * L)) / k;
  EXPECT_NEAR(tip_of({k, 0}).x(), side, 1e-3 * side);  // about y: towards x
  EXPECT_NEAR(tip_of({0, k}).y(), side, 1e-3 * side);  // about z x y = -x: towards y
}

Subject lagging(const char* what, double time) {
  plant::Effect lag = effect("sensor_lag", {{"time", {time}}});
  lag.words["what"] = what;
  return hinge({lag});
}

// Of a sine a lag leaves 1 / sqrt(1 + (w tau)^2).
TEST(ReferenceEffects, LaggingMarkers) {
  const double T = 0.5, A = 0.05, tau = 0.06, kept = 1 / std::hypot(1.0, 2 * M_PI / T * tau);
  const TrialPlan plan = turned(3.0, [&](double t) { return A * std::sin(2 * M_PI * t / T); });
  const auto largest = [&](const char* what) {
    const Record record = run_trial(lagging(what, tau), plan, tip, {1.0, 0.001});
    return record.markers.col(1).tail(200).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(largest("markers") / largest("force"), kept, 0.01);
}

// A force that is gone at once goes as exp(-t / tau).
TEST(ReferenceEffects, ALaggingForceSensor) {
  const double tau = 0.06;
  TrialPlan plan = turned(1.0, [](double) { return 0.05; });
  plan.holds.front().release = 0.5;
  const Record record = run_trial(lagging("force", tau), plan, tip, {1.0, 0.001});
  const double held = record.force(99, 1);
  EXPECT_GT(std::abs(held), 0.01);
  for (const int i : {100, 104, 110, 130})
    EXPECT_NEAR(record.force(i, 1) / held, std::exp(-(record.time[i] - 0.5) / tau), 1e-3) << i;
}

double tip_shift(const std::vector<plant::Effect>& effects, const Vec3& force, double spacing,
                 const Vec3& gravity = Vec3::Zero()) {
  TrialPlan t;
  t.gravity = gravity;
  t.loads = {{{"stem", 1.0, {}}, force}};
  const Vec3 at = settled_point(hinge(effects), t, {"stem", 1.0, {}}, {spacing, 0.005});
  return std::hypot(at.x(), at.y());
}

// Wind: the moment rho a U^2 L^2 / 4 about the hinge, to first order in the angle; gusts settle in
// the mean wind.
TEST(ReferenceEffects, WindBendsTheHinge) {
  const std::map<std::string, std::vector<double>> wind{{"velocity", {2, 0, 0}},
                                                        {"drag_area", {0.02}}};
  auto gust = wind;
  gust["frequency"] = {1.0};
  gust["amplitude"] = {0.5};
  const double phi = 0.25 * 1.2 * 0.02 * 4 * L * L / K;
  EXPECT_NEAR(tip_shift({effect("wind", wind)}, Vec3::Zero(), 1.0), L * phi, 0.002 * L * phi);
  EXPECT_NEAR(tip_shift({effect("gust", gust)}, Vec3::Zero(), 1.0), L * phi, 0.002 * L * phi);
}

// Static bending by a tip force P, from M = P (L - s) and the virtual unit force:
// base P L^2/k; weak stretch P (1/f - 1) int (L-s)^2 ds / EI; gradient P int (L-s)^2/(EI g(s)) ds;
// anisotropy: EI along `direction` only.
TEST(ReferenceEffects, SoftPlacesBendMore) {
  const double P = 1e-4, fine = L / 80, plain = tip_shift({}, Vec3(P, 0, 0), fine);
  const auto more = [&](const plant::Effect& e, const Vec3& force) {
    return tip_shift({e}, force, fine) - plain;
  };
  const Vec3 x(P, 0, 0), y(0, P, 0);
  EXPECT_NEAR(more(effect("base_compliance", {{"stiffness", {0.5}}}), x), P * L * L / 0.5,
              1e-4 * plain);
  const auto weak = effect("weak_segment", {{"factor", {0.5}}, {"length", {0.033}}},
                           plant::CurvePlace{"stem", 0.4, {}});
  const double a = 0.6 * L + 0.0165, b = 0.6 * L - 0.0165;
  EXPECT_NEAR(more(weak, x), P / EI * (a * a * a - b * b * b) / 3, 1e-3 * plain);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double s = (i + 0.5) / 1000;
    sum += P / EI * L * L * L * (1 - s) * (1 - s) / (1 + 0.8 * (s - 0.5)) / 1000;
  }
  EXPECT_NEAR(more(effect("stiffness_gradient", {{"gradient", {0.8}}}), x), sum - plain,
              2e-4 * plain);
  const auto turned_section = effect("anisotropy", {{"ratio", {0.5}}, {"direction", {1, 0, 0}}});
  EXPECT_NEAR(more(turned_section, x), plain, 1e-4 * plain);
  EXPECT_NEAR(more(turned_section, y), 0.0, 1e-4 * plain);
}

// A branch at a right angle on a stem that hardly bends: its junction turns by P b / k.
TEST(ReferenceEffects, JunctionsTurn) {
  Subject s = hinge({}, 100.0);
  plant::PlantCurve branch = s.plant.curves[0];
  branch.name = "branch";
  branch.points = {Vec3(0, 0, L / 2), Vec3(0.1, 0, L / 2)};
  s.plant.curves.push_back(branch);
  TrialPlan t;
  t.gravity.setZero();
  t.loads = {{{"branch", 1.0, {}}, Vec3(0, 0, 1e-3)}};
  const Mesh mesh{0.005, 0.005};
  const double before = settled_point(s, t, {"branch", 1.0, {}}, mesh).z();
  s.effects = {effect("attachment_compliance", {{"stiffness", {2.0}}},
                      plant::CurvePlace{"branch", 0.0, {}})};
  const double after = settled_point(s, t, {"branch", 1.0, {}}, mesh).z();
  EXPECT_NEAR(after - before, 1e-3 * 0.1 * 0.1 / 2.0, 1e-8);
}

// Sideways gravity g: the moment about the hinge is m g L/2; a mass M at x adds M g x, a gradient
// (in one segment: its middle's factor, 1) nothing, over many segments it moves the centre by
// gradient L / 12.
TEST(ReferenceEffects, MassesWeigh) {
  const Vec3 sideways(0.05, 0, 0);
  const double one = L * m * 0.05 * L / 2 / K;
  EXPECT_NEAR(tip_shift({}, Vec3::Zero(), 1.0, sideways), one, 1e-4 * one);
  const auto mass = effect("extra_mass", {{"mass", {0.01}}}, plant::CurvePlace{"stem", 0.7, {}});
  EXPECT_NEAR(tip_shift({mass}, Vec3::Zero(), 1.0, sideways) - one, L * 0.01 * 0.05 * 0.7 * L / K,
              1e-3 * one);
  const auto heavy = effect("density", {{"factor", {1.5}}});
  EXPECT_NEAR(tip_shift({heavy}, Vec3::Zero(), 1.0, sideways), 1.5 * one, 1e-3 * one);
  Subject s = hinge({effect("mass_distribution", {{"gradient", {0.6}}})});
  double moment = 0.0, mass_sum = 0.0;
  for (const Segment& segment : build_tree(s.plant, s.effects, {}, L / 50).segments) {
    moment += segment.mass * (segment.arc_near + segment.centre);
    mass_sum += segment.mass;
  }
  EXPECT_NEAR(mass_sum, m, 1e-9);
  EXPECT_NEAR(moment / mass_sum, L / 2 + 0.6 * L / 12, 1e-4 * L);
}

// At the grip and in the sensors: what they say they do to the same motion.
TEST(ReferenceEffects, GripAndSensors) {
  TrialPlan t = turned(1.0, [](double time) { return 0.1 * std::sin(6 * time); });
  t.holds[0].stiffness = 100.0;
  const Mesh mesh{1.0, 0.005};
  const Record plain = run_trial(hinge({}), t, tip, mesh);
  const Record late = run_trial(hinge({effect("latency", {{"delay", {0.05}}})}), t, tip, mesh);
  EXPECT_LT((late.markers.bottomRows(150) - plain.markers.middleRows(41, 150)).norm(), 1e-9);
  const Record scaled =
      run_trial(hinge({effect("marker_scale", {{"factor", {1.01}}})}), t, tip, mesh);
  EXPECT_LT((scaled.markers - 1.01 * plain.markers).norm(), 1e-12);
  const Record turned_frame =
      run_trial(hinge({effect("frame_rotation", {{"rotation", {0, 0, M_PI / 2}}})}), t, tip, mesh);
  EXPECT_LT((turned_frame.markers.col(0) + plain.markers.col(1)).norm(), 1e-9);
  const Record gained = run_trial(
      hinge({effect("force_gain", {{"gain", {1.1}}, {"offset", {0.1, 0, 0}}})}), t, tip, mesh);
  EXPECT_LT((gained.force.col(1) - 1.1 * plain.force.col(1)).norm(), 1e-12);
  EXPECT_NEAR(gained.force(7, 0), 1.1 * plain.force(7, 0) + 0.1, 1e-12);
  plant::Effect offset = effect("marker_offset", {{"offset", {0.0, 0.01, 0}}});
  offset.words["marker"] = "tip";
  const Record aside = run_trial(hinge({offset}), t, tip, mesh);
  const int i = 50;  // turned by phi about -x
  const double phi = std::atan2(plain.markers(i, 1), plain.markers(i, 2));
  EXPECT_NEAR(aside.markers(i, 1) - plain.markers(i, 1), 0.01 * std::cos(phi), 1e-9);
  EXPECT_NEAR(aside.markers(i, 2) - plain.markers(i, 2), -0.01 * std::sin(phi), 1e-9);
}

// A grip of stiffness k on a hinge that gives K' = K/L^2 at the tip: F = path k K' / (k + K'). A
// grip k at a on the stem, pulled to (y, L/2): K phi = k a (y - phi L/2) whatever a is, L/2 before
// the slip and L/2 + distance after it.
TEST(ReferenceEffects, GripsGiveAndSlip) {
  TrialPlan t = turned(1.0, [](double) { return 0.02; });
  const double at_tip = K / (L * L);
  const Record record =
      run_trial(hinge({effect("grip_compliance", {{"stiffness", {3.0}}})}), t, tip, {1.0, 0.005});
  EXPECT_NEAR(record.force(3, 1), 0.02 * L * 3.0 * at_tip / (3.0 + at_tip),
              1e-3 * record.force(3, 1));
  t.holds[0].place.at = 0.5;
  t.holds[0].stiffness = 10.0;
  const double y = 0.002;
  for (Vec3& p : t.holds[0].path.position) p = Vec3(0, y, L / 2);
  Subject s = hinge({effect("grip_slip", {{"distance", {0.02}}, {"time", {0.5}}})});
  s.plant.material.damping_time = 0.02;
  const Record slipped = run_trial(s, t, tip, {1.0, 0.005});
  for (const auto& [sample, a] : {std::pair{90, 0.1}, {200, 0.12}}) {
    const double phi = 10.0 * a * y / (K + 10.0 * a * L / 2);
    EXPECT_NEAR(slipped.markers(sample, 1), L * phi, 2e-4 * L * phi) << sample;
  }
}

// What no name stands for: a slack string does nothing and a taut one pulls, a stake stops, an
// attraction draws near; each in balance with the hinge, K phi = force x L.
// Pulled along itself a stem gives F L / EA, in series with the grip's 1/k: F = d / (1/k + L/EA).
TEST(ReferenceEffects, StemsGiveAlongThemselves) {
  const double EA = E * M_PI * r * r, k = EA / L / 3, d = 1e-4;
  TrialPlan t = turned(0.02, [](double) { return 0.0; });
  t.holds[0].stiffness = k;
  for (Vec3& p : t.holds[0].path.position) p.z() += d;
  const Record record = run_trial(hinge({}, 1.0), t, tip, {0.25 * L, 0.005});
  EXPECT_NEAR(record.force(2, 2), d / (1 / k + L / EA), 1e-9);
}

TEST(ReferenceEffects, Strangers) {
  TrialPlan t;
  t.gravity.setZero();
  const auto tip_y = [&](const OutsideEffect& s, double load) {
    Subject subject = hinge({});
    subject.outside = {s};
    t.loads = {{{"stem", 1.0, {}}, Vec3(0, load, 0)}};
    return settled_point(subject, t, {"stem", 1.0, {}}, {1.0, 0.005}).y();
  };
  const double k = K / (L * L), push = 0.05 * k * L;
  OutsideEffect s;
  s.place = {"stem", 1.0, {}};
  s.point = Vec3(0, -0.1, L);
  s.slack = 0.102;
  s.size = 2 * k;
  EXPECT_NEAR(tip_y(s, -push), -0.05 * L, 1e-4 * L);
  EXPECT_NEAR(tip_y(s, push), (push + s.size * 0.002) / (k + s.size), 1e-4 * L);
  s.kind = OutsideEffect::Kind::stake;
  s.point = Vec3(0, 0.004, 0);
  s.direction = Vec3(0, -1, 0);
  s.size = 1e5;
  EXPECT_NEAR(tip_y(s, -push), -0.05 * L, 1e-4 * L);
  EXPECT_NEAR(tip_y(s, push), 0.004, 1e-5);
  s.kind = OutsideEffect::Kind::attraction;
  s.point = Vec3(0, 0.05, L);
  s.size = 0.02 * k * L;
  const double y = tip_y(s, 0.0);
  EXPECT_NEAR(k * y, s.size * 0.0025 / (0.0025 + (0.05 - y) * (0.05 - y)), 0.01 * k * y);
}

TEST(ReferenceEffects, RefusesWhatItDoesNotKnow) {
  Subject s = hinge({});
  s.plant.fruits.resize(1);
  EXPECT_THROW(build_tree(s.plant, {}, {}, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace pedicel::reference
