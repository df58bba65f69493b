#include "app/report/headless.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/draw/scene_view.h"
#include "app/report/meta.h"
#include "app/report/run_state.h"
#include "app/report/sensor_recorder.h"
#include "app/report/version.h"
#include "engine/core/diagnostics.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/timer.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "engine/world/settings.h"
#include "plugins/simulation/channels.h"
#include "plugins/simulation/plants/organ_contacts.h"
#include "plugins/simulation/rough_spell.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

namespace {

bool is_quiet_run(const RunOptions& options) {
  return options.quiet || verbosity() < Verbosity::lines;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// "unstable at 1.6375 s: truss/stalk_5: it moves at 2e4 m/s: lower dt, ..."
std::string unstable(const world::WorldReport& report) {
  std::string text = "unstable at " + io::format_number(report.time, 6) + " s: ";
  for (const std::string& part : {report.culprit, report.cause})
    if (!part.empty()) text += part + ": ";
  return text + world::remedy(static_cast<world::WorldError>(report.errors & world::fatal_errors));
}

/// The folder of a run, taken once there is something to write: what was there goes now.
std::shared_ptr<io::OutputFolder> take_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return nullptr;
  stop_in_good_order();
  auto taken = std::make_shared<io::OutputFolder>(folder, files_of_a_run());
  if (!taken->replaced().empty()) say(Verbosity::warnings, "%s", taken->replaced().c_str());
  return taken;
}

/// Before the folder is taken: who refuses the simulation costs no earlier run.
std::vector<std::unique_ptr<RunWatcher>> watchers_of(const RunOptions& options,
                                                     simulation::Simulation& simulation,
                                                     PictureTaker* taker) {
  std::vector<std::unique_ptr<RunWatcher>> all;
  for (const MakeWatcher& make : options.watchers) all.push_back(make(simulation, taker));
  return all;
}

/// Null where the run takes no pictures.
std::unique_ptr<PictureTaker> taker_of(const RunOptions& options) {
  if (!options.pictures || options.out.empty()) return nullptr;
  return std::make_unique<PictureTaker>();
}

/// A simulation, at the state that the run goes on from.
class Started {
 public:
  Started(const world::Scene& scene, const RunOptions& options)
      : simulation(scene, options.simulation) {
    if (!options.save_state.empty()) model = model_hash(simulation);
    if (options.load_state.empty()) return;
    const RunState state = read_state(options.load_state);
    say(Verbosity::lines, "%s: the %ld steps up to it are done again",
        options.load_state.string().c_str(), state.steps);
    go_to_state(simulation, state, options.load_state);
  }

