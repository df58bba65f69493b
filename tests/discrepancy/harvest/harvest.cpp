#include "tests/discrepancy/harvest/harvest.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/yaml.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "plugins/discrepancy/scene_procedure/extended_scene.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/discrepancy/scene_cases/harvest_case.h"

namespace pedicel::harvest {

namespace {

using discrepancy::Experiment;
using discrepancy::SceneDataSet;
using discrepancy::SceneReadings;
using nlohmann::json;

constexpr double least_to_gain = 1.05;  // noise units: below, a share of it is one of chances

Experiment read(const std::filesystem::path& folder, const std::filesystem::path& scene) {
  Diagnostics diagnostics;
  auto experiment = discrepancy::read_experiment(folder, diagnostics, {.scene = scene});
  if (!experiment) throw InvalidFile(diagnostics);
  return std::move(*experiment);
}

/// The experiment with further points of its plant that nothing measured, for the plant's shape.
Experiment with_points(Experiment experiment, const std::vector<scene_case::Place>& points) {
  for (const auto& [curve, at] : points) {
    discrepancy::Marker marker;
    marker.name = "point " + std::to_string(experiment.markers.size());
    marker.plant = 0;
    marker.place = {curve, at, {}};
    experiment.markers.push_back(std::move(marker));
  }
  for (discrepancy::Trial& trial : experiment.trials) {
    Eigen::MatrixXd& seen = trial.markers.value;
    const long more = 3 * static_cast<long>(points.size());
    seen.conservativeResize(Eigen::NoChange, seen.cols() + more);
    seen.rightCols(more).setConstant(std::nan(""));
  }
  return experiment;
}

std::string effect_text(const scene_case::Hidden& hidden) {
  std::string text = "{name: " + hidden.name;
  for (const auto& [key, values] : hidden.numbers) {
    text += ", " + key + ": " + (values.size() > 1 ? "[" : "");
    for (std::size_t i = 0; i < values.size(); ++i)
      text += (i > 0 ? ", " : "") + io::exact_number(values[i]);
    if (values.size() > 1) text += "]";
  }
  return text + "}";
}

discrepancy::SceneVariant variant_of(const scene_case::Setting& setting,
                                     const Experiment& experiment) {
  discrepancy::SceneVariant variant;
  Diagnostics diagnostics;
  for (const scene_case::Hidden& hidden : setting.hidden)
    variant.effects.push_back(discrepancy::read_scene_effect(
        io::parse_yaml(effect_text(hidden), "hidden", diagnostics), experiment));
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return variant;
}

void take_peaks(Course& course, const Eigen::Matrix<double, 6, 1>& wrench) {
  course.force.push_back(wrench.head<3>().norm());
  course.peak_force = std::max(course.peak_force, course.force.back());
  course.peak_moment = std::max(course.peak_moment, wrench.tail<3>().norm());
}

/// s, of the last camera picture in which the fruit is on: of none that came off the last of all.
std::size_t last_row(const std::vector<double>& time, const std::optional<double>& came_off) {
  const double end = came_off.value_or(time.back() + 1.0);
  const auto first_off = std::ranges::lower_bound(time, end - 1.0e-9);
  return static_cast<std::size_t>(std::max<long>(0, first_off - time.begin() - 1));
}

Course real_course(const scene_case::Run& run, const discrepancy::Trial& trial) {
  Course course;
  course.came_off = run.came_off;
  const std::vector<double>& seen = trial.markers.time;
  course.shape = run.points[run.step(seen[last_row(seen, run.came_off)])];
  for (const double t : trial.wrenches.front().time)
    take_peaks(course, run.mean_wrench(t, scene_case::wrench_rate));
  return course;
}

Course course_of(const SceneReadings& readings, const discrepancy::Trial& trial, const Course& real,
                 std::size_t points) {
  Course course;
  course.healthy = readings.healthy;
  for (const discrepancy::MeasuredEvent& event : readings.events)
    if (event.event == "detached") course.came_off = event.time;
  const Eigen::MatrixXd& wrench = readings.wrenches.front();
  for (long r = 0; r < wrench.rows(); ++r) take_peaks(course, wrench.row(r).transpose());
  // A fruit that stays on has no moment of its own: the real one's stands for it.
  const auto row = static_cast<long>(
      last_row(trial.markers.time, course.came_off ? course.came_off : real.came_off));
  const long first = readings.markers.cols() - 3 * static_cast<long>(points);
  double square = 0.0;
  for (std::size_t p = 0; p < points; ++p) {
    course.shape.emplace_back(
        readings.markers.row(row).segment<3>(first + 3 * static_cast<long>(p)).transpose());
    const double apart = (course.shape.back() - real.shape[p]).norm();
    square += apart * apart;
    course.most_apart = std::max(course.most_apart, apart);
  }
  course.rms_apart = std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, points)));
  return course;
}

