#include "tests/discrepancy/hidden_case.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tests/discrepancy/sensor_noise.h"

namespace pedicel::hidden {

namespace {

using Kind = CaseOrder::Kind;
using reference::Mesh;
using reference::Record;
using reference::Subject;
using reference::TrialPlan;

// The least that counts as identifiable: what stays of the change after a refit, in noise units.
constexpr double identifiable = 5.0;
constexpr int most_draws = 20;          // of an effect until one leaves a trace, and
constexpr double least_visible = 0.02;  // of what is identifiable, that counts as one,
constexpr double least_parted = 0.2;    // or as one of its own: instruments five times as good

/// Makes one case, step by step.
class Maker {
 public:
  Maker(std::uint64_t seed, const CaseOrder& order)
      : random_(seed * 0x9e3779b97f4a7c15ull + 1000003ull * order.number + 17) {
    case_.order = order;
    case_.seed = seed;
    std::ostringstream name;
    name << "case_" << std::setw(4) << std::setfill('0') << order.number;
    case_.name = name.str();
  }

  HiddenCase make() {
    prepare();
    hide();
    if (case_.order.kind == Kind::look_alike) compare();
    judge();
    measure();
    return std::move(case_);
  }

 private:
  const CaseOrder& order() const { return case_.order; }
  bool same_damping() const {
    return order().kind == Kind::look_alike && count("mass_damping") > 0;
  }
  static bool same_kind(const std::string& name, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  long count(const std::string& name) const {
    return std::count(order().hidden.begin(), order().hidden.end(), name);
  }

  void prepare() {
    case_.setting = make_setting(order().plant, random_);
    if (same_damping())  // where mode 2 has its node
      case_.setting.markers = {{"m1", {"stem", 0.77, {}}}, {"m2", {"stem", 0.79, {}}}};
    case_.noise.position_std = 2e-4 * std::pow(3.0, random_.uniform());
    case_.noise.force_std = 0.005 * std::pow(4.0, random_.uniform());
    case_.noise.rho = order().coloured ? random_.uniform(0.5, 0.95) : 0.0;
    case_.noise.moment_std = 0.1 * case_.noise.force_std;  // m, times a sensor's force
    if (order().off)
      case_.refitted = {factor("youngs_modulus", random_.uniform(0.7, 1.4)),
                        factor("damping_time", random_.uniform(0.6, 1.6))};
    subject_ = {case_.setting.plant, case_.refitted, {}};
    plain_ = subject_;
    // What yields is a zone next to the sharpest bend, which a coarse mesh makes as long as a
    // segment.
    coarse_ = {(count("yield") ? 0.5 : 2.0) * case_.setting.plant.distance, 0.005};
    fine_ = {0.25 * case_.setting.plant.distance, 0.0017};
    make_trials();
    if (order().pack == PackKind::moving && order().kind != Kind::null) find_starts();
  }

  void make_trials() {
    const Subject nominal{case_.setting.plant, {}, {}};
    start_ = settled_point(nominal, {}, case_.setting.hold, fine_);
    const double softness = tip_softness(case_.setting);
    const double pause = count("stiffness_drift") ? 900.0 : 60.0;
    case_.trials = make_pack(order().pack, case_.setting, start_, softness, pause, random_);
    if (same_damping()) case_.trials = first_mode_pack(case_.setting, softness);
    if (order().kind == Kind::look_alike && count("base_compliance"))
      for (reference::LoadPlan& load : case_.trials.back().loads) load.place = case_.setting.tip;
    scale_.pause = pause;
    scale_.held = start_;
    scale_.reach = case_.setting.reach;
    for (const TrialPlan& t : case_.trials) {
      const Record r = run_trial(plain_, t, case_.setting.markers, coarse_);
      scale_.most_curvature = std::max(scale_.most_curvature, r.most_curvature);
      if (count("yield"))
        fine_curvature_ = std::max(
            fine_curvature_, run_trial(plain_, t, case_.setting.markers, fine_).most_curvature);
      scale_.settled_curvature = std::max(scale_.settled_curvature, r.settled_curvature);
    }
  }

  Eigen::VectorXd predict(const Subject& subject) const { return predict(subject, coarse_); }

  Eigen::VectorXd predict(const Subject& subject, const Mesh& mesh) const {
    std::vector<Record> records;
    for (const TrialPlan& t : case_.trials) records.push_back(seen(subject, t, mesh));
    Eigen::VectorXd data = whitened(records, case_.noise);
    Eigen::Index first = 0;
    for (const Eigen::MatrixXd& start : starts_) {
      auto trial = data.segment(first, start.rows());
      trial -= (start * (start.transpose() * trial)).eval();
      first += start.rows();
    }
    return data;
  }

  // What no table has a column for changes with nothing.
  Record seen(const Subject& subject, const TrialPlan& trial, const Mesh& mesh) const {
    Record record = run_trial(subject, trial, case_.setting.markers, mesh);
    for (int c = 0; c < record.markers.cols(); ++c)
      if (!measures_axis(order().pack, c / 3, c % 3)) record.markers.col(c).setZero();
    for (int c = 0; c < record.force.cols(); ++c)
      if (!measures_force_axis(order().pack, c)) record.force.col(c).setZero();
    return record;
  }

  // Where a record begins in mid swing, nobody knows how the plant stands and moves then: what a
  // push in the quarter second before could change is no trace of anything.
  void find_starts() {
    const double force = 0.02 * scale_.reach / tip_softness(case_.setting);
    for (const TrialPlan& trial : case_.trials) {
      const auto data = [&](const TrialPlan& t) {
        return whitened({seen(plain_, t, coarse_)}, case_.noise);
      };
      const Eigen::VectorXd plain = data(trial);
      std::vector<Eigen::VectorXd> columns;
      for (std::size_t m = 0; m < case_.setting.markers.size(); m += 2)
        for (const double before : {0.24, 0.1})
          for (int axis = 0; axis < 3; ++axis) {
            TrialPlan pushed = trial;
            pushed.loads.push_back({case_.setting.markers[m].place, force * Vec3::Unit(axis),
                                    trial.begins - before, trial.begins});
            columns.push_back(data(pushed) - plain);
          }
      Eigen::MatrixXd all(plain.size(), static_cast<Eigen::Index>(columns.size()));
      for (std::size_t i = 0; i < columns.size(); ++i)
        all.col(static_cast<Eigen::Index>(i)) = columns[i];
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
      qr.setThreshold(1e-3);
      qr.compute(all);
      starts_.push_back(qr.householderQ() * Eigen::MatrixXd::Identity(plain.size(), qr.rank()));
    }
  }

  // What a refit could change as well; the parameter that is itself the cause is not among it.
  Sight sight(const std::string& cause) const {
    std::vector<std::string> absorbing;
    for (const char* name : {"youngs_modulus", "density", "damping_time"})
      if (cause != name && (order().kind != Kind::look_alike || !count(name)))
        absorbing.push_back(name);
    return Sight(
        plain_, [this](const Subject& s) { return predict(s); }, absorbing);
  }

  // What other causes, the plant's mesh and junctions led otherwise make of the data.
  Distinguishability distinguishability(const std::string& truth, const Sight& eye) const {
    const auto change = [&](const std::vector<plant::Effect>& effects) -> Eigen::VectorXd {
      Subject subject = plain_;
      subject.effects.insert(subject.effects.end(), effects.begin(), effects.end());
      return predict(subject) - eye.plain();
    };
    const double distance = case_.setting.plant.distance;
    std::vector<Eigen::VectorXd> conventions{predict(plain_, {distance, coarse_.dt}) -
                                             predict(plain_, {0.25 * distance, coarse_.dt})};
    if (case_.setting.plant.curves.size() > 1)
      conventions.push_back(change(soft_junctions(case_.setting.plant)));
    return {eye.columns(), conventions, other_causes(truth, case_.setting, scale_), change};
  }

  static Subject with(Subject subject, const HiddenEffect& effect, double size) {
    effect.add(size, subject);
    return subject;
  }

  void hide() {
    const bool one = order().kind == Kind::look_alike;
    for (std::size_t i = 0; i < order().hidden.size() && (!one || i == 0); ++i) {
      const std::string& name = order().hidden[i];
      int draws = 0;  // a string may hang where the plant never goes
      while (!hide_one(draw(name)))
        if (++draws == most_draws) throw NoTrace(case_.name + ": no trace of " + name);
    }
  }

  HiddenEffect draw(const std::string& name) {
    HiddenEffect effect = draw_effect(name, case_.setting, scale_, random_);
    if (order().kind == Kind::look_alike && name == "weak_segment") {
      // At the foot of the stem or of the branch, below every marker.
      const bool foot = count("base_compliance");
      const std::string curve =
          foot ? case_.setting.hold.curve : case_.setting.plant.curves[1].name;
      effect.add = [curve, reach = case_.setting.reach](double size, Subject& subject) {
        plant::Effect e = factor("weak_segment", 1 / (1 + size));
        e.place = plant::CurvePlace{curve, 0.02, {}};
        e.numbers["length"] = {0.01 * reach};
        subject.effects.push_back(e);
      };
      effect.guess = 1.0;
      effect.cap = 200.0;
    }
    // A larger modulus is a smaller density, but more damping of one kind more of another.
    if (order().kind == Kind::look_alike && same_kind(name, {"youngs_modulus", "density"}))
      effect.add = [name, inverse = name != order().hidden.front()](double size, Subject& subject) {
        subject.effects.push_back(factor(name, inverse ? 1 / (1 + size) : 1 + size));
      };
    if (order().kind == Kind::look_alike && name == "damping_time")
      effect.add = [](double size, Subject& subject) {
        subject.effects.push_back(factor("damping_time", 1 + size));
      };
    if (order().kind == Kind::look_alike && name == "attachment_compliance")
      effect.add = [curve = case_.setting.plant.curves[1].name](double size, Subject& subject) {
        plant::Effect e;
        e.name = "attachment_compliance";
        e.place = plant::CurvePlace{curve, 0.0, {}};
        e.numbers["stiffness"] = {1 / size};
        subject.effects.push_back(e);
      };
    return effect;
  }

  // The change that a size makes, its refit started where that of the last size points to.
  Eigen::VectorXd look(const Sight& eye, const HiddenEffect& effect, double size) {
    Eigen::VectorXd start;
    if (last_size_ > 0.0) start = std::min(size / last_size_, 4.0) * last_refit_;
    const Sight::Change change = eye.change(with(plain_, effect, size), start);
    last_size_ = size;
    last_refit_ = change.refit;
    return change.rest;
  }

  // Adds it at the ordered multiple of its smallest identifiable size. Where that would be more
  // than makes sense, better instruments are taken instead. False where it leaves no trace.
  bool hide_one(const HiddenEffect& effect) {
    double smallest = 0.003, size = smallest * std::min(order().size, 8.0), seen = 0.0;
    if (effect.sized) {
      const Sight eye = sight(effect.name);
      const bool apart = order().told_apart;
      const auto others =
          apart ? std::optional(distinguishability(effect.name, eye)) : std::nullopt;
      std::map<double, Eigen::VectorXd> changes;
      const auto change = [&](double u) -> const Eigen::VectorXd& {
        return changes.contains(u) ? changes[u] : changes[u] = look(eye, effect, u);
      };
      const auto norm = [&](double u) {
        return others ? others->nearest(change(u)).distance : change(u).norm();
      };
      last_size_ = 0.0;
      smallest = size_for(norm, identifiable, effect.guess, effect.cap / order().size);
      size = smallest * order().size;
      if (order().kind == Kind::look_alike && count("density"))
        size = 0.15;  // nothing tells them apart, however large: no need to be near the limit
      const double better = norm(smallest) / identifiable;
      if (!(better > (apart ? least_parted : least_visible))) return false;
      seen = change(size).norm();
      if (apart) case_.nearest = others->nearest(change(size));
      if (better < 0.94) {
        case_.noise.position_std *= better;
        case_.noise.force_std *= better;
        case_.noise.moment_std *= better;
        for (double& before : case_.visible) before /= better;
        seen /= better;
        case_.nearest.distance /= better;
      }
    }
    effect.add(size, subject_);
    // Met in the data as far below the sharpest bend as in what the size was found with.
    if (effect.name == "yield")
      subject_.effects.back().numbers["curvature"][0] *= fine_curvature_ / scale_.most_curvature;
    case_.smallest.push_back(smallest);
    case_.size.push_back(size);
    case_.visible.push_back(seen);
    return true;
  }

  // The sine between the truth and the others that are said to look like it.
  void compare() {
    const Sight eye = sight(order().hidden.front());
    const Eigen::VectorXd truth = eye.change(subject_).rest;
    case_.sine = 0.0;
    for (std::size_t i = 1; i < order().hidden.size(); ++i) {
      HiddenEffect other = draw(order().hidden[i]);
      if (count("density")) other.guess = case_.size.front();
      last_size_ = 0.0;
      const double size = size_for([&](double u) { return look(eye, other, u).norm(); },
                                   truth.norm(), other.guess, other.cap);
      case_.sine =
          std::max(case_.sine, hidden::sine(truth, eye.change(with(plain_, other, size)).rest));
    }
  }

  void judge() {
    const std::size_t known = case_.refitted.size();
    case_.causes.assign(subject_.effects.begin() + static_cast<long>(known),
                        subject_.effects.end());
    case_.outside = subject_.outside;
    if (order().kind == Kind::look_alike) case_.look_alikes = order().hidden;
    switch (order().kind) {
      case Kind::null:
        case_.expected = Expected::adequate;
        break;
      case Kind::effect:
      case Kind::pair:
        case_.expected = Expected::named;
        break;
      case Kind::look_alike:
        case_.expected = Expected::ambiguous;
        break;
      case Kind::outside:
        case_.expected = Expected::unknown;
        break;
    }
  }

  // The data, on a mesh so fine that its own error is far below the noise, and the noise.
  void measure() {
    if (order().hidden_start) start_where_hidden();
    for (const TrialPlan& t : case_.trials) {
      Record r = run_trial(subject_, t, case_.setting.markers, fine_);
      // A plant that softens without end folds where it is held.
      if (!r.markers.allFinite() || !r.force.allFinite())
        throw NoTrace(case_.name + ": the reference does not survive " + t.name);
      case_.clean.push_back(r);
      add_noise(r.markers, case_.noise.position_std, case_.noise.rho, random_);
      add_noise(r.force, case_.noise.force_std, 0.0, random_);
      if (r.wrench.rows() > 0) {
        Eigen::MatrixXd force = r.wrench.leftCols(3), moment = r.wrench.rightCols(3);
        add_noise(force, case_.noise.force_std, 0.0, random_);
        add_noise(moment, case_.noise.moment_std, 0.0, random_);
        r.wrench << force, moment;
      }
      add_outliers(r.markers, case_.causes, case_.noise.position_std, random_);
      case_.records.push_back(std::move(r));
    }
  }

  void start_where_hidden() {
    TrialPlan still;
    const Vec3 shift = settled_point(subject_, still, case_.setting.hold, fine_) - start_;
    for (TrialPlan& t : case_.trials)
      for (reference::HoldPlan& hold : t.holds)
        for (Vec3& p : hold.path.position) p += shift;
  }

  Random random_;
  HiddenCase case_;
  Subject plain_, subject_;  // without and with what is hidden
  Mesh coarse_, fine_;
  Scale scale_;
  double fine_curvature_ = 0.0;  // 1/m, most_curvature on the mesh of the data
  Vec3 start_ = Vec3::Zero();
  // Of each trial, orthonormal: changes of whitened data by how the record begins.
  std::vector<Eigen::MatrixXd> starts_;
  double last_size_ = 0.0;  // of look()
  Eigen::VectorXd last_refit_;
};

}  // namespace

HiddenCase make_case(std::uint64_t seed, const CaseOrder& order) {
  return Maker(seed, order).make();
}

}  // namespace pedicel::hidden
