#include "tests/discrepancy/reference_trial.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/discrepancy/reference_rotation.h"

namespace pedicel::reference {

namespace {

using plant::Effect;

const Effect* find(const std::vector<Effect>& effects, const std::string& name) {
  const auto it =
      std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.name == name; });
  return it == effects.end() ? nullptr : &*it;
}

Vec3 vector_of(const Effect& effect, const std::string& key) {
  const auto it = effect.numbers.find(key);
  return it == effect.numbers.end() ? Vec3::Zero()
                                    : Vec3(it->second[0], it->second[1], it->second[2]);
}

// Only between two times, by the middle of the step.
PointLaw within(PointLaw law, double from, double to) {
  return [law = std::move(law), from, to](double t, double middle, const Vec3& x,
                                          const Vec3& v) -> PointPush {
    return middle >= from && middle < to ? law(t, middle, x, v) : PointPush{};
  };
}

PointLaw outside_law(const OutsideEffect& s) {
  using enum OutsideEffect::Kind;
  return [&s](double t, double, const Vec3& x, const Vec3&) -> PointPush {
    const Vec3 away = s.point - x;
    const double r = away.norm();
    switch (s.kind) {
      case string:
        if (r <= s.slack) return {};
        return {s.size * (r - s.slack) / r * away, s.size};
      case stake: {
        const double depth = s.direction.dot(away);
        return depth <= 0 ? PointPush{} : PointPush{s.size * depth * s.direction, s.size};
      }
      case push:
        return {s.size * std::sin(2 * M_PI * s.frequency * t) * s.direction, 0.0};
      case attraction: {
        const double d2 = 0.05 * 0.05;
        return {s.size * d2 / (d2 + r * r) * away / std::max(r, 1e-9), 0.0};
      }
    }
    return {};
  };
}

/// A running trial: the solver with everything that acts in it.
class Run {
 public:
  Run(const Subject& subject, const TrialPlan& trial, const Mesh& mesh)
      : subject_(subject), trial_(trial) {
    Tree tree = build_tree(subject.plant, subject.effects, trial.masses, mesh.spacing);
    Surroundings around;
    around.gravity = trial.gravity;
    around.clock = trial.clock;
    for (const HoldPlan& hold : trial.holds) add_hold(tree, hold, around);
    for (const LoadPlan& load : trial.loads)
      around.forces.push_back(
          {at(tree, load.place), within(
                                     [f = load.force](double, double, const Vec3&, const Vec3&) {
                                       return PointPush{f, 0.0};
                                     },
                                     load.from, load.to)});
    for (const OutsideEffect& s : subject.outside)
      around.forces.push_back({at(tree, s.place), outside_law(s)});
    if (trial.base) around.clamp = [this](double t) { return trial_.base->at(t); };
    solver = std::make_unique<Solver>(std::move(tree), std::move(around));
    hang(mesh);
  }

  Place at(const Tree& tree, const plant::CurvePlace& place) const {
    return locate(subject_.plant, tree, place.curve, place.at);
  }

