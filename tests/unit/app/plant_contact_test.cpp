// Plants that touch each other in a scene, what came off them, and strings.
#include <gmock/gmock.h>

#include <algorithm>

#include "plugins/simulation/plants/organ_contacts.h"
#include "plugins/simulation/plants/scene_ties.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

using testing::HasSubstr;

const char* two_stems =
    "plants:\n  - {name: upper, file: upper.plant.yaml}\n  - {name: lower, file: "
    "lower.plant.yaml}\n";

// A soft stem that ends above a stiffer one and carries a fruit, drawn 0.2 mm apart.
void write_crossed(const SceneCase& files) {
  files.write(
      "upper.plant.yaml",
      stem_file("[-0.3, 0, 0.5122]", "[0.05, 0, 0.5122]", 0.006, 1.0e8,
                "fruits:\n  - {name: fruit, curve: stem, at: 1, radius: 0.008, density: 900}\n"));
  files.write("lower.plant.yaml", stem_file("[0, -0.3, 0.5]", "[0, 0.1, 0.5]", 0.006, 2.0e9));
}

double lowest(const simulation::Simulation& sim, int plant) {
  double height = 1.0e9;
  for (const Vec3& position : sim.rods().state(plant).position)
    height = std::min(height, position.z());
  return height;
}

// A load presses the upper one down: apart it sinks past the lower one, touching it is held by it.
TEST(PlantContact, AStemPressesOnAnotherOne) {
  SceneCase files;
  write_crossed(files);
  const std::string scene =
      std::string(two_stems) + "loads:\n  - {fruit: upper/fruit, force: [0, 0, -0.5], to: 10}\n";
  const auto apart = files.simulation(scene);
  const auto touching = files.simulation("coupling: {plant_contact: 1}\n" + scene);
  for (int i = 0; i < 720; ++i) {
    apart->step();
    touching->step();
  }
  EXPECT_TRUE(simulation::organ_contacts(apart->rods()).empty());
  EXPECT_LT(lowest(*apart, 0), 0.49);
  EXPECT_NEAR(lowest(*apart, 1), 0.5, 1e-5);
  const std::vector<simulation::OrganContact> pairs = simulation::organ_contacts(touching->rods());
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].organ, "upper/stem");
  EXPECT_EQ(pairs[0].other, "lower/stem");
  // The load stands beyond the crossing, so that the lower one bears more than all of it.
  EXPECT_GT(pairs[0].force_W.z(), 0.3);
  EXPECT_LT(pairs[0].force_W.z(), 0.9);
  EXPECT_GT(lowest(*touching, 0), lowest(*apart, 0) + 0.005);
  EXPECT_LT(lowest(*touching, 1), 0.4995);
}

// It falls from a stalk that breaks at once, and comes to rest on the stem of another plant below,
// which bends under its weight: in one-way coupling, too.
TEST(PlantContact, AFruitThatCameOffLandsOnAnotherPlant) {
  SceneCase files;
  files.write("upper.plant.yaml",
              stem_file("[-0.2, 0, 0.8]", "[0, 0, 0.8]", 0.004, 1.0e9,
                        "fruits:\n  - {name: fruit, curve: stem, at: 1, radius: 0.015, density: "
                        "900, detach: {force: 0.01}}\n"));
  // A nest: two stems, and two across them.
  files.write("along.plant.yaml", stem_file("[0, -0.2, 0.6]", "[0, 0.2, 0.6]", 0.006, 5.0e9));
  files.write("across.plant.yaml", stem_file("[-0.2, 0, 0.606]", "[0.2, 0, 0.606]", 0.006, 5.0e9));
  const std::string plants =
      "plants:\n  - {name: upper, file: upper.plant.yaml}\n"
      "  - {name: right, file: along.plant.yaml, position: [0.012, 0, 0]}\n"
      "  - {name: left, file: along.plant.yaml, position: [-0.012, 0, 0]}\n"
      "  - {name: back, file: across.plant.yaml, position: [0, 0.018, 0]}\n"
      "  - {name: front, file: across.plant.yaml, position: [0, -0.018, 0]}\n";
  const auto height = [&](const std::string& coupling, double& force) {
    const auto sim = files.simulation(coupling + plants);
    for (int i = 0; i < 480; ++i) sim->step();
    const int body = sim->world().body_index("upper/fruit");
    EXPECT_GE(body, 0);
    force = 0.0;
    for (int p = 1; p < sim->rods().size(); ++p)
      for (const cosserat::ContactForce& contact : sim->rods().contact_forces(p))
        force -= contact.normal * contact.point.normal_W.z() + contact.tangential_W.z();
    return sim->world().body_pose(body).position.z();
  };
  double force = 0.0;
  EXPECT_LT(height("", force), 0.0);  // through them, and on
  EXPECT_NEAR(height("coupling: {plant_contact: 1}\n", force), 0.62, 0.03);
  const double weight = 4.0 / 3.0 * 3.14159265 * 0.015 * 0.015 * 0.015 * 900.0 * 9.81;
  EXPECT_NEAR(force, weight, 0.25 * weight);
}