class Foretelling {
 public:
  Foretelling(const Experiment& experiment, int threads)
      : experiment_(experiment), data_(experiment), simulator_(experiment, {}, threads) {}

  /// By trial.
  std::vector<Course> courses(const discrepancy::SceneVariant& variant,
                              const std::vector<Course>& real, std::size_t points) {
    std::vector<discrepancy::SceneSimulator::Request> requests;
    for (int t = 0; t < static_cast<int>(experiment_.trials.size()); ++t)
      requests.push_back({&variant, t});
    const std::vector<SceneReadings> readings = simulator_.run(requests);
    std::vector<Course> all;
    for (std::size_t t = 0; t < readings.size(); ++t) {
      if (!readings[t].healthy)
        throw discrepancy::SceneFailed("trial \"" + experiment_.trials[t].name +
                                       "\" cannot be simulated to its end");
      all.push_back(course_of(readings[t], experiment_.trials[t], real[t], points));
      discrepancy::Misfit sum;
      for (const discrepancy::Misfit& one : data_.sums(static_cast<int>(t), readings[t]))
        sum += one;
      all.back().misfit = sum.rms();
    }
    return all;
  }

 private:
  const Experiment& experiment_;
  SceneDataSet data_;
  discrepancy::SceneSimulator simulator_;
};

std::string number(double value, int digits = 3) {
  return io::format_number(value, digits);
}

}  // namespace

std::vector<scene_case::Hidden> hidden_by_default() {
  return {{"contact_friction", {{"coefficient", {0.3}}}},
          {"robot_latency", {{"delay", {0.025}}}},
          {"detachment_threshold", {{"factor", {0.7}}}}};
}

scene_case::Setting setting_of(const Options& options) {
  scene_case::Setting setting;
  setting.seed = options.seed;
  setting.trials = options.trials;
  scene_case::draw(setting);
  scene_case::make_harvest(setting);
  setting.hidden = options.hidden;
  return setting;
}

Diagnosed diagnose(const std::filesystem::path& folder, const std::filesystem::path& out,
                   int threads) {
  const Experiment experiment = read(folder, {});
  discrepancy::SceneDiagnosisOptions options;
  options.threads = threads;
  discrepancy::SceneDiagnosis found = diagnose_scene(experiment, options);
  Diagnosed told;
  told.is_believed = found.verdict.outcome != discrepancy::Outcome::unknown;
  const std::vector<discrepancy::SceneCandidate>& nearest = found.findings.candidates;
  const std::vector<plant::Effect>& model =
      told.is_believed || nearest.empty() ? found.model : nearest.front().fit.hypothesis.effects;
  std::filesystem::create_directories(out);
  found.verdict.extended_scene =
      write_extended_scene(out, experiment, model, found.fit_trials.front()).file;
  if (!found.verdict.extended_scene.empty()) told.extended = out / found.verdict.extended_scene;
  told.verdict = to_json(found.verdict) + "\n";
  told.findings = found.text;
  io::write_file_atomically(out / "verdict.json", told.verdict);
  io::write_file_atomically(out / "findings.txt", told.findings);
  return told;
}

std::optional<double> Trial::gain(const Course& course) const {
  if (nominal.misfit < least_to_gain) return std::nullopt;
  return (nominal.misfit - course.misfit) / (nominal.misfit - 1.0);
}

const Trial& Comparison::held_out() const {
  return *std::ranges::find_if(trials, &Trial::check);
}

