#include <algorithm>
#include <cmath>
#include <set>

#include "engine/io/csv.h"
#include "plugins/discrepancy/data/drive_reader.h"
#include "plugins/discrepancy/data/experiment_keys.h"
#include "plugins/discrepancy/data/experiment_progress.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::DescribedMap;
using io::KeyType;
using io::Told;
using io::YamlNode;

constexpr double usual_window = 0.2;  // s
constexpr int least_in_window = 3;    // rows

const io::KeyList& experiment_list() {
  static const io::KeyList keys{
      "experiment",
      "an experiment",
      {{.name = "format",
        .type = KeyType::word,
        .words = {"pedicel-experiment"},
        .sentence = "says what the file is"},
       {.name = "version",
        .type = KeyType::whole,
        .bounds = {1, 1},
        .sentence = "version of the format"},
       {.name = "title",
        .type = KeyType::text,
        .otherwise = Told{"empty"},
        .sentence = "heads the report"},
       {.name = "plant",
        .type = KeyType::path,
        .sentence = "the nominal [plant file](plant_file.md)"},
       {.name = "markers",
        .type = KeyType::list,
        .form = "one or more",
        .sentence = "measured points of the plant"},
       {.name = "noise",
        .type = KeyType::map,
        .otherwise = Told{"from the data"},
        .sentence = "known noise of the sensors"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known [effects of every trial](effects.md#effects-of-an-experiment)"},
       {.name = "trials",
        .type = KeyType::list,
        .form = "one or more",
        .sentence = "what was done and measured"}}};
  return keys;
}

const io::KeyList& marker_list() {
  static const io::KeyList keys{
      "marker",
      "a marker",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "name of the marker"}},
      "",
      {&plant::place_keys()}};
  return keys;
}

const io::KeyList& noise_list() {
  const auto deviation = [](const char* name, const char* unit, const char* otherwise,
                            const char* sentence) {
    return io::Key{.name = name,
                   .unit = unit,
                   .otherwise = Told{otherwise},
                   .bounds = io::positive,
                   .sentence = sentence};
  };
  static const io::KeyList keys{
      "noise",
      "noise",
      {deviation("position_std", "m", "estimated", "standard deviation of a marker's axis"),
       deviation("force_std", "N", "estimated", "standard deviation of a force's axis"),
       deviation("moment_std", "N m", "estimated", "standard deviation of a moment's axis"),
       deviation("path_std", "m", "none",
                 "standard deviation of an axis of the [paths themselves](#noise-of-paths)")}};
  return keys;
}

const io::KeyList& trial_list() {
  static const io::KeyList keys{
      "trial",
      "a trial",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "name of the trial"},
       {.name = "folder", .type = KeyType::path, .sentence = "where its tables lie"},
       {.name = "use",
        .type = KeyType::word,
        .otherwise = Told{"the program splits"},
        .words = {"fit", "check"},
        .sentence = "`check` holds the trial out of all fits"},
       {.name = "clock",
        .unit = "s",
        .otherwise = Trial{}.clock,
        .sentence = "when the trial began, since the first"},
       {.name = "gravity",
        .type = KeyType::vector,
        .unit = "m/s2",
        .otherwise = Trial{}.gravity,
        .sentence = "gravity"},
       {.name = "begins",
        .type = KeyType::word,
        .otherwise = "at_rest",
        .words = {"at_rest", "moving"},
        .sentence = "how the plant is at time 0"},
       {.name = "window",
        .unit = "s",
        .otherwise = usual_window,
        .bounds = io::positive,
        .form = "where it begins `moving`",
        .sentence = "first samples that say how it "
                    "[begins in motion](#a-record-that-begins-in-motion)"},
       {.name = "static",
        .type = KeyType::flag,
        .otherwise = Trial{}.is_static,
        .sentence = "a [static series](#static-series) without time"},
       {.name = "masses",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known masses that hang on the plant in this trial"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known effects of this trial"},
       {.name = "drive",
        .type = KeyType::list,
        .form = "one or more",
        .sentence = "what is known to have been done"}}};
  return keys;
}

const io::KeyList& mass_list() {
  static const io::KeyList keys{
      "mass",
      "a mass",
      {{.name = "mass", .unit = "kg", .bounds = io::positive, .sentence = "of one of them"}},
      "masses",
      {&plant::place_keys()}};
  return keys;
}

class Reader {
 public:
  Reader(const YamlNode& node, const ReadProgress& progress)
      : node_(node), diagnostics_(node.diagnostics()), progress_(progress) {}

  Experiment read(const std::filesystem::path& folder) {
    experiment_.folder = folder;
    DescribedMap map(node_, experiment_list());
    if (!node_.is_map() || !map.has_format()) return {};
    experiment_.title = map.text("title");
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
  void read_plant(DescribedMap& map) {
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
  plant::CurvePlace place(DescribedMap& map) {
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
      DescribedMap map(node, marker_list());
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
    DescribedMap map(node, noise_list());
    experiment_.noise.position_std = map.optional_number("position_std");
    experiment_.noise.force_std = map.optional_number("force_std");
    experiment_.noise.moment_std = map.optional_number("moment_std");
    experiment_.noise.path_std = map.optional_number("path_std");
    map.finish();
  }

  std::vector<plant::Effect> read_effects(DescribedMap& map) {
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
    DescribedMap map(node, trial_list());
    Trial trial;
    trial.name = map.text("name");
    const auto folder = map.required("folder");
    if (folder) trial.folder = folder->text("folder");
    if (map.has("use"))
      trial.use = map.choice("use") == "fit" ? Trial::Use::fit : Trial::Use::check;
    trial.clock = map.number("clock");
    trial.gravity = map.vector("gravity");
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
  static void read_beginning(DescribedMap& map, Trial& trial) {
    trial.is_static = map.boolean("static");
    const bool moves = map.choice("begins") == "moving";
    const auto window = map.optional("window");
    if (moves) trial.window = map.number("window");
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
    DescribedMap map(node, mass_list());
    plant::PlantMass mass;
    mass.place = place(map);
    mass.mass = map.number("mass");
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
      trial.events = read_events(
          folder / "events.csv", diagnostics_,
          [&](const MeasuredEvent& event, io::SpecTable& table) { check_event(event, table); });
    if (!trial.wrench_file.empty())
      trial.wrench = read_wrench(folder / trial.wrench_file, diagnostics_, rows);
  }

  // What detached is a fruit of the plant.
  void check_event(const MeasuredEvent& event, io::SpecTable& table) const {
    const plant::PlantFile& plant = experiment_.plant;
    const auto named = [&](const auto& fruit) { return fruit.name == event.what; };
    if (event.is_detachment() && std::ranges::none_of(plant.fruits, named))
      table.row_error("no fruit", what_column,
                      "what: " + in_quotes(event.what) + " is no fruit of plant \"" + plant.name +
                          "\", expected the name of one that detached");
  }

  const YamlNode& node_;
  Diagnostics& diagnostics_;
  const ReadProgress& progress_;
  Experiment experiment_;
  bool has_plant_ = false, stopped_ = false;
};

}  // namespace

std::vector<const io::KeyList*> experiment_keys() {
  std::vector<const io::KeyList*> all = {&experiment_list(), &marker_list(), &plant::place_keys(),
                                         &noise_list(),      &trial_list(),  &mass_list()};
  for (const io::KeyList* one : drive_keys()) all.push_back(one);
  return all;
}

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
