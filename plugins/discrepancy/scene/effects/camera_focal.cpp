#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_camera_focal() {
  SceneEffectDefinition d;
  d.name = "camera_focal";
  d.plain_name = "a camera with another focal length";
  d.sentence = "the focal length of a camera differs from its calibration";
  d.home = SceneHome::camera;
  d.is_only_seen = true;
  d.parameters = {factor_of("factor", "on both focal lengths"), which("camera", "camera")};
  d.apply = [](const SceneEffectTarget& t) {
    t.each_camera([&](Camera& camera) { camera.focal *= t.number("factor"); });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const Camera& camera : c.experiment.cameras)
      starts.push_back(effects::Start("camera_focal")
                           .word("camera", camera.name)
                           .positive("factor", 1.0, 0.5, 2.0));
    return starts;
  };
  d.speaks_for = {{"image_motion", 2}};
  d.tells_apart = "calibrate the camera with a chessboard";
  return d;
}

}  // namespace pedicel::discrepancy
