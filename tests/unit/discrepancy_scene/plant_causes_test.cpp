// Effects of the plants' own models as causes of what an arm feels and markers show.
#include "plugins/discrepancy/scene_fit/plant_causes.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/unit/discrepancy_scene/diagnosed_scene.h"

namespace pedicel::discrepancy {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;

class PlantCauses : public DiagnosedScene {
 protected:
  Experiment read() {
    at_.write_all();
    for (const auto& [name, text] : more_) at_.write(name, text);
    return at_.read();
  }
  static std::set<std::string> names(const std::vector<SceneFit>& starts) {
    std::set<std::string> all;
    for (const SceneFit& start : starts) all.insert(start.effect.name);
    return all;
  }
};

TEST_F(PlantCauses, AreWhatAPlantDoesAndNotItsMaterialGripOrInstruments) {
  const std::set<std::string> tried = names(plant_starts(read(), {}));
  EXPECT_THAT(tried, IsSupersetOf({"base_compliance", "weak_segment", "extra_mass", "relaxation",
                                   "leaf_drag"}));
  for (const char* other : {"youngs_modulus", "density", "damping_time", "grip_compliance",
                            "latency", "clamp_play", "contact_friction"})
    EXPECT_THAT(tried, Not(Contains(other)));
}

TEST_F(PlantCauses, SayUnitsAndWhereTheyVanishAsTheirDefinitionsDo) {
  for (const SceneFit& start : plant_starts(read(), {})) {
    if (start.effect.name != "base_compliance") continue;
    EXPECT_FALSE(start.effect.words.contains("plant"));
    EXPECT_EQ(start.free.front().unit, "N m/rad");
    EXPECT_EQ(start.free.front().vanishes, effects::Vanishes::at_infinity);
  }
}

// A branch that leads away from the finger, and carries no marker.
TEST_F(PlantCauses, HavePlacesOnlyWhereSomebodySeesOrTouches) {
  more_["plant.yaml"] =
      "format: pedicel-plant\nversion: 1\nname: bush\n"
      "material: {youngs_modulus: 1.0e9, poisson_ratio: 0.35, density: 700, damping_time: 0.01}\n"
      "sampling: {connect: 0.004, distance: 0.05}\nroot: [0, 0, 0]\ncurves:\n"
      "  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.6]], radius: 0.004}\n"
      "  - {name: branch, interpolation: linear, points: [[0, 0, 0.6], [0.3, 0.3, 0.9]], radius: "
      "0.003}\n";
  std::set<std::string> curves;
  for (const SceneFit& start : plant_starts(read(), {}))
    if (start.effect.place) curves.insert(start.effect.place->curve);
  EXPECT_THAT(curves, ElementsAre("stem"));
}

TEST_F(PlantCauses, SayWhichPlantWhereThereAreSeveralAndLeaveOutTheOneOutOfReach) {
  for (const char* far : {"[3, 3, 0]", "[0.4, -0.06, 0]"}) {
    more_["scene.yaml"] =
        "format: pedicel-scene\nversion: 1\nname: finger\npurpose: A finger pushes a stem.\n"
        "see: The stem bends.\nduration: 1\ndt: 0.001\nplants:\n"
        "  - {name: bush, file: plant.yaml, position: [0.4, 0.03, 0]}\n"
        "  - {name: other, file: plant.yaml, position: " +
        std::string(far) +
        "}\nrobot:\n  {name: arm, file: arm.urdf, joints: {turn: 0}, tool: finger}\n";
    at_.instruments =
        "markers:\n  - {name: tip, plant: bush, curve: stem, at: 1}\n"
        "wrenches:\n  - {name: wrist, link: finger}\n"
        "noise: {position_std: 0.0003, force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
    more_["push/markers.csv"] = "time,tip.x,tip.y,tip.z\n0,0,0,0\n1,0,0,0\n";
    std::set<std::string> plants;
    for (const SceneFit& start : plant_starts(read(), {}))
      if (start.effect.name == "base_compliance") plants.insert(start.effect.words.at("plant"));
    EXPECT_EQ(plants.size(), std::string(far) == "[3, 3, 0]" ? 1u : 2u) << far;
    EXPECT_TRUE(plants.contains("bush"));
  }
}

// Beside what the model has already.
TEST_F(PlantCauses, AreLeftOutWhereTheyCannotBeSimulated) {
  const Experiment plain = read();
  const plant::Effect yields = scene_effect("{name: yield, curvature: 2}", plain);
  EXPECT_THAT(names(plant_starts(plain, {})), Contains("asymmetry"));
  EXPECT_THAT(names(plant_starts(plain, {yields})), Not(Contains("asymmetry")));
}

TEST_F(PlantCauses, ASoftRootIsNamedAloneWithItsStiffness) {
  at_.instruments =
      "markers:\n"
      "  - {name: tip, curve: stem, at: 1}\n"
      "  - {name: middle, curve: stem, at: 0.6}\n"
      "  - {name: nail, link: finger, offset: [0, 0, 0.1]}\n"
      "wrenches:\n  - {name: wrist, link: finger}\n"
      "noise: {position_std: 0.0003, force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}\n";
  // To be quick: half the rate, and the best few are tried and refitted.
  numerics_.dt = 4.0e-3;
  settings_.search.plant_starts = 8;
  settings_.search.tried = 6;
  settings_.search.refits = 2;
  const SceneDiagnosis found = diagnose({"{name: base_compliance, stiffness: 1.0}"});
  EXPECT_EQ(found.verdict.outcome, Outcome::named) << found.text;
  ASSERT_EQ(found.verdict.causes.size(), 1u) << found.text;
  const NamedCause& root = found.verdict.causes.front();
  EXPECT_EQ(root.name, "base_compliance");
  const Estimate& stiffness = root.parameters.at("stiffness").front();
  EXPECT_EQ(stiffness.unit, "N m/rad");
  EXPECT_LT(stiffness.low, 1.0) << found.text;
  EXPECT_GT(stiffness.high, 1.0) << found.text;
  EXPECT_LT(stiffness.high / stiffness.low, 1.5) << found.text;
}

}  // namespace
}  // namespace pedicel::discrepancy
