#include "plugins/discrepancy/files/experiment_lists.h"

#include <string>

#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/drive_reader.h"
#include "plugins/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::KeyType;
using io::Told;

constexpr double usual_window = 0.2;  // s

io::Key plant_key() {
  return {.name = "plant",
          .type = KeyType::text,
          .otherwise = Told{"the only one"},
          .form = "a plant of the scene",
          .sentence = "of a scene: where it sits"};
}

}  // namespace

const io::KeyList& experiment_list() {
  const Told none{"none"};
  static const io::KeyList keys{
      "experiment",
      "an experiment",
      {io::format_key("pedicel-experiment"),
       io::version_key(),
       {.name = "title",
        .type = KeyType::text,
        .otherwise = Told{"empty"},
        .sentence = "heads the report"},
       {.name = "plant",
        .type = KeyType::path,
        .otherwise = Told{"a scene"},
        .sentence = "the nominal [plant file](plant_file.md)"},
       {.name = "scene",
        .type = KeyType::path,
        .otherwise = Told{"a single plant"},
        .sentence = "the nominal [scene](scene_file.md) with a robot, in place of `plant`"},
       {.name = "source",
        .type = KeyType::word,
        .otherwise = Told{"measured"},
        .words = {"measured", "run"},
        .sentence = "of a scene, `run`: a log of a run of the scene by this program, whose step, "
                    "mesh and contact "
                    "are the run's"},
       {.name = "markers",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_markers),
        .sentence = "measured points of plants and of the robot; a single plant needs one"},
       {.name = "cameras",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_cameras),
        .sentence = "of a scene: pinholes that saw the markers"},
       {.name = "wrenches",
        .type = KeyType::list,
        .otherwise = none,
        .form = "at most " + std::to_string(most_wrenches),
        .sentence = "of a scene: sensors of force and moment in the arm"},
       {.name = "noise",
        .type = KeyType::map,
        .otherwise = Told{"from the data"},
        .sentence = "known noise of the instruments"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = none,
        .sentence = "known [effects of every trial](effects.md#effects-of-an-experiment); of a "
                    "scene [its own](scene_experiment.md#effects), too"},
       {.name = "trials",
        .type = KeyType::list,
        .form = "one or more, at most " + std::to_string(most_trials),
        .sentence = "what was done and measured"}}};
  return keys;
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
        .sentence = "of a scene: in a fruit's centre, in place of `curve` and `at`"},
       {.name = "link",
        .type = KeyType::text,
        .otherwise = Told{"on a plant"},
        .form = "a link of the robot",
        .sentence = "of a scene: on the robot, in place of a plant"},
       {.name = "offset",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = Marker{}.offset_L,
        .sentence = "of a scene: in the link's frame"}},
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
  const auto deviation = [](const char* name, const char* unit, const char* sentence,
                            const char* otherwise = "estimated") {
    return io::Key{.name = name,
                   .unit = unit,
                   .otherwise = Told{otherwise},
                   .bounds = io::positive,
                   .sentence = sentence};
  };
  static const io::KeyList keys{
      "noise",
      "noise",
      {deviation("position_std", "m", "standard deviation of a marker's axis"),
       deviation("force_std", "N", "standard deviation of a force's axis"),
       deviation("moment_std", "N m", "standard deviation of a moment's axis"),
       deviation("path_std", "m",
                 "standard deviation of an axis of the [paths themselves](#noise-of-paths)",
                 "none"),
       deviation("pixel_std", "px", "of a scene: of an image point's axis"),
       deviation("joint_std", "rad or m", "of a scene: of an encoder"),
       deviation("torque_std", "N m or N", "of a scene: of a motor's torque")}};
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
       {.name = "masses",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known masses that hang on plants in this trial"},
       {.name = "effects",
        .type = KeyType::list,
        .otherwise = Told{"none"},
        .sentence = "known effects of this trial"},
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
       {.name = "drive",
        .type = KeyType::list,
        .otherwise = Told{"of a scene: the robot"},
        .form = "one or more",
        .sentence = "what is known to have been done to a single plant"},
       {.name = "robot",
        .type = KeyType::map,
        .otherwise = Told{"of a single plant: none"},
        .sentence = "what drives the arm"},
       {.name = "plants",
        .type = KeyType::map,
        .otherwise = Told{"as the scene says"},
        .form = "names of plants with places",
        .sentence = "of a scene: places of plants that stood elsewhere"}}};
  return keys;
}

const io::KeyList& follows_list() {
  static const io::KeyList keys{"follows",
                                "robot",
                                {{.name = "follows",
                                  .type = KeyType::word,
                                  .words = {"joints", "commands"},
                                  .sentence = "`joints`: the arm goes where the encoders say; "
                                              "`commands`: a controller is given them"}},
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

std::vector<const io::KeyList*> experiment_keys() {
  std::vector<const io::KeyList*> all = {
      &experiment_list(), &marker_list(), &plant::place_keys(), &camera_list(), &wrench_list(),
      &noise_list(),      &trial_list(),  &follows_list(),      &mass_list(),   &moved_list()};
  for (const io::KeyList* one : drive_keys()) all.push_back(one);
  return all;
}

}  // namespace pedicel::discrepancy
