#include "app/dataset/data_set.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "app/dataset/annotations.h"
#include "app/dataset/data_set_files.h"
#include "app/dataset/split.h"
#include "app/sense/scene_sensors.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/core/timer.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

/// What was drawn for a picture, for its labels.
Json drawn_json(const world::Scene& scene) {
  Json drawn = Json::object();
  for (const auto& [key, text] : world::draw(scene.vary, static_cast<std::uint64_t>(scene.seed))) {
    const std::optional<double> number = world::to_number(text);
    drawn[key] = number ? Json(*number) : Json(text);
  }
  return drawn;
}

class Maker {
 public:
  explicit Maker(const DataSetOptions& options) : options_(options) {
    if (!taker_.available()) throw UsageError(taker_.why());
  }

  /// Why the picture is left out; empty: it is made.
  std::string make(long picture) {
    world::Scene scene = options_.scene;
    scene.seed = options_.seed + static_cast<int>(picture);
    std::string why;
    const std::unique_ptr<simulation::Simulation> built = build(scene, why);
    if (built && !step_to(*built, time_of(scene.seed))) why = "its simulation is unstable";
    if (!why.empty()) {
      write(picture, {{"left_out", why}, {"seed", scene.seed}, {"drawn", drawn_json(scene)}});
      return why;
    }
    simulation::Simulation& simulation = *built;
    SceneSensors sensors(simulation);
    SenseRequest wanted{camera_of_picture(picture), options_.size, true, true};
    const SensedPicture seen =
        *sensors.take(taker_, wanted, static_cast<std::uint64_t>(scene.seed));
    const PictureLabels labels = annotate(seen, sensors.things(), sensors.areas_alone(taker_),
                                          detached_things(simulation, sensors.things()));
    write_picture(picture, seen, sensors.things());
    Json image = image_entry(picture, seen);
    image["seed"] = scene.seed;
    image["camera"] = wanted.camera;
    image["hidden"] = labels.hidden;
    image["drawn"] = drawn_json(scene);
    if (picture == 0)
      io::write_file_atomically(options_.out / "things.json",
                                things_json(sensors.things()).dump(1) + "\n");
    write(picture, {{"image", std::move(image)}, {"annotations", labels.annotations}});
    return "";
  }

 private:
  /// Null where what was drawn cannot stand. Where the scene cannot either, that is its own fault,
  /// and the end of the set.
  std::unique_ptr<simulation::Simulation> build(const world::Scene& scene, std::string& why) {
    try {
      return std::make_unique<simulation::Simulation>(scene, options_.simulation);
    } catch (const InvalidFile& fault) {
      why = fault.what();
    }
    if (!scene_stands_) {
      world::Scene plain = options_.scene;
      plain.vary.clear();
      simulation::Simulation alone(plain, options_.simulation);
      scene_stands_ = true;
    }
    return nullptr;
  }

  double time_of(int seed) const {
    Random random(noise_seed(static_cast<std::uint64_t>(seed), "time", 0));
    return random.uniform(options_.at[0], options_.at[1]);
  }

  bool step_to(simulation::Simulation& simulation, double time) const {
    const long steps = std::lround(time / simulation.world().dt());
    for (long s = 0; s < steps; ++s)
      if (simulation.step().errors & world::fatal_errors) return false;
    return true;
  }

  std::string camera_of_picture(long picture) const {
    const auto& cameras = options_.scene.cameras;
    if (!options_.camera.empty() || cameras.empty()) return options_.camera;
    return cameras[static_cast<std::size_t>(picture) % cameras.size()].name;
  }

  std::filesystem::path place(const char* folder, long picture, const char* end) const {
    return options_.out / folder / (picture_name(picture) + end);
  }

  void write_picture(long picture, const SensedPicture& seen, const NamedThings& things) const {
    const render::LabelMap& map = seen.map;
    render::write_png(place("images", picture, ".png"), seen.image);
    render::write_png(place("depth", picture, ".png"),
                      depth_millimetres(map.depth, map.width, map.height));
    render::write_png(place("instances", picture, ".png"), instance_mask(map));
    render::write_png(place("classes", picture, ".png"), class_mask(map, things), 8);
    const Json camera = {{"time_s", seen.time},
                         {"camera", camera_json(seen.camera)},
                         {"keypoints", keypoints_json(seen, things)}};
    io::write_file_atomically(place("cameras", picture, ".json"), camera.dump(1) + "\n");
  }

  Json image_entry(long picture, const SensedPicture& seen) const {
    const std::string name = picture_name(picture);
    return {{"id", picture + 1},
            {"file_name", "images/" + name + ".png"},
            {"width", seen.map.width},
            {"height", seen.map.height},
            {"depth_file", "depth/" + name + ".png"},
            {"instances_file", "instances/" + name + ".png"},
            {"classes_file", "classes/" + name + ".png"},
            {"camera_file", "cameras/" + name + ".json"},
            {"split", std::string(split_of(picture, static_cast<std::uint64_t>(options_.seed)))},
            {"time_s", seen.time}};
  }

  /// Last of all: it says that the picture is whole.
  void write(long picture, const Json& labels) const {
    io::write_file_atomically(labels_file(options_.out, picture), labels.dump() + "\n");
  }

  const DataSetOptions& options_;
  PictureTaker taker_;
  bool scene_stands_ = false;  // without what varies; known once it was asked
};

void show_progress(const DataSetOptions& options, long done) {
  if (options.quiet || verbosity() < Verbosity::lines || !isatty(2)) return;
  std::fprintf(stderr, "\r%ld of %ld pictures%s", done, options.count,
               done == options.count ? "\n" : "");
}

/// Its labels come last; what was taken away since is made anew.
bool is_whole(const DataSetOptions& options, long picture) {
  const std::filesystem::path labels = labels_file(options.out, picture);
  std::error_code none;
  if (!std::filesystem::exists(labels, none)) return false;
  const Json read = read_labels(labels);
  if (!read.contains("image")) return true;
  for (const char* key :
       {"file_name", "depth_file", "instances_file", "classes_file", "camera_file"})
    if (!std::filesystem::exists(options.out / read["image"].value(key, ""), none)) return false;
  return true;
}

}  // namespace

DataSetResult make_data_set(const DataSetOptions& options) {
  if (static_cast<double>(options.seed) + static_cast<double>(options.count) > 1.0e9)
    throw UsageError("seed + count is above 1e9, expected seeds up to that");
  const Timer timer;
  Maker maker(options);
  const io::FolderLock lock = take_data_set_folder(options);
  long made = 0;
  for (long i = options.first; i < options.count && !stop_requested; ++i) {
    if (!is_whole(options, i)) {
      const std::string why = maker.make(i);
      made += why.empty();
      if (!why.empty())
        say(Verbosity::warnings, "picture %ld (seed %ld) is left out: %s", i, options.seed + i,
            why.c_str());
    }
    show_progress(options, i + 1);
  }
  DataSetResult result = end_data_set(options);
  result.made = made;
  result.seconds = timer.seconds();
  return result;
}

DataSetResult end_data_set(const DataSetOptions& options) {
  DataSetResult result;
  for (long i = 0; i < options.count; ++i) {
    const std::filesystem::path labels = labels_file(options.out, i);
    if (!std::filesystem::exists(labels)) continue;
    ++(read_labels(labels).contains("image") ? result.pictures : result.left_out);
  }
  result.annotations = write_coco(options);
  write_contact_sheet(options);
  return result;
}

}  // namespace pedicel::app
