#include "discrepancy/causes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "discrepancy/cause_start.h"
#include "plant/effects.h"
#include "plant/plant_builder.h"

namespace pedicel::discrepancy {

namespace {

// Shares of the compliance of a branch's first half segment, of what the joint below it has more:
// with a solver that gives it the branch's whole segment, on a mesh of half the file's spacing (and
// 10 %); and the most that a fit may find.
constexpr double most_by_convention = 0.55, most_give = 1.5;

class Candidates {
 public:
  Candidates(const Experiment& experiment, const Scales& scales)
      : experiment_(experiment), plant_(experiment.plant), scales_(scales) {}

  std::vector<Cause> run() {
    masses();
    softness();
    material();
    dissipation();
    air();
    grip();
    sensors();
    return std::move(causes_);
  }

 private:
  void add(const std::string& name, std::vector<Hypothesis> starts) {
    const plant::EffectKind* kind = plant::find_effect(name);
    if (!kind || (kind->home == plant::EffectHome::plant && !kind->simulated)) return;
    if (!starts.empty()) causes_.push_back({name, std::move(starts)});
  }

  void masses() {
    std::vector<Hypothesis> starts;
    const double m = scales_.mass;
    for (const plant::PlantCurve& curve : plant_.curves)
      for (const double at : {0.35, 0.65, 0.95})
        starts.push_back(Start("extra_mass")
                             .moving_place(curve.name, at)
                             .positive("mass", 0.1 * m, 1.0e-4 * m, 30.0 * m));
    add("extra_mass", starts);
    add("mass_distribution",
        {Start("mass_distribution").signed_number("gradient", 0.2, 0.3, -1.95, 1.95),
         Start("mass_distribution").signed_number("gradient", -0.2, 0.3, -1.95, 1.95)});
  }

  void softness() {
    const double k = scales_.root_stiffness;
    std::vector<Hypothesis> base, junction, weak;
    for (const double part : {30.0, 5.0})
      base.push_back(Start("base_compliance").positive("stiffness", part * k, 1e-3 * k, 1e4 * k));
    for (std::size_t c = 0; c < plant_.curves.size(); ++c) {
      const plant::PlantCurve& curve = plant_.curves[c];
      if (!is_root(curve))
        for (const double part : {10.0, 1.0})
          junction.push_back(Start("attachment_compliance")
                                 .place(curve.name, 0.0)
                                 .positive("stiffness", part * k, 1e-5 * k, 1e4 * k));
      for (const double at : {0.04, 0.15, 0.4, 0.7}) {
        const double length = 0.1 * length_of(curve);
        weak.push_back(Start("weak_segment")
                           .moving_place(curve.name, at)
                           .positive("factor", 0.6, 0.01, 10.0)
                           .positive("length", length, 0.2 * length, 5.0 * length)
                           .prior(0.5, length));
      }
    }
    add("base_compliance", base);
    add("attachment_compliance", junction);
    add("weak_segment", weak);
    add("stiffness_gradient",
        {Start("stiffness_gradient").signed_number("gradient", 0.2, 0.3, -1.95, 1.95),
         Start("stiffness_gradient").signed_number("gradient", -0.2, 0.3, -1.95, 1.95)});
  }

  void material() {
    std::vector<Hypothesis> nonlinear, anisotropy, drift;
    for (const double b : {0.1, -0.1})
      nonlinear.push_back(Start("material_nonlinearity")
                              .fixed("k0", {scales_.curvature})
                              .signed_number("coefficient", b, 0.2, -20.0, 20.0));
    // Stiffer one way is softer across it only in a single straight stem: branches tell them apart.
    for (int i = 0; i < 4; ++i)
      anisotropy.push_back(Start("anisotropy")
                               .positive("ratio", 0.8, 0.05, 20.0)
                               .heading(0.25 * i * std::numbers::pi));
    add("material_nonlinearity", nonlinear);
    add("anisotropy", anisotropy);
    const double long_time = std::max(clock_span(), scales_.duration);
    for (const double change : {0.05, -0.05})
      drift.push_back(Start("stiffness_drift")
                          .signed_number("rate", change / long_time, 0.1 / long_time,
                                         -0.9 / long_time, 5.0 / long_time));
    add("stiffness_drift", drift);
    std::vector<Hypothesis> yield;
    // Near the largest curvature of the trials a threshold soon does nothing, or much.
    for (double part = 0.3; part < 3.5; part *= 1.2)
      yield.push_back(Start("yield").positive("curvature", part * scales_.curvature,
                                              1e-2 * scales_.curvature, 20 * scales_.curvature));
    add("yield", yield);
  }

