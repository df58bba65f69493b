// Cuts through stems: what is cut off goes on as one body with the momentum that it had.
#include "plugins/simulation/plants/cutting.h"

#include <gmock/gmock.h>

#include <cmath>

#include "engine/core/check.h"
#include "plugins/cosserat/solver/detachment.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

using testing::HasSubstr;

// A stem of 0.5 m that stands, with a fruit at its side.
const char* tree = "plants:\n  - {name: tree, file: tree.plant.yaml}\nground: {height: 0}\n";

void write_tree(const SceneCase& files) {
  files.write(
      "tree.plant.yaml",
      stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.005, 1.0e9,
                "fruits:\n  - {name: fruit, curve: stem, at: 0.9, radius: 0.015, density: 900}\n"));
}

double mass_of(const simulation::Simulation& sim) {
  double mass = 0.0;
  for (int e = 0; e < sim.rods().model(0).size(); ++e)
    if (sim.rods().state(0).alive[e]) mass += sim.rods().model(0).elements[e].mass;
  return mass;
}

TEST(Cutting, AtATimeOfTheScene) {
  SceneCase files;
  write_tree(files);
  const auto sim =
      files.simulation(std::string(tree) + "cuts:\n  - {organ: tree/stem, at: 0.6, time: 0.1}\n");
  const double whole = mass_of(*sim);
  for (int i = 0; i < 24; ++i) sim->step();
  EXPECT_TRUE(sim->cutting().events().empty());
  EXPECT_EQ(sim->world().body_index("tree/stem_cut"), -1);
  for (int i = 0; i < 360; ++i) sim->step();
  ASSERT_EQ(sim->cutting().events().size(), 1u);
  EXPECT_EQ(sim->cutting().events()[0].cause, "cut");
  EXPECT_NEAR(sim->cutting().events()[0].time, 0.1, 0.005);
  const int body = sim->world().body_index("tree/stem_cut");
  ASSERT_GE(body, 0);
  EXPECT_NEAR(mass_of(*sim) + sim->world().body(body).mass, whole, 1e-12);
  EXPECT_NEAR(mass_of(*sim) / (0.3 * 700.0 * M_PI * 0.005 * 0.005), 1.0, 0.1);
  // It has fallen over, onto the ground; the stump stands.
  EXPECT_LT(sim->world().body_pose(body).position.z(), 0.2);
  EXPECT_GT(sim->world().body_pose(body).position.z(), 0.0);
  EXPECT_TRUE(sim->rods().state(0).fruit_gone[0]);
  const cosserat::RodModel& model = sim->rods().model(0);
  const cosserat::RodState& state = sim->rods().state(0);
  for (int e = 0; e < model.size() && state.alive[e]; ++e)
    EXPECT_LT((state.position[e] - model.elements[e].drawn_position).norm(), 2e-3);
}

// A stem that swings freely: linear and angular momentum of all that moves, just before and after.
TEST(Cutting, MomentumGoesAlong) {
  SceneCase files;
  write_tree(files);
  const auto sim = files.simulation(std::string(tree) + "gravity: [0, 0, 0]\n");
  for (Vec3& v : sim->rods().edit_state(0).velocity) v.x() = 0.5;
  sim->rods().edit_state(0).previous_dt = 0.0;
  for (int i = 0; i < 10; ++i) sim->step();
  const cosserat::RodModel& model = sim->rods().model(0);
  cosserat::RodState state = sim->rods().state(0);
  const auto moments = [&](const cosserat::RodState& of, Vec3& linear, Vec3& angular) {
    for (int e = 10; e < model.size(); ++e) {
      const cosserat::Element& element = model.elements[e];
      const Vec3 centre = cosserat::point_on(model, of, e, element.com_back);
      linear += element.mass * of.velocity[e];
      angular += element.mass * centre.cross(of.velocity[e]) +
                 of.orientation[e] * element.inertia.cwiseProduct(of.angular_velocity[e]);
    }
  };
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  moments(state, linear, angular);
  const cosserat::CutOff off = cosserat::cut(model, state, 10);
  EXPECT_LT((off.mass * off.velocity_W - linear).norm(), 1e-12);
  Mat3 inertia = Mat3::Zero();
  const cosserat::RodState before = sim->rods().state(0);
  for (const int e : off.elements) {
    const Mat3 r = before.orientation[e].toRotationMatrix();
    const Vec3 arm =
        cosserat::point_on(model, before, e, model.elements[e].com_back) - off.centre_W;
    inertia +=
        r * model.elements[e].inertia.asDiagonal() * r.transpose() +
        model.elements[e].mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  const Vec3 after =
      off.centre_W.cross(off.mass * off.velocity_W) + inertia * off.angular_velocity_W;
  EXPECT_LT((after - angular).norm(), 1e-9 * angular.norm() + 1e-12);
  EXPECT_GT(angular.norm(), 1e-6);
}

TEST(Cutting, TwiceInOnePlaceIsRefused) {
  SceneCase files;
  write_tree(files);
  const auto sim = files.simulation(tree);
  sim->step();
  sim->cutting().cut("tree/stem", 0.5);
  EXPECT_THROW(sim->cutting().cut("tree/stem", 0.7), UsageError);
  EXPECT_THROW(sim->cutting().cut("tree/twig", 0.7), UsageError);
  sim->cutting().cut("tree/stem", 0.2);  // the stump, farther down
  sim->step();
  EXPECT_GE(sim->world().body_index("tree/stem_cut_2"), 0);
}

TEST(Cutting, AFaultIsToldWithItsPlace) {
  SceneCase files;
  write_tree(files);
  const auto fault_of = [&](const std::string& cut) -> std::string {
    try {
      files.simulation(std::string(tree) + "cuts:\n  - " + cut + "\n");
    } catch (const InvalidFile& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault_of("{organ: tree/stem, at: 0.6}"), HasSubstr("exactly one of time"));
  EXPECT_THAT(fault_of("{organ: tree/stem, by_tool: true}"), HasSubstr("no robot"));
  EXPECT_THAT(fault_of("{organ: tree/twig, time: 1}"), HasSubstr("tree/twig"));
}

}  // namespace
}  // namespace pedicel::app
