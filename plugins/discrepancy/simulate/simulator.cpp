#include "plugins/discrepancy/simulate/simulator.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "engine/core/check.h"
#include "engine/core/thread_pool.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/data/path_smoothing.h"
#include "plugins/discrepancy/simulate/data_set.h"
#include "plugins/discrepancy/simulate/motion_cache.h"
#include "plugins/discrepancy/simulate/trial_run.h"

namespace pedicel::discrepancy {

namespace {

constexpr int widest = 8;  // plants side by side: the solver's lanes
constexpr std::size_t cache_bytes = 24u << 20;

using Effects = std::vector<plant::Effect>;

/// Everything that acts in a request: what the files state, then the variant's.
// A variant's effect that names a trial happened in that one alone.
Effects effects_of(const Experiment& experiment, const Simulator::Request& request) {
  const Trial& trial = experiment.trials[request.trial];
  Effects all = experiment.effects;
  for (const Effects* more : {&trial.effects, &request.variant->effects})
    for (const plant::Effect& effect : *more) {
      const auto only = effect.words.find("trial");
      if (only == effect.words.end() || only->second == trial.name) all.push_back(effect);
    }
  return all;
}

/// A simulation that some requests share.
struct Job {
  bool possible = true;
  std::string key;
  int trial = 0;
  RunMember member;
  StepPlan plan;
  bool lasting = true;  // its motion may serve later calls
  std::vector<int> requests;
};

/// A request, and where its motion comes from.
struct Wanted {
  Effects effects;
  std::string key;
  double until = 0.0;  // s, of the motion
  std::shared_ptr<const Motion> known;
};

std::string key_of(const Simulator::Request& request, const Effects& effects, bool begins_moving) {
  std::string key = std::to_string(request.trial);
  // How a plant begins in motion is read from its markers, through whatever they are seen by.
  for (const plant::Effect& effect : effects)
    if (begins_moving || !is_of_sensor(effect)) key += plant::effect_text(effect);
  if (begins_moving)
    for (const double shift : request.variant->start_shift) key += " " + io::exact_number(shift);
  if (!request.variant->forces.empty())
    key += "@" + std::to_string(reinterpret_cast<std::uintptr_t>(request.variant));
  return key;
}

// Of its instruments: what is stated, or an estimate from the data.
NoiseLevels noise_levels(const Experiment& experiment) {
  const AllSeries all = measured_series(experiment);
  const StatedNoise& stated = experiment.noise;
  const auto level = [](const std::vector<Series>& series, const std::optional<double>& said) {
    return choose_noise(series, said.value_or(0.0), NoiseRule{}).std;
  };
  return {level(all.position, stated.position_std), level(all.force, stated.force_std),
          level(all.moment, stated.moment_std)};
}

/// Jobs of one trial with the same steps, as many side by side as there are lanes.
struct Group {
  std::vector<int> jobs;
  double cost = 0.0;
};

}  // namespace

struct Simulator::Impl {
  Impl(const Experiment& given, const Numerics& how, int threads, const std::atomic<bool>* caller)
      : as_given(given),
        smooth(with_smooth_paths(given)),
        experiment(smooth ? *smooth : given),
        numerics(how),
        maker(given, how.distance, how.junction * how.distance),
        starts(plan_starts(experiment, how.junction)),
        quiet(how.quiet > 1 ? all_quiet_spans(experiment)
                            : std::vector<std::vector<TimeSpan>>(experiment.trials.size())),
        pool(threads),
        stop(caller ? *caller : never) {
    check_places();
  }

  // Here, because nothing may throw within threads.
  void check_places() const {
    for (const Marker& marker : experiment.markers) maker.locate(marker.place);
    for (const Trial& trial : experiment.trials) {
      for (const plant::PlantMass& mass : trial.masses) maker.locate(mass.place);
      for (const Hold& hold : trial.holds) maker.locate(hold.place);
      for (const TimedLoad& load : trial.loads) maker.locate(load.place);
    }
  }

  Wanted want(const Request& request) const {
    const Trial& trial = experiment.trials[request.trial];
    Wanted wanted;
    wanted.effects = effects_of(experiment, request);
    wanted.key = key_of(request, wanted.effects, trial.window.has_value());
    // Markers that run ahead of the drive look beyond the trial's end.
    const double ahead = std::max(0.0, -latency_of(wanted.effects));
    wanted.until = std::min(request.until, trial.duration()) + ahead;
    return wanted;
  }

  Job make_job(const Request& request, const Wanted& wanted) const {
    Job job;
    job.key = wanted.key;
    job.trial = request.trial;
    job.member.effects = wanted.effects;
    job.member.forces = request.variant->forces;
    job.member.start = &starts[request.trial];
    job.member.start_shift = request.variant->start_shift;
    job.lasting = request.variant->forces.empty();
    return job;
  }

  static std::vector<std::vector<TimeSpan>> all_quiet_spans(const Experiment& experiment) {
    const NoiseLevels noise = noise_levels(experiment);
    std::vector<std::vector<TimeSpan>> all;
    for (const Trial& trial : experiment.trials) all.push_back(quiet_spans(trial, noise));
    return all;
  }