  simulation::Simulation simulation;
  std::uint64_t model = 0;  // model_hash(), where the state is to be saved
};

/// One run: the simulation and everything that watches it.
class Run {
 public:
  Run(const world::Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        started_(scene, options),
        simulation_(started_.simulation),
        pictures_(taker_of(options)),
        watchers_(watchers_of(options, simulation_, pictures_.get())),
        output_(take_folder(options.out)),
        recorder_(options.out, scene.log_rate),
        view_(simulation_) {
    result_.folder = options.out;
    result_.moving_scene = options.moving_scene;
    result_.output = output_;
    if (output_) output_->file("log.csv"), output_->file("events.csv");
    if (output_ && simulation_.assets()->coupling.plant_contact)
      organ_contacts_ = std::make_unique<simulation::OrganContactLog>(
          output_->file("organ_contacts.csv"), scene.log_rate);
    simulation::add_channels(recorder_, simulation_);
    begin_at(simulation_.world());
    recorder_.open();
    simulation_.world().set_recorder(&recorder_);
    for (const world::ScenePicture& picture : scene.pictures) {
      if (picture.when == world::ScenePicture::When::before_detachment) {
        wants_history_ = true;
        strain_history_ |= picture.strain;
      }
    }
    if (pictures_ && options.video) open_video();
    if (output_)
      sensors_ = std::make_unique<SensorRecorder>(simulation_, *output_, pictures_.get());
    say_start();
  }

  SceneResult go() {
    for (const auto& watcher : watchers_) watcher->begin();
    picture_now();
    if (sensors_) sensors_->record();
    const long before = simulation_.world().steps();
    const long steps = options_.steps
                           ? *options_.steps
                           : std::max(0L, std::lround(scene_.duration / scene_.dt) - before);
    for (long i = 0; i < steps && result_.exit_code == 0; ++i) {
      step();
      show_progress(i + 1, steps);
      if (stop_requested) {
        result_.exit_code = stop_exit_code();
        result_.error = "stopped by the user";
      }
    }
    finish();
    return std::move(result_);
  }

 private:
  /// What a loaded state has behind it is not recorded again.
  void begin_at(const world::SimWorld& world) {
    if (world.steps() == 0) return;
    events_ = simulation_.plant_step().detached().size();
    cuts_ = simulation_.cutting().events().size();
    next_frame_ = last_picture_time_ = world.time();
  }

  void step() {
    if (wants_history_ && pictures_ && pictures_->available())
      view_.fill(history_.next(), strain_history_);
    const Timer timer;
    const world::WorldReport& report = simulation_.step();
    milliseconds_.push_back(1.0e3 * timer.seconds());
    if (organ_contacts_) organ_contacts_->observe(simulation_.world().time(), simulation_.rods());
    result_.wall += timer.seconds();
    ++result_.steps;
    for (const auto& all = simulation_.plant_step().detached(); events_ < all.size(); ++events_) {
      recorder_.add_event(simulation::to_event(all[events_]));
      say(Verbosity::everything, "t = %.4f s: %s comes off (%s)", report.time,
          all[events_].fruit.c_str(), all[events_].event.cause.c_str());
      picture_event();
    }
    for (const auto& all = simulation_.cutting().events(); cuts_ < all.size(); ++cuts_) {
      recorder_.add_event(all[cuts_]);
      say(Verbosity::everything, "t = %.4f s: %s is cut", report.time, all[cuts_].organ.c_str());
      picture_event();
    }
    picture_now();
    for (const auto& watcher : watchers_) watcher->after_step();
    if (sensors_) sensors_->record();
    rough_.look(simulation_, report);
    if (report.errors & world::fatal_errors) {
      result_.exit_code = exit_unstable;
      result_.error = unstable(report);
    }
  }

  // The pictures and the video frame that are due now.
  void picture_now() {
    if (!pictures_ || !pictures_->available()) return;
    const double time = simulation_.world().time();
    const bool video_due = options_.video && time >= next_frame_ - 1.0e-9;
    std::vector<const world::ScenePicture*> due;
    for (const world::ScenePicture& picture : scene_.pictures)
      if (picture.when == world::ScenePicture::When::time && time >= picture.time - 1.0e-9 &&
          picture.time > last_picture_time_)
        due.push_back(&picture);
    last_picture_time_ = time;
    if (!video_due && due.empty()) return;
    frame_ = Frame{};
    view_.fill(frame_);
    if (video_due) {
      pictures_->add_to_video(frame_, view_.camera(video_.camera, frame_));
      next_frame_ += 1.0 / video_.fps;
    }
    for (const world::ScenePicture* picture : due)
      save(*picture, frame_, "t" + io::format_number(picture->time, 4) + "s");
  }

  void picture_event() {
    if (!pictures_ || !pictures_->available()) return;
    const std::string number = std::to_string(events_ + 1);
    for (const world::ScenePicture& picture : scene_.pictures) {
      if (picture.when == world::ScenePicture::When::before_detachment) {
        if (const Frame* before = history_.back(0))
          save(picture, *before, "before_break_" + number);
      } else if (picture.when == world::ScenePicture::When::after_detachment) {
        Frame after;
        view_.fill(after, picture.strain);
        save(picture, after, "after_break_" + number);
      }
    }
  }

  void save(const world::ScenePicture& picture, const Frame& given, const std::string& name) {
    Frame coloured;
    const Frame* frame = &given;
    if (picture.strain && picture.when == world::ScenePicture::When::time) {
      view_.fill(coloured, true);
      frame = &coloured;
    }
    const auto path = output_->file(name + (picture.camera.empty() ? "" : "_" + picture.camera) +
                                    (picture.strain ? "_strain" : "") + ".png");
    if (pictures_->save(path, *frame, view_.camera(picture.camera, *frame), video_.size[0],
                        video_.size[1]))
      result_.pictures.push_back(path), say(Verbosity::everything, "picture %s", path.c_str());
  }

  void open_video() {
    video_ = scene_.video;
    if (options_.fps) video_.fps = *options_.fps;
    if (options_.size) video_.size = *options_.size;
    output_->file("run_frames/");  // without ffmpeg
    pictures_->open_video(output_->file("run.mp4"), video_);
  }

  void finish() {
    result_.simulated = simulation_.world().time();
    result_.ms_per_step_p50 = percentile(milliseconds_, 0.50);
    result_.ms_per_step_p95 = percentile(milliseconds_, 0.95);
    result_.largest_stretch = simulation_.measurements().largest_stretch();
    result_.state_hash = simulation_.state_hash();
    result_.residual = simulation::worst_residual(simulation_.plants());
    result_.events = recorder_.events();
    result_.gentleness = simulation_.gentleness().total();
    result_.handled = handled_organs(simulation_);
    add_limits();
    simulation_.measurements().set_wall_seconds(result_.wall);
    picture_end();
    for (const auto& watcher : watchers_) keep_on([&] { watcher->end(); });
    if (pictures_ && options_.video) result_.video = pictures_->finish_video();
    for (const world::Expectation& expectation : scene_.expectations) {
      if (expectation.over_sweep()) continue;
      const double measured = simulation_.measurements().value(expectation, simulation_.world());
      if (std::isnan(measured) && is_of_what_is_left_out(expectation))
        std::fprintf(stderr, "not judged: %s (its plant is not there)\n",
                     world::to_string(expectation).c_str());
      else
        result_.verdicts.push_back(world::judge(expectation, measured));
    }
    const bool unmet = std::any_of(result_.verdicts.begin(), result_.verdicts.end(),
                                   [](const world::ExpectationResult& v) { return !v.met; });
    if (result_.exit_code == 0 && unmet) result_.exit_code = exit_unmet;
    if (options_.comparison_with) compare_with_measured();
    if (result_.exit_code == 0 && pictures_ && !pictures_->available())
      result_.exit_code = exit_no_pictures;
    write_files();
    say_end();
    if (not_written_) std::rethrow_exception(not_written_);
  }

  void write_files() {
    if (output_) keep_on([&] { write_meta(output_->file("log.meta.json"), simulation_, result_); });
    if (output_)
      keep_on([&] {
        io::write_file_atomically(output_->file("gentleness.csv"), to_csv(result_.handled));
      });
    keep_on([&] { copy_table("log.csv", options_.log); });
    keep_on([&] { copy_table("events.csv", options_.events); });
    if (!options_.save_state.empty() && result_.exit_code != exit_unstable)
      keep_on([&] { write_state(options_.save_state, state_of(simulation_, started_.model)); });
  }

  /// One file that cannot be written does not cost the others.
  void keep_on(const std::function<void()>& write) {
    try {
      write();
    } catch (const io::WriteError&) {
      if (!not_written_) not_written_ = std::current_exception();
    }
  }

  void copy_table(const char* name, const std::filesystem::path& wanted) const {
    if (!wanted.empty()) io::write_file_atomically(wanted, io::read_file(options_.out / name));
  }

  void compare_with_measured() {
    const ComparisonRequest& wanted = *options_.comparison_with;
    result_.comparison =
        compare(wanted.measured, wanted.tolerance, recorder_.columns(), recorder_.rows());
    if (result_.exit_code == 0 && !result_.comparison->within()) result_.exit_code = exit_unmet;
  }

  // Of an optional plant whose file is not there, or, if no plant is there, of all of them.
  bool is_of_what_is_left_out(const world::Expectation& expectation) const {
    return std::ranges::any_of(scene_.plants, [&](const world::ScenePlant& plant) {
      for (int p = 0; p < simulation_.rods().size(); ++p)
        if (simulation_.rods().model(p).name == plant.name) return false;
      return expectation.plant == plant.name || expectation.fruit.starts_with(plant.name + "/") ||
             (expectation.plant.empty() && expectation.fruit.empty() &&
              simulation_.rods().size() == 0);
    });
  }

  void add_limits() {
    for (int p = 0; p < simulation_.rods().size(); ++p) {
      const cosserat::RodModel& model = simulation_.rods().model(p);
      for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
        result_.limits.push_back({simulation::fruit_name(model, f),
                                  model.fruits[f].thresholds.stretch,
                                  model.fruits[f].thresholds.bend});
    }
  }

  void picture_end() {
    if (!pictures_ || !pictures_->available()) return;
    for (const world::ScenePicture& picture : scene_.pictures) {
      if (picture.when != world::ScenePicture::When::end) continue;
      Frame end;
      view_.fill(end, picture.strain);
      save(picture, end, "end");
    }
  }

  void say_start() const {
    for (const std::string& note : simulation_.notes())
      say(Verbosity::warnings, "%s", note.c_str());
    if (is_quiet()) return;
    int elements = 0;
    for (int p = 0; p < simulation_.rods().size(); ++p)
      elements += simulation_.rods().model(p).size();
    const std::string renderer = !pictures_               ? "no pictures asked for"
                                 : pictures_->available() ? pictures_->renderer_name()
                                                          : pictures_->why();
    std::fprintf(stderr, "pedicel %s (%s), scene %s, seed %d, %d thread%s, %d rod elements, %s\n",
                 version().c_str(), git_hash().c_str(), printable(scene_.name).c_str(), scene_.seed,
                 scene_.threads, scene_.threads == 1 ? "" : "s", elements, renderer.c_str());
  }

  void say_end() const {
    if (const std::string text = rough_.warning(); !text.empty())
      say(Verbosity::warnings, "%s", text.c_str());
    if (!result_.error.empty()) say(Verbosity::errors, "error: %s", result_.error.c_str());
    say_result(result_, options_);
    if (is_quiet() || !result_.comparison) return;
    for (const ColumnComparison& column : result_.comparison->columns)
      std::fprintf(stderr, "%s\n", to_string(column, result_.comparison->tolerance).c_str());
    for (const std::string& column : result_.comparison->left_out)
      std::fprintf(stderr, "%s: not in the log, not compared\n", column.c_str());
  }

  bool is_quiet() const { return is_quiet_run(options_); }

  void show_progress(long done, long all) {
    if (is_quiet() || !isatty(2)) return;
    if (done < all && progress_.seconds() < 0.2) return;
    progress_.restart();
    std::fprintf(stderr, "\r%5.1f %%  t = %.2f s%s",
                 100.0 * static_cast<double>(done) / static_cast<double>(all),
                 simulation_.world().time(), done == all ? "\n" : "");
  }

  const world::Scene& scene_;
  RunOptions options_;
  Started started_;
  simulation::Simulation& simulation_;      // of started_
  std::unique_ptr<PictureTaker> pictures_;  // null: none are taken
  std::vector<std::unique_ptr<RunWatcher>> watchers_;
  std::shared_ptr<io::OutputFolder> output_;
  world::Recorder recorder_;
  simulation::RoughSpell rough_;
  SceneView view_;
  std::unique_ptr<SensorRecorder> sensors_;
  FrameHistory history_;
  Frame frame_;
  SceneResult result_;
  std::exception_ptr not_written_;  // of the first file that could not be
  Timer progress_;
  world::SceneVideo video_;
  std::vector<double> milliseconds_;
  std::unique_ptr<simulation::OrganContactLog>
      organ_contacts_;  // null where plants do not touch each other
  std::size_t events_ = 0, cuts_ = 0;
  double next_frame_ = 0.0, last_picture_time_ = -1.0;  // s
  bool wants_history_ = false, strain_history_ = false;
};

}  // namespace

void say_result(const SceneResult& result, const RunOptions& options) {
  if (is_quiet_run(options)) return;
  std::fprintf(stderr,
               "%ld steps, %.3f s simulated, %.2f s wall, %.3f ms/step p50, %.3f p95, %.2f x real "
               "time, largest stretch %.4f, %zu break%s, state %016llx\n",
               result.steps, result.simulated, result.wall, result.ms_per_step_p50,
               result.ms_per_step_p95, result.real_time_factor(), result.largest_stretch,
               result.events.size(), result.events.size() == 1 ? "" : "s",
               static_cast<unsigned long long>(result.state_hash));
  for (const world::ExpectationResult& verdict : result.verdicts)
    std::fprintf(stderr, "%s\n", world::to_string(verdict).c_str());
}

const std::vector<std::string>& files_of_a_run() {
  static const std::vector<std::string> names = {
      "log.csv", "events.csv",  "gentleness.csv", "organ_contacts.csv", "log.meta.json",
      "run.mp4", "report.html", "sweep.csv",      "solvers.csv",        "polar.svg"};
  return names;
}

SceneResult run_scene(const world::Scene& scene, const RunOptions& options) {
  if (scene.vary.empty()) return Run(scene, options).go();
  const world::Scene drawn = world::drawn_scene(scene);
  return Run(drawn, options).go();
}

namespace {

nlohmann::ordered_json comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json json = {{"measured", comparison.measured.string()},
                                 {"tolerance", comparison.tolerance},
                                 {"within", comparison.within()},
                                 {"columns", nlohmann::ordered_json::array()}};
  for (const ColumnComparison& one : comparison.columns)
    json["columns"].push_back({{"column", one.column},
                               {"samples", one.samples},
                               {"largest", one.largest},
                               {"rms", one.rms},
                               {"time_s", one.time},
                               {"within", one.within}});
  json["left_out"] = comparison.left_out;
  return json;
}

}  // namespace