  // N, W: what the first hold does to the plant now.
  Vec3 grip(double t) const { return grip(t, t); }
  // `middle` says on which side of a jump that is.
  Vec3 grip(double t, double middle) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < grips_; ++i) {
      const PointForce& point = solver->surroundings().forces[i];
      sum += point.law(t, middle, solver->position(point.place), Vec3::Zero()).force;
    }
    return sum;
  }

  std::unique_ptr<Solver> solver;

 private:
  // For hours under its own weight: all that hung terms carry is gone.
  void hang(const Mesh& mesh) {
    double gone = 0.0;
    for (const MemoryTerm& term : solver->tree().law.memory) gone += term.hung ? term.share : 0.0;
    if (gone == 0.0) return;
    Tree relaxed = build_tree(subject_.plant, subject_.effects, {}, mesh.spacing);
    std::erase_if(relaxed.law.memory, [](const MemoryTerm& term) { return term.hung; });
    for (Segment& s : relaxed.segments) s.joint.stiffness *= 1.0 - gone;
    Surroundings around;
    around.gravity = trial_.gravity;
    around.clock = trial_.clock;
    Solver before(std::move(relaxed), std::move(around));
    before.settle();
    solver->hang(before.settled());
  }

  // Its spring pulls through the stem, which gives along itself: in the joint coordinates it does
  // not, so what it would give is added to the spring's compliance. (EA over the length is 50 kN/m
  // where a grip has 150 N/m: 0.3 %.)
  PointLaw hold_law(const HoldPlan& hold, int held) const {
    double k = hold.stiffness.value_or(rigid_stiffness);
    if (const Effect* e = find(subject_.effects, "grip_compliance")) k = e->number("stiffness");
    return
        [this, &hold, held, k](double t, double middle, const Vec3& x, const Vec3&) -> PointPush {
          if (middle >= hold.release) return {};
          const Mat3 compliance = Mat3::Identity() / k + stretch_below(held);
          const Vec3 away = hold.path.at(t).position - x;
          if (!hold.axes.empty()) return led(hold, compliance, away, k);
          return {compliance.llt().solve(away), k};
        };
  }

  // Along its axes alone.
  static PointPush led(const HoldPlan& hold, const Mat3& compliance, const Vec3& away, double k) {
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> axes(3, hold.axes.size());
    for (std::size_t i = 0; i < hold.axes.size(); ++i) axes.col(i) = hold.axes[i];
    if (hold.one_sided && axes.col(0).dot(away) <= 0.0) return {};
    const auto along = (axes.transpose() * compliance * axes).eval();
    return {axes * along.llt().solve(axes.transpose() * away), k};
  }

  // m/N, W: what the segments from the clamp to one give along themselves as they stand now.
  Mat3 stretch_below(int segment) const {
    Mat3 sum = Mat3::Zero();
    for (int i = segment; i >= 0; i = solver->tree().segments[i].parent) {
      const Vec3 along = solver->rotation(i).col(2);
      sum += solver->tree().segments[i].stretch * along * along.transpose();
    }
    return sum;
  }

  // With grip_slip the first hold lets go of its place and takes hold further along the stem.
  void add_hold(const Tree& tree, const HoldPlan& hold, Surroundings& around) {
    const Place place = at(tree, hold.place);
    const PointLaw law = hold_law(hold, place.segment);
    const Effect* slip = find(subject_.effects, "grip_slip");
    const bool first = around.forces.empty();
    if (!slip || !first) {
      around.forces.push_back({place, law});
      if (first) grips_ = 1;
      return;
    }
    const double time = slip->number("time"), never = std::numeric_limits<double>::infinity();
    plant::CurvePlace after = hold.place;
    after.at +=
        slip->number("distance") / tree.curve_lengths[subject_.plant.curve_index(hold.place.curve)];
    const Place next = at(tree, after);
    around.forces.push_back({place, within(law, -never, time)});
    around.forces.push_back({next, within(hold_law(hold, next.segment), time, never)});
    grips_ = 2;
  }

  const Subject& subject_;
  const TrialPlan& trial_;
  int grips_ = 0;  // the first entries of the forces: the first hold
};

// Positions between two steps, cubic in time.
Vec3 hermite(const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double h, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * x0 + (u3 - 2 * u2 + u) * h * v0 + (3 * u2 - 2 * u3) * x1 +
         (u3 - u2) * h * v1;
}

struct Track {
  std::vector<Vec3> x, v;  // of one marker, at every step

  Vec3 at(double t, double h) const {
    const int last = static_cast<int>(x.size()) - 1;
    if (t <= 0.0 || last == 0) return x.front();
    const int i = std::min(last - 1, static_cast<int>(t / h));
    return hermite(x[i], v[i], x[i + 1], v[i + 1], h, t / h - i);
  }
};

/// The sensors: where they sit, and what they make of what they see.
class Sensors {
 public:
  Sensors(const Subject& subject, const Tree& tree, const std::vector<MarkerPlan>& markers)
      : effects_(subject.effects), tracks_(markers.size()) {
    for (const MarkerPlan& m : markers) {
      places_.push_back(locate(subject.plant, tree, m.place.curve, m.place.at));
      Vec3 offset = Vec3::Zero();
      for (const Effect& e : effects_)
        if (e.name == "marker_offset" && e.words.at("marker") == m.name)
          offset += vector_of(e, "offset");
      offsets_.push_back(tree.segments[places_.back().segment].drawn.conjugate() * offset);
    }
  }

