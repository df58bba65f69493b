#include <algorithm>
#include <cmath>
#include <set>

#include "pedicel/discrepancy/data/drive_reader.h"
#include "pedicel/discrepancy/data/experiment_progress.h"
#include "pedicel/discrepancy/data/experiment_tables.h"
#include "pedicel/effects/registry/effect_definition.h"
#include "pedicel/io/yaml.h"
#include "pedicel/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::YamlMap;
using io::YamlNode;

constexpr double usual_window = 0.2;  // s
constexpr int least_in_window = 3;    // rows

class Reader {
 public:
  Reader(const YamlNode& node, const ReadProgress& progress)
      : node_(node), diagnostics_(node.diagnostics()), progress_(progress) {}

  Experiment read(const std::filesystem::path& folder) {
    experiment_.folder = folder;
    YamlMap map(node_, "an experiment");
    if (!node_.is_map() || !io::check_format(map, "pedicel-experiment", 1)) return {};
    experiment_.title = map.text("title", "");
    read_plant(map);
    if (const auto markers = map.required("markers")) read_markers_list(*markers);
    if (const auto noise = map.optional("noise")) read_noise(*noise);
    experiment_.effects = read_effects(map);
    if (const auto trials = map.required("trials")) read_trials(*trials);
    map.finish();
    return std::move(experiment_);
  }
  bool was_stopped() const { return stopped_; }

 private:
  void read_plant(YamlMap& map) {
    const auto node = map.required("plant");
    if (!node) return;
    const std::string file = node->text("plant");
    if (file.empty()) return;
    experiment_.plant_path = experiment_.folder / file;
    auto plant = plant::read_plant_file(experiment_.plant_path, diagnostics_);
    has_plant_ = plant.has_value();
    if (plant) experiment_.plant = std::move(*plant);
  }

  // Without a plant its own faults are enough.
  plant::CurvePlace place(YamlMap& map) {
    plant::CurvePlace found = plant::read_place(map);
    check_curve(found);
    return found;
  }

  void check_curve(const plant::CurvePlace& place) {
    if (!has_plant_ || place.curve.empty() || experiment_.plant.curve_index(place.curve) >= 0)
      return;
    std::string names;
    for (const plant::PlantCurve& curve : experiment_.plant.curves)
      names += (names.empty() ? "" : ", ") + curve.name;
    diagnostics_.error(place.where,
                       "curve \"" + place.curve + "\" is unknown, expected one of: " + names);
  }

  void read_markers_list(const YamlNode& list) {
    std::set<std::string> names;
    for (const YamlNode& node : list.list("markers")) {
      YamlMap map(node, "a marker");
      Marker marker;
      marker.name = map.text("name");
      if (!marker.name.empty() && !names.insert(marker.name).second)
        node.error("marker \"" + marker.name + "\" appears twice, expected each name once");
      marker.place = place(map);
      map.finish();
      experiment_.markers.push_back(std::move(marker));
    }
    if (list.is_list() && experiment_.markers.empty())
      list.error("no markers, expected at least one");
  }

  void read_noise(const YamlNode& node) {
    YamlMap map(node, "noise");
    if (const auto std = map.optional("position_std"))
      experiment_.noise.position_std = std->number("position_std", io::positive);
    if (const auto std = map.optional("force_std"))
      experiment_.noise.force_std = std->number("force_std", io::positive);
    if (const auto std = map.optional("moment_std"))
      experiment_.noise.moment_std = std->number("moment_std", io::positive);
    if (const auto std = map.optional("path_std"))
      experiment_.noise.path_std = std->number("path_std", io::positive);
    map.finish();
  }

  std::vector<plant::Effect> read_effects(YamlMap& map) {
    std::vector<plant::Effect> effects;
    for (const YamlNode& node : map.list("effects")) {
      plant::Effect effect = plant::read_effect(node, effects::EffectFile::experiment);
      if (effect.place) check_curve(*effect.place);
      if (effect.words.contains("marker")) check_marker(node, effect.words.at("marker"));
      effects.push_back(std::move(effect));
    }
    return effects;
  }

  void check_marker(const YamlNode& node, const std::string& name) {
    std::string names;
    for (const Marker& marker : experiment_.markers) {
      if (marker.name == name) return;
      names += (names.empty() ? "" : ", ") + marker.name;
    }
    node.error("marker \"" + name + "\" is unknown, expected one of: " + names);
  }

  void read_trials(const YamlNode& list) {
    std::set<std::string> names;
    const std::vector<YamlNode> all = list.list("trials");
    const auto told = [&] {
      const std::size_t done = experiment_.trials.size();
      stopped_ = progress_ && !progress_(static_cast<int>(done), static_cast<int>(all.size()));
      return !stopped_;
    };
    for (const YamlNode& node : all) {
      if (!told()) return;
      Trial trial = read_trial(node);
      if (!trial.name.empty() && !names.insert(trial.name).second)
        node.error("trial \"" + trial.name + "\" appears twice, expected each name once");
      experiment_.trials.push_back(std::move(trial));
    }
    told();
    if (list.is_list() && experiment_.trials.empty())
      list.error("no trials, expected at least one");
  }