  void dissipation() {
    add("mass_damping", {Start("mass_damping").positive("rate", 0.3, 1e-4, 1e3)});
    // Where the modulus of the settled shape is met again, solvers and materials differ.
    add("structural_damping", {Start("structural_damping")
                                   .positive("loss_factor", 0.05, 1e-4, 2.0)
                                   .positive("frequency", 2.0, 0.01, 200.0)
                                   .prior(1.5, 2.0)});
    std::vector<Hypothesis> friction, relaxation, creep;
    for (const double slip : {0.03, 0.1, 0.3})
      for (const double ratio : {0.1, 0.3})
        friction.push_back(Start("internal_friction")
                               .positive("curvature", slip * scales_.curvature,
                                         1e-4 * scales_.curvature, 20 * scales_.curvature)
                               .positive("ratio", ratio, 1e-3, 0.95));
    add("internal_friction", friction);
    const double longest = scales_.duration;
    for (const char* from : {"settled", "unloaded"}) {
      for (const double time : {0.02, 0.1, 0.4})
        relaxation.push_back(Start("relaxation")
                                 .word("start", from)
                                 .positive("fraction", 0.1, 1e-3, 0.95)
                                 .positive("time", time * longest, 1e-3 * longest, longest));
      creep.push_back(Start("creep")
                          .word("start", from)
                          .positive("fraction", 0.2, 1e-3, 0.95)
                          .positive("time", 2.0 * longest, longest, 50.0 * longest));
    }
    add("relaxation", relaxation);
    add("creep", creep);
  }

  void air() {
    std::vector<Hypothesis> drag, wind, gust;
    for (const double area : {0.01, 0.1})
      drag.push_back(Start("leaf_drag").positive("drag_area", area, 1e-5, 10.0));
    add("leaf_drag", drag);
    for (int i = 0; i < 4; ++i) {
      const double angle = 0.5 * i * std::numbers::pi;
      const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
      for (const double speed : {0.3, 1.5, 5.0})
        wind.push_back(Start("wind")
                           .vector("velocity", speed * along, 0.3, 30.0, 2)
                           .positive("drag_area", 0.02, 1e-4, 1.0)
                           .prior(1.5, 0.02));
    }
    add("wind", wind);
    // A record of duration T parts frequencies 1/T from each other; halfway between two of these
    // starts a fit still slides to the right one.
    const int count = std::clamp(static_cast<int>(1.8 * scales_.duration), 6, 16);
    for (int f = 1; f <= count; ++f)
      for (int i = 0; i < 2; ++i)
        gust.push_back(
            Start("gust")
                .vector("velocity", 0.7 * (i ? Vec3::UnitY() : Vec3::UnitX()), 0.3, 30.0, 2)
                .positive("drag_area", 0.02, 1e-4, 1.0)
                .prior(1.5, 0.02)
                .positive("frequency", 1.9 * f / count, 0.03, 5.0)
                .positive("amplitude", 0.7, 1e-3, 5.0));
    add("gust", gust);
  }

  void grip() {
    double stiffness = 0.0;
    bool held = false;
    for (const Trial& trial : experiment_.trials)
      for (const Hold& hold : trial.holds) {
        held = true;
        stiffness = std::max(stiffness, hold.stiffness.value_or(0.0));
      }
    if (!held) return;
    const double soft = scales_.root_stiffness / (scales_.length * scales_.length);
    const double from = stiffness > 0.0 ? stiffness : 300.0 * soft;
    std::vector<Hypothesis> compliance, slip;
    for (const double part : {0.6, 0.1}) {
      Start start("grip_compliance");
      start.positive("stiffness", part * from, 0.1 * soft, 1e5 * soft);
      // It replaces a stated stiffness; without one the grip is rigid.
      if (stiffness > 0.0) start.vanishing_at(stiffness);
      compliance.push_back(start);
    }
    add("grip_compliance", compliance);
    // In every trial, or in one.
    double first_end = 1e300;
    for (const Trial& trial : experiment_.trials)
      if (!trial.holds.empty()) first_end = std::min(first_end, end_of_hold(trial));
    slips("", first_end, slip);
    for (const Trial& trial : experiment_.trials)
      if (!trial.holds.empty()) slips(trial.name, end_of_hold(trial), slip);
    add("grip_slip", slip);
  }

  static double end_of_hold(const Trial& trial) {
    return std::min(trial.holds[0].release, trial.duration());
  }

  // A slip in the trial of that name (empty: in all) before `end`.
  static void slips(const std::string& trial, double end, std::vector<Hypothesis>& starts) {
    for (const double part : {0.1, 0.25, 0.4, 0.55, 0.7, 0.85}) {
      Start start("grip_slip");
      if (!trial.empty()) start.word("trial", trial);
      start.signed_number("distance", 0.01, 0.01, -0.1, 0.1)
          .signed_number("time", part * end, 0.2 * end, 0.0, end);
      starts.push_back(start);
    }
  }

