#include "tests/discrepancy/scene_cases/drawn_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "tests/discrepancy/scene_cases/draw.h"
#include "tests/discrepancy/scene_cases/harvest_case.h"

namespace pedicel::scene_case {

namespace {

// m, how far a stem that is clamped below goes aside at a height, where it is pushed aside by
// `way` at `at`.
double bent(double height, double at, double way) {
  if (height > at) return way * (1.0 + 1.5 * (height - at) / at);
  return way * (3.0 * at * height * height - std::pow(height, 3)) / (2.0 * std::pow(at, 3));
}

// Sizes that a person would look for: some clear, some hardly above what two solvers differ by.
Hidden draw_hidden(const std::string& name, const Setting& s, Draw& draw) {
  if (name == "contact_friction") {
    const double share = draw.chance(0.7) ? draw.between(0.3, 0.6) : draw.between(1.4, 1.8);
    return {name, {{"coefficient", {share * s.friction}}}};
  }
  if (name == "plant_pose") return {name, {{"offset", draw.vector(0.002, 0.008)}}};
  if (name == "tool_pose")
    return {name, {{"offset", draw.vector(0.0015, 0.006)}, {"rotation", draw.vector(0.015, 0.05)}}};
  if (name == "joint_offset") {
    std::vector<double> offset(3, 0.0);
    const auto joint = static_cast<std::size_t>(draw.between(0.0, 3.0));
    offset[joint] = draw.sign() * (joint < 2 ? draw.size(0.006, 0.025) : draw.size(0.002, 0.006));
    return {name, {{"offset", offset}}};
  }
  if (name == "robot_latency") return {name, {{"delay", {draw.size(0.01, 0.04)}}}};
  if (name == "reaction") return {name, {{"joint_stiffness", {draw.size(80.0, 300.0)}}}};
  if (name == "payload")
    return {name,
            {{"mass", {draw.size(0.03, 0.12)}},
             {"centre",
              {draw.between(0.02, 0.12), draw.between(-0.02, 0.02), draw.between(-0.02, 0.02)}}}};
  if (name == "wrench_bias")
    return {name, {{"force", draw.vector(0.05, 0.3)}, {"moment", draw.vector(0.004, 0.02)}}};
  if (name == "wrench_gain") return {name, {{"gain", {draw.factor(1.06, 1.2)}}}};
  // What a finger bears is 0.5 to 1 N: it gives way by half a millimetre to some.
  if (name == "contact_compliance") return {name, {{"stiffness", {draw.size(150.0, 1000.0)}}}};
  if (name == "tracking_lag") return {name, {{"time", {draw.size(0.01, 0.05)}}}};
  if (name == "joint_friction") {
    // Of the shoulder: in these trials the lift stands still, and the elbow creeps.
    const std::vector<double> coulomb = {draw.size(0.08, 0.4), 0.0, 0.0},
                              viscous = {draw.size(0.1, 0.5), 0.0, 0.0};
    return {name, {{"coulomb", coulomb}, {"viscous", viscous}}};
  }
  if (name == "fruit_mass") return {name, {{"factor", {draw.factor(1.2, 1.6)}}}};
  if (name == "detachment_threshold") return {name, {{"factor", {draw.factor(1.15, 1.5)}}}};
  if (name == "youngs_modulus") return {name, {{"factor", {draw.factor(1.1, 1.3)}}}};
  if (name == "damping_time") return {name, {{"factor", {draw.factor(1.8, 2.6)}}}};
  if (name == "camera_pose")
    return {name, {{"offset", draw.vector(0.002, 0.01)}, {"rotation", draw.vector(0.003, 0.02)}}};
  if (name == "camera_focal") return {name, {{"factor", {draw.factor(1.01, 1.05)}}}};
  if (name == "lens_distortion") return {name, {{"k1", {draw.sign() * draw.size(0.1, 0.4)}}}};
  if (name == "post") {
    // Beyond the stem, on a side to which a finger pushes it: half of its way there is left.
    const double z =
        s.height * (draw.chance(0.5) ? draw.between(0.3, 0.42) : draw.between(0.75, 0.92));
    const double way = bent(z, 0.55 * s.height, 0.03) * draw.between(0.4, 0.65);
    return {name, {{"position", {s.root.x(), s.root.y() + draw.sign() * (way + s.radius), z}}}};
  }
  if (name == "string") {
    const double at = draw.between(0.65, 0.98), aside = draw.between(0.12, 0.25);
    const double way = bent(at * s.height, 0.55 * s.height, 0.03) * draw.between(0.3, 0.6);
    const Vec3 anchor = s.root + Vec3(draw.between(-0.04, 0.04), draw.sign() * aside,
                                      at * s.height + draw.between(-0.05, 0.05));
    const double taut = (anchor - s.root - Vec3(0, 0, at * s.height)).norm();
    return {
        name,
        {{"at", {at}}, {"anchor", {anchor.x(), anchor.y(), anchor.z()}}, {"length", {taut + way}}}};
  }
  throw std::invalid_argument(name + ": there is nothing of this name to hide");
}

bool is_of_camera(const std::string& name) {
  return name.starts_with("camera_") || name == "lens_distortion";
}

using Names = std::vector<std::string>;

// Kinds, names and how many of each.
struct Stratum {
  const char* kind;
  Names names;
  int count;
  bool commands = false, torques = false, harvest = false;
};
const std::vector<Stratum>& strata() {
  static const std::vector<Stratum> all = {
      {"null", {}, 30},
      {"effect", {"contact_friction"}, 3},
      {"effect", {"plant_pose"}, 3},
      {"effect", {"tool_pose"}, 3},
      {"effect", {"joint_offset"}, 3},
      {"effect", {"robot_latency"}, 3},
      {"effect", {"reaction"}, 3},
      {"effect", {"payload"}, 3},
      {"effect", {"wrench_bias"}, 3},
      {"effect", {"wrench_gain"}, 3},
      {"effect", {"camera_pose"}, 3},
      {"effect", {"camera_focal"}, 3},
      {"effect", {"lens_distortion"}, 3},
      {"effect", {"youngs_modulus"}, 3},
      {"effect", {"damping_time"}, 3},
      {"pair", {"contact_friction", "robot_latency"}, 2},
      {"pair", {"contact_friction", "wrench_bias"}, 2},
      {"pair", {"plant_pose", "payload"}, 2},
      {"pair", {"reaction", "wrench_bias"}, 2},
      {"pair", {"tool_pose", "contact_friction"}, 2},
      {"pair", {"plant_pose", "robot_latency"}, 2},
      {"pair", {"camera_pose", "wrench_gain"}, 2},
      {"outside", {"post"}, 7},
      {"outside", {"string"}, 7},
  };
  return all;
}

// Of records and effects that the hundred do not have.
const std::vector<Stratum>& later_strata() {
  static const std::vector<Stratum> all = {
      {.kind = "effect", .names = {"contact_compliance"}, .count = 3},
      {.kind = "null", .names = {}, .count = 2, .commands = true},
      {.kind = "effect", .names = {"tracking_lag"}, .count = 3, .commands = true},
      {.kind = "null", .names = {}, .count = 2, .torques = true},
      {.kind = "effect", .names = {"joint_friction"}, .count = 3, .torques = true},
      {.kind = "null", .names = {}, .count = 2, .harvest = true},
      {.kind = "effect", .names = {"fruit_mass"}, .count = 3, .harvest = true},
      {.kind = "effect", .names = {"detachment_threshold"}, .count = 3, .harvest = true},
  };
  return all;
}

// Each case has a place between 0 and 1 in its stratum; all are taken in this order, so that a
// bench that was cut short has seen a share of everything.
std::vector<Order> mixed(const std::vector<Stratum>& strata) {
  std::multimap<double, Order> placed;
  int stratum = 0;
  for (const Stratum& one : strata) {
    for (int i = 0; i < one.count; ++i) {
      const std::string kind = one.kind;
      // Every third case has another modulus beside what it hides.
      const bool off = kind != "null" && !one.harvest && one.names.front() != "youngs_modulus" &&
                       one.names.front() != "damping_time" && (i + stratum) % 3 == 2;
      placed.emplace((i + 0.5) / one.count + 1.0e-4 * stratum,
                     Order{0, kind, one.names, off, one.commands, one.torques, one.harvest});
    }
    ++stratum;
  }
  std::vector<Order> all;
  for (auto& [place, order] : placed) all.push_back(order);
  return all;
}

}  // namespace

std::vector<Order> orders() {
  std::vector<Order> all = mixed(strata());
  // These stand behind: numbers of cases before them stay.
  for (const Order& order : mixed(later_strata())) all.push_back(order);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].number = static_cast<int>(i);
  return all;
}

Setting drawn(const Order& order, std::uint64_t seed) {
  Setting setting;
  setting.seed = seed * 1000 + static_cast<std::uint64_t>(order.number);
  draw(setting);
  if (order.harvest) make_harvest(setting);
  setting.commands = order.commands;
  setting.torques = order.torques;
  setting.camera = order.number % 2 == 1 || std::ranges::any_of(order.names, is_of_camera);
  Draw draw_of(setting.seed * 104729 + 31);
  for (const std::string& name : order.names)
    setting.hidden.push_back(draw_hidden(name, setting, draw_of));
  if (order.off) setting.hidden.push_back(draw_hidden("youngs_modulus", setting, draw_of));
  return setting;
}

std::vector<std::string> hidden_names(const Setting& setting) {
  Names names;
  for (const Hidden& one : setting.hidden) names.push_back(one.name);
  std::ranges::sort(names);
  return names;
}

}  // namespace pedicel::scene_case
