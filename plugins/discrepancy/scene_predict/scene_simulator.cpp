#include "plugins/discrepancy/scene_predict/scene_simulator.h"

#include <cstdio>
#include <deque>
#include <map>
#include <mutex>
#include <random>

#include "engine/core/thread_pool.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/arm_run.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

namespace {

constexpr double far_below = 100.0;    // m: there no arm reaches, and a plant moves as anywhere
constexpr std::size_t widest = 8;      // plants side by side: the solver's lanes
constexpr std::size_t most_kept = 64;  // motions, some 2 MB each

using Makers = std::vector<std::unique_ptr<PlantMaker>>;

Makers makers_of(const Experiment& experiment, const Trial& trial, const SceneNumerics& numerics) {
  Makers makers;
  for (std::size_t p = 0; p < experiment.plants.size(); ++p) {
    const ExperimentPlant& plant = experiment.plants[p];
    const auto moved = trial.poses.find(static_cast<int>(p));
    plant::BuildOptions options;
    options.pose = moved == trial.poses.end() ? plant.pose : moved->second;
    options.gravity = experiment.scene.gravity;
    options.leaf_folders.push_back(plant.path.parent_path());
    const double distance = std::min(numerics.distance, plant.file.distance);
    if (!numerics.as_run) options.junction = numerics.junction * distance;
    makers.push_back(std::make_unique<PlantMaker>(plant.file, distance, options));
  }
  return makers;
}

// A log of a run is predicted as it was run.
SceneNumerics numerics_of(const Experiment& experiment, SceneNumerics numerics) {
  if (!experiment.is_run) return numerics;
  numerics.as_run = true;
  numerics.dt = numerics.run_steps * experiment.scene.dt;
  numerics.distance = std::numeric_limits<double>::infinity();  // the plant file's
  return numerics;
}

simulation::ShapeFields fields_for(const Experiment& experiment, const SceneNumerics& numerics) {
  std::vector<std::string> notes;  // about meshes that are large: nothing for an experiment
  return numerics.as_run ? simulation::fields_of(experiment.robot, notes)
                         : simulation::exact_fields_of(experiment.robot);
}

// What the motion depends on: requests with the same share one simulation. `moves`: what acts on
// the arm moves it, too, because it follows commands.
std::string key_of(int trial, int draw, bool moves, double until,
                   const std::vector<plant::Effect>& effects) {
  std::string key =
      std::to_string(trial) + "/" + std::to_string(draw) + "@" + std::to_string(until);
  for (const plant::Effect& effect : effects)
    if (moves || !is_only_seen(effect)) key += plant::effect_text(effect);
  return key;
}

std::string key_of(const std::vector<SceneForce>& forces) {
  std::string key;
  for (const SceneForce& force : forces) {
    key += "|" + std::to_string(force.plant) + force.place.curve;
    for (const double number : {force.place.at, force.force.x(), force.force.y(), force.force.z(),
                                force.from, force.until, force.rise}) {
      char text[32];
      std::snprintf(text, sizeof text, ",%.17g", number);
      key += text;
    }
  }
  return key;
}

/// What one request runs.
struct Prepared {
  SceneState state;
  std::unique_ptr<Arm> arm;
  SceneMember member;
  std::vector<plant::Effect> sensors;
  std::string key;
  const JointPath* path = nullptr;  // of readings
  JointPath run;                    // of an arm that follows commands
};

}  // namespace

JointPath path_of(const Experiment& experiment, const Trial& trial, int draw) {
  const robot::KinematicModel model(experiment.robot);
  Eigen::VectorXd start = model.neutral();
  for (const auto& [joint, value] : experiment.scene.robot->joints)
    if (const int dof = model.joint_index(joint); dof >= 0) start[dof] = value;
  if (trial.follows_commands) return {};
  const double deviation = experiment.noise.joint_std.value_or(0.0);
  if (experiment.is_run && draw == 0 && trial.joints.value.allFinite()) {
    // A run's log says where its joints were, without noise, also where they stop at once.
    std::vector<Eigen::VectorXd> rows;
    rows.reserve(static_cast<std::size_t>(trial.joints.size()));
    for (int r = 0; r < trial.joints.size(); ++r) rows.emplace_back(trial.joints.value.row(r));
    return path_through(trial.joints.time, rows).spread(trial.joint_columns, start);
  }
  if (draw == 0) return smooth_readings(trial.joints, deviation).spread(trial.joint_columns, start);
  Samples other = trial.joints;
  const Eigen::VectorXd scatter = smooth_readings(trial.joints, deviation).scatter();
  std::mt19937_64 random(static_cast<std::uint64_t>(draw));
  std::normal_distribution<double> normal;
  for (long c = 0; c < other.value.cols(); ++c)
    for (long r = 0; r < other.value.rows(); ++r)
      other.value(r, c) += (deviation > 0.0 ? deviation : scatter[c]) * normal(random);
  // As if their noise were no larger, or they would be smoothed by more than the readings are.
  return smooth_readings(other, deviation).spread(trial.joint_columns, start);
}