  void look(const Solver& solver) {
    for (std::size_t m = 0; m < places_.size(); ++m) {
      const Mat3 R = solver.rotation(places_[m].segment);
      const Vec3 arm = R * offsets_[m];
      tracks_[m].x.push_back(solver.position(places_[m]) + arm);
      // The offset's own turning velocity from the last step is enough for interpolation.
      const Vec3 turning = before_.size() == places_.size() && step_ > 0
                               ? Vec3((arm - before_[m]) / step_)
                               : Vec3::Zero();
      tracks_[m].v.push_back(solver.velocity(places_[m]) + turning);
    }
    before_.resize(places_.size());
    for (std::size_t m = 0; m < places_.size(); ++m)
      before_[m] = solver.rotation(places_[m].segment) * offsets_[m];
  }

  Vec3 seen(std::size_t marker, double t) const {
    double delay = 0.0, scale = 1.0;
    Quat turn = Quat::Identity();
    for (const Effect& e : effects_) {
      if (e.name == "latency") delay += e.number("delay");
      if (e.name == "marker_scale") scale *= e.number("factor");
      if (e.name == "frame_rotation") turn = rotation_exp(vector_of(e, "rotation"));
    }
    return scale * (turn * tracks_[marker].at(t - delay, step_));
  }

  // s, of a sensor that follows as a low-pass.
  double lag(const std::string& what) const {
    double sum = 0.0;
    for (const Effect& e : effects_)
      if (e.name == "sensor_lag" && e.words.at("what") == what) sum += e.number("time");
    return sum;
  }

  // What is seen follows, from its steady state on; exact for a straight line between steps.
  void follow() {
    const double time = lag("markers");
    if (time == 0.0) return;
    for (Track& track : tracks_) {
      Vec3 y = track.x.front(), before = y;
      for (std::size_t i = 0; i < track.x.size(); ++i) {
        const Vec3 x = track.x[i];
        if (i > 0) y = lagging(y, before, x, step_, time);
        before = x;
        track.x[i] = y;
        track.v[i] = (x - y) / time;
      }
    }
  }

  static Vec3 lagging(const Vec3& y, const Vec3& from, const Vec3& to, double h, double time) {
    const Vec3 behind = time / h * (to - from);
    return to - behind + std::exp(-h / time) * (y - from + behind);
  }

  Vec3 felt(const Vec3& force) const {
    const Effect* e = find(effects_, "force_gain");
    return e ? Vec3(e->number("gain") * force + vector_of(*e, "offset")) : force;
  }

  void set_step(double h) { step_ = h; }

 private:
  const std::vector<Effect>& effects_;
  std::vector<Place> places_;
  std::vector<Vec3> offsets_;  // E
  std::vector<Vec3> before_;   // W
  std::vector<Track> tracks_;
  double step_ = 0.0;
};

double sharpest(const Solver& solver) {
  double most = 0.0;
  for (int i = 0; i < solver.tree().size(); ++i) most = std::max(most, solver.curvature(i));
  return most;
}

}  // namespace

Pose Rows::at(double t) const {
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  if (after == time.begin() || after == time.end()) {
    const std::size_t i = after == time.begin() ? 0 : time.size() - 1;
    return {position[i], rotation.empty() ? Quat::Identity() : rotation[i]};
  }
  const std::size_t i = after - time.begin();
  const double u = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return {(1 - u) * position[i - 1] + u * position[i],
          rotation.empty() ? Quat::Identity() : rotation[i - 1].slerp(u, rotation[i])};
}

const char* name_of(OutsideEffect::Kind kind) {
  constexpr const char* names[] = {"string", "stake", "push", "attraction"};
  return names[static_cast<int>(kind)];
}

