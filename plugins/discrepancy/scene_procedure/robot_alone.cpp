#include "plugins/discrepancy/scene_procedure/robot_alone.h"

#include <algorithm>
#include <cmath>

#include "engine/io/csv.h"
#include "engine/robot/carried_links.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

namespace {

/// Of the changes just before it: how far from them a wrench jumps at a break. And of the usual
/// time between two samples: what is no gap of the record.
constexpr double stands_out = 2.0, longest_gap = 3.0;

/// Force and moment of the contact alone, in the sensor's frame, over time.
struct Felt {
  std::vector<double> time;
  std::vector<Vec3> force, moment;

  double largest() const {
    double most = 0.0;
    for (const Vec3& f : force) most = std::max(most, f.norm());
    return most;
  }
};

// s, on average between two samples.
double sample_of(const Felt& felt) {
  return (felt.time.back() - felt.time.front()) /
         static_cast<double>(std::max<std::size_t>(1, felt.time.size() - 1));
}

Felt less(const Samples& measured, const Eigen::MatrixXd& own) {
  Felt felt;
  for (long r = 0; r < measured.size(); ++r) {
    const Eigen::RowVectorXd d = measured.value.row(r) - own.row(r);
    if (!d.allFinite()) continue;
    felt.time.push_back(measured.time[static_cast<std::size_t>(r)]);
    felt.force.push_back(d.head<3>().transpose());
    felt.moment.push_back(d.tail<3>().transpose());
  }
  return felt;
}

/// The scene in which nothing is taken hold of.
Experiment without_events(const Experiment& experiment) {
  Experiment own = experiment;
  for (Trial& trial : own.trials) trial.events.clear();
  return own;
}

/// The scene with places along all curves as further markers of one trial, of one sample.
Experiment with_curves(const Experiment& experiment, int trial, double time, int places_a_curve,
                       std::vector<Marker>& places) {
  Experiment own = experiment;
  own.trials = {experiment.trials[static_cast<std::size_t>(trial)]};
  own.markers.clear();
  for (std::size_t p = 0; p < experiment.plants.size(); ++p)
    for (const plant::PlantCurve& curve : experiment.plants[p].file.curves)
      for (int i = 0; i <= places_a_curve; ++i) {
        Marker marker;
        marker.name = "place " + std::to_string(own.markers.size());
        marker.plant = static_cast<int>(p);
        marker.place = {curve.name, static_cast<double>(i) / places_a_curve, {}};
        own.markers.push_back(marker);
      }
  places = own.markers;
  Trial& one = own.trials.front();
  one.pixels.assign(one.pixels.size(), Samples{});
  one.markers.time = {time};
  one.markers.value = Eigen::MatrixXd::Constant(1, 3 * static_cast<long>(own.markers.size()),
                                                std::numeric_limits<double>::quiet_NaN());
  return own;
}

class RobotAlone {
 public:
  RobotAlone(SceneSimulator& simulator, const std::vector<plant::Effect>& model, double force_std,
             double moment_std, const Vec3& standing_error, const RobotAloneSettings& how)
      : simulator_(simulator),
        how_(how),
        experiment_(simulator.experiment()),
        empty_(without_events(experiment_)),
        alone_(empty_, simulator.numerics(), 1),
        model_(model),
        force_std_(force_std),
        moment_std_(moment_std),
        standing_error_(standing_error),
        state_(nominal_state(experiment_)),
        fields_(simulation::exact_fields_of(experiment_.robot)) {
    for (const auto* list : {&experiment_.scene_effects, &experiment_.effects, &model_})
      for (const plant::Effect& effect : *list) apply_scene_effect(effect, experiment_, state_);
  }

  std::vector<SymptomNumber> run() {
    for (std::size_t t = 0; t < experiment_.trials.size(); ++t) look_at(static_cast<int>(t));
    return std::move(found_);
  }

