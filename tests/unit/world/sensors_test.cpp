#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"
#include "engine/world/settings.h"

namespace pedicel::world {
namespace {

using ::testing::HasSubstr;

const std::string head =
    "format: pedicel-scene\nversion: 1\npurpose: a test\nsee: nothing\nduration: 1\nseed: 3\n"
    "plants: [{name: wood, built_in: forest}]\n"
    "bodies: [{name: ball, sphere: {radius: 0.02}}]\n"
    "loads: [{fruit: wood_0/a, force: [0, 0, -2], to: 1}]\n";

Scene read(const std::string& more) {
  Diagnostics diagnostics;
  auto scene = parse_scene(head + more, "test.scene.yaml", diagnostics);
  EXPECT_TRUE(scene) << diagnostics.text();
  return scene ? *scene : Scene{};
}

std::string fault_of(const std::string& more) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_scene(head + more, "test.scene.yaml", diagnostics));
  return diagnostics.text();
}

const std::string views =
    "cameras:\n"
    "  - {name: a, eye: [1, 0, 1], size: [320, 240], sensors: [rgb, depth], rate: 20,\n"
    "     noise: {depth_std: 0.002, latency: 0.05}}\n"
    "  - {name: b, position: [0, -1, 0.5], orientation: [-0.70710678118654757, 0, 0, "
    "0.70710678118654757], focal: 300, size: [400, 300]}\n"
    "look: {sun: 0.5, leaf_hue: 0.2}\n"
    "vary:\n"
    "  look.exposure: {distribution: uniform, low: 0.8, high: 1.2}\n"
    "  bodies.ball.position.x: {distribution: normal, mean: 0, deviation: 0.1, high: 1}\n"
    "  dt: {distribution: choice, values: [0.001, 0.002]}\n";

