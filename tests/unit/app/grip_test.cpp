// The gripper of assets/robots/gantry_gripper holds a fruit while it is shaken up and down with 2 g
// for 10 s. Its motor presses with 1.5 N, less or more 0.2 N of friction in each finger's joint,
// and each finger gets half: N = 0.55 to 0.95 N. The fruit, m = 6.9 g, wants at most m (2 g + g) =
// 0.20 N of friction from both fingers, and its stalk up to 0.09 N more. mu 0.8 gives 2 mu N >=
// 0.88 N: it holds. mu 0.1 gives at most 0.19 N: it slips.
#include <cmath>
#include <iostream>
#include <sstream>

#include "plugins/simulation/colliders.h"
#include "tests/support/places.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

constexpr double radius = 0.012, height = 0.6;

// The tool opens around the fruit, comes within 1 s, closes within 0.4 s, then goes to and fro
// between two heights every 0.1 s: minimum jerk over a way D in T has a largest acceleration
// of 5.7735 D / T^2, so D = 34 mm.
std::string robot_shaking(double from, double to) {
  std::ostringstream text;
  text << "robot:\n  name: gantry\n  file: " << pedicel::test::source_folder().string()
       << "/assets/robots/gantry_gripper/gantry_gripper.urdf\n"
          "  position: [0, 0, 0]\n  tool: tool\n  gripper: finger_joint\n  gripper_force: 1.5\n  "
          "joints: {finger_joint: 0.02}\n"
          "  waypoints:\n";
  const auto waypoint = [&](double time, double z, double gripper, bool first) {
    text << "    - {time: " << time << ", position: [0, 0, " << z << "], gripper: " << gripper
         << (first ? ", facing: {approach: [1, 0, 0], across: [0, 1, 0]}" : "") << "}\n";
  };
  waypoint(0.0, height, 0.02, true);
  waypoint(1.0, height, 0.02, false);
  waypoint(1.4, height, 0.005, false);
  waypoint(from, height, 0.005, false);
  double z = height;
  for (int i = 1; from + 0.1 * i <= to; ++i) {
    z = i % 2 == 1 ? height + 0.034 : height;
    waypoint(from + 0.1 * i, z, 0.005, false);
  }
  return text.str();
}

struct Hold {
  double slipped = 0.0;  // m, farthest that the fruit was from where it was gripped, in the tool
  double penetration = 0.0;  // m, largest in the grip at rest
};

template <class FruitPlace>
Hold shake(simulation::Simulation& sim, const FruitPlace& place) {
  Hold hold;
  Vec3 gripped = Vec3::Zero();
  for (int i = 0; i < 240 * 12; ++i) {
    const auto& report = sim.step();
    if (report.errors & world::fatal_errors) break;  // torn about once it is lost
    const Vec3 in_tool = sim.robot()->tool_pose().inverse() * place();
    if (i == 470) gripped = in_tool;
    if (i > 430 && i <= 470) hold.penetration = std::max(hold.penetration, report.deepest_overlap);
    if (i > 470) hold.slipped = std::max(hold.slipped, (in_tool - gripped).norm());
  }
  return hold;
}

// A fruit on a stalk of 0.15 m, E A = 0.39 N: 34 mm of way stretch it by less than 0.23, 0.09 N.
Hold hold_on_stalk(double friction) {
  SceneCase files;
  files.write(
      "fruit.plant.yaml",
      stem_file("[0, 0, 0.75]", "[0, 0, 0.6]", 0.0005, 5.0e5,
                "fruits:\n  - {name: fruit, curve: stem, at: 1.0, radius: 0.012, density: 950}\n"));
  const auto sim = files.simulation(
      "dt: 0.004166666666666667\ncoupling: {direction: two_way, friction: " +
      std::to_string(friction) + "}\nplants:\n  - {name: p, file: fruit.plant.yaml}\n" +
      robot_shaking(2.0, 12.0));
  return shake(*sim, [&] {
    const auto& model = sim->rods().model(0);
    return cosserat::point_on(model, sim->rods().state(0), model.fruits[0].element,
                              model.fruits[0].back);
  });
}

TEST(Grip, HoldsAFruitOnItsStalkAtMu08) {
  const Hold hold = hold_on_stalk(0.8);
  std::cout << "slipped " << hold.slipped << " m, penetration " << hold.penetration << " m\n";
  // Two friction springs, in series with the fingers' own give of at most 1e-3 m/N (a 60 g pair of
  // fingers, dt^2 / m, three contacts counted), stretch by (0.20 + 0.09) N / 2 x (1e-4 + 1e-3) m/N.
  EXPECT_LT(hold.slipped, 1.6e-4);
  EXPECT_LT(hold.penetration, 2.0e-4);
}

TEST(Grip, LosesAFruitOnItsStalkAtMu01) {
  const Hold hold = hold_on_stalk(0.1);
  std::cout << "slipped " << hold.slipped << " m, penetration " << hold.penetration << " m\n";
  EXPECT_GT(hold.slipped, 5.0e-3);
}

}  // namespace
}  // namespace pedicel::app