Comparison compare(const std::filesystem::path& folder, const std::filesystem::path& extended,
                   const scene_case::Setting& setting, const std::vector<scene_case::Run>& runs,
                   int threads) {
  const std::vector<scene_case::Place> points = scene_case::points_of(setting);
  const Experiment nominal = with_points(read(folder, {}), points);
  const std::vector<scene_case::Drive> drives = scene_case::drives_of(setting);
  Comparison out;
  out.setting = setting;
  std::vector<Course> real;
  for (std::size_t t = 0; t < runs.size(); ++t)
    real.push_back(real_course(runs[t], nominal.trials[t]));
  Foretelling files(nominal, threads);
  const std::vector<Course> plain = files.courses({}, real, points.size());
  const std::vector<Course> hidden =
      files.courses(variant_of(setting, nominal), real, points.size());
  std::vector<Course> found;
  if (!extended.empty()) {
    const Experiment own = with_points(read(folder, extended), points);
    found = Foretelling(own, threads).courses({}, real, points.size());
  }
  for (std::size_t t = 0; t < runs.size(); ++t) {
    Trial trial;
    trial.name = drives[t].name;
    trial.check = drives[t].check;
    trial.taken = drives[t].grasp;
    trial.time = nominal.trials[t].wrenches.front().time;
    trial.stem =
        static_cast<std::size_t>(std::ranges::count(points, "stem", &scene_case::Place::first));
    trial.real = real[t];
    trial.nominal = plain[t];
    trial.hidden = hidden[t];
    if (!found.empty()) trial.extended = found[t];
    out.trials.push_back(std::move(trial));
  }
  return out;
}

std::vector<Said> said_of(const scene_case::Setting& setting, const std::string& verdict) {
  const json all = json::parse(verdict);
  std::vector<Said> out;
  for (const scene_case::Hidden& hidden : setting.hidden)
    for (const auto& [key, values] : hidden.numbers)
      for (std::size_t i = 0; i < values.size(); ++i) {
        Said said{hidden.name, key, values[i]};
        for (const json& cause : all.at("causes")) {
          if (cause.at("name") != hidden.name) continue;
          said.named = true;
          const json& told = cause.at("parameters").at(key);
          const json& own = told.is_array() ? told.at(i) : told;
          said.value = own.at("value");
          if (own.at("low").is_number()) said.low = own.at("low").get<double>();
          if (own.at("high").is_number()) said.high = own.at("high").get<double>();
        }
        out.push_back(said);
      }
  return out;
}

std::string tables(const Comparison& comparison, const std::string& extended) {
  std::string text;
  for (const Trial& trial : comparison.trials) {
    text += "\n`" + trial.name + "`, " + (trial.check ? "held out" : "fitted") +
            "\n\n| | real | nominal scene | " + extended +
            " | nominal scene with what is hidden |\n|---|---|---|---|---|\n";
    const auto row = [&](const std::string& name, const auto& cell, bool of_real) {
      text += "| " + name + " | " + (of_real ? cell(trial.real) : "") + " | " +
              cell(trial.nominal) + " | " + (trial.extended ? cell(*trial.extended) : "none") +
              " | " + cell(trial.hidden) + " |\n";
    };
    row(
        "fruit comes off, s after it was taken",
        [&](const Course& c) {
          return c.came_off ? number(*c.came_off - trial.taken, 4) : std::string("stays on");
        },
        true);
    row(
        "plant's shape just before, off by: rms, largest, mm",
        [&](const Course& c) {
          return number(1.0e3 * c.rms_apart) + ", " + number(1.0e3 * c.most_apart);
        },
        false);
    row(
        "peak force at the wrist, N", [](const Course& c) { return number(c.peak_force); }, true);
    row(
        "peak moment at the wrist, N m", [](const Course& c) { return number(c.peak_moment); },
        true);
    row(
        "misfit, noise units", [](const Course& c) { return number(c.misfit); }, false);
    row(
        "share of the nominal scene's misfit that is gone",
        [&](const Course& c) {
          const std::optional<double> gain = trial.gain(c);
          return gain && &c != &trial.nominal ? number(100.0 * *gain) + " %" : std::string();
        },
        false);
  }
  return text;
}

std::string tables(const std::vector<Said>& said, const std::string& verdict) {
  const json all = json::parse(verdict);
  std::string text =
      "The verdict: `" + all.at("verdict").get<std::string>() +
      "`\n\n| hidden | number | real | said | 95 % interval |\n|---|---|---|---|---|\n";
  for (const Said& one : said) {
    text += "| `" + one.name + "` | `" + one.parameter + "` | " + number(one.truth) + " | ";
    if (one.named)
      text += number(one.value, 4) + " | " + (one.low ? number(*one.low, 4) : "open") + " to " +
              (one.high ? number(*one.high, 4) : "open") + " |\n";
    else
      text += "not named | |\n";
  }
  for (const json& cause : all.at("causes"))
    if (const std::string name = cause.at("name");
        std::ranges::none_of(said, [&](const Said& one) { return one.name == name; }))
      text += "| nothing | `" + name + "` | | named | |\n";
  return text;
}

}  // namespace pedicel::harvest