struct SceneSimulator::Impl {
  Impl(const Experiment& given, const SceneNumerics& how, int threads,
       const std::atomic<bool>* caller)
      : experiment(given),
        numerics(numerics_of(given, how)),
        fields(fields_for(given, numerics)),
        nominal(nominal_state(given)),
        pool(threads),
        stop(caller ? *caller : never) {
    for (const Trial& trial : given.trials) {
      paths.push_back(path_of(given, trial));
      makers.push_back(makers_of(given, trial, numerics));
    }
  }

  Prepared prepare(const Request& request) const {
    const Trial& trial = experiment.trials[static_cast<std::size_t>(request.trial)];
    Prepared out;
    out.state = nominal;
    std::vector<plant::Effect> all;
    for (const auto* list : {&experiment.scene_effects, &experiment.effects, &trial.effects,
                             &request.variant->effects})
      for (const plant::Effect& effect : *list) {
        const auto only = effect.words.find("trial");
        if (only != effect.words.end() && only->second != trial.name) continue;
        all.push_back(effect);
        if (apply_scene_effect(effect, experiment, out.state)) continue;
        (is_of_experiment(effect) ? out.sensors : out.member.effects).push_back(effect);
      }
    if (request.variant->plants_away)
      for (SceneState::Plant& plant : out.state.plants) plant.offset += Vec3(0.0, 0.0, -far_below);
    out.arm = std::make_unique<Arm>(experiment, out.state);
    out.key = key_of(request.trial, request.variant->draw, trial.follows_commands,
                     std::min(request.until, trial.duration()), all) +
              key_of(request.variant->forces) + (request.variant->plants_away ? "|away" : "");
    out.member.forces = request.variant->forces;
    if (numerics.as_run) out.member.run_step = experiment.scene.dt;
    out.path = &path(request.trial, request.variant->draw);
    return out;
  }

  const JointPath& path(int trial, int draw) const {
    if (draw == 0) return paths[static_cast<std::size_t>(trial)];
    const auto known = drawn.find({trial, draw});
    if (known != drawn.end()) return known->second;
    return drawn
        .emplace(std::pair(trial, draw),
                 path_of(experiment, experiment.trials[static_cast<std::size_t>(trial)], draw))
        .first->second;
  }

  // Arms that follow commands go their way first: they do not feel the plants.
  void follow_commands(std::span<const Request> requests, std::vector<Prepared>& prepared) {
    pool.for_each(static_cast<int>(requests.size()), [&](int r) {
      const auto at = static_cast<std::size_t>(r);
      const Trial& trial = experiment.trials[static_cast<std::size_t>(requests[at].trial)];
      if (!trial.follows_commands || stop) return;
      Prepared& one = prepared[at];
      one.run = run_arm(experiment, trial, one.state, *one.arm, numerics.dt,
                        std::min(requests[at].until, trial.duration()));
      one.member.path = &one.run;
      one.member.is_run = true;
    });
  }

