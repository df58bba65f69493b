#include <algorithm>

#include "engine/world/scene_sections.h"
#include "engine/world/settings.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

const std::vector<std::string>& picture_times() {
  static const std::vector<std::string> words = {"before_detachment", "after_detachment", "end"};
  return words;
}

const io::KeyList& picture_list() {
  static const io::KeyList keys{"picture",
                                "a picture",
                                {{.name = "at",
                                  .unit = "s",
                                  .bounds = io::not_negative,
                                  .words = picture_times(),
                                  .sentence = "when: a time or a word"},
                                 {.name = "camera",
                                  .type = KeyType::text,
                                  .otherwise = Told{"the first"},
                                  .form = "name of a camera",
                                  .sentence = "from where"},
                                 {.name = "strain",
                                  .type = KeyType::flag,
                                  .otherwise = ScenePicture{}.strain,
                                  .sentence = "stems are coloured by their strain"}}};
  return keys;
}

const io::KeyList& video_list() {
  static const io::KeyList keys{"video",
                                "video",
                                {{.name = "fps",
                                  .unit = "Hz",
                                  .otherwise = SceneVideo{}.fps,
                                  .bounds = video_rates,
                                  .sentence = "frames a simulated second"},
                                 picture_size_key(SceneVideo{}.size, "width and height"),
                                 {.name = "camera",
                                  .type = KeyType::text,
                                  .otherwise = Told{"the first"},
                                  .form = "name of a camera",
                                  .sentence = "from where"}}};
  return keys;
}

const io::KeyList& sweep_list() {
  static const io::KeyList keys{"sweep",
                                "sweep",
                                {{.name = "set",
                                  .type = KeyType::text,
                                  .form = "a key of `--set`",
                                  .sentence = "what is changed"},
                                 {.name = "values",
                                  .type = KeyType::numbers,
                                  .unit = "of the key",
                                  .form = "two or more, each once",
                                  .sentence = "its values"}}};
  return keys;
}

}  // namespace

std::vector<const io::KeyList*> view_keys() {
  return {&picture_list(), &video_list(), &sweep_list()};
}

ScenePicture read_picture(const io::YamlNode& node) {
  ScenePicture picture;
  io::DescribedMap map(node, picture_list());
  picture.camera = map.text("camera");
  picture.strain = map.boolean("strain");
  const std::vector<std::string>& words = map.key("at").words;
  const auto at = map.required("at");
  if (at && !at->raw().IsNull() && at->is_scalar() &&
      std::find(words.begin(), words.end(), at->raw().Scalar()) != words.end()) {
    const auto index = std::find(words.begin(), words.end(), at->raw().Scalar()) - words.begin();
    picture.when = static_cast<ScenePicture::When>(1 + index);
  } else if (at) {
    picture.time = at->number("at (a time in s, before_detachment, after_detachment or end)",
                              map.key("at").bounds);
  }
  map.finish();
  return picture;
}

SceneVideo read_video(const io::YamlNode& node) {
  SceneVideo video;
  io::DescribedMap map(node, video_list());
  video.fps = map.number("fps");
  video.camera = map.text("camera");
  read_picture_size(map, video.size);
  map.finish();
  return video;
}

SceneSweep read_sweep(const io::YamlNode& node) {
  SceneSweep sweep;
  io::DescribedMap map(node, sweep_list());
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
