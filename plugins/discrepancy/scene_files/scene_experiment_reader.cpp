#include "plugins/discrepancy/scene_files/scene_experiment_reader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/io/csv.h"
#include "engine/io/described_map.h"
#include "engine/robot/kinematics.h"
#include "engine/world/scene_reader.h"
#include "engine/world/settings.h"
#include "plugins/discrepancy/scene/camera.h"
#include "plugins/discrepancy/scene/run_effects.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_files/scene_experiment_keys.h"
#include "plugins/discrepancy/scene_files/scene_tables.h"
#include "plugins/plant/effect_reader.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::discrepancy {

namespace {

using io::DescribedMap;
using io::KeyType;
using io::Told;
using io::YamlNode;

/// Rows of all tables of a trial, so that no folder fills the memory.
constexpr int most_trials = 1000;
constexpr std::size_t most_markers = 1000, most_cameras = 100, most_wrenches = 100;
constexpr double same_time = 1.0e-9;  // s

template <class Items>
int index_of(const Items& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

template <class Items>
std::string names_of(const Items& items) {
  std::string names;
  for (const auto& item : items) names += (names.empty() ? "" : ", ") + item.name;
  return names.empty() ? "none" : names;
}

const io::KeyList& experiment_list() {
  const Told none{"none"};
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
        .otherwise = none,
        .sentence = "what it is, for people"},
       {.name = "scene",
        .type = KeyType::path,
        .sentence = "the nominal scene, in place of `plant`"},
       {.name = "source",
        .type = KeyType::word,
        .otherwise = Told{"measured"},
        .words = {"measured", "run"},
        .sentence =
            "`run`: a log of a run of the scene by this program, whose step, mesh and contact "
            "are the run's"},
       {.name = "markers",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_markers),
        .sentence = "measured points of plants and of the robot"},
       {.name = "cameras",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_cameras),
        .sentence = "pinholes that saw the markers"},
       {.name = "wrenches",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_wrenches),
        .sentence = "sensors of force and moment in the arm"},
       {.name = "noise",
        .type = KeyType::map,
        .otherwise = Told{"from the data"},
        .sentence = "known noise of the instruments"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = none,
        .sentence = "known effects of every trial, of scenes and of plants"},
       {.name = "trials",
        .type = KeyType::list,
        .form = "one or more, at most " + std::to_string(most_trials),
        .sentence = "what was done and measured"}}};
  return keys;
}

io::Key plant_key() {
  return {.name = "plant",
          .type = KeyType::text,
          .otherwise = Told{"the only one"},
          .form = "a plant of the scene",
          .sentence = "where it sits"};
}

const io::KeyList& marker_list() {
  static const io::KeyList keys{
      "marker",
      "a marker",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "name of the marker"},
       plant_key(),
       {.name = "fruit",
        .type = KeyType::text,
        .otherwise = Told{"on a stem"},
        .form = "a fruit of the plant",
        .sentence = "in a fruit's centre, in place of `curve` and `at`"},
       {.name = "link",
        .type = KeyType::text,
        .otherwise = Told{"on a plant"},
        .form = "a link of the robot",
        .sentence = "on the robot, in place of a plant"},
       {.name = "offset",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = SceneMarker{}.offset_L,
        .sentence = "in the link's frame"}},
      "",
      {&plant::place_keys()}};
  return keys;
}