  Trial read_trial(const YamlNode& node) {
    YamlMap map(node, "a trial");
    Trial trial;
    trial.name = map.text("name");
    const auto folder = map.required("folder");
    if (folder) trial.folder = folder->text("folder");
    if (map.has("use"))
      trial.use =
          map.choice("use", {"fit", "check"}, "fit") == "fit" ? Trial::Use::fit : Trial::Use::check;
    trial.clock = map.number("clock", io::any_number, 0.0);
    trial.gravity = map.vector("gravity", trial.gravity);
    for (const YamlNode& item : map.list("masses")) trial.masses.push_back(read_mass(item));
    trial.effects = read_effects(map);
    read_beginning(map, trial);
    const auto drive = map.required("drive");
    map.finish();
    if (trial.folder.empty()) return trial;
    const std::filesystem::path at = experiment_.folder / trial.folder;
    if (!std::filesystem::is_directory(at)) {
      folder->error("folder " + at.string() + " does not exist, expected the trial's tables in it");
      return trial;
    }
    if (drive)
      read_drives(
          *drive, at, [&](const plant::CurvePlace& place) { check_curve(place); }, trial);
    read_tables(at, trial);
    if (trial.is_static) check_static(node, trial, diagnostics_);
    check_noise(node, trial);
    check_window(at, trial);
    end_holds(trial);
    return trial;
  }

  // How the plant is at time 0, and whether there is a time at all.
  static void read_beginning(YamlMap& map, Trial& trial) {
    trial.is_static = map.boolean("static", false);
    const bool moves = map.choice("begins", {"at_rest", "moving"}, "at_rest") == "moving";
    const auto window = map.optional("window");
    if (moves) trial.window = window ? window->number("window", io::positive) : usual_window;
    if (window && !moves)
      window->error("a window where the trial begins at rest, expected begins: moving beside it");
    if (moves && trial.is_static)
      map.error("begins: moving in a static series, expected one of the two");
  }

  void check_window(const std::filesystem::path& folder, const Trial& trial) const {
    if (!trial.window || trial.markers.size() == 0) return;
    const auto within = std::ranges::count_if(
        trial.markers.time, [&](double t) { return t <= *trial.window + 1.0e-9; });
    if (within < least_in_window)
      diagnostics_.error({(folder / "markers.csv").string(), 0, 0},
                         "has " + std::to_string(within) + " rows up to " +
                             io::format_number(*trial.window) +
                             " s, the window of a trial that begins in motion, expected " +
                             std::to_string(least_in_window) + " or more");
  }

  // Nothing rests there from one row to the next, so that the noise cannot be read off the data.
  void check_noise(const YamlNode& node, const Trial& trial) const {
    if (!trial.is_static) return;
    const StatedNoise& noise = experiment_.noise;
    const auto need = [&](const std::optional<double>& std, const char* key) {
      if (!std)
        node.error("a static series where noise has no " + std::string(key) +
                   ", expected one: rows at rest once each do not show their noise");
    };
    need(noise.position_std, "position_std");
    if (trial.force.size() > 0 || trial.wrench.size() > 0) need(noise.force_std, "force_std");
    if (trial.wrench.size() > 0) need(noise.moment_std, "moment_std");
  }

  // A path of one row is a place: it does not end.
  static void end_holds(Trial& trial) {
    for (Hold& hold : trial.holds)
      if (std::isinf(hold.release) && hold.path.time.size() > 1 &&
          hold.path.time.back() < trial.duration())
        hold.release = hold.path.time.back();
  }

  plant::PlantMass read_mass(const YamlNode& node) {
    YamlMap map(node, "a mass");
    plant::PlantMass mass;
    mass.place = place(map);
    mass.mass = map.number("mass", io::positive);
    map.finish();
    return mass;
  }

  void read_tables(const std::filesystem::path& folder, Trial& trial) {
    const Rows rows = trial.is_static ? Rows::rest : Rows::time;
    trial.markers = read_markers(folder / "markers.csv", experiment_.markers, diagnostics_, rows);
    if (std::filesystem::exists(folder / "force.csv")) {
      trial.force = read_force(folder / "force.csv", diagnostics_, rows);
      if (trial.holds.empty())
        diagnostics_.warning({(folder / "force.csv").string(), 1, 1},
                             "a force was measured where nothing is held, expected a hold");
    }
    if (std::filesystem::exists(folder / "events.csv"))
      trial.events = read_events(folder / "events.csv", experiment_.plant, diagnostics_);
    if (!trial.wrench_file.empty())
      trial.wrench = read_wrench(folder / trial.wrench_file, diagnostics_, rows);
  }

  const YamlNode& node_;
  Diagnostics& diagnostics_;
  const ReadProgress& progress_;
  Experiment experiment_;
  bool has_plant_ = false, stopped_ = false;
};

}  // namespace

bool records_detachments(const Experiment& experiment) {
  return std::ranges::any_of(experiment.trials, [](const Trial& trial) {
    return std::ranges::any_of(trial.events, &MeasuredEvent::is_detachment);
  });
}

std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics) {
  return read_experiment(path, diagnostics, {});
}

std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics, const ReadProgress& progress) {
  const int before = diagnostics.error_count();
  const std::filesystem::path file =
      std::filesystem::is_directory(path) ? path / "experiment.yaml" : path;
  try {
    const YamlNode node = io::load_yaml(file, diagnostics);
    Reader reader(node, progress);
    Experiment experiment = reader.read(file.parent_path());
    if (!reader.was_stopped() && diagnostics.error_count() == before) return experiment;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
