#include "app/headless.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/channels.h"
#include "app/meta.h"
#include "app/scene_view.h"
#include "app/version.h"
#include "core/timer.h"

namespace pedicel::app {

std::atomic<bool> stop_requested{false};

namespace {

constexpr int exit_unstable = 4, exit_unmet = 5, exit_no_pictures = 77, exit_stopped = 130;

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto place =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// One run: the simulation and everything that watches it.
class Run {
 public:
  Run(const world::Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        simulation_(scene, options.simulation),
        recorder_(options.out, scene.log_rate),
        view_(simulation_) {
    result_.folder = options.out;
    add_channels(recorder_, simulation_);
    recorder_.open();
    simulation_.world().set_recorder(&recorder_);
    for (const world::ScenePicture& picture : scene.pictures) {
      if (picture.when == world::ScenePicture::When::before_detachment) {
        wants_history_ = true;
        strain_history_ |= picture.strain;
      }
    }
    if (options.pictures && !options.out.empty()) {
      pictures_ = std::make_unique<PictureTaker>();
      if (options.video) open_video();
    }
    say_start();
  }

  RunResult go() {
    picture_now();
    const long steps = std::lround(scene_.duration / scene_.dt);
    for (long i = 0; i < steps && result_.exit_code == 0; ++i) {
      step();
      show_progress(i + 1, steps);
      if (stop_requested) {
        result_.exit_code = exit_stopped;
        result_.error = "stopped by the user";
      }
    }
    finish();
    return std::move(result_);
  }

 private:
  void step() {
    if (wants_history_ && pictures_ && pictures_->available())
      view_.fill(history_.next(), strain_history_);
    const Timer timer;
    const world::StepReport& report = simulation_.step();
    milliseconds_.push_back(1.0e3 * timer.seconds());
    result_.wall += timer.seconds();
    ++result_.steps;
    for (const auto& all = simulation_.plant_step().detached(); events_ < all.size(); ++events_) {
      recorder_.add_event(to_event(all[events_]));
      picture_event();
    }
    picture_now();
    if (report.errors & world::fatal_errors) {
      result_.exit_code = exit_unstable;
      result_.error =
          "unstable at " + io::format_number(report.time, 6) +
          " s: " + (report.culprit.empty() ? "" : report.culprit + ": ") +
          world::remedy(static_cast<world::StepError>(report.errors & world::fatal_errors));
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
    const auto path = options_.out / (name + (picture.camera.empty() ? "" : "_" + picture.camera) +
                                      (picture.strain ? "_strain" : "") + ".png");
    if (pictures_->save(path, *frame, view_.camera(picture.camera, *frame), video_.size[0],
                        video_.size[1]))
      result_.pictures.push_back(path);
  }

  void open_video() {
    video_ = scene_.video;
    if (options_.fps) video_.fps = *options_.fps;
    if (options_.size) video_.size = *options_.size;
    pictures_->open_video(options_.out / "run.mp4", video_);
  }

  void finish() {
    result_.simulated = simulation_.world().time();
    result_.ms_per_step_p50 = percentile(milliseconds_, 0.50);
    result_.ms_per_step_p95 = percentile(milliseconds_, 0.95);
    result_.largest_stretch = simulation_.measurements().largest_stretch();
    result_.state_hash = simulation_.state_hash();
    result_.residual = simulation_.worst_residual();
    result_.events = recorder_.events();
    add_limits();
    simulation_.measurements().set_wall_seconds(result_.wall);
    picture_end();
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
                                   [](const world::Verdict& v) { return !v.met; });
    if (result_.exit_code == 0 && unmet) result_.exit_code = exit_unmet;
    if (result_.exit_code == 0 && pictures_ && !pictures_->available())
      result_.exit_code = exit_no_pictures;
    if (!options_.out.empty()) write_meta(options_.out / "log.meta.json", simulation_, result_);
    say_end();
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
        result_.limits.push_back({fruit_name(model, f), model.fruits[f].thresholds.stretch,
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
    for (const std::string& note : simulation_.notes()) std::fprintf(stderr, "%s\n", note.c_str());
    if (options_.quiet) return;
    int elements = 0;
    for (int p = 0; p < simulation_.rods().size(); ++p)
      elements += simulation_.rods().model(p).size();
    const std::string renderer = !pictures_               ? "no pictures asked for"
                                 : pictures_->available() ? pictures_->renderer_name()
                                                          : pictures_->why();
    std::fprintf(stderr, "pedicel %s (%s), scene %s, seed %d, %d thread%s, %d rod elements, %s\n",
                 version().c_str(), git_hash().c_str(), scene_.name.c_str(), scene_.seed,
                 scene_.threads, scene_.threads == 1 ? "" : "s", elements, renderer.c_str());
  }

  void say_end() const {
    if (!result_.error.empty()) std::fprintf(stderr, "error: %s\n", result_.error.c_str());
    if (options_.quiet) return;
    std::fprintf(
        stderr,
        "%ld steps, %.3f s simulated, %.2f s wall, %.3f ms/step p50, %.3f p95, %.2f x real "
        "time, largest stretch %.4f, %zu break%s, state %016llx\n",
        result_.steps, result_.simulated, result_.wall, result_.ms_per_step_p50,
        result_.ms_per_step_p95, result_.real_time_factor(), result_.largest_stretch,
        result_.events.size(), result_.events.size() == 1 ? "" : "s",
        static_cast<unsigned long long>(result_.state_hash));
    for (const world::Verdict& verdict : result_.verdicts)
      std::fprintf(stderr, "%s\n", world::to_string(verdict).c_str());
  }

  void show_progress(long done, long all) {
    if (options_.quiet || !isatty(2)) return;
    if (done < all && progress_.seconds() < 0.2) return;
    progress_.restart();
    std::fprintf(stderr, "\r%5.1f %%  t = %.2f s%s",
                 100.0 * static_cast<double>(done) / static_cast<double>(all),
                 simulation_.world().time(), done == all ? "\n" : "");
  }

  const world::Scene& scene_;
  RunOptions options_;
  Simulation simulation_;
  world::Recorder recorder_;
  SceneView view_;
  std::unique_ptr<PictureTaker> pictures_;
  FrameHistory history_;
  Frame frame_;
  RunResult result_;
  Timer progress_;
  world::SceneVideo video_;
  std::vector<double> milliseconds_;
  std::size_t events_ = 0;
  double next_frame_ = 0.0, last_picture_time_ = -1.0;  // s
  bool wants_history_ = false, strain_history_ = false;
};

}  // namespace

RunResult run_scene(const world::Scene& scene, const RunOptions& options) {
  return Run(scene, options).go();
}

std::string to_json(const world::Scene& scene, const RunResult& result) {
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
  json["expectations"] = nlohmann::ordered_json::array();
  for (const world::Verdict& v : result.verdicts)
    json["expectations"].push_back(
        {{"what", world::to_string(v.expectation)}, {"met", v.met}, {"measured", v.measured}});
  json["out"] = result.folder.string();
  return json.dump(2);
}

}  // namespace pedicel::app