// In one-way coupling the robot moves as if no plant were there; that plants touch each other does
// not change it.
TEST(PlantContact, OneWayCouplingStaysOneWay) {
  const SceneCase files;
  files.write("upper.plant.yaml", stem_file("[0, 0, 0.5]", "[0.2, 0, 0.5]", 0.004, 1.0e9));
  files.write("slider.urdf", slider_urdf(0.2, "0 0 1"));
  const auto height = [&](const std::string& coupling) {
    const auto sim = files.simulation(
        coupling + "plants:\n  - {name: upper, file: upper.plant.yaml}\n" +
        "robot: {name: slider, file: slider.urdf, position: [0.15, 0, 0.54], control: torque}\n");
    for (int i = 0; i < 60; ++i) sim->step();
    return sim->robot()->robot().positions()[0];
  };
  const double free = height("");
  EXPECT_EQ(height("coupling: {plant_contact: 1}\n"), free);
  EXPECT_GT(height("coupling: {plant_contact: 1, direction: two_way}\n"), free + 0.01);
}

TEST(PlantContact, NeedsTheDirectSolver) {
  SceneCase files;
  write_crossed(files);
  try {
    files.simulation(std::string("rods: {solver: position_based}\ncoupling: {plant_contact: 1}\n") +
                     two_stems);
    FAIL();
  } catch (const InvalidFile& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected the direct solver"));
  }
}

TEST(SceneTies, HoldEachPlantOfAGrid) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.004, 1.0e9));
  const auto sim = files.simulation(
      "plants:\n  - {name: row, file: stem.plant.yaml, repeat: {count: [3, 1], spacing: [1, 1]}}\n"
      "ties:\n  - {organ: row/stem, at: 0.5, offset: [0.3, 0, 0], length: 0.29, stiffness: 50}\n");
  ASSERT_EQ(sim->ties().all().size(), 3u);
  EXPECT_EQ(sim->ties().all()[2].name, "tie_1_2");
  for (int i = 0; i < 480; ++i) sim->step();
  for (const simulation::SceneTies::One& tie : sim->ties().all()) {
    EXPECT_GT(sim->ties().tension(tie), 0.1);
    EXPECT_GT(sim->rods().state(tie.plant).position.back().x(),
              tie.plant + 1e-3);  // pulled towards the post
  }
}

// Three stems hang from a wire by strings to the nearest place of it; the wire bears what they
// pull.
TEST(SceneTies, HangPlantsFromAWire) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.003, 2.0e7));
  files.write("wire.plant.yaml", stem_file("[-0.3, 0.02, 0.8]", "[1.3, 0.02, 0.8]", 0.002, 2.0e11,
                                           "supports:\n  - {curve: stem, at: 1}\n", 7850, "0.05"));
  const std::string plants =
      "plants:\n  - {name: row, file: stem.plant.yaml, repeat: {count: [3, 1], spacing: [0.5, "
      "1]}}\n"
      "  - {name: wire, file: wire.plant.yaml}\n";
  const std::string tie = "ties:\n  - {organ: row/stem, at: 0.9, to_organ: wire/stem";
  const auto sim = files.simulation(plants + tie + ", stiffness: 3000}\n");
  ASSERT_EQ(sim->ties().all().size(), 3u);
  for (const simulation::SceneTies::One& one : sim->ties().all()) {
    const auto course = sim->ties().course(one);
    ASSERT_TRUE(course);
    EXPECT_NEAR(course->to_W.x(), 0.5 * one.plant, 1e-9);  // straight above
    EXPECT_NEAR(course->length, std::hypot(0.35, 0.02), 1e-9);
    EXPECT_EQ(course->tension, 0.0);
  }
  const auto short_one = files.simulation(plants + tie + ", stiffness: 3000, length: 0.34}\n");
  const auto untied = files.simulation(plants);
  for (int i = 0; i < 480; ++i) {
    short_one->step();
    untied->step();
  }
  EXPECT_LT(lowest(*short_one, 3), lowest(*untied, 3) - 1e-3);
  for (const simulation::SceneTies::One& one : short_one->ties().all())
    EXPECT_GT(short_one->ties().tension(one), 0.01) << one.name;
}

TEST(SceneTies, AnOrganThatIsNotThereIsAnError) {
  SceneCase files;
  files.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.004, 1.0e9));
  const std::string plant = "plants:\n  - {name: stem, file: stem.plant.yaml}\n";
  const auto fault_of = [&](const std::string& tie) -> std::string {
    try {
      files.simulation(plant + "ties:\n  - " + tie + "\n");
    } catch (const InvalidFile& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault_of("{organ: stem/branch, to: [0, 0, 1]}"), HasSubstr("stem/branch"));
  EXPECT_THAT(fault_of("{organ: tree/stem, to: [0, 0, 1]}"), HasSubstr("expected PLANT/CURVE"));
  EXPECT_THAT(fault_of("{organ: stem/stem}"), HasSubstr("exactly one of to"));
  EXPECT_THAT(fault_of("{organ: stem/stem, to: [0, 0, 1], to_organ: stem/stem}"),
              HasSubstr("exactly one of to"));
  EXPECT_THAT(fault_of("{organ: stem/stem, to_organ: stem/branch}"), HasSubstr("stem/branch"));
  EXPECT_THAT(fault_of("{organ: stem/stem, to_organ: stem/stem}"),
              HasSubstr("both ends are on one segment"));
  EXPECT_THAT(fault_of("{organ: stem/stem, to: [0, 0, 1], to_at: 0.5}"),
              HasSubstr("expected only beside to_organ"));
  EXPECT_THAT(fault_of("{organ: stem/stem, to_organ: stem/stem, to_at: 2}"), HasSubstr("to_at"));
}

}  // namespace
}  // namespace pedicel::app
