#include "plugins/discrepancy/scene/effect_parameters.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

SceneEffectDefinition define_lens_distortion() {
  SceneEffectDefinition d;
  d.name = "lens_distortion";
  d.plain_name = "a lens that distorts";
  d.sentence = "the lens of a camera distorts more than its calibration says";
  d.home = SceneHome::camera;
  d.is_only_seen = true;
  d.parameters = {
      {.name = "k1",
       .unit = "1",
       .bounds = io::any_number,
       .sentence = "added to the first radial coefficient",
       .vanishes = effects::Vanishes::at_zero,
       .first = {0.0}},
      which("camera", "camera"),
  };
  d.apply = [](const SceneEffectTarget& t) {
    t.each_camera([&](Camera& camera) { camera.distortion[0] += t.number("k1"); });
  };
  d.starts = [](const SceneStartContext& c) -> std::vector<effects::Start> {
    std::vector<effects::Start> starts;
    for (const Camera& camera : c.experiment.cameras)
      starts.push_back(effects::Start("lens_distortion")
                           .word("camera", camera.name)
                           .signed_number("k1", 0.0, 0.01, -1.0, 1.0));
    return starts;
  };
  d.speaks_for = {{"image_motion", 3}};
  d.tells_apart = "calibrate the camera with a chessboard";
  return d;
}

}  // namespace pedicel::discrepancy
