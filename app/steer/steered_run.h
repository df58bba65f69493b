#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/session/document/document.h"
#include "app/steer/organ_forces.h"
#include "app/steer/saved_run.h"
#include "app/steer/state_arrays.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

/// A scene with what was set over it, built once for any number of runs.
struct SteeredScene {
  /// Throws InvalidFile and UsageError.
  SteeredScene(Document opened, std::vector<std::string> wanted_packages);

  using Settings = std::vector<std::pair<std::string, std::string>>;  ///< key and text
  /// The same with more settings (Document::settings). Throws UsageError where they are impossible.
  std::shared_ptr<const SteeredScene> with(const Settings& settings) const;

  Document files;     ///< as it was opened
  Document document;  ///< with the settings
  std::vector<std::string> packages;
  std::shared_ptr<const simulation::SceneAssets> assets;

 private:
  void build();
};

/// A simulation that is led from outside: what is done to it is kept, so that its state can be
/// saved and had again, bit by bit.
class SteeredRun {
 public:
  explicit SteeredRun(std::shared_ptr<const SteeredScene> scene);
  SteeredRun(const SteeredRun&) = delete;
  SteeredRun& operator=(const SteeredRun&) = delete;

  const SteeredScene& scene() const { return *scene_; }
  /// The same with what was set since.
  const SteeredScene& constants() const { return *now_; }
  simulation::Simulation& simulation() { return *simulation_; }
  const simulation::Simulation& simulation() const { return *simulation_; }
  long steps() const { return simulation_->world().steps(); }
  /// Another number with each simulation(): what was made for one is of no use for the next.
  long generation() const { return generation_; }

  /// Does something now, and keeps it. Throws UsageError where it is impossible, and then nothing
  /// is done.
  void act(Act act);
  /// Null where the last step was good; else the sentence that says what went wrong, when, and what
  /// helps. A run that failed does no more steps.
  bool step();
  bool failed() const;
  std::string failure() const;

  /// To time 0 of the scene that it was made with, or of that scene with more settings. Throws
  /// UsageError where they are impossible or make other rows (RowLayout), and then it is at time
  /// 0 of the scene that it was made with.
  void reset(const SteeredScene::Settings& settings = {});

  SavedRun save() const;
  /// Goes to a state, from here where the way leads through here, else from time 0. Throws
  /// UsageError where it is one of another scene, or does not come out bit by bit.
  void restore(const SavedRun& saved);

 private:
  void begin();
  void carry_out(const Act& act);
  void set_targets(const Act& act);
  void change(const std::string& key, const std::string& text);
  bool leads_through_here(const SavedRun& saved) const;

  std::shared_ptr<const SteeredScene> made_;   // that it was made with
  std::shared_ptr<const SteeredScene> scene_;  // that it began with
  std::shared_ptr<const SteeredScene> now_;    // whose constants count
  std::unique_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<OrganForces> forces_;  // of simulation_
  std::uint64_t model_ = 0;              // model_hash() at its start
  std::vector<Act> acts_;
  long generation_ = 0;
};

}  // namespace pedicel::app