namespace {

// From rest at its beginning to its end.
Record run_whole(const Subject& subject, const TrialPlan& trial,
                 const std::vector<MarkerPlan>& markers, const Mesh& mesh) {
  Run run(subject, trial, mesh);
  Solver& solver = *run.solver;
  Record record;
  record.settled = solver.settle();
  record.settled_curvature = record.most_curvature = sharpest(solver);
  const int samples = static_cast<int>(std::lround(trial.duration / trial.interval)) + 1;
  const int substeps = std::max(1, static_cast<int>(std::ceil(trial.interval / mesh.dt - 1e-9)));
  const double h = trial.interval / substeps;
  Sensors sensors(subject, solver.tree(), markers);
  sensors.set_step(h);
  sensors.look(solver);
  if (trial.measures_force) record.force.resize(samples, 3);
  if (trial.measures_wrench) record.wrench.resize(samples, 6);
  const double force_lag = sensors.lag("force");
  Vec3 pull = run.grip(0.0), shown = pull;
  for (int i = 0; i < samples; ++i) {
    const double t = i * trial.interval;
    for (int k = 0; k < substeps && i > 0; ++k) {
      solver.step(h);
      sensors.look(solver);
      if (force_lag == 0.0) continue;
      // Where a grip lets go at the step's end it has not done so within it.
      shown = Sensors::lagging(shown, pull, run.grip(solver.time(), solver.time() - 0.5 * h), h,
                               force_lag);
      pull = run.grip(solver.time());
    }
    record.time.push_back(t);
    record.most_curvature = std::max(record.most_curvature, sharpest(solver));
    if (trial.measures_force)
      record.force.row(i) = sensors.felt(force_lag > 0.0 ? shown : run.grip(t));
    // The accelerations are those of the step's end: what jumps there has not done so yet.
    if (trial.measures_wrench)
      record.wrench.row(i) = solver.root_wrench(i > 0 ? t - 0.5 * h : 0.0).transpose();
  }
  sensors.follow();
  record.markers.resize(samples, 3 * static_cast<int>(markers.size()));
  for (int i = 0; i < samples; ++i)
    for (std::size_t m = 0; m < markers.size(); ++m)
      record.markers.block<1, 3>(i, 3 * static_cast<int>(m)) =
          sensors.seen(m, record.time[i]).transpose();
  return record;
}

Rows row_at(const Rows& path, double t) {
  const Pose pose = path.at(t);
  Rows row{{0.0}, {pose.position}, {}};
  if (!path.rotation.empty()) row.rotation = {pose.rotation};
  return row;
}

// Each sample an equilibrium of its own.
Record run_static(const Subject& subject, const TrialPlan& trial,
                  const std::vector<MarkerPlan>& markers, const Mesh& mesh) {
  Record series;
  const int samples = static_cast<int>(std::lround(trial.duration / trial.interval)) + 1;
  for (int i = 0; i < samples; ++i) {
    const double t = i * trial.interval;
    TrialPlan one = trial;
    one.duration = 0.0;
    for (HoldPlan& hold : one.holds) hold.path = row_at(hold.path, t);
    if (one.base) one.base = row_at(*one.base, t);
    const Record row = run_whole(subject, one, markers, mesh);
    if (i == 0) {
      series = row;
      series.markers.resize(samples, row.markers.cols());
      series.force.resize(trial.measures_force ? samples : 0, 3);
      series.wrench.resize(trial.measures_wrench ? samples : 0, 6);
      series.time.clear();
    }
    series.time.push_back(t);
    series.markers.row(i) = row.markers;
    if (trial.measures_force) series.force.row(i) = row.force;
    if (trial.measures_wrench) series.wrench.row(i) = row.wrench;
    series.most_curvature = std::max(series.most_curvature, row.most_curvature);
    series.settled = series.settled && row.settled;
  }
  return series;
}

// Without what comes before it begins; its clock begins anew.
Record cut(Record record, const TrialPlan& trial) {
  const auto rows = std::lround(trial.begins / trial.interval);
  for (Eigen::MatrixXd* channel : {&record.markers, &record.force, &record.wrench})
    if (channel->rows() > 0) *channel = channel->bottomRows(channel->rows() - rows).eval();
  record.time.resize(record.time.size() - static_cast<std::size_t>(rows));
  return record;
}

}  // namespace

Record run_trial(const Subject& subject, const TrialPlan& trial,
                 const std::vector<MarkerPlan>& markers, const Mesh& mesh) {
  if (trial.is_static) return run_static(subject, trial, markers, mesh);
  Record record = run_whole(subject, trial, markers, mesh);
  return trial.begins > 0.0 ? cut(std::move(record), trial) : record;
}

Vec3 settled_point(const Subject& subject, const TrialPlan& trial, const plant::CurvePlace& place,
                   const Mesh& mesh) {
  TrialPlan bare = trial;
  bare.holds.clear();
  Run run(subject, bare, mesh);
  run.solver->settle();
  return run.solver->position(locate(subject.plant, run.solver->tree(), place.curve, place.at));
}

}  // namespace pedicel::reference
