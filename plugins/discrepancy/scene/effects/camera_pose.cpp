#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_camera_pose() {
  SceneEffectDefinition d;
  d.name = "camera_pose";
  d.plain_name = "a camera that stands elsewhere";
  d.sentence = "a camera stands or looks elsewhere than its calibration says";
  d.home = SceneHome::camera;
  d.is_only_seen = true;
  d.parameters = {vector_of("offset", "m", "in the world"),
                  vector_of("rotation", "rad", "rotation vector in the camera's own frame", false),
                  which("camera", "camera")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_camera([&](Camera& camera) {
      camera.X_WC.position += t.vector("offset");
      if (!t.has("rotation")) return;
      const Vec3 turn = t.vector("rotation");
      if (turn.norm() > 0.0)
        camera.X_WC.rotation =
            camera.X_WC.rotation * Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const Camera& camera : c.experiment.cameras)
      starts.push_back(effects::Start("camera_pose")
                           .word("camera", camera.name)
                           .vector("offset", Vec3::Zero(), 2.0e-3, 0.5)
                           .vector("rotation", Vec3::Zero(), 2.0e-3, 0.5));
    return starts;
  };
  d.speaks_for = {{"image_motion", 1}};
  d.tells_apart = "calibrate the camera against the arm with a marker on the tool";
  return d;
}

}  // namespace pedicel::discrepancy