  std::vector<SceneReadings> run(std::span<const Request> requests) {
    std::vector<Prepared> prepared;
    for (const Request& request : requests) prepared.push_back(prepare(request));
    for (Prepared& one : prepared) {
      one.member.state = &one.state;
      one.member.arm = one.arm.get();
      one.member.path = one.path;
    }
    follow_commands(requests, prepared);
    // Requests of one motion, and motions of one trial that end together and run side by side.
    std::map<std::string, std::vector<std::size_t>> same;
    for (std::size_t r = 0; r < requests.size(); ++r) same[prepared[r].key].push_back(r);
    std::vector<SceneReadings> out(requests.size());
    std::map<std::pair<int, double>, std::vector<std::vector<std::size_t>>> alike;
    std::vector<std::pair<std::shared_ptr<const SceneMotion>, std::vector<std::size_t>>> known;
    for (auto& [key, list] : same) {
      const Request& first = requests[list.front()];
      if (auto motion = find(key))
        known.emplace_back(std::move(motion), list);
      else
        alike[{first.trial, first.until}].push_back(list);
    }
    struct Group {
      int trial = 0;
      double until = 0.0;
      std::vector<std::vector<std::size_t>> jobs;
    };
    std::vector<Group> groups;
    for (const auto& [what, jobs] : alike) {
      const std::size_t parts = (jobs.size() + widest - 1) / widest;
      for (std::size_t part = 0; part < parts; ++part)
        groups.push_back({what.first,
                          what.second,
                          {jobs.begin() + static_cast<long>(jobs.size() * part / parts),
                           jobs.begin() + static_cast<long>(jobs.size() * (part + 1) / parts)}});
    }
    const auto observe = [&](const SceneMotion& motion, const std::vector<std::size_t>& list) {
      for (const std::size_t r : list)
        out[r] = observe_scene(experiment,
                               experiment.trials[static_cast<std::size_t>(requests[r].trial)],
                               motion, prepared[r].member, prepared[r].sensors);
    };
    pool.for_each(static_cast<int>(groups.size()), [&](int g) {
      const Group& group = groups[static_cast<std::size_t>(g)];
      const auto t = static_cast<std::size_t>(group.trial);
      const Trial& trial = experiment.trials[t];
      std::vector<SceneMember> members;
      for (const auto& job : group.jobs) members.push_back(prepared[job.front()].member);
      std::vector<SceneMotion> motions =
          run_scene_trial(experiment, trial, makers[t], fields, numerics,
                          std::min(group.until, trial.duration()), members, stop);
      for (std::size_t i = 0; i < group.jobs.size(); ++i) {
        const auto motion = std::make_shared<const SceneMotion>(std::move(motions[i]));
        observe(*motion, group.jobs[i]);
        keep(prepared[group.jobs[i].front()].key, motion);
      }
      simulations += static_cast<long>(group.jobs.size());
    });
    pool.for_each(static_cast<int>(known.size()), [&](int k) {
      const auto& [motion, list] = known[static_cast<std::size_t>(k)];
      observe(*motion, list);
    });
    return out;
  }

  // The last motions, for requests that differ only in what instruments say.
  std::shared_ptr<const SceneMotion> find(const std::string& key) {
    const std::lock_guard lock(mutex);
    for (const auto& [own, motion] : kept)
      if (own == key) return motion;
    return nullptr;
  }
  void keep(const std::string& key, const std::shared_ptr<const SceneMotion>& motion) {
    if (!motion->healthy) return;
    const std::lock_guard lock(mutex);
    kept.emplace_back(key, motion);
    if (kept.size() > most_kept) kept.pop_front();
  }

  const Experiment& experiment;
  SceneNumerics numerics;
  simulation::ShapeFields fields;
  SceneState nominal;
  std::vector<JointPath> paths;                            // by trial
  mutable std::map<std::pair<int, int>, JointPath> drawn;  // by trial and draw
  std::vector<Makers> makers;                              // by trial
  ThreadPool pool;
  std::atomic<bool> never{false};
  const std::atomic<bool>& stop;
  std::atomic<long> simulations{0};
  std::mutex mutex;
  std::deque<std::pair<std::string, std::shared_ptr<const SceneMotion>>> kept;
};

SceneSimulator::SceneSimulator(const Experiment& experiment, const SceneNumerics& numerics,
                               int threads, const std::atomic<bool>* stop)
    : impl_(std::make_unique<Impl>(experiment, numerics, threads, stop)) {}
SceneSimulator::~SceneSimulator() = default;

std::vector<SceneReadings> SceneSimulator::run(std::span<const Request> requests) {
  return impl_->run(requests);
}
const Experiment& SceneSimulator::experiment() const {
  return impl_->experiment;
}
const SceneNumerics& SceneSimulator::numerics() const {
  return impl_->numerics;
}
long SceneSimulator::simulations() const {
  return impl_->simulations;
}

}  // namespace pedicel::discrepancy