  StepPlan plan(int trial, const Effects& effects, double until, int most) const {
    const Trial& one = experiment.trials[trial];
    if (one.is_static) return make_step_plan({}, 1.0, one.duration(), one.duration());
    return make_step_plan(jumps_of(one, effects), numerics.dt, one.duration(), until, quiet[trial],
                          most);
  }

  // Up to the end of the window, of a trial that begins in motion. What comes off ends it before.
  StepPlan rehearsal(int trial, const Effects& effects) const {
    if (starts[trial].modes == 0) return {};
    double end = starts[trial].window;
    for (const MeasuredEvent& event : experiment.trials[trial].events)
      if (event.is_detachment()) end = std::min(end, event.time);
    return plan(trial, effects, end, 1);
  }

  /// Requests of the same motion to one job, as long as the longest of them needs.
  std::vector<Job> make_jobs(std::span<const Request> requests, std::vector<Wanted>& wanted) {
    std::vector<Job> jobs;
    std::map<std::string, int> known;
    std::vector<double> until;
    for (int r = 0; r < static_cast<int>(requests.size()); ++r) {
      Wanted& one = wanted[r];
      if (requests[r].variant->forces.empty()) one.known = cache.find(one.key, one.until);
      if (one.known) continue;
      const auto [place, fresh] = known.emplace(one.key, static_cast<int>(jobs.size()));
      if (fresh) {
        jobs.push_back(make_job(requests[r], one));
        until.push_back(one.until);
      }
      jobs[place->second].requests.push_back(r);
      until[place->second] = std::max(until[place->second], one.until);
    }
    for (std::size_t j = 0; j < jobs.size(); ++j)
      jobs[j].plan = plan(jobs[j].trial, jobs[j].member.effects, until[j],
                          jobs[j].member.forces.empty() ? numerics.quiet : 1);
    return jobs;
  }

  /// The longest first, so that no thread is left with one at the end.
  std::vector<Group> make_groups(const std::vector<Job>& jobs) const {
    std::vector<std::vector<int>> alike;
    for (int j = 0; j < static_cast<int>(jobs.size()); ++j) {
      if (!jobs[j].possible) continue;
      const auto same = std::find_if(alike.begin(), alike.end(), [&](const auto& list) {
        const Job& other = jobs[list.front()];
        return other.trial == jobs[j].trial && other.plan == jobs[j].plan;
      });
      if (same == alike.end())
        alike.push_back({j});
      else
        same->push_back(j);
    }
    std::vector<Group> groups;
    for (const std::vector<int>& list : alike) {
      const int size = static_cast<int>(list.size());
      const int parts = (size + widest - 1) / widest;
      for (int part = 0; part < parts; ++part) {
        Group group;
        group.jobs.assign(list.begin() + size * part / parts,
                          list.begin() + size * (part + 1) / parts);
        group.cost = jobs[list.front()].plan.steps();
        groups.push_back(std::move(group));
      }
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return a.cost > b.cost; });
    return groups;
  }