  // In both over the stretch in which the measured push is firm.
  Vec3 shift() {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (std::size_t t = 0; t < experiment_.trials.size(); ++t) {
      const Trial& trial = experiment_.trials[t];
      const SceneReadings own = untouched(static_cast<int>(t)),
                          model = touched(static_cast<int>(t));
      if (!own.healthy || !model.healthy) continue;
      for (std::size_t w = 0; w < trial.wrenches.size(); ++w) {
        if (trial.wrenches[w].size() < 10) continue;
        const Felt felt = less(trial.wrenches[w], own.wrenches[w]);
        const std::optional<Push> push = firmest(felt);
        if (!push || felt.largest() < how_.least_push * force_std_) continue;
        const Samples foretold{trial.wrenches[w].time, model.wrenches[w]};
        const Push there = push_between(less(foretold, own.wrenches[w]), push->from, push->until);
        if (there.force.norm() < how_.least_push * force_std_) continue;
        const int link = experiment_.wrenches[w].link;
        const std::optional<Vec3> a = place_of(trial, *push, link),
                                  b = place_of(trial, there, link);
        if (!a || !b) continue;
        sum += *a - *b;
        ++count;
      }
    }
    return sum / std::max(1, count);
  }

 private:
  void look_at(int t) {
    const Trial& trial = experiment_.trials[static_cast<std::size_t>(t)];
    const SceneReadings own = untouched(t);
    if (!own.healthy) return;
    for (std::size_t w = 0; w < trial.wrenches.size(); ++w) {
      if (trial.wrenches[w].size() < 10) continue;
      const Felt felt = less(trial.wrenches[w], own.wrenches[w]);
      if (felt.largest() < how_.least_push * force_std_) continue;
      tell_place(t, trial, felt, experiment_.wrenches[w].link);
      tell_break(trial, felt);
    }
  }

  // As if no plant were there: what remains is weight, inertia and the sensor's own.
  SceneReadings untouched(int t) {
    SceneVariant variant{model_};
    variant.plants_away = true;
    const SceneSimulator::Request request{&variant, t};
    return alone_.run({&request, 1}).front();
  }

  /// Means over a stretch of time.
  struct Push {
    double from = 0.0, until = 0.0, time = 0.0;  // s
    int count = 0;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  };
  static Push mean_of(const Felt& felt, std::size_t first, std::size_t end) {
    Push push;
    for (std::size_t i = first; i < end; ++i) {
      push.force += felt.force[i];
      push.moment += felt.moment[i];
      push.time += felt.time[i];
    }
    push.count = static_cast<int>(end - first);
    const double count = std::max(1, push.count);
    push.force /= count, push.moment /= count, push.time /= count;
    return push;
  }
  static Push push_between(const Felt& felt, double from, double until) {
    const auto first = std::ranges::lower_bound(felt.time, from);
    const auto end = std::ranges::upper_bound(felt.time, until);
    Push push = mean_of(felt, static_cast<std::size_t>(first - felt.time.begin()),
                        static_cast<std::size_t>(end - felt.time.begin()));
    push.from = from, push.until = until;
    return push;
  }

  // The longest stretch of a firm push is one place; its middle stands for it.
  std::optional<Push> firmest(const Felt& felt) const {
    const double most = felt.largest();
    std::size_t best = 0, length = 0, begin = 0;
    for (std::size_t i = 0; i <= felt.force.size(); ++i) {
      const bool firm = i < felt.force.size() && felt.force[i].norm() > how_.firm_share * most;
      if (firm) continue;
      if (i - begin > length) best = begin, length = i - begin;
      begin = i + 1;
    }
    if (length < 3) return std::nullopt;
    return push_between(felt, felt.time[best], felt.time[best + length - 1]);
  }

  std::vector<Pose> links_at(const Arm& arm, const Trial& trial, double time) const {
    const JointPath path = path_of(experiment_, trial);
    SceneMember member;
    member.state = &state_;
    member.arm = &arm;
    member.path = &path;
    std::vector<Pose> links;
    arm.model().link_poses(arm_at(member, time).q, links);
    return links;
  }

  SceneReadings touched(int t) {
    const SceneVariant variant{model_};
    const SceneSimulator::Request request{&variant, t};
    return simulator_.run({&request, 1}).front();
  }

  // Where one force would give the moment: nearest to what all samples of a firm push say.
  std::optional<Vec3> place_of(const Trial& trial, const Push& push, int link) const {
    if (trial.follows_commands) return std::nullopt;  // its links are not known beforehand
    const Arm arm(experiment_, state_);
    const std::vector<Pose> links = links_at(arm, trial, push.time);
    const Pose& sensor = links[static_cast<std::size_t>(link)];
    const Vec3 f = sensor.rotation * push.force, m = sensor.rotation * push.moment;
    return entry(arm, links, link, sensor.position + f.cross(m) / f.squaredNorm(), f.normalized());
  }

