#include <algorithm>
#include <cmath>

#include "engine/core/joined.h"
#include "engine/io/csv.h"
#include "engine/io/described_map.h"
#include "engine/world/scene_reader.h"
#include "engine/world/settings.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/drive_reader.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/files/experiment_lists.h"
#include "plugins/discrepancy/scene/camera.h"
#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/effect_reader.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::discrepancy {

namespace {

using io::DescribedMap;
using io::YamlNode;

constexpr int least_in_window = 3;    // rows
constexpr double same_time = 1.0e-9;  // s

template <class Items>
int index_of(const Items& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

template <class Items>
std::string names_of(const Items& items) {
  if (items.empty()) return "none";
  return joined(items, [](const auto& item) -> const std::string& { return item.name; });
}

class Reader {
 public:
  Reader(const YamlNode& node, const ReadOptions& options)
      : node_(node), diagnostics_(node.diagnostics()), options_(options) {}

  Experiment read(const std::filesystem::path& folder) {
    out_.folder = folder;
    DescribedMap map(node_, experiment_list());
    if (!node_.is_map() || !map.has_format()) return {};
    out_.title = map.text("title");
    is_scene_ = map.has("scene");
    if (is_scene_) {
      read_scene(map);
      // Without a whole scene names cannot be looked up: its own faults are enough.
      if (!whole_) return {};
      read_each(map, "cameras", most_cameras, out_.cameras,
                [&](const YamlNode& node) { return read_camera(node); });
      read_each(map, "wrenches", most_wrenches, out_.wrenches,
                [&](const YamlNode& node) { return read_wrench_sensor(node); });
    } else {
      refuse_keys(map, {"source", "cameras", "wrenches"});
      read_plant(map);
    }
    read_each(map, "markers", most_markers, out_.markers,
              [&](const YamlNode& node) { return read_marker(node); });
    if (!is_scene_) need_markers(map);
    if (const auto noise = map.optional("noise")) read_noise(*noise);
    if (!is_scene_) out_.effects = read_effects(map);
    if (const auto trials = map.required("trials")) read_trials(*trials);
    if (is_scene_) {
      // Afterwards, because they may name trials.
      out_.scene_effects = scene_file_effects(out_, diagnostics_);
      out_.effects = read_effects(map);
    }
    map.finish();
    return std::move(out_);
  }
  bool was_stopped() const { return stopped_; }

 private:
  // Those of the other kind of experiment.
  void refuse_keys(DescribedMap& map, std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      if (const auto node = map.misplaced(key))
        node->error(std::string(key) +
                    (is_scene_ ? " where the model is a scene, expected a single plant"
                               : " where the model is a single plant, expected a scene"));
  }

  void read_plant(DescribedMap& map) {
    const auto node = map.required("plant");
    if (!node) return;
    const std::string file = node->text("plant");
    if (file.empty()) return;
    ExperimentPlant& plant = out_.plants.front();
    plant.path = out_.folder / file;
    auto read = plant::read_plant_file(plant.path, diagnostics_);
    whole_ = read.has_value();
    if (read) plant.file = std::move(*read), plant.name = plant.file.name;
  }

  void read_scene(DescribedMap& map) {
    out_.is_run = map.has("source") && map.choice("source") == "run";
    const auto node = map.required("scene");
    out_.scene_path = node->text("scene");
    if (out_.scene_path.empty()) return;
    std::filesystem::path file = out_.folder / out_.scene_path;
    if (!options_.scene.empty()) {
      file = options_.scene;
      out_.scene_path = file.filename();
    }
    if (const auto plant = map.misplaced("plant"))
      plant->error("plant beside scene, expected one of them: a scene names its plants");
    const int before = diagnostics_.error_count();
    auto scene = world::read_scene(file, diagnostics_);
    if (!scene) return;
    out_.scene = scene->vary.empty() ? std::move(*scene) : world::drawn_scene(*scene);
    if (!out_.scene.robot)
      node->error("the scene has no robot, expected one whose joints were measured");
    else if (auto robot = simulation::read_robot(*out_.scene.robot, {}, diagnostics_))
      out_.robot = std::move(*robot);
    read_plants();
    if (out_.scene.plants.empty()) node->error("the scene has no plants, expected at least one");
    whole_ = diagnostics_.error_count() == before;
    if (!whole_) return;
    try {
      nominal_state(out_);
    } catch (const InvalidFile& fault) {
      diagnostics_.add(fault);
      whole_ = false;
    }
  }

  // As a run has them: with the scene's settings, and each of a grid by itself.
  void read_plants() {
    out_.plants.clear();
    for (simulation::PlacedPlantFile& plant :
         simulation::plant_files(out_.scene, {}, diagnostics_)) {
      const std::string name = plant.file.name;
      out_.plants.push_back({name, std::move(plant.file), std::move(plant.source), plant.pose});
    }
  }

  template <class Item, class Read>
  void read_each(DescribedMap& map, const char* key, std::size_t most, std::vector<Item>& items,
                 const Read& read) {
    for (const YamlNode& node : map.list(key)) {
      if (items.size() == most)
        return node.error(std::string(key) + ": the list goes on, expected at most " +
                          std::to_string(most));
      Item item = read(node);
      if (!item.name.empty() && index_of(items, item.name) >= 0)
        node.error(std::string(key) + ": \"" + item.name +
                   "\" appears twice, expected each name once");
      items.push_back(std::move(item));
    }
  }

  Marker read_marker(const YamlNode& node) {
    DescribedMap map(node, marker_list());
    Marker marker;
    marker.name = map.text("name");
    if (!is_scene_) refuse_keys(map, {"plant", "fruit", "link", "offset"});
    if (const auto link = map.optional("link")) {
      marker.plant = -1;
      marker.link = link_of(*link, "link");
      marker.offset_L = map.vector("offset");
    } else {
      marker.plant = plant_of(map);
      if (const auto fruit = map.optional("fruit"))
        marker.fruit = fruit_of(*fruit, marker.plant);
      else
        marker.place = place(map, marker.plant);
    }
    map.finish();
    return marker;
  }

  void need_markers(DescribedMap& map) const {
    const auto list = map.required("markers");
    if (list && list->is_list() && out_.markers.empty())
      list->error("no markers, expected at least one");
  }

  int plant_of(DescribedMap& map) {
    const auto node = map.optional("plant");
    if (!node) {
      if (out_.plants.size() > 1) map.error("no plant, expected one of: " + names_of(out_.plants));
      return 0;
    }
    const std::string name = node->text("plant");
    const int found = out_.plant_index(name);
    if (found < 0)
      node->error("plant \"" + name + "\" is unknown, expected one of: " + names_of(out_.plants));
    return std::max(0, found);
  }

  int fruit_of(const YamlNode& node, int plant) {
    const std::string name = node.text("fruit");
    const auto& fruits = out_.plants[static_cast<std::size_t>(plant)].file.fruits;
    const int found = index_of(fruits, name);
    if (found < 0)
      node.error("fruit \"" + name + "\" is unknown, expected one of: " + names_of(fruits));
    return std::max(0, found);
  }

  int link_of(const YamlNode& node, const char* what) {
    const std::string name = node.text(what);
    const int found = out_.robot.link(name);
    if (found < 0)
      node.error(std::string(what) + " \"" + name +
                 "\" is unknown, expected one of: " + names_of(out_.robot.links));
    return std::max(0, found);
  }

  plant::CurvePlace place(DescribedMap& map, int plant) {
    plant::CurvePlace found = plant::read_place(map);
    check_curve(found, plant);
    return found;
  }

  // Without a plant its own faults are enough.
  void check_curve(const plant::CurvePlace& place, int plant) {
    const plant::PlantFile& file = out_.plants[static_cast<std::size_t>(plant)].file;
    if (whole_ && !place.curve.empty() && file.curve_index(place.curve) < 0)
      diagnostics_.error(
          place.where,
          "curve \"" + place.curve + "\" is unknown, expected one of: " + names_of(file.curves));
  }

  Camera read_camera(const YamlNode& node) {
    DescribedMap map(node, camera_list());
    Camera camera;
    camera.name = map.text("name");
    const auto size = map.optional("size");
    if (size) {
      const std::vector<double> both = size->numbers("size", map.key("size").bounds);
      if (both.size() == 2)
        camera.size = {static_cast<int>(both[0]), static_cast<int>(both[1])};
      else
        size->error("size: expected two numbers, width and height in px");
    }
    camera.centre = {0.5 * camera.size[0], 0.5 * camera.size[1]};
    if (map.has("eye")) {
      const Vec3 eye = map.vector("eye");
      const auto aim = map.required("target");
      const Vec3 target = aim ? aim->vector("target") : Vec3(Vec3::Zero());
      if (!((target - eye).norm() > 0.0)) node.error("target: expected another place than eye");
      camera.X_WC = {eye, looking_at(eye, target)};
      const double fov = map.required_number("fov");
      camera.focal.setConstant(0.5 * camera.size[1] / std::tan(0.5 * fov));
    } else {
      camera.X_WC.position = map.vector("position");
      if (const auto turn = map.required("orientation"))
        camera.X_WC.rotation = turn->quaternion("orientation");
      camera.focal = pair(map, "focal", camera.focal);
    }
    camera.centre = pair(map, "centre", camera.centre);
    if (const auto lens = map.optional("distortion")) {
      const std::vector<double> all = lens->numbers("distortion", map.key("distortion").bounds);
      if (all.size() == 5)
        std::ranges::copy(all, camera.distortion.begin());
      else
        lens->error("distortion: expected five numbers, k1 k2 p1 p2 k3");
    }
    map.finish();
    return camera;
  }

  static Eigen::Vector2d pair(DescribedMap& map, const char* key,
                              const Eigen::Vector2d& otherwise) {
    const auto node = map.asked(key);
    if (!node) return otherwise;
    const std::vector<double> both = node->numbers(key, map.key(key).bounds);
    if (both.size() == 2) return {both[0], both[1]};
    node->error(std::string(key) + ": expected two numbers, px");
    return otherwise;
  }

  WrenchSensor read_wrench_sensor(const YamlNode& node) {
    DescribedMap map(node, wrench_list());
    WrenchSensor sensor;
    sensor.name = map.text("name");
    if (const auto link = map.required("link")) sensor.link = link_of(*link, "link");
    sensor.tared = map.boolean("tared");
    map.finish();
    return sensor;
  }

  void read_noise(const YamlNode& node) {
    DescribedMap map(node, noise_list());
    StatedNoise& noise = out_.noise;
    noise.position_std = map.optional_number("position_std");
    noise.force_std = map.optional_number("force_std");
    noise.moment_std = map.optional_number("moment_std");
    if (is_scene_) {
      refuse_keys(map, {"path_std"});
      noise.pixel_std = map.optional_number("pixel_std");
      noise.joint_std = map.optional_number("joint_std");
      noise.torque_std = map.optional_number("torque_std");
    } else {
      refuse_keys(map, {"pixel_std", "joint_std", "torque_std"});
      noise.path_std = map.optional_number("path_std");
    }
    map.finish();
  }

  std::vector<plant::Effect> read_effects(DescribedMap& map) {
    std::vector<plant::Effect> effects;
    for (const YamlNode& node : map.list("effects"))
      effects.push_back(is_scene_ ? read_scene_effect(node, out_) : read_plant_effect(node));
    return effects;
  }

  plant::Effect read_plant_effect(const YamlNode& node) {
    plant::Effect effect = plant::read_effect(node, effects::EffectFile::experiment);
    if (effect.place) check_curve(*effect.place, 0);
    if (!effect.words.contains("marker")) return effect;
    if (const std::string name = effect.words.at("marker"); index_of(out_.markers, name) < 0)
      node.error("marker \"" + name + "\" is unknown, expected one of: " + names_of(out_.markers));
    return effect;
  }

  void read_trials(const YamlNode& list) {
    const std::vector<YamlNode> all = list.list("trials");
    const auto told = [&] {
      stopped_ = options_.progress && !options_.progress(static_cast<int>(out_.trials.size()),
                                                         static_cast<int>(all.size()));
      return !stopped_;
    };
    for (const YamlNode& node : all) {
      if (!told()) return;
      if (out_.trials.size() == most_trials)
        return node.error("trials: the list goes on, expected at most " +
                          std::to_string(most_trials));
      Trial trial = read_trial(node);
      if (!trial.name.empty() && index_of(out_.trials, trial.name) >= 0)
        node.error("trial \"" + trial.name + "\" appears twice, expected each name once");
      out_.trials.push_back(std::move(trial));
    }
    told();
    if (list.is_list() && out_.trials.empty()) list.error("no trials, expected at least one");
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
    for (const YamlNode& item : map.list("masses")) trial.masses.push_back(read_mass(item));
    std::optional<YamlNode> drive;
    if (is_scene_) {
      refuse_keys(map, {"gravity", "begins", "window", "static", "drive"});
      if (const auto robot = map.required("robot")) {
        DescribedMap follows(*robot, follows_list());
        trial.follows_commands = follows.choice("follows") == "commands";
        follows.finish();
      }
      if (const auto plants = map.optional("plants")) read_poses(*plants, trial);
    } else {
      refuse_keys(map, {"robot", "plants"});
      trial.gravity = map.vector("gravity");
      read_beginning(map, trial);
      drive = map.required("drive");
    }
    trial.effects = read_effects(map);
    map.finish();
    if (trial.folder.empty()) return trial;
    const std::filesystem::path at = out_.folder / trial.folder;
    if (!std::filesystem::is_directory(at)) {
      folder->error("folder " + at.string() + " does not exist, expected the trial's tables in it");
      return trial;
    }
    if (drive)
      read_drives(
          *drive, at, [&](const plant::CurvePlace& place) { check_curve(place, 0); }, trial);
    if (is_scene_) {
      read_scene_tables(at, trial);
      return trial;
    }
    read_plant_tables(at, trial);
    if (trial.is_static) check_static(node, trial, diagnostics_);
    check_noise(node, trial);
    check_window(at, trial);
    end_holds(trial);
    return trial;
  }

  Trial::Mass read_mass(const YamlNode& node) {
    DescribedMap map(node, mass_list());
    if (!is_scene_) refuse_keys(map, {"plant"});
    Trial::Mass mass;
    mass.plant = plant_of(map);
    mass.place = place(map, mass.plant);
    mass.mass = map.number("mass");
    map.finish();
    return mass;
  }

  void read_poses(const YamlNode& node, Trial& trial) {
    io::YamlMap map(node, "plants");  // its keys are names of plants
    for (std::size_t p = 0; p < out_.plants.size(); ++p) {
      const auto entry = map.optional(out_.plants[p].name);
      if (!entry) continue;
      DescribedMap pose(*entry, moved_list());
      Pose moved = out_.plants[p].pose;
      if (const auto place = pose.optional("position")) moved.position = place->vector("position");
      if (const auto turn = pose.optional("orientation"))
        moved.rotation = turn->quaternion("orientation");
      pose.finish();
      trial.poses[static_cast<int>(p)] = moved;
    }
    map.finish();
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
    const StatedNoise& noise = out_.noise;
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

  void read_plant_tables(const std::filesystem::path& folder, Trial& trial) {
    const Rows rows = trial.is_static ? Rows::rest : Rows::time;
    trial.markers = read_markers(folder / "markers.csv", out_.markers, diagnostics_, rows);
    if (std::filesystem::exists(folder / "force.csv")) {
      trial.force = read_force(folder / "force.csv", diagnostics_, rows);
      if (trial.holds.empty())
        diagnostics_.warning({(folder / "force.csv").string(), 1, 1},
                             "a force was measured where nothing is held, expected a hold");
    }
    read_events_of(folder, trial);
    if (!trial.wrench_file.empty())
      trial.wrench = read_wrench(folder / trial.wrench_file, diagnostics_, rows);
  }

  void read_scene_tables(const std::filesystem::path& folder, Trial& trial) {
    const auto there = [&](const std::string& name) {
      return std::filesystem::exists(folder / name);
    };
    // One of the two drives the arm; the other may be there, too.
    const std::string driver = trial.follows_commands ? "commands.csv" : "joints.csv";
    const auto read_joints = [&](const char* file, io::Quantity quantity, bool needed,
                                 std::vector<int>& columns) {
      if (!needed && !there(file)) return Samples{};
      return read_joint_table(folder / file, out_.robot, quantity, columns, diagnostics_);
    };
    trial.joints = read_joints("joints.csv", io::Quantity::angle, !trial.follows_commands,
                               trial.joint_columns);
    trial.commands = read_joints("commands.csv", io::Quantity::angle, trial.follows_commands,
                                 trial.command_columns);
    trial.torques = read_joints("torques.csv", io::Quantity::moment, false, trial.torque_columns);
    if (there("markers.csv"))
      trial.markers = read_some_markers(folder / "markers.csv", out_.markers, diagnostics_);
    for (const Camera& camera : out_.cameras) {
      const std::string name = "pixels_" + camera.name + ".csv";
      trial.pixels.push_back(there(name) ? read_pixels(folder / name, out_.markers, diagnostics_)
                                         : Samples{});
    }
    for (const WrenchSensor& sensor : out_.wrenches) {
      const std::string name = "wrench_" + sensor.name + ".csv";
      trial.wrenches.push_back(
          there(name) ? read_samples(folder / name, wrench_spec(), diagnostics_) : Samples{});
    }
    read_events_of(folder, trial);
    check_strangers(folder);
    check_begin(folder, driver, trial);
  }

  void read_events_of(const std::filesystem::path& folder, Trial& trial) {
    if (!std::filesystem::exists(folder / "events.csv")) return;
    trial.events = read_events(folder / "events.csv", diagnostics_,
                               [&](const MeasuredEvent& event, io::SpecTable& table) {
                                 if (is_scene_)
                                   check_scene_event(event, table);
                                 else
                                   check_plant_event(event, table);
                               });
  }

  // A table of an instrument that experiment.yaml does not have would be passed over in silence.
  void check_strangers(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      const auto named = [&](const std::string& head, const auto& items, const char* what) {
        if (!name.starts_with(head) || !name.ends_with(".csv")) return;
        const std::string own = name.substr(head.size(), name.size() - head.size() - 4);
        if (index_of(items, own) < 0)
          diagnostics_.error({entry.path().string(), 1, 1},
                             std::string("a table of ") + what + " " + in_quotes(own) +
                                 ", expected one of: " + names_of(items));
      };
      named("pixels_", out_.cameras, "camera");
      named("wrench_", out_.wrenches, "wrench");
    }
  }

  void check_begin(const std::filesystem::path& folder, const std::string& driver,
                   const Trial& trial) {
    const Samples& lead = trial.follows_commands ? trial.commands : trial.joints;
    if (lead.size() == 0) {
      // Rows that could not be read were told one by one.
      const std::string file = (folder / driver).string();
      const bool is_told = std::ranges::any_of(diagnostics_.all(), [&](const Diagnostic& one) {
        return one.severity == Severity::error && one.where.file == file;
      });
      if (!is_told && std::filesystem::exists(folder / driver))
        diagnostics_.error({(folder / driver).string(), 1, 1},
                           "the table has no rows, expected where the joints are");
      return;
    }
    for (long c = 0; c < lead.value.cols(); ++c)
      if (lead.value.col(c).array().isNaN().all())
        diagnostics_.error({(folder / driver).string(), 1, 1},
                           "a joint has no readings at all, expected some or no such column");
    const auto check = [&](const std::string& name, const Samples& samples) {
      if (samples.size() > 0 && samples.time.front() < lead.time.front() - same_time)
        diagnostics_.error({(folder / name).string(), 2, 1},
                           "its first row, at " + io::format_number(samples.time.front()) +
                               " s, is before the first row of " + driver + ", at " +
                               io::format_number(lead.time.front()) +
                               " s: expected none before the arm's log begins");
    };
    check("markers.csv", trial.markers);
    check("torques.csv", trial.torques);
    if (trial.follows_commands) check("joints.csv", trial.joints);
    for (std::size_t c = 0; c < trial.pixels.size(); ++c)
      check("pixels_" + out_.cameras[c].name + ".csv", trial.pixels[c]);
    for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
      check("wrench_" + out_.wrenches[w].name + ".csv", trial.wrenches[w]);
  }

  // What detached is a fruit of the plant.
  void check_plant_event(const MeasuredEvent& event, io::SpecTable& table) const {
    if (event.is_detachment() && index_of(out_.plant().fruits, event.what) < 0)
      table.row_error("no fruit", what_column,
                      "what: " + in_quotes(event.what) + " is no fruit of plant \"" +
                          out_.plant().name + "\", expected the name of one that detached");
  }

  void check_scene_event(const MeasuredEvent& event, io::SpecTable& table) {
    constexpr const char* kinds[] = {"grasped", "released", "detached", "slipped"};
    if (std::ranges::find(kinds, event.event) == std::end(kinds))
      table.row_error(
          "no event", event_column,
          "event: " + in_quotes(event.event) + ", expected grasped, released, detached or slipped");
    if (event.time < 0.0)
      table.row_error("no time", event_column,
                      "the event is before the trial begins, expected a time >= 0");
    const bool known = std::ranges::any_of(out_.plants, [&](const ExperimentPlant& plant) {
      return index_of(plant.file.fruits, event.what) >= 0 ||
             index_of(plant.file.curves, event.what) >= 0;
    });
    if (!known)
      table.row_error(
          "no organ", what_column,
          "what: " + in_quotes(event.what) + " is no fruit or curve of a plant of the scene");
    if (!event.by.empty() && out_.robot.link(event.by) < 0 &&
        (event.event == "grasped" || event.event == "released"))
      table.row_error(
          "no link", by_column,
          "by: " + in_quotes(event.by) + ", expected one of: " + names_of(out_.robot.links));
  }

  const YamlNode& node_;
  Diagnostics& diagnostics_;
  const ReadOptions& options_;
  Experiment out_;
  bool is_scene_ = false;
  bool whole_ = false;  // the plant, or the scene
  bool stopped_ = false;
};

}  // namespace

std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics, const ReadOptions& options) {
  const int before = diagnostics.error_count();
  const std::filesystem::path file =
      std::filesystem::is_directory(path) ? path / "experiment.yaml" : path;
  try {
    const YamlNode node = io::load_yaml(file, diagnostics);
    Reader reader(node, options);
    Experiment experiment = reader.read(file.parent_path());
    if (!reader.was_stopped() && diagnostics.error_count() == before) return experiment;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
