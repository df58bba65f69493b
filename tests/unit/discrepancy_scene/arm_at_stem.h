#pragma once

#include <cmath>
#include <fstream>
#include <string>

#include "engine/io/yaml.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene/scene_effects.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {

/// A scene experiment on disk: an arm of one joint swings an upright finger, whose face is flat,
/// about the vertical, 0.4 m from its axis, and may push a stem on its way. Gravity as ever; the
/// finger's mass is 0.05 kg.
class ArmAtStem {
 public:
  static constexpr double reach = 0.4;  // m, from the joint's axis to the finger's
  std::string gap = "0.03";             // m, between the finger's axis and the stem's in y
  std::string head =
      "format: pedicel-experiment\nversion: 1\ntitle: a finger at a stem\nscene: scene.yaml\n";
  std::string instruments =
      "markers:\n"
      "  - {name: tip, plant: bush, curve: stem, at: 1}\n"
      "  - {name: middle, curve: stem, at: 0.6}\n"
      "  - {name: nail, link: finger, offset: [0, 0, 0.1]}\n"
      "cameras:\n"
      "  - {name: left, position: [0.4, -1, 0.3], orientation: [-0.70710678118654757, 0, 0, "
      "0.70710678118654757], focal: [1000, 1000], centre: [640, 360], size: [1280, 720]}\n"
      "wrenches:\n"
      "  - {name: wrist, link: finger}\n"
      "noise: {position_std: 0.0003, pixel_std: 0.4, force_std: 0.03, moment_std: 0.002, "
      "joint_std: 0.00002, torque_std: 0.05}\n";
  std::string trials = "trials:\n  - {name: push, folder: push, robot: {follows: joints}}\n";
  double swing = 0.12;    // rad
  double duration = 1.2;  // s
  std::string coupling = "{friction: 0.5}";
  std::string modulus = "1.0e9";  // Pa, of the stem
  std::string scene_more;
  bool sees_nothing = false;  // no markers, no cameras

  std::filesystem::path path() const { return folder_ / ""; }
  void write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  /// rad, where the joint is at a time.
  double joint(double t) const {
    const double s = std::clamp((t - 0.1) / 0.8, 0.0, 1.0);
    return swing * s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
  }

  void write_all() const {
    write("arm.urdf", urdf());
    write("plant.yaml",
          "format: pedicel-plant\nversion: 1\nname: bush\n"
          "material: {youngs_modulus: " +
              modulus +
              ", poisson_ratio: 0.35, density: 700, damping_time: "
              "0.01}\nsampling: {connect: 0.004, distance: 0.05}\nroot: [0, 0, 0]\ncurves:\n"
              "  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.6]], radius: "
              "0.004}\n");
    write("scene.yaml",
          "format: pedicel-scene\nversion: 1\nname: finger\npurpose: A finger pushes a stem.\n"
          "see: The stem bends.\nduration: 1\ndt: 0.001\ncoupling: " +
              coupling +
              "\nplants:\n"
              "  - {name: bush, file: plant.yaml, position: [" +
              std::to_string(reach) + ", " + gap +
              ", 0]}\nrobot:\n  {name: arm, file: arm.urdf, joints: {turn: 0}, tool: finger}\n" +
              scene_more);
    write("experiment.yaml", head + instruments + trials);
    std::string joints = "time,turn\n", times = "", wrench = "time,fx,fy,fz,tx,ty,tz\n",
                markers =
                    "time,tip.x,tip.y,tip.z,middle.x,middle.y,middle.z,nail.x,nail.y,nail.z\n",
                pixels = "time,tip.u,tip.v,middle.u,middle.v,nail.u,nail.v\n",
                torques = "time,turn\n";
    for (int i = 0; i <= static_cast<int>(std::lround(duration / 0.01)); ++i) {
      const std::string t = std::to_string(0.01 * i);
      char value[40];
      std::snprintf(value, sizeof value, "%.9f", joint(0.01 * i));
      joints += t + "," + value + "\n";
      wrench += t + ",,,,,,\n";
      markers += t + ",,,,,,,,,\n";
      pixels += t + ",,,,,,\n";
      torques += t + ",\n";
    }
    write("push/joints.csv", joints);
    write("push/wrench_wrist.csv", wrench);
    if (!sees_nothing) {
      write("push/markers.csv", markers);
      if (instruments.find("cameras:") != std::string::npos) write("push/pixels_left.csv", pixels);
    }
    write("push/torques.csv", torques);
  }

  /// Reads what write_all() wrote. The diagnostics' text as an error.
  Experiment read() const {
    Diagnostics diagnostics;
    auto experiment = read_experiment(path(), diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    return std::move(*experiment);
  }

  static std::string urdf() {
    return R"(<?xml version="1.0"?>
<robot name="swing">
  <link name="base"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.2 0 0"/><mass value="0.3"/><inertia ixx="0.0001" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.3"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="50" velocity="5"/><dynamics damping="0.5" friction="0.1"/></joint>
  <link name="finger"><inertial><origin xyz="0 0 0.02"/><mass value="0.05"/><inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.000002"/></inertial>
    <collision><geometry><box size="0.08 0.012 0.2"/></geometry></collision></link>
  <joint name="mount" type="fixed"><parent link="arm"/><child link="finger"/><origin xyz="0.4 0 0"/></joint>
</robot>
)";
  }

 private:
  TemporaryFolder folder_;
};

inline plant::Effect scene_effect(const std::string& text, const Experiment& experiment) {
  Diagnostics diagnostics;
  plant::Effect effect = read_scene_effect(io::parse_yaml(text, "effect", diagnostics), experiment);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return effect;
}

/// What the instruments of the only trial say of a variant.
inline SceneReadings readings_of(const Experiment& experiment,
                                 const std::vector<std::string>& effects = {},
                                 SceneNumerics numerics = {0.02, 1.0e-3, 0.05, 1.0e-5}) {
  SceneVariant variant;
  for (const std::string& text : effects) variant.effects.push_back(scene_effect(text, experiment));
  SceneSimulator simulator(experiment, numerics, 1);
  const SceneSimulator::Request request{&variant, 0};
  return simulator.run({&request, 1}).front();
}

}  // namespace pedicel::discrepancy
