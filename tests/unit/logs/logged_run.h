#pragma once

#include <functional>

#include "app/report/headless.h"
#include "app/topics/mcap_log.h"
#include "engine/world/scene_reader.h"
#include "plugins/discrepancy/log_import/log_contents.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::app {

/// A run with its log: an arm of one joint swings a finger along a known path, and in the end
/// against a stem where `gap` is small.
class LoggedRun {
 public:
  explicit LoggedRun(const std::string& gap = "0.03", double duration = 1.2,
                     const std::function<void(discrepancy::ArmAtStem&)>& change = {}) {
    files_.gap = gap;
    if (change) change(files_);
    files_.write_all();
    std::string path = "time_s,turn\n";
    for (int i = 0; i <= 120; ++i)
      path += std::to_string(0.01 * i) + "," + std::to_string(files_.joint(0.01 * i)) + "\n";
    files_.write("path.csv", path);
    Diagnostics diagnostics;
    auto scene = world::read_scene(files_.path() / "scene.yaml", diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    scene->robot->trajectory = files_.path() / "path.csv";
    scene->duration = duration;
    RunOptions options;
    options.quiet = true;
    options.pictures = !files_.scene_more.empty();
    options.video = options.comparison = false;
    options.out = files_.path() / "out";
    options.watchers = {mcap_log(log_file())};
    result_ = run_scene(*scene, options);
  }

  std::filesystem::path log_file() const { return files_.path() / "run.mcap"; }
  const SceneResult& result() const { return result_; }
  const discrepancy::ArmAtStem& files() const { return files_; }
  std::filesystem::path path(const std::string& name) const { return files_.path() / name; }
  /// rad, where the joint is told to be.
  double joint(double time) const { return files_.joint(time); }

 private:
  discrepancy::ArmAtStem files_;
  SceneResult result_;
};

}  // namespace pedicel::app