const io::KeyList& camera_list() {
  static const io::KeyList keys{
      "camera",
      "a camera",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "names its tables"},
       {.name = "position", .type = KeyType::vector, .unit = "m", .sentence = "where it is"},
       {.name = "orientation",
        .type = KeyType::rotation,
        .otherwise = io::Needed{},
        .sentence = "turns its frame into the world's: x right, y down, z forward"},
       {.name = "focal",
        .type = KeyType::numbers,
        .unit = "px",
        .bounds = {1.0e-3, 1.0e7},
        .form = "two",
        .sentence = "focal lengths"},
       {.name = "centre",
        .type = KeyType::numbers,
        .unit = "px",
        .otherwise = Told{"the middle"},
        .form = "two",
        .sentence = "principal point"},
       {.name = "size",
        .type = KeyType::numbers,
        .unit = "px",
        .otherwise = Told{"`[" + std::to_string(Camera{}.size[0]) + ", " +
                          std::to_string(Camera{}.size[1]) + "]`"},
        .bounds = {1.0, 1.0e5},
        .form = "two",
        .sentence = "width and height"},
       {.name = "distortion",
        .type = KeyType::numbers,
        .unit = "1",
        .otherwise = Told{"none"},
        .bounds = {-1.0e3, 1.0e3},
        .form = "five",
        .sentence = "Brown's k1 k2 p1 p2 k3"},
       {.name = "eye",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = Told{"none"},
        .sentence = "where it is, in place of `position`, `orientation` and `focal`"},
       {.name = "target",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = Told{"needed beside `eye`"},
        .form = "apart from `eye`",
        .sentence = "where it looks"},
       {.name = "fov",
        .unit = "rad",
        .otherwise = Told{"needed beside `eye`"},
        .bounds = {1.0e-3, 3.1},
        .sentence = "vertical field of view"}}};
  return keys;
}

const io::KeyList& wrench_list() {
  static const io::KeyList keys{
      "wrench",
      "a wrench",
      {{.name = "name", .type = KeyType::text, .form = "once", .sentence = "names its tables"},
       {.name = "link",
        .type = KeyType::text,
        .form = "a link of the robot",
        .sentence = "whose wrench it is"},
       {.name = "tared",
        .type = KeyType::flag,
        .otherwise = WrenchSensor{}.tared,
        .sentence = "less its mean over the first " + io::format_number(tare_time) + " s"}}};
  return keys;
}

const io::KeyList& noise_list() {
  const auto deviation = [](const char* name, const char* unit, const char* sentence) {
    return io::Key{.name = name,
                   .unit = unit,
                   .otherwise = Told{"estimated"},
                   .bounds = io::positive,
                   .sentence = sentence};
  };
  static const io::KeyList keys{"noise",
                                "noise",
                                {deviation("position_std", "m", "of a marker's axis"),
                                 deviation("pixel_std", "px", "of an image point's axis"),
                                 deviation("force_std", "N", "of a wrench's force"),
                                 deviation("moment_std", "N m", "of a wrench's moment"),
                                 deviation("joint_std", "rad or m", "of an encoder"),
                                 deviation("torque_std", "N m or N", "of a motor's torque")}};
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
        .otherwise = SceneTrial{}.clock,
        .sentence = "when the trial began, since the first"},
       {.name = "masses",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known masses that hang on plants in this trial"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known effects of this trial"},
       {.name = "robot", .type = KeyType::map, .sentence = "what drives the arm"},
       {.name = "plants",
        .type = KeyType::map,
        .otherwise = Told{"as the scene says"},
        .form = "names of plants with places",
        .sentence = "places of plants that stood elsewhere"}}};
  return keys;
}

const io::KeyList& follows_list() {
  static const io::KeyList keys{
      "follows",
      "robot",
      {{.name = "follows",
        .type = KeyType::word,
        .words = {"joints", "commands"},
        .sentence = "encoders that are believed, or a controller that is told"}},
      "robot"};
  return keys;
}

const io::KeyList& mass_list() {
  static const io::KeyList keys{
      "mass",
      "a mass",
      {{.name = "mass", .unit = "kg", .bounds = io::positive, .sentence = "of one of them"},
       plant_key()},
      "masses",
      {&plant::place_keys()}};
  return keys;
}

const io::KeyList& moved_list() {
  static const io::KeyList keys{"moved",
                                "a plant's place",
                                {{.name = "position",
                                  .type = KeyType::vector,
                                  .unit = "m",
                                  .otherwise = Told{"the scene's"},
                                  .sentence = "of one of them"},
                                 {.name = "orientation",
                                  .type = KeyType::rotation,
                                  .otherwise = Told{"the scene's"},
                                  .sentence = "of one of them"}},
                                "plants"};
  return keys;
}

class SceneReader {
 public:
  SceneReader(const YamlNode& node, const std::filesystem::path& instead)
      : node_(node), diagnostics_(node.diagnostics()), instead_(instead) {}