  void tell_place(int t, const Trial& trial, const Felt& felt, int link) {
    const std::optional<Push> push = firmest(felt);
    if (!push) return;
    const std::optional<Vec3> place = place_of(trial, *push, link);
    if (!place) return;
    const std::vector<Pose> links = links_at(Arm(experiment_, state_), trial, push->time);
    const double far = (*place - links[static_cast<std::size_t>(link)].position).norm();
    const double samples = std::sqrt(static_cast<double>(push->count));
    const double error = (moment_std_ + force_std_ * far) / samples / push->force.norm();
    tell_along(t, trial, push->time, *place, error);
  }

  // m, W: where the line of a force first meets what collides of the links beyond the sensor.
  std::optional<Vec3> entry(const Arm& arm, const std::vector<Pose>& links, int link,
                            const Vec3& on_line, const Vec3& along) const {
    const robot::CarriedLinks carried(arm.description(), link);
    const auto inside = [&](const Vec3& place) {
      for (const int l : carried.links()) {
        const auto at = static_cast<std::size_t>(l);
        const auto& shapes = arm.description().links[at].collisions;
        for (std::size_t c = 0; c < shapes.size(); ++c) {
          const Vec3 place_C = (links[at] * shapes[c].X_LC).inverse() * place;
          if (fields_[at][c]->distance(place_C) < how_.touching) return true;
        }
      }
      return false;
    };
    for (double s = -how_.line_reach; s < how_.line_reach; s += how_.line_step)
      if (inside(on_line + s * along)) return on_line + s * along;
    return std::nullopt;
  }

  // The place on the stems of the fitted model, as they are bent then.
  void tell_along(int t, const Trial& trial, double time, const Vec3& place, double error) {
    std::vector<Marker> places;
    const Experiment own = with_curves(experiment_, t, time, how_.places, places);
    SceneSimulator simulator(own, simulator_.numerics(), 1);
    const SceneVariant variant{model_};
    const SceneSimulator::Request request{&variant, 0};
    const SceneReadings bent = simulator.run({&request, 1}).front();
    if (!bent.healthy) return;
    double nearest = how_.near_stem;
    std::size_t best = places.size();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance =
          (bent.markers.row(0).segment<3>(3 * static_cast<long>(i)).transpose() - place).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      best = i;
    }
    if (best == places.size()) return;
    const plant::CurvePlace& at = places[best].place;
    const double length = length_of(places[best].plant, at.curve);
    SymptomNumber said;
    said.name = "hold_place";
    said.of = trial.name;
    said.value = at.at * length;
    said.error = std::hypot(error, 0.5 * length / how_.places, root_error(bent, best));
    said.unit = "m";
    said.shows = true;
    said.sentence = "In " + trial.name + " the tool pushes most at " + io::format_number(time, 3) +
                    " s, by the wrench at (" + io::format_number(place.x(), 3) + ", " +
                    io::format_number(place.y(), 3) + ", " + io::format_number(place.z(), 3) +
                    ") m: on " + at.curve + ", " + io::format_number(said.value, 3) +
                    " m from its foot.";
    found_.push_back(said);
  }

  // m, along the stem: where an unseen plant stands is fitted, too, and its foot with it.
  double root_error(const SceneReadings& bent, std::size_t best) const {
    const auto at = [&](std::size_t i) -> Vec3 {
      return bent.markers.row(0).segment<3>(3 * static_cast<long>(i)).transpose();
    };
    const std::size_t other = best > 0 ? best - 1 : best + 1;
    return (at(best) - at(other)).normalized().cwiseProduct(standing_error_).norm();
  }

  double length_of(int plant, const std::string& name) const {
    const plant::PlantFile& file = experiment_.plants[static_cast<std::size_t>(plant)].file;
    const plant::PlantCurve& curve = file.curves[static_cast<std::size_t>(file.curve_index(name))];
    double length = 0.0;
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      length += (curve.points[i] - curve.points[i - 1]).norm();
    return length;
  }

