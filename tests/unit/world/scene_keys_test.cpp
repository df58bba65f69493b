// Keys of scenes are described once: what is described is read, and nothing else.
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "engine/world/variation.h"
#include "tests/support/described_keys.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::world {
namespace {

std::string faults_of_scene(const std::string& text) {
  Diagnostics diagnostics;
  parse_scene("format: pedicel-scene\nversion: 1\n" + text, "s.scene.yaml", diagnostics);
  return diagnostics.text();
}

std::string faults_of_variation(const std::string& text) {
  const TemporaryFolder folder;
  io::write_file_atomically(folder / "v.yaml", "format: pedicel-variation\nversion: 1\n" + text);
  try {
    Variation::read(folder / "v.yaml");
  } catch (const InvalidFile& fault) {
    return fault.what();
  }
  return "";
}

TEST(SceneKeys, EachThatIsDescribedIsRead) {
  const KeyPlaces places = {
      {"scene", {"%"}},
      {"pose", {"bodies: [{%}]"}},
      {"thing", {"cameras: [{follow: {%}}]"}},
      {"plant", {"plants: [{%}]"}},
      {"repeat", {"plants: [{repeat: {%}}]"}},
      {"load", {"loads: [{%}]"}},
      {"tie", {"ties: [{%}]"}},
      {"cut", {"cuts: [{%}]"}},
      {"wind", {"wind: {%}"}},
      {"robot", {"robot: {%}"}},
      {"waypoint", {"robot: {waypoints: [{%}]}", "robot: {waypoints: [{at: {tool: true}, %}]}"}},
      {"facing", {"robot: {waypoints: [{facing: {%}}]}"}},
      {"recorded", {"robot: {recorded: [{%}]}"}},
      {"body", {"bodies: [{%}]"}},
      {"round", {"bodies: [{cylinder: {%}}]"}},
      {"tray", {"bodies: [{tray: {%}}]"}},
      {"ground", {"ground: {%}"}},
      {"camera", {"cameras: [{%}]", "cameras: [{orientation: [0, 0, 0, 1], %}]"}},
      {"wrench", {"wrenches: [{%}]"}},
      {"imu", {"imus: [{%}]"}},
      {"picture", {"pictures: [{%}]"}},
      {"video", {"video: {%}"}},
      {"sweep", {"sweep: {%}"}},
      {"expectation", {"expect: [{%}]", "expect: [{with_sweep: steady, %}]"}},
      {"varied",
       {"vary: {dt: {%}}", "vary: {dt: {distribution: normal, %}}",
        "vary: {dt: {distribution: choice, %}}"}},
      {"variation", {"%"}}};
  expect_every_key_is_read(
      scene_keys(), places, [](const std::string& list, const std::string& text) {
        return list == "variation" ? faults_of_variation(text) : faults_of_scene(text);
      });
}

// What the manual says of a default is what the reader takes.
TEST(SceneKeys, ADefaultIsThatOfTheDescription) {
  Diagnostics diagnostics;
  const auto scene = parse_scene(
      "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\nduration: 1\n"
      "bodies: [{name: b, sphere: {radius: 1}}]\n",
      "s.scene.yaml", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.text();
  const auto described = [](const char* list, const char* key) {
    for (const io::KeyList* one : scene_keys())
      if (one->name == list) return std::get<double>(one->find(key)->otherwise);
    return -1.0;
  };
  EXPECT_EQ(scene->dt, described("scene", "dt"));
  EXPECT_EQ(scene->dt, 1.0 / 240.0);
  EXPECT_EQ(scene->bodies.front().friction, described("body", "friction"));
  EXPECT_EQ(scene->bodies.front().restitution, described("body", "restitution"));
  EXPECT_EQ(scene->name, "s");
}

}  // namespace
}  // namespace pedicel::world
