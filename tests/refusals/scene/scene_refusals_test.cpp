// Each rule of the scene reader with the smallest scene that breaks it: where the error stands, and
// its words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "engine/world/scene_reader.h"

namespace pedicel::world {
namespace {

using ::testing::HasSubstr;

const std::string head =
    "format: pedicel-scene\n"
    "version: 1\n"
    "purpose: p\n"
    "see: s\n"
    "duration: 1\n";

struct Case {
  std::string name;
  std::string body;  ///< follows the head: its first line is line 6
  std::string expected;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class SceneRefusal : public ::testing::TestWithParam<Case> {};

TEST_P(SceneRefusal, IsDiagnosedWithPlaceAndWords) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(head + GetParam().body, "s.scene.yaml", diagnostics);
  EXPECT_FALSE(scene);
  EXPECT_THAT(diagnostics.text(), HasSubstr(GetParam().expected));
}

const Case cases[] = {
    {"unknown_key", "durration: 3\n",
     "s.scene.yaml:6:1: error: unknown key \"durration\" in a scene"},
    {"dt_zero", "dt: 0\n", "6:5: error: dt is \"0\", expected a number between 1e-07 and 1"},
    {"dt_nan", "dt: .nan\n", "dt is \".nan\""},
    {"seed_fraction", "seed: 1.5\n", "seed is \"1.5\", expected a whole number"},
    {"threads_zero", "threads: 0\n", "threads is \"0\", expected a whole number between 1 and 256"},
    {"gravity_short", "gravity: [0, 0]\n", "expected [x, y, z]"},
    {"settings_list", "rods: [1]\n", "rods: expected keys with values"},
    {"plant_without_name", "plants: [{built_in: forest}]\n", "missing key \"name\""},
    {"plant_name_with_slash", "plants: [{name: a/b, built_in: forest}]\n",
     "expected a name without \"/\" and \".\""},
    {"plant_without_source", "plants: [{name: a}]\n",
     "expected exactly one of file, mtg and built_in"},
    {"plant_with_two_sources", "plants: [{name: a, built_in: forest, file: CMakeLists.txt}]\n",
     "expected exactly one of file, mtg and built_in"},
    {"plant_file_absent", "plants: [{name: a, file: none.plant.yaml}]\n",
     "6:26: error: file: none.plant.yaml is not there, expected a file"},
    {"fallback_alone", "plants: [{name: a, built_in: forest, fallback: s}]\n",
     "fallback: expected only beside \"optional: true\""},
    {"plant_names_twice", "plants: [{name: a, built_in: forest}, {name: a, built_in: forest}]\n",
     "name \"a\" is used twice in plants"},
    {"repeat_count",
     "plants: [{name: a, built_in: forest, repeat: {count: [1], spacing: [1, 1]}}]\n",
     "repeat.count: expected [along X, along Y]"},
    {"repeat_spacing",
     "plants: [{name: a, built_in: forest, repeat: {count: [1, 2], spacing: [1]}}]\n",
     "repeat.spacing: expected [along X, along Y] in m"},
    {"repeat_spacing_negative",
     "plants: [{name: a, built_in: forest, repeat: {count: [1, 2], spacing: [1, -1]}}]\n",
     "repeat.spacing is \"-1\", expected a number > 0"},
    {"robot_without_file", "robot: {name: r}\n", "missing key \"file\", expected in robot"},
    {"robot_control", "robot: {file: s, control: magic}\n",
     "control is \"magic\", expected one of: position, velocity, torque"},
    {"gripper_force_negative", "robot: {file: s, gripper: j, gripper_force: -1}\n",
     "gripper_force is \"-1\", expected a number between 0 and 1000000"},
    {"gripper_force_huge", "robot: {file: s, gripper: j, gripper_force: 2e6}\n",
     "gripper_force is \"2e6\", expected a number between 0 and 1000000"},
    {"gripper_force_alone", "robot: {file: s, gripper_force: 5}\n",
     "gripper_force: expected only beside the joint that grips, as \"gripper\""},
    {"robot_joints", "robot: {file: s, joints: [1]}\n",
     "joints: expected joint names with start values"},
    {"waypoint_without_place",
     "robot: {file: s, waypoints: [{time: 0, orientation: [0, 0, 0, 1]}]}\n",
     "missing key \"position\""},
    {"waypoint_without_orientation",
     "robot: {file: s, waypoints: [{time: 0, position: [0, 0, 0]}]}\n",
     "the first waypoint: expected an orientation or facing"},
    {"waypoint_order",
     "robot: {file: s, waypoints: [{time: 1, position: [0, 0, 0], orientation: [0, 0, 0, 1]},"
     " {time: 1, position: [0, 0, 0]}]}\n",
     "time: expected later than the waypoint before"},
    {"waypoint_two_orientations",
     "robot: {file: s, waypoints: [{time: 0, position: [0, 0, 0], orientation: [0, 0, 0, 1],"
     " facing: {approach: [1, 0, 0]}}]}\n",
     "expected orientation or facing, not both"},
    {"waypoint_zero_orientation",
     "robot: {file: s, waypoints: [{time: 0, position: [0, 0, 0], orientation: [0, 0, 0, 0]}]}\n",
     "orientation has length 0"},
    {"facing_parallel",
     "robot: {file: s, waypoints: [{time: 0, position: [0, 0, 0],"
     " facing: {approach: [0, 2, 0]}}]}\n",
     "expected approach and across that are not parallel"},
    {"anchor_empty", "robot: {file: s, waypoints: [{time: 0, at: {}}]}\n",
     "at: expected {fruit: NAME}, {body: NAME}, {plant: NAME} or {tool: true}"},
    {"anchor_two", "robot: {file: s, waypoints: [{time: 0, at: {body: a, plant: b}}]}\n",
     "at: expected one thing only"},
    {"recorded_without_joints", "robot: {file: s, recorded: [{time: 0}]}\n",
     "missing key \"joints\", expected in a recorded place"},
    {"recorded_no_joints", "robot: {file: s, recorded: [{time: 0, joints: []}]}\n",
     "joints: expected one number a joint"},
    {"recorded_order",
     "robot: {file: s, recorded: [{time: 1, joints: [0]}, {time: 1, joints: [0]}]}\n",
     "6:53: error: time: expected later than the recorded place before"},
    {"recorded_counts",
     "robot: {file: s, recorded: [{time: 0, joints: [0]}, {time: 1, joints: [0, 1]}]}\n",
     "joints: expected as many as at the first recorded place"},
    {"recorded_before_zero", "robot: {file: s, recorded: [{time: -1, joints: [0]}]}\n",
     "time is \"-1\""},
    {"trajectory_and_waypoints",
     "robot: {file: s, trajectory: t.csv, waypoints: [{time: 0, position: [0, 0, 0],"
     " orientation: [0, 0, 0, 1]}]}\n",
     "robot: expected trajectory or waypoints, not both"},
    {"body_without_shape", "bodies: [{name: a}]\n",
     "expected exactly one of box, sphere, cylinder, capsule and tray"},
    {"body_flat", "bodies: [{name: a, box: [1, 1, 0]}]\n", "box: expected three numbers > 0"},
    {"body_name_of_two_lines", "bodies: [{name: \"x\\ny\", sphere: {radius: 1}}]\n",
     "6:10: error: name \"x\\ny\" in bodies has a line end or another control character"},
    {"body_far", "bodies: [{name: a, sphere: {radius: 1}, position: [1e300, 0, 0]}]\n",
     "position: expected three numbers, each between -10000000 and 10000000, in m"},
    {"body_heavy", "bodies: [{name: a, sphere: {radius: 1}, mass: 1e300}]\n",
     "mass is \"1e300\", expected a number between 0 and 1e+09"},
    {"body_huge", "bodies: [{name: a, sphere: {radius: 1e300}}]\n",
     "radius is \"1e300\", expected a number > 0 and at most 10000000"},
    {"body_long", "bodies: [{name: a, box: [1, 1e300, 1]}]\n",
     "box: expected three numbers > 0 and at most"},
    {"ground_high", "ground: {height: 1e300}\n",
     "height is \"1e300\", expected a number between -10000000 and 10000000"},
    {"ground_restitution", "ground: {restitution: 1.2}\n",
     "restitution is \"1.2\", expected a number between 0 and 1"},
    {"camera_far", "cameras: [{name: c, eye: [1e300, 0, 0]}]\n",
     "eye: expected three numbers, each between"},
    {"body_radius", "bodies: [{name: a, sphere: {radius: -1}}]\n",
     "radius is \"-1\", expected a number > 0"},
    {"body_mass", "bodies: [{name: a, box: [1, 1, 1], mass: -2}]\n",
     "mass is \"-2\", expected a number between 0 and 1e+09"},
    {"body_look", "bodies: [{name: a, box: [1, 1, 1], look: pink}]\n",
     "look is \"pink\", expected one of: steel, wood"},
    {"body_names_twice", "bodies: [{name: a, box: [1, 1, 1]}, {name: a, box: [1, 1, 1]}]\n",
     "name \"a\" is used twice in bodies"},
    {"tray_walls", "bodies: [{name: a, tray: {size: [1, 1, 0.1], wall: 0.05}}]\n",
     "tray: expected walls thinner than half its size"},
    {"load_order",
     "plants: [{name: a, built_in: forest}]\nloads: [{fruit: a/f, force: [0, 0, 1], from: 2, to: "
     "1}]\n",
     "a load: expected from < to"},
    {"load_target", "loads: [{fruit: f, force: [0, 0, 1], to: 1}]\n",
     "fruit \"f\": expected PLANT/FRUIT, a plant of this scene"},
    {"camera_without_length", "cameras: [{name: a, eye: [0, 0, 0]}]\n",
     "a camera: expected eye and target to be apart"},
    {"camera_follow", "cameras: [{name: a, eye: [1, 0, 0], follow: {body: tray}}]\n",
     "body \"tray\": there is none of that name"},
    {"camera_follow_tool", "cameras: [{name: a, eye: [1, 0, 0], follow: {tool: true}}]\n",
     "tool: the scene has no robot"},
    {"camera_unknown", "pictures: [{at: 1, camera: far}]\n",
     "camera \"far\": there is none of that name"},
    {"picture_when", "pictures: [{at: teatime}]\n",
     "at (a time in s, before_detachment, after_detachment or end) is \"teatime\""},
    {"video_size", "video: {size: [640]}\n", "size: expected [width, height] in pixels"},
    {"sweep_values", "sweep: {set: detach.stretch, values: [1]}\n",
     "values: expected at least two"},
    {"quantity_unknown", "expect: [{quantity: joy, is: 1}]\n",
     "quantity \"joy\" is unknown, expected one of: detached_count"},
    {"quantity_subject_missing", "expect: [{quantity: detach_time_s, above: 1}]\n",
     "missing key \"fruit\": detach_time_s is measured of a fruit"},
    {"quantity_subject_wrong", "expect: [{quantity: max_penetration_m, fruit: a/b, below: 1}]\n",
     "max_penetration_m is not measured of a fruit"},
    {"expect_without_bound", "expect: [{quantity: detached_count}]\n",
     "expected exactly one of is, between, above, below and with_sweep"},
    {"expect_two_bounds", "expect: [{quantity: detached_count, is: 1, above: 0}]\n",
     "expected exactly one of is, between, above, below and with_sweep"},
    {"expect_between", "expect: [{quantity: detached_count, between: [3, 1]}]\n",
     "between: expected [low, high]"},
    {"expect_sweep_without_sweep", "expect: [{quantity: detached_count, with_sweep: rises}]\n",
     "with_sweep: the scene has no sweep"},
    {"expect_steady_without_share", "expect: [{quantity: detached_count, with_sweep: steady}]\n",
     "missing key \"within\""},
    {"expect_body", "expect: [{quantity: fruit_in, body: tray, is: 1}]\n",
     "body \"tray\": there is none of that name"},
    {"expect_plant", "expect: [{quantity: max_drift_m, plant: oak, below: 1}]\n",
     "plant \"oak\": there is none of that name"},
};

INSTANTIATE_TEST_SUITE_P(Rules, SceneRefusal, ::testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

std::string refusal_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_scene(text, "s.scene.yaml", diagnostics));
  return diagnostics.text();
}

TEST(SceneRefusals, TheHeadIsNeeded) {
  EXPECT_THAT(refusal_of("version: 1\n"), HasSubstr("missing key \"format\""));
  EXPECT_THAT(refusal_of("format: pedicel-plant\nversion: 1\n"),
              HasSubstr("expected pedicel-scene"));
  EXPECT_THAT(refusal_of("format: pedicel-scene\nversion: 2\n"),
              HasSubstr("version is 2, expected 1"));
  EXPECT_THAT(refusal_of("format: pedicel-scene\nversion: 1\nsee: s\nduration: 1\n"),
              HasSubstr("missing key \"purpose\""));
  EXPECT_THAT(refusal_of("format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\n"),
              HasSubstr("missing key \"duration\""));
}

TEST(SceneRefusals, AllFaultsAreShownAtOnce) {
  const std::string text = refusal_of(head + "dt: -1\nseed: x\nbodies: [{name: a}]\n");
  EXPECT_THAT(text, HasSubstr(":6:5:"));
  EXPECT_THAT(text, HasSubstr(":7:7:"));
  EXPECT_THAT(text, HasSubstr(":8:10:"));
}

// What follows from a fault is no fault of its own.
TEST(SceneRefusals, OneFaultIsToldOnce) {
  const std::string plant = head + "plants: [{name: a, built_in: cantilever}]\n";
  for (const std::string body : {"ties: [5]",
                                 "ties: [{organ: a/x}]",
                                 "ties: [{organ: a/x, to_organ: b/x}]",
                                 "ties: [{organ: a/x, to: [0, 0, 1], to_at: 0.5}]",
                                 "wind: {}",
                                 "wind: 5",
                                 "wind: {velocity: fast}",
                                 "cuts: [5]",
                                 "cuts: [{organ: a/x}]",
                                 "cuts: [{organ: a/x, time: 1, by_tool: true}]",
                                 "cameras: [5]",
                                 "cameras: [{name: c}]",
                                 "cameras: [{name: c, eye: [1, 0]}]",
                                 "cameras: [{name: c, eye: [1, 0, 0], focal: 0}]",
                                 "cameras: [{name: c, eye: [1, 0, 0], sensors: 5}]",
                                 "cameras: [{name: c, eye: [1, 0, 0], follow: 5}]",
                                 "wrenches: [5]",
                                 "loads: [5]",
                                 "bodies: [5]",
                                 "bodies: [{name: b}]",
                                 "expect: [5]",
                                 "expect: [{quantity: breaks, is: 0}]",
                                 "pictures: [5]",
                                 "video: 5",
                                 "sweep: 5",
                                 "vary: 5",
                                 "vary: {dt: 5}",
                                 "vary: {dt: {low: 1}}",
                                 "vary: {dt: {distribution: choice}}",
                                 "ground: 5",
                                 "look: 5",
                                 "robot: 5",
                                 "rods: 5",
                                 "coupling: 5",
                                 "gravity: 5"}) {
    const std::string text = refusal_of(plant + body + "\n");
    EXPECT_EQ(std::ranges::count(text, '\n'), 0) << body << "\n" << text;
    EXPECT_THAT(text, HasSubstr("error: ")) << body;
  }
  const std::string text = refusal_of(head + "plants: [5]\n");
  EXPECT_EQ(std::ranges::count(text, '\n'), 0) << text;
}

TEST(SceneRefusals, AKeyTwice) {
  EXPECT_THAT(refusal_of(head + "dt: 0.001\ndt: 0.002\n"), HasSubstr("\"dt\" appears twice"));
}

TEST(SceneRefusals, ListsHaveAnEnd) {
  std::string text = head + "bodies:\n";
  for (int i = 0; i < 10'001; ++i)
    text += "  - {name: b" + std::to_string(i) + ", box: [1, 1, 1]}\n";
  EXPECT_THAT(refusal_of(text),
              HasSubstr(":10007:5: error: bodies: the list goes on, expected at most 10000"));
}

TEST(SceneRefusals, WhatIsNoYamlOrCannotBeRead) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_scene("a: [1\n", "s.scene.yaml", diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("s.scene.yaml:"));
  EXPECT_FALSE(read_scene("none.scene.yaml", diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("none.scene.yaml"));
}

}  // namespace
}  // namespace pedicel::world
