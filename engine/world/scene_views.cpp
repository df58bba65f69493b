#include <algorithm>

#include "pedicel/world/scene_sections.h"
#include "pedicel/world/settings.h"

namespace pedicel::world::sections {

ScenePicture read_picture(const io::YamlNode& node) {
  ScenePicture picture;
  io::YamlMap map(node, "a picture");
  picture.camera = map.text("camera", "");
  picture.strain = map.boolean("strain", false);
  const std::vector<std::string> words = {"before_detachment", "after_detachment", "end"};
  const auto at = map.required("at");
  if (at && !at->raw().IsNull() && at->is_scalar() &&
      std::find(words.begin(), words.end(), at->raw().Scalar()) != words.end()) {
    const auto index = std::find(words.begin(), words.end(), at->raw().Scalar()) - words.begin();
    picture.when = static_cast<ScenePicture::When>(1 + index);
  } else if (at) {
    picture.time = at->number("at (a time in s, before_detachment, after_detachment or end)",
                              io::not_negative);
  }
  map.finish();
  return picture;
}

SceneVideo read_video(const io::YamlNode& node) {
  SceneVideo video;
  io::YamlMap map(node, "video");
  video.fps = map.number("fps", video_rates, video.fps);
  video.camera = map.text("camera", "");
  if (const auto size = map.optional("size")) {
    const auto parts = size->list("size");
    if (parts.size() != 2) size->error("size: expected [width, height] in pixels");
    for (std::size_t i = 0; i < 2 && parts.size() == 2; ++i)
      video.size[i] = parts[i].integer("size", 16, 8192);
  }
  map.finish();
  return video;
}

SceneSweep read_sweep(const io::YamlNode& node) {
  SceneSweep sweep;
  io::YamlMap map(node, "sweep");
  sweep.where = node.position();
  sweep.key = map.text("set");
  if (const auto values = map.required("values")) {
    sweep.values = values->numbers("values");
    if (sweep.values.size() < 2) values->error("values: expected at least two");
    for (std::size_t i = 1; i < sweep.values.size(); ++i)
      if (std::count(sweep.values.begin(), sweep.values.begin() + i, sweep.values[i]) > 0)
        values->error("values: one of them comes twice, expected each once");
  }
  map.finish();
  return sweep;
}

}  // namespace pedicel::world::sections
