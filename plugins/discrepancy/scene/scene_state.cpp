#include "plugins/discrepancy/scene/scene_state.h"

#include "engine/core/diagnostics.h"
#include "engine/robot/kinematics.h"
#include "engine/world/settings.h"

namespace pedicel::discrepancy {

namespace {
constexpr double hard = 1.0e6;  // N/m
}

SceneState nominal_state(const Experiment& experiment) {
  SceneState state;
  // What nobody states is hard: a stem that sticks to a finger holds it by its axial stiffness, and
  // a softer contact lets it creep.
  if (!experiment.is_run) state.coupling.contact_stiffness = hard;
  Diagnostics diagnostics;
  int direction = state.coupling.two_way ? 1 : 0;
  world::apply_settings(experiment.scene.coupling, "coupling",
                        coupling::parameters_of(state.coupling),
                        {{"direction", {"one_way", "two_way"}, &direction}}, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  state.plants.resize(experiment.plants.size());
  const int dofs = robot::KinematicModel(experiment.robot).dofs();
  state.joint_offset = state.coulomb = state.viscous = Eigen::VectorXd::Zero(dofs);
  state.gauges.resize(experiment.wrenches.size());
  state.cameras = experiment.cameras;
  return state;
}

}  // namespace pedicel::discrepancy
