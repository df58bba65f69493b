#include "engine/robot/kinematics.h"
#include "engine/urdf/urdf_reader.h"
#include "plugins/discrepancy/log_import/log_map.h"
#include "plugins/discrepancy/log_import/log_proposal.h"
#include "plugins/discrepancy/log_import/log_tables.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

constexpr const char* arm =
    "<robot name='arm'><link name='base'/><link name='hand'><inertial><mass value='1'/>"
    "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
    "<joint name='turn' type='revolute'><parent link='base'/><child link='hand'/>"
    "<axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>";
constexpr const char* bush =
    "format: pedicel-plant\nversion: 1\nname: bush\nmaterial: {youngs_modulus: 1.0e9, "
    "poisson_ratio: 0.35, density: 700, damping_time: 0.01}\nsampling: {connect: 0.004, distance: "
    "0.05}\nroot: [0, 0, 0]\ncurves:\n"
    "  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.6]], radius: 0.004}\n";

discrepancy::LogScene scene() {
  Diagnostics diagnostics;
  discrepancy::LogScene out;
  out.robot = robot::parse_urdf(arm, "arm.urdf", {}, diagnostics).value();
  out.joints = robot::KinematicModel(out.robot).joint_names();
  out.plants = {plant::parse_plant(bush, "bush.yaml", diagnostics).value()};
  return out;
}

void import(const discrepancy::LogContents& log, const discrepancy::LogScene& believed) {
  const std::string text = discrepancy::proposed_map(log, believed, "scene.yaml");
  if (text.find("topic: ?") != std::string::npos) return;
  Diagnostics diagnostics;
  const auto map = discrepancy::parse_log_map(text, "map.yaml", diagnostics);
  fuzz::require_answer(map, diagnostics);
  if (!map) return;
  fuzz::require(!map->follows_commands && map->frame == "world" && map->trials.empty(),
                "a log's names are no keys of its map");
  discrepancy::check_places(*map, believed, diagnostics);
  fuzz::require(!diagnostics.has_errors(), "what is proposed is in the scene");
  discrepancy::LogMap::Trial wanted;
  wanted.name = "one";
  const auto trial = discrepancy::trial_of_log(log, *map, wanted, believed, diagnostics);
  for (std::size_t i = 1; i < trial.joints.time.size(); ++i)
    fuzz::require(trial.joints.time[i] > trial.joints.time[i - 1], "times go on");
}

}  // namespace

// A log (MCAP or bag) is read as an import reads it: contents, a first map, a trial.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  static const discrepancy::LogScene believed = scene();
  try {
    const auto log = discrepancy::read_log(folder.write("f.mcap", fuzz::text_of(data, size)));
    for (const double time : {0.0, 0.5, 1.0e9}) {
      discrepancy::frame_at(log, "bush/stem", "world", time, false);
      discrepancy::frame_at(log, "hand", "world", time, true);
    }
    import(log, believed);
  } catch (const InvalidFile& fault) {
    fuzz::require(fault.what()[0] != '\0', "a reason");
  }
  return 0;
}