std::string to_json(const world::Scene& scene, const SceneResult& result) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(result.state_hash));
  nlohmann::ordered_json json = {{"scene", scene.name},
                                 {"exit_code", result.exit_code},
                                 {"error", result.error},
                                 {"steps", result.steps},
                                 {"simulated_s", result.simulated},
                                 {"wall_s", result.wall},
                                 {"real_time_factor", result.real_time_factor()},
                                 {"ms_per_step_p50", result.ms_per_step_p50},
                                 {"ms_per_step_p95", result.ms_per_step_p95},
                                 {"stretch_max", result.largest_stretch},
                                 {"state_hash", hash}};
  json["events"] = nlohmann::ordered_json::array();
  for (const world::Event& e : result.events)
    json["events"].push_back({{"time_s", e.time},
                              {"organ", e.organ},
                              {"cause", e.cause},
                              {"stretch", e.stretch},
                              {"bend_rad", e.bend},
                              {"force_N", e.force}});
  json["gentleness"] = to_json(result.gentleness, result.handled);
  json["expectations"] = nlohmann::ordered_json::array();
  for (const world::ExpectationResult& v : result.verdicts)
    json["expectations"].push_back(
        {{"what", world::to_string(v.expectation)}, {"met", v.met}, {"measured", v.measured}});
  if (result.comparison) json["comparison"] = comparison_json(*result.comparison);
  json["out"] = result.folder.string();
  return json.dump(2);
}

}  // namespace pedicel::app