  SceneExperiment read(const std::filesystem::path& folder) {
    out_.folder = folder;
    DescribedMap map(node_, experiment_list());
    if (!node_.is_map() || !map.has_format()) return {};
    out_.title = map.text("title");
    out_.is_run = map.has("source") && map.choice("source") == "run";
    read_scene(map);
    // Without a whole scene names cannot be looked up: its own faults are enough.
    if (!whole_) return {};
    read_each(map, "cameras", most_cameras, out_.cameras,
              [&](const YamlNode& node) { return read_camera(node); });
    read_each(map, "wrenches", most_wrenches, out_.wrenches,
              [&](const YamlNode& node) { return read_wrench_sensor(node); });
    read_each(map, "markers", most_markers, out_.markers,
              [&](const YamlNode& node) { return read_marker(node); });
    if (const auto noise = map.optional("noise")) read_noise(*noise);
    if (const auto trials = map.required("trials")) read_trials(*trials);
    // Afterwards, because they may name trials.
    out_.scene_effects = scene_file_effects(out_, diagnostics_);
    out_.effects = read_effects(map);
    map.finish();
    return std::move(out_);
  }

 private:
  void read_scene(DescribedMap& map) {
    const auto node = map.required("scene");
    if (!node) return;
    out_.scene_path = node->text("scene");
    if (out_.scene_path.empty()) return;
    std::filesystem::path file = out_.folder / out_.scene_path;
    if (!instead_.empty()) {
      file = instead_;
      out_.scene_path = instead_.filename();
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

  SceneMarker read_marker(const YamlNode& node) {
    DescribedMap map(node, marker_list());
    SceneMarker marker;
    marker.name = map.text("name");
    if (const auto link = map.optional("link")) {
      marker.link = link_of(*link, "link");
      marker.offset_L = map.vector("offset");
    } else {
      marker.plant = plant_of(map);
      if (const auto fruit = map.optional("fruit")) {
        marker.fruit = fruit_of(*fruit, marker.plant);
      } else {
        marker.place = place(map, marker.plant);
      }
    }
    map.finish();
    return marker;
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
    const plant::PlantFile& file = out_.plants[static_cast<std::size_t>(plant)].file;
    if (!found.curve.empty() && file.curve_index(found.curve) < 0)
      diagnostics_.error(
          found.where,
          "curve \"" + found.curve + "\" is unknown, expected one of: " + names_of(file.curves));
    return found;
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
    SceneNoise& noise = out_.noise;
    const std::pair<const char*, std::optional<double>*> all[] = {
        {"position_std", &noise.position_std}, {"pixel_std", &noise.pixel_std},
        {"force_std", &noise.force_std},       {"moment_std", &noise.moment_std},
        {"joint_std", &noise.joint_std},       {"torque_std", &noise.torque_std}};
    for (const auto& [key, value] : all) *value = map.optional_number(key);
    map.finish();
  }

  std::vector<plant::Effect> read_effects(DescribedMap& map) {
    std::vector<plant::Effect> effects;
    for (const YamlNode& node : map.list("effects"))
      effects.push_back(read_scene_effect(node, out_));
    return effects;
  }

  void read_trials(const YamlNode& list) {
    for (const YamlNode& node : list.list("trials")) {
      if (out_.trials.size() == most_trials)
        return node.error("trials: the list goes on, expected at most " +
                          std::to_string(most_trials));
      SceneTrial trial = read_trial(node);
      if (!trial.name.empty() && index_of(out_.trials, trial.name) >= 0)
        node.error("trial \"" + trial.name + "\" appears twice, expected each name once");
      out_.trials.push_back(std::move(trial));
    }
    if (list.is_list() && out_.trials.empty()) list.error("no trials, expected at least one");
  }

  SceneTrial read_trial(const YamlNode& node) {
    DescribedMap map(node, trial_list());
    SceneTrial trial;
    trial.name = map.text("name");
    const auto folder = map.required("folder");
    if (folder) trial.folder = folder->text("folder");
    if (map.has("use"))
      trial.use = map.choice("use") == "fit" ? Trial::Use::fit : Trial::Use::check;
    trial.clock = map.number("clock");
    for (const YamlNode& item : map.list("masses")) trial.masses.push_back(read_mass(item));
    if (const auto robot = map.required("robot")) {
      DescribedMap follows(*robot, follows_list());
      trial.follows_commands = follows.choice("follows") == "commands";
      follows.finish();
    }
    if (const auto plants = map.optional("plants")) read_poses(*plants, trial);
    trial.effects = read_effects(map);
    map.finish();
    if (trial.folder.empty()) return trial;
    const std::filesystem::path at = out_.folder / trial.folder;
    if (!std::filesystem::is_directory(at))
      folder->error("folder " + at.string() + " does not exist, expected the trial's tables in it");
    else
      read_tables(at, trial);
    return trial;
  }

  SceneTrial::Mass read_mass(const YamlNode& node) {
    DescribedMap map(node, mass_list());
    SceneTrial::Mass mass;
    mass.plant = plant_of(map);
    mass.mass.place = place(map, mass.plant);
    mass.mass.mass = map.number("mass");
    map.finish();
    return mass;
  }

  void read_poses(const YamlNode& node, SceneTrial& trial) {
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

  void read_tables(const std::filesystem::path& folder, SceneTrial& trial) {
    const auto there = [&](const std::string& name) {
      return std::filesystem::exists(folder / name);
    };
    // One of the two drives the arm; the other may be there, too.
    const std::string driver = trial.follows_commands ? "commands.csv" : "joints.csv";
    if (there("joints.csv") || !trial.follows_commands)
      trial.joints = read_joint_table(folder / "joints.csv", out_.robot, io::Quantity::angle,
                                      trial.joint_columns, diagnostics_);
    if (there("commands.csv") || trial.follows_commands)
      trial.commands = read_joint_table(folder / "commands.csv", out_.robot, io::Quantity::angle,
                                        trial.command_columns, diagnostics_);
    if (there("torques.csv"))
      trial.torques = read_joint_table(folder / "torques.csv", out_.robot, io::Quantity::moment,
                                       trial.torque_columns, diagnostics_);
    if (there("markers.csv"))
      trial.markers = read_scene_markers(folder / "markers.csv", out_.markers, diagnostics_);
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
    if (there("events.csv"))
      trial.events = read_events(
          folder / "events.csv", diagnostics_,
          [&](const MeasuredEvent& event, io::SpecTable& table) { check_event(event, table); });
    check_strangers(folder);
    check_begin(folder, driver, trial);
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
                   const SceneTrial& trial) {
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

  void check_event(const MeasuredEvent& event, io::SpecTable& table) {
    constexpr const char* kinds[] = {"grasped", "released", "detached", "slipped"};
    if (std::ranges::find(kinds, event.event) == std::end(kinds))
      table.row_error(
          "no event", event_column,
          "event: " + in_quotes(event.event) + ", expected grasped, released, detached or slipped");
    if (event.time < 0.0)
      table.row_error("no time", event_column,
                      "the event is before the trial begins, expected a time >= 0");
    const bool known = std::ranges::any_of(out_.plants, [&](const ScenePlantFile& plant) {
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
  const std::filesystem::path& instead_;
  SceneExperiment out_;
  bool whole_ = false;
};

std::filesystem::path file_of(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) ? path / "experiment.yaml" : path;
}

}  // namespace

bool is_scene_experiment(const std::filesystem::path& path) {
  Diagnostics ignored;
  try {
    const YamlNode node = io::load_yaml(file_of(path), ignored);
    return node.is_map() && node.raw()["scene"] && node.raw()["format"] &&
           node.raw()["format"].IsScalar() && node.raw()["format"].Scalar() == "pedicel-experiment";
  } catch (const std::exception&) {
    return false;
  }
}

std::vector<const io::KeyList*> scene_experiment_keys() {
  return {&experiment_list(), &marker_list(), &plant::place_keys(), &camera_list(), &wrench_list(),
          &noise_list(),      &trial_list(),  &follows_list(),      &mass_list(),   &moved_list()};
}

std::optional<SceneExperiment> read_scene_experiment(const std::filesystem::path& path,
                                                     Diagnostics& diagnostics,
                                                     const std::filesystem::path& scene) {
  const int before = diagnostics.error_count();
  const std::filesystem::path file = file_of(path);
  try {
    const YamlNode node = io::load_yaml(file, diagnostics);
    SceneExperiment experiment = SceneReader(node, scene).read(file.parent_path());
    if (diagnostics.error_count() == before) return experiment;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