  void sensors() {
    std::vector<Hypothesis> latency, offset, rotation;
    for (const double delay : {0.01, -0.01})
      latency.push_back(Start("latency").signed_number("delay", delay, 0.01, -1.0, 1.0));
    add("latency", latency);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 little = 1e-4 * Vec3::Unit(axis);
      for (const Marker& marker : experiment_.markers)
        offset.push_back(
            Start("marker_offset").word("marker", marker.name).vector("offset", little, 1e-3, 0.2));
      rotation.push_back(Start("frame_rotation").vector("rotation", little, 0.01, 0.7));
    }
    add("marker_offset", offset);
    add("frame_rotation", rotation);
    add("marker_scale", {Start("marker_scale").positive("factor", 1.001, 0.3, 3.0)});
    const bool force = std::ranges::any_of(
        experiment_.trials, [](const Trial& trial) { return trial.force.size() > 0; });
    if (force)
      add("force_gain", {Start("force_gain")
                             .positive("gain", 1.01, 0.1, 10.0)
                             .vector("offset", Vec3::Zero(), 0.01, 100.0)});
  }

  double clock_span() const {
    double first = 1e300, last = -1e300;
    for (const Trial& trial : experiment_.trials) {
      first = std::min(first, trial.clock);
      last = std::max(last, trial.clock + trial.duration());
    }
    return last - first;
  }

  static double length_of(const plant::PlantCurve& curve) {
    double length = 0.0;
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      length += (curve.points[i] - curve.points[i - 1]).norm();
    return length;
  }

  bool is_root(const plant::PlantCurve& curve) const {
    double nearest = 1e300;
    for (const plant::PlantCurve& other : plant_.curves)
      nearest = std::min(nearest, end_distance(other));
    return end_distance(curve) <= nearest + 1e-9;
  }
  double end_distance(const plant::PlantCurve& curve) const {
    return std::min((curve.points.front() - plant_.root).norm(),
                    (curve.points.back() - plant_.root).norm());
  }

  const Experiment& experiment_;
  const plant::PlantFile& plant_;
  const Scales& scales_;
  std::vector<Cause> causes_;
};

}  // namespace

Hypothesis baseline() {
  Hypothesis all;
  for (const char* name : {"youngs_modulus", "density", "damping_time"}) {
    const double reach = std::string(name) == "damping_time" ? 300.0 : 10.0;
    // The prior is wide; it only keeps apart what some data leave entirely open (a free vibration
    // sees modulus over density alone).
    all.add(Start(name)
                .positive("factor", 1.0, 1.0 / reach, reach)
                .prior(std::string(name) == "density" ? 0.1 : 1.5, 1.0));
  }
  all.name.clear();
  return all;
}

Hypothesis mesh_freedom() {
  Hypothesis mesh = Start(mesh_error).fixed("share", {0.3}).free_share(0.0, 2.0).prior(0.5, 0.3);
  mesh.name.clear();
  return mesh;
}

Hypothesis junction_freedom(const Experiment& experiment) {
  Diagnostics diagnostics;
  const auto built = plant::build_plant(experiment.plant, {}, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  Hypothesis all;
  std::vector<char> seen(experiment.plant.curves.size(), 0);
  for (const plant::BuiltPlant::Span& span : built->spans) {
    const cosserat::Element& element = built->model.elements[span.element];
    if (std::exchange(seen[span.curve], 1) || element.parent < 0) continue;
    const cosserat::Section& section = element.section;
    const double softest = (section.bend1 + section.bend2) / (most_give * element.length);
    all.add(Start("attachment_compliance")
                .place(experiment.plant.curves[span.curve].name, 0.0)
                .positive("stiffness", 4.0 * softest, softest, 1e3 * softest)
                .prior(2.0, 8.0 * softest));
  }
  all.name.clear();
  return all;
}

bool is_by_convention(const FitSummary& model, int count) {
  double weights = 0.0, sum = 0.0, squares = 0.0;
  for (int p = model.hypothesis.size() - count; p < model.hypothesis.size(); ++p) {
    const double share = most_give * model.hypothesis.free[p].low / model.hypothesis.value(p);
    // The unknown is a logarithm.
    const double weight = std::pow(share * model.standard_error[p], -2);
    weights += weight;
    sum += weight * share;
    squares += weight * share * share;
  }
  const double mean = sum / weights, freedom = count - 1.0;
  return mean - 2.0 / std::sqrt(weights) <= most_by_convention &&
         (count < 2 || squares - sum * mean <= freedom + 3.0 * std::sqrt(2.0 * freedom));
}

std::vector<Cause> candidate_causes(const Experiment& experiment, const Scales& scales) {
  return Candidates(experiment, scales).run();
}

}  // namespace pedicel::discrepancy