TEST(SceneSensors, AreReadAsTheyStand) {
  const Scene scene = read(views);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_THAT(scene.cameras[0].sensors, ::testing::ElementsAre(Sensor::rgb, Sensor::depth));
  EXPECT_EQ(scene.cameras[0].rate, 20.0);
  EXPECT_EQ(scene.cameras[0].noise.depth_std, 0.002);
  EXPECT_EQ(scene.cameras[0].noise.latency, 0.05);
  // Its frame's z points along Y, its y down.
  const SceneCamera& turned = scene.cameras[1];
  EXPECT_LT((turned.target - Vec3(0, 0, 0.5)).norm(), 1e-9);
  EXPECT_LT((turned.up - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(turned.field_of_view, 2.0 * std::atan(150.0 / 300.0), 1e-12);
  EXPECT_EQ(scene.look.sun, 0.5);
  EXPECT_EQ(scene.vary.size(), 3u);
}

TEST(SceneSensors, AreWrittenAsTheyWereRead) {
  const Scene scene = read(views);
  Diagnostics diagnostics;
  const std::string text = scene_text(scene, {});
  const auto again = parse_scene(text, "test.scene.yaml", diagnostics);
  ASSERT_TRUE(again) << diagnostics.text() << text;
  EXPECT_EQ(scene_text(*again, {}), text);
  EXPECT_THAT(text, HasSubstr("look: {sun: 0.5, leaf_hue: 0.2}"));
  EXPECT_EQ(again->look, scene.look);
  EXPECT_EQ(draw(again->vary, 5), draw(scene.vary, 5));
  EXPECT_LT((again->cameras[1].up - scene.cameras[1].up).norm(), 1e-9);
}

TEST(SceneSensors, FaultsSayWhatWasExpected) {
  const auto camera = [](const std::string& more) {
    return fault_of("cameras: [{name: a, eye: [1, 0, 1], " + more + "}]\n");
  };
  EXPECT_THAT(camera("sensors: [smell]"), HasSubstr("smell"));
  EXPECT_THAT(camera("sensors: [rgb, rgb]"), HasSubstr("comes twice"));
  EXPECT_THAT(camera("noise: {depth_std: -1}"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(camera("noise: {haze: 1}"), HasSubstr("unknown key \"haze\""));
  EXPECT_THAT(camera("size: [8, 8]"), HasSubstr("size"));
  EXPECT_THAT(camera("fov: 1, focal: 200"), HasSubstr("fov or focal"));
  EXPECT_THAT(camera("focal: [200, 300]"), HasSubstr("two equal ones"));
  EXPECT_THAT(camera("orientation: [0, 0, 0, 1]"), HasSubstr("not both"));
  EXPECT_THAT(fault_of("wrenches: [{name: w, link: hand}]\n"), HasSubstr("has no robot"));
  EXPECT_THAT(fault_of("look: {sun: 9}\n"), HasSubstr("between 0 and 4"));
}

TEST(SceneSensors, WhatVariesIsCheckedWithItsPlace) {
  EXPECT_THAT(fault_of("vary:\n  look.sun: {distribution: uniform, low: 5, high: 6}\n"),
              ::testing::AllOf(HasSubstr("test.scene.yaml:11:"), HasSubstr("look.sun")));
  EXPECT_THAT(fault_of("vary:\n  cameras.none.fov: {low: 0.5, high: 1}\n"),
              HasSubstr("cameras.NAME.fov"));
}

TEST(DrawnScene, IsTheSameForTheSameSeedAndWhatIsSetByHandStays) {
  Scene scene = read(views);
  const Scene drawn = drawn_scene(scene);
  EXPECT_TRUE(drawn.vary.empty());
  EXPECT_EQ(drawn.bodies[0].pose.position, drawn_scene(scene).bodies[0].pose.position);
  EXPECT_NE(drawn.look.exposure, 1.0);
  scene.seed = 4;
  EXPECT_NE(drawn_scene(scene).look.exposure, drawn.look.exposure);
  scene.seed = 3;
  apply_override(scene, "look.exposure", "2");
  const Scene held = drawn_scene(scene);
  EXPECT_EQ(held.look.exposure, 2.0);
  // The others are drawn as before.
  EXPECT_EQ(held.bodies[0].pose.position, drawn.bodies[0].pose.position);
}

TEST(PlaceSettings, PutThingsWhereTheySay) {
  Scene scene = read(views);
  const auto set = [&](const char* key, const char* value) { apply_override(scene, key, value); };
  set("plants.wood.position.y", "0.3");
  set("plants.wood.yaw", "1.5");
  set("bodies.ball.position.z", "0.7");
  set("cameras.a.eye.x", "2");
  set("cameras.a.fov", "0.4");
  set("cameras.a.noise.latency", "0.07");
  EXPECT_EQ(scene.plants[0].pose.position, Vec3(0, 0.3, 0));
  EXPECT_NEAR(scene.plants[0].pose.rotation.angularDistance(Quat::Identity()), 1.5, 1e-9);
  EXPECT_EQ(scene.bodies[0].pose.position.z(), 0.7);
  EXPECT_EQ(scene.cameras[0].eye, Vec3(2, 0, 1));
  EXPECT_EQ(scene.cameras[0].field_of_view, 0.4);
  EXPECT_EQ(scene.cameras[0].noise.latency, 0.07);
  EXPECT_EQ(scene.cameras[0].noise.depth_std, 0.002);  // as the file says
  scene.instruments.emplace_back(instrument_kind("wrench")).name = "wrist";
  set("wrenches.wrist.noise.force_std", "0.3");
  EXPECT_EQ(scene.instruments[0].noise.sizes[0].std, 0.3);
  // A key of the plant itself stays one.
  set("plants.wood.material.density", "500");
  EXPECT_EQ(scene.plants[0].set.back().key, "material.density");
  for (const auto& [key, value] :
       {std::pair("plants.wood.position.x", "far"), std::pair("bodies.none.yaw", "1"),
        std::pair("look.none", "1"), std::pair("cameras.a.fov", "9"), std::pair("robot.yaw", "1"),
        std::pair("cameras.a.noise.haze", "1"), std::pair("cameras.a.noise.latency", "-1"),
        std::pair("wrenches.wrist.noise.latency", "late"),
        std::pair("wrenches.none.noise.latency", "0")})
    EXPECT_THROW(set(key, value), UsageError) << key;
}

TEST(PlaceSettings, LoadsTurnAndKeepTheirSize) {
  Scene scene = read("");
  apply_override(scene, "loads.angle", "1.5707963267948966");
  EXPECT_LT((scene.loads[0].force - Vec3(2, 0, 0)).norm(), 1e-9);
  apply_override(scene, "loads.azimuth", "1.5707963267948966");
  EXPECT_LT((scene.loads[0].force - Vec3(0, 2, 0)).norm(), 1e-9);
  apply_override(scene, "loads.angle", "0");
  EXPECT_LT((scene.loads[0].force - Vec3(0, 0, -2)).norm(), 1e-9);
  apply_override(scene, "loads.angle", "3.141592653589793");
  EXPECT_LT((scene.loads[0].force - Vec3(0, 0, 2)).norm(), 1e-9);
}

}  // namespace
}  // namespace pedicel::world