  /// How the wrench changes between a sample and the one before it.
  struct Jump {
    Vec3 force = Vec3::Zero();  // N, in the sensor's frame
    double before = 0.0;        // N, the force that there was
    Eigen::Vector<double, 6> scaled =
        Eigen::Vector<double, 6>::Zero();  // force, moment: of the noise
    double deviations() const { return scaled.norm(); }
  };
  // Of a fast sensor several samples are taken together on each side.
  Jump jump_at(const Felt& felt, std::size_t i) const {
    std::size_t first = i - 1, end = i + 1;
    while (first > 0 && felt.time[i - 1] - felt.time[first - 1] <= how_.break_window) --first;
    while (end < felt.time.size() && felt.time[end] - felt.time[i] <= how_.break_window) ++end;
    const Push before = mean_of(felt, first, i), after = mean_of(felt, i, end);
    const double samples = 1.0 / (1.0 / before.count + 1.0 / after.count);
    Jump jump;
    jump.force = after.force - before.force;
    jump.before = before.force.norm();
    jump.scaled << jump.force / force_std_, (after.moment - before.moment) / moment_std_;
    jump.scaled *= std::sqrt(samples);
    return jump;
  }

  // What comes off lets the wrench jump while something is held. The force itself need not fall: a
  // tool may touch the stem again at once.
  void tell_break(const Trial& trial, const Felt& felt) {
    std::vector<Jump> jumps(felt.time.size());
    for (std::size_t i = 1; i < jumps.size(); ++i) jumps[i] = jump_at(felt, i);
    const double gap = longest_gap * sample_of(felt);
    // Of what was felt until then: afterwards a tool may run into something else.
    double most_held = how_.least_push * force_std_ / how_.break_share, largest = 0.0;
    std::size_t first = 0;
    for (std::size_t i = 1; i < jumps.size(); ++i) {
      most_held = std::max(most_held, felt.force[i - 1].norm());
      // A touch that begins is a jump, too, and so is what changes over a gap of the record.
      if (jumps[i].deviations() < how_.break_deviations ||
          jumps[i].before < how_.break_share * most_held || felt.time[i] - felt.time[i - 1] > gap)
        continue;
      // A push may grow as fast, in the same direction from sample to sample.
      const double before =
          std::max(jumps[i - 1].deviations(), jumps[i - (i > 1 ? 2 : 1)].deviations());
      if ((jumps[i].scaled - jumps[i - 1].scaled).norm() < stands_out * before) continue;
      // What swings afterwards may jump farther than what has come off.
      double after = 0.0;
      for (std::size_t k = i; k < jumps.size() && felt.time[k] < felt.time[i] + how_.around_break;
           ++k)
        after = std::max(after, jumps[k].deviations());
      if (after <= largest) continue;
      largest = after;
      first = i;
    }
    if (first == 0) return;
    // Between the two samples, anywhere.
    const double sample = felt.time[first] - felt.time[first - 1];
    SymptomNumber said;
    said.name = "force_breaks_off";
    said.of = trial.name;
    said.value = felt.time[first] - 0.5 * sample;
    // A tool that slides off at its leisure lets the wrench jump later than the stalk parts.
    said.error = std::hypot(0.5 * sample + how_.break_window, 0.5 * how_.around_break);
    said.unit = "s";
    said.shows = true;
    said.speaks_for = scene_spoken_for(said.name);
    said.sentence = "In " + trial.name + " the force jumps by " +
                    io::format_number(jumps[first].force.norm(), 2) + " N at " +
                    io::format_number(said.value, 4) + " s: something slips or comes off.";
    found_.push_back(said);
  }

  SceneSimulator& simulator_;
  const RobotAloneSettings& how_;
  const Experiment& experiment_;
  Experiment empty_;
  SceneSimulator alone_;
  const std::vector<plant::Effect>& model_;
  double force_std_, moment_std_;
  Vec3 standing_error_;  // m, W
  SceneState state_;
  simulation::ShapeFields fields_;
  std::vector<SymptomNumber> found_;
};

}  // namespace

std::vector<SymptomNumber> robot_alone(SceneSimulator& simulator,
                                       const std::vector<plant::Effect>& model, double force_std,
                                       double moment_std, const Vec3& standing_error,
                                       const RobotAloneSettings& settings) {
  return RobotAlone(simulator, model, force_std, moment_std, standing_error, settings).run();
}

Vec3 push_shift(SceneSimulator& simulator, const std::vector<plant::Effect>& model,
                double force_std, const RobotAloneSettings& settings) {
  return RobotAlone(simulator, model, force_std, 0.0, Vec3::Zero(), settings).shift();
}

}  // namespace pedicel::discrepancy
