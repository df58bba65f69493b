#pragma once

#include "plugins/discrepancy/report/report.h"
#include "tests/unit/discrepancy/made_data.h"

namespace pedicel::discrepancy {

inline Hypothesis hypothesis_of(const std::string& name, const std::string& parameter, double value,
                                const std::string& unit) {
  Hypothesis h;
  h.name = name;
  plant::Effect effect;
  effect.name = name;
  effect.numbers[parameter] = {value};
  h.effects.push_back(effect);
  FreeParameter free;
  free.name = parameter;
  free.logarithmic = true;
  free.low = 1e-3 * value;
  free.high = 1e3 * value;
  free.unit = unit;
  h.free.push_back(free);
  return h;
}

/// A diagnosis as it would stand after a turn of 1 degree about the root was found in made data:
/// the nominal model is farther off than the refitted one, and the extended one is right.
inline Diagnosis made_diagnosis(Outcome outcome = Outcome::named) {
  MadeData made;
  made.add_noise(1);
  const double angle = 0.0175;
  made.change([=](int trial, double t, int, const Vec3& p) -> Vec3 {
    return trial == 1 && t < 4.0 ? Vec3::Zero() : Vec3(0, angle, 0).cross(p);
  });
  Diagnosis d;
  d.admission.experiment = made.experiment;
  d.admission.samples = 4321;
  d.admission.remarks = {"2 outliers were taken out of m3 <at the top>"};
  d.position_noise = white_noise(MadeData::position_std);
  d.force_noise = white_noise(MadeData::force_std);
  d.numerical_error = 0.07;
  d.fit_trials = {0, 1};
  d.check_trials = {2};
  const auto with_turn = [&](double share) {
    std::vector<Prediction> p = made.predictions;
    for (std::size_t t = 0; t < p.size(); ++t)
      for (Eigen::Index i = 0; i < p[t].markers.rows(); ++i)
        for (Eigen::Index c = 0; c < p[t].markers.cols(); c += 3) {
          const Vec3 x = p[t].markers.row(i).segment<3>(c).transpose();
          if (t != 1 || made.experiment.trials[t].markers.time[i] >= 4.0)
            p[t].markers.row(i).segment<3>(c) += share * Vec3(0, angle, 0).cross(x).transpose();
        }
    return p;
  };
  d.predictions = {with_turn(-0.5), with_turn(0.0), with_turn(1.0)};
  d.before = {52.0, 4.0, 0, true};
  Candidate best;
  best.cause = "base_compliance";
  best.fit.hypothesis = hypothesis_of("base_compliance", "stiffness", 0.81, "N m/rad");
  best.gain = 640.0, best.evidence = 631.0;
  best.whole = true;
  Candidate competitor;
  competitor.cause = "weak_segment";
  competitor.fit.hypothesis = hypothesis_of("weak_segment", "factor", 0.1, "1");
  competitor.fit.hypothesis.add(mesh_nuisance());
  competitor.fit.at_bound = {0, 1};
  competitor.gain = 610.0, competitor.evidence = 598.0;
  competitor.whole = true;
  Candidate none = competitor;
  none.cause = "wind";
  none.gain = 0.2, none.evidence = -9.0;
  Candidate left = none;
  left.cause = "gust";
  left.whole = false;
  d.ranking = {best, competitor, none, left};
  d.best = best.fit;
  d.best.why = "relative change of the cost below its limit";
  d.best.converged = true;
  NamedCause cause;
  cause.name = "base_compliance";
  cause.parameters["stiffness"] = {{0.81, 0.77, 0.86, "N m/rad"}};
  cause.evidence = 631.0;
  Verdict& v = d.verdict;
  v.outcome = outcome;
  v.causes = {cause};
  if (outcome == Outcome::ambiguous) {
    NamedCause other;
    other.name = "weak_segment";
    other.where = plant::CurvePlace{"stem", 0.15, {}};
    other.parameters["factor"] = {{0.1, 0.05, INFINITY, "1"}};
    other.parameters["length"] = {{0.06, 0.03, 0.12, "m"}};
    other.evidence = 628.0;
    v.causes.push_back(other);
    v.next_experiment = "Pull stem at 0.8 along x by 40 mm and let go.";
    d.next.sentence = v.next_experiment;
    d.next.channel = "m3.x";
    d.next.unit = "m";
    d.next.noise = 3e-4;
    d.next.names = {"base_compliance", "weak_segment"};
    for (int i = 0; i < 200; ++i) d.next.time.push_back(0.02 * i);
    for (const double f : {2.0, 2.1}) {
      d.next.series.emplace_back();
      for (const double t : d.next.time)
        d.next.series.back().push_back(0.02 * std::cos(6.28 * f * t));
    }
  }
  if (outcome == Outcome::unknown || outcome == Outcome::adequate) v.causes.clear();
  if (outcome == Outcome::unknown) v.remainder = "31 % of what the refitted model left";
  if (outcome == Outcome::adequate) {
    d.best = d.base;
    d.ranking.clear();
    d.before = {2.1, 4.0, 0, false};
    d.predictions[extended] = d.predictions[refitted];
  }
  if (outcome == Outcome::bad_data) {
    d.admission.refusal = v.remainder = "trial \"weights\" has no data";
    d.predictions = {};
    d.ranking.clear();
    v.causes.clear();
  }
  v.competing = {{"weak_segment", 33.0}};
  v.fit = {9.1, 6.2, 1.01};
  v.check = {8.4, 5.9, 1.03};
  if (outcome == Outcome::named) v.gain = 0.994;
  v.parameters["youngs_modulus"] = {3.1e8, 3.0e8, 3.2e8, "Pa"};
  v.detectable_limits = {{"extra_mass", "mass", 0.004, "kg"},
                         {"grip_compliance", "stiffness", 900.0, "N/m"},
                         {"gust", "", INFINITY, "1"}};
  v.extended_plant = "extended.plant.yaml";
  v.simulations = 412;
  v.seconds = 38.5;
  d.unseen = {"density"};
  d.steps = {"Nodes every 10 mm and a step of 2 ms.", "Largest directed statistic 52, level 4."};
  return d;
}

}  // namespace pedicel::discrepancy
