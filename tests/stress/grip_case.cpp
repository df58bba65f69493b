#include "tests/stress/grip_case.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/world/scene_reader.h"
#include "tests/stress/draw.h"
#include "tests/stress/sentence.h"
#include "tests/support/places.h"

namespace pedicel::stress {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double open = 0.025, height = 0.7;    // m
constexpr double settled = 0.1, held = 0.2;     // s, before it shuts, before it pulls
constexpr double pulling = 0.5, shaking = 1.0;  // s
const Vec3 grip_W(0.0, 0.0, height);

// Pa. Softer, it would sag far out of the grip: by a tenth of its length under its own weight.
double stands_from(const GripCase& one) {
  const double length = one.before + one.after, area = pi * one.radius * one.radius;
  const double fruit = one.thing == GripCase::Thing::stem ? 0.0 : std::pow(one.fruit_radius, 3);
  const double weight = 9.81 * (900.0 * area * length + 950.0 * 4.0 / 3.0 * pi * fruit);
  const double second_moment = 0.25 * area * one.radius * one.radius;
  return 10.0 * weight * length * length / (3.0 * second_moment);
}

void draw_plant(Random& random, GripCase& one) {
  one.thing = static_cast<GripCase::Thing>(random.integer(0, 2));
  const bool is_stem = one.thing == GripCase::Thing::stem;
  one.radius = is_stem ? draw_log(random, 0.001, 0.012) : draw_log(random, 0.0005, 0.003);
  one.fruit_radius = draw_log(random, std::max(0.006, 1.5 * one.radius), 0.021);
  one.youngs_modulus = draw_log(random, 1.0e6, 1.0e10);
  one.damping_time = draw_log(random, 1.0e-3, 3.0e-2);
  one.element = random.uniform(0.006, 0.03);
  // It clears the gripper's palm.
  one.along = Vec3(random.uniform(-0.12, 0.12), random.uniform(-0.3, 0.3),
                   random.uniform() < 0.5 ? -1.0 : 1.0)
                  .normalized();
  one.before = random.uniform(0.05, 0.3);
  one.after = is_stem ? random.uniform(0.02, 0.15) : one.fruit_radius + random.uniform(0.015, 0.04);
  if (one.thing == GripCase::Thing::fruit) one.after = 0.0;
  one.youngs_modulus = std::max(one.youngs_modulus, stands_from(one));
  if (is_stem || random.uniform() < 0.5) return;
  one.detach = draw_chance(random, 0.5)
                   ? sentence("stretch: %.4g", draw_log(random, 0.01, 0.3))
                   : sentence("force: %.4g, moment: %.4g", draw_log(random, 0.3, 20.0),
                              draw_log(random, 0.003, 0.3));
}

void draw_gripper(Random& random, GripCase& one) {
  one.effort = draw_chance(random, 0.5) ? 40.0 : draw_log(random, 1.0, 200.0);
  one.force = draw_chance(random, 0.3) ? draw_log(random, 1.0, 100.0) : 0.0;
  one.velocity = draw_chance(random, 0.5) ? 0.2 : draw_log(random, 0.1, 2.0);
  const double size = one.thing == GripCase::Thing::fruit ? one.fruit_radius : one.radius;
  one.shut = draw_chance(random, 0.5) ? 0.0 : random.uniform(0.0, 0.9) * size;
  one.closing = draw_log(random, 2.0 * open / one.velocity, 1.5);
  one.friction = random.uniform(0.3, 1.2);
  one.contact_stiffness = draw_chance(random, 0.7) ? 1.0e5 : draw_log(random, 1.0e4, 1.0e6);
  one.fruit_stiffness = draw_chance(random, 0.7) ? 1.0e4 : draw_log(random, 5.0e2, 1.0e5);
}

void draw_motion(Random& random, GripCase& one) {
  one.pull = draw_chance(random, 0.8) ? Vec3(draw_log(random, 1e-3, 0.15) * draw_direction(random))
                                      : Vec3::Zero();
  one.turn = draw_chance(random, 0.3) ? random.uniform(-0.7, 0.7) : 0.0;
  one.frequency = draw_log(random, 1.0, 8.0);
  const double amplitude = std::min(draw_log(random, 1.0e-3, 0.03), 0.1 / one.frequency);
  one.shake = draw_chance(random, 0.8) ? Vec3(amplitude * draw_direction(random)) : Vec3::Zero();
}

std::string text_of(const Vec3& v) {
  return sentence("[%.9g, %.9g, %.9g]", v.x(), v.y(), v.z());
}

std::string plant_text(const GripCase& one) {
  const Vec3 root = grip_W - one.before * one.along, end = grip_W + one.after * one.along;
  const bool straight_to_fruit = one.thing == GripCase::Thing::fruit;
  std::ostringstream text;
  text << "format: pedicel-plant\nversion: 1\nname: plant\nshape: drawn\nmaterial: "
       << sentence("{youngs_modulus: %.6g, poisson_ratio: 0.35, density: 900, damping_time: %.6g}",
                   one.youngs_modulus, one.damping_time)
       << sentence("\nsampling: {connect: 0.002, distance: %.6g}\nroot: ", one.element)
       << text_of(root) << "\ncurves:\n  - {name: stem, points: [" << text_of(root) << ", "
       << text_of(straight_to_fruit ? grip_W : end) << sentence("], radius: %.6g}\n", one.radius);
  if (one.thing != GripCase::Thing::stem)
    text << sentence("fruits:\n  - {name: fruit, curve: stem, at: 1.0, radius: %.6g, density: 950",
                     one.fruit_radius)
         << (one.detach.empty() ? "" : ", detach: {" + one.detach + "}") << "}\n";
  return text.str();
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

std::string robot_text(const GripCase& one) {
  const std::filesystem::path robots = pedicel::test::source_folder() / "assets" / "robots";
  std::ifstream file(robots / "gantry_gripper" / "gantry_gripper.urdf");
  std::stringstream all;
  all << file.rdbuf();
  std::string text = all.str();
  replace_all(text, "../stalk6/meshes", (robots / "stalk6" / "meshes").string());
  replace_all(text, "effort=\"40\" velocity=\"0.2\"",
              sentence("effort=\"%.6g\" velocity=\"%.6g\"", one.effort, one.velocity));
  return text;
}

std::string waypoint(double time, const Vec3& place, double gripper, double turn) {
  return sentence("    - {time: %.9g, position: ", time) + text_of(place) +
         sentence(", facing: {approach: [1, 0, 0], across: [0, %.9g, %.9g]}, gripper: %.9g}\n",
                  std::cos(turn), std::sin(turn), gripper);
}

std::string waypoints_text(const GripCase& one) {
  std::string text = waypoint(0.0, grip_W, open, 0.0) + waypoint(settled, grip_W, open, 0.0);
  double time = settled + one.closing;
  text += waypoint(time, grip_W, one.shut, 0.0);
  text += waypoint(time += held, grip_W, one.shut, 0.0);
  text += waypoint(time += pulling, grip_W + one.pull, one.shut, one.turn);
  const double half = 0.5 / one.frequency, end = time + shaking;
  for (double way = 1.0; time + half <= end; way = -way)
    text += waypoint(time += half, grip_W + one.pull + way * one.shake, one.shut, one.turn);
  return text;
}

std::string scene_text(const GripCase& one) {
  std::ostringstream text;
  text << "format: pedicel-scene\nversion: 1\nname: grip\npurpose: test\nsee: test\n"
       << sentence("duration: %.9g\ndt: 0.004166666666666667\n", one.duration())
       << sentence("coupling: {friction: %.6g, contact_stiffness: %.6g, fruit_stiffness: %.6g, ",
                   one.friction, one.contact_stiffness, one.fruit_stiffness)
       << "direction: " << (one.two_way ? "two_way" : "one_way") << "}\n"
       << "plants:\n  - {name: p, file: grip.plant.yaml}\n"
       << "robot:\n  name: gantry\n  file: grip.urdf\n  tool: tool\n  gripper: finger_joint\n"
       << sentence("  joints: {x_joint: -0.16, z_joint: %.6g, tilt_joint: 1.5707963, ", height)
       << sentence("finger_joint: %.6g}\n", open)
       << (one.force > 0.0 ? sentence("  gripper_force: %.6g\n", one.force) : "")
       << "  waypoints:\n"
       << waypoints_text(one);
  return text.str();
}

}  // namespace

double GripCase::pressing() const {
  return force > 0.0 ? std::min(force, effort) : effort;
}

double GripCase::joint_friction() {
  return 2.0 * 0.2;
}

double GripCase::duration() const {
  return settled + closing + held + pulling + shaking;
}

GripCase draw_grip(std::uint64_t seed) {
  Random random(seed);
  GripCase one;
  one.seed = seed;
  one.two_way = draw_chance(random, 0.5);
  draw_plant(random, one);
  draw_gripper(random, one);
  draw_motion(random, one);
  return one;
}

std::string describe(const GripCase& one) {
  const char* names[] = {"stem", "stalk", "fruit"};
  return sentence(
             "seed %d: %s, %s, radius %.3g mm, fruit %.3g mm, %.3g Pa, grip %.3g m from the clamp, "
             "presses %.3g N at %.3g m/s to %.3g mm, mu %.3g, stiffness %.3g and %.3g N/m, ",
             static_cast<int>(one.seed), names[static_cast<int>(one.thing)],
             one.two_way ? "two-way" : "one-way", 1e3 * one.radius, 1e3 * one.fruit_radius,
             one.youngs_modulus, one.before, one.pressing(), one.velocity, 1e3 * one.shut,
             one.friction, one.contact_stiffness, one.fruit_stiffness) +
         sentence("pulled %.3g mm, turned %.3g rad, shaken %.3g mm at %.3g Hz, breaks: %s",
                  1e3 * one.pull.norm(), one.turn, 1e3 * one.shake.norm(), one.frequency,
                  one.detach.empty() ? "no" : one.detach.c_str());
}

std::unique_ptr<simulation::Simulation> make_grip(const GripCase& one,
                                                  const std::filesystem::path& folder) {
  std::ofstream(folder / "grip.plant.yaml") << plant_text(one);
  std::ofstream(folder / "grip.urdf") << robot_text(one);
  std::ofstream(folder / "grip.scene.yaml") << scene_text(one);
  Diagnostics diagnostics;
  const auto scene = world::read_scene(folder / "grip.scene.yaml", diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  return std::make_unique<simulation::Simulation>(*scene, simulation::SimulationOptions{});
}

}  // namespace pedicel::stress