  std::vector<std::shared_ptr<const Motion>> simulate(const std::vector<Job>& jobs,
                                                      const Group& group) {
    std::vector<RunMember> members;
    for (const int j : group.jobs) members.push_back(jobs[j].member);
    const Job& first = jobs[group.jobs.front()];
    std::vector<RunResult> results =
        run_trial(maker, experiment, experiment.trials[first.trial], first.plan, members, stop,
                  rehearsal(first.trial, first.member.effects));
    simulations += static_cast<long>(members.size());
    std::vector<std::shared_ptr<const Motion>> motions;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const Job& job = jobs[group.jobs[i]];
      motions.push_back(std::make_shared<Motion>(std::move(results[i].motion)));
      if (job.lasting && motions.back()->healthy) cache.add(job.key, motions.back());
    }
    return motions;
  }

  Prediction predict(const Request& request, const Wanted& wanted, const Motion& motion) const {
    const Trial& trial = experiment.trials[request.trial];
    Observed seen = observe(motion, experiment.markers, wanted.effects, trial.markers.time,
                            trial.force.time, trial.wrench.time);
    Prediction out{std::move(seen.markers), std::move(seen.force), std::move(seen.marker_velocity),
                   motion.healthy,          motion.events,         std::move(seen.wrench)};
    const double last = request.until + 1.0e-9;
    const auto cut = [&](const std::vector<double>& time, Eigen::MatrixXd& rows) {
      const auto kept = std::upper_bound(time.begin(), time.end(), last) - time.begin();
      rows.bottomRows(rows.rows() - kept).setConstant(std::numeric_limits<double>::quiet_NaN());
    };
    cut(trial.markers.time, out.markers);
    cut(trial.markers.time, out.marker_velocity);
    cut(trial.force.time, out.force);
    cut(trial.wrench.time, out.wrench);
    return out;
  }

  std::vector<Prediction> run(std::span<const Request> requests) {
    if (stop) return nothing(requests);
    std::vector<Wanted> wanted;
    for (const Request& request : requests) wanted.push_back(want(request));
    std::vector<Job> jobs = make_jobs(requests, wanted);
    for (Job& job : jobs) {
      if (stop) return nothing(requests);
      job.possible = check(job);
    }
    const std::vector<Group> groups = make_groups(jobs);
    std::vector<Prediction> out(requests.size());
    for (const Job& job : jobs)
      if (!job.possible)
        for (const int r : job.requests) out[r] = nothing(requests[r]);
    pool.for_each(static_cast<int>(groups.size()), [&](int g) {
      if (stop) {
        for (const int j : groups[g].jobs)
          for (const int r : jobs[j].requests) out[r] = nothing(requests[r]);
        return;
      }
      const auto motions = simulate(jobs, groups[g]);
      for (std::size_t i = 0; i < motions.size(); ++i)
        for (const int r : jobs[groups[g].jobs[i]].requests)
          out[r] = predict(requests[r], wanted[r], *motions[i]);
    });
    pool.for_each(static_cast<int>(requests.size()), [&](int r) {
      if (wanted[r].known) out[r] = predict(requests[r], wanted[r], *wanted[r].known);
    });
    return out;
  }

  /// The whole of one trial, with what the member wants beside the variant.
  RunResult run_alone(const Variant& variant, int trial, RunMember member) {
    const Trial& one = experiment.trials[trial];
    member.effects = effects_of(experiment, {&variant, trial});
    member.forces = variant.forces;
    member.start = &starts[trial];
    const StepPlan steps = plan(trial, member.effects, one.duration(), 1);
    ++simulations;
    return std::move(run_trial(maker, experiment, one, steps, {&member, 1}, stop,
                               rehearsal(trial, member.effects))
                         .front());
  }

  // Before any thread begins, where nothing may throw. False where effects that a plant can have
  // one by one leave nothing of it together.
  bool check(const Job& job) const {
    const Trial& trial = experiment.trials[job.trial];
    for (const PointForce& force : job.member.forces) maker.locate(force.place);
    try {
      maker.make(trial, job.member.effects);
    } catch (const UsageError&) {
      for (const plant::Effect& effect : job.member.effects)
        maker.make(trial, std::span(&effect, 1));
      return false;
    }
    return true;
  }

  std::vector<Prediction> nothing(std::span<const Request> requests) const {
    std::vector<Prediction> none;
    for (const Request& request : requests) none.push_back(nothing(request));
    return none;
  }

  Prediction nothing(const Request& request) const {
    const Trial& trial = experiment.trials[request.trial];
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const Eigen::MatrixXd markers =
        Eigen::MatrixXd::Constant(trial.markers.value.rows(), trial.markers.value.cols(), nan);
    const Eigen::MatrixXd force =
        Eigen::MatrixXd::Constant(trial.force.value.rows(), trial.force.value.cols(), nan);
    const Eigen::MatrixXd wrench = Eigen::MatrixXd::Constant(trial.wrench.size(), 6, nan);
    return {markers, force, markers, false, {}, wrench};
  }

  const Experiment& as_given;
  const std::optional<Experiment> smooth;
  const Experiment& experiment;  // what is simulated
  const Numerics numerics;
  const PlantMaker maker;
  const std::vector<StartPlan> starts;             // by trial
  const std::vector<std::vector<TimeSpan>> quiet;  // by trial
  ThreadPool pool;
  MotionCache cache{cache_bytes};
  const std::atomic<bool> never{false};
  const std::atomic<bool>& stop;
  std::atomic<long> simulations{0};
};

Simulator::Simulator(const Experiment& experiment, const Numerics& numerics, int threads,
                     const std::atomic<bool>* stop)
    : impl_(std::make_unique<Impl>(experiment, numerics, threads, stop)) {}

Simulator::~Simulator() = default;

std::vector<Prediction> Simulator::run(std::span<const Request> requests) {
  return impl_->run(requests);
}

Eigen::MatrixXd Simulator::tracking_forces(const Variant& variant, int trial, double stiffness) {
  RunMember member;
  member.tracking_stiffness = stiffness;
  return tracking_at_samples(impl_->run_alone(variant, trial, member),
                             impl_->experiment.trials[trial].markers);
}

std::vector<StalkLoads> Simulator::stalk_loads(const Variant& variant, int trial) {
  RunMember member;
  member.records_stalks = true;
  RunResult result = impl_->run_alone(variant, trial, member);
  for (StalkLoads& stalk : result.stalks)
    for (const MeasuredEvent& event :
         impl_->experiment.trials[trial].events)  // at the trial's very end, too
      if (event.is_detachment() && event.what == stalk.fruit) stalk.came_off = event.time;
  return std::move(result.stalks);
}

int Simulator::start_amplitudes(int trial) const {
  return impl_->starts[trial].amplitudes();
}

const Experiment& Simulator::experiment() const {
  return impl_->as_given;
}
const Numerics& Simulator::numerics() const {
  return impl_->numerics;
}
long Simulator::simulations() const {
  return impl_->simulations;
}
const std::atomic<bool>* Simulator::stop() const {
  return &impl_->stop;
}

}  // namespace pedicel::discrepancy
