#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <map>

#include "plugins/discrepancy/scene_predict/scene_observe.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/unit/discrepancy_scene/arm_at_stem.h"

namespace pedicel::discrepancy {

/// Data of a variant with the instruments' noise, diagnosed with the same mesh and step.
class DiagnosedScene : public testing::Test {
 protected:
  DiagnosedScene() {
    numerics_.distance = 0.05;
    numerics_.dt = 2.0e-3;
  }
  SceneDiagnosis diagnose(const std::vector<std::string>& hidden,
                          const std::vector<SceneForce>& forces = {}) {
    at_.write_all();
    for (const auto& [name, text] : more_) at_.write(name, text);
    const Experiment plain = at_.read();
    SceneVariant variant;
    for (const std::string& text : hidden) variant.effects.push_back(scene_effect(text, plain));
    variant.forces = forces;
    SceneObserveOptions how;
    how.numerics = numerics_;
    made_ = observed_scene(plain, variant, how);
    SceneDiagnosisOptions options;
    options.settings = settings_;
    options.numerics = numerics_;
    options.settings.search.mesh = numerics_.distance;
    options.settings.search.dt = numerics_.dt;
    if (stops_) {
      options.stop = &stop_;
      options.progress = [this](const std::string& what, double) {
        if (cut_ == 0 && what.find("simulating") == std::string::npos) stop_ = true;
      };
      options.cut_short = [this] { stop_ = false, ++cut_; };
    }
    return diagnose_scene(made_, options);
  }
  static const NamedCause* cause(const SceneDiagnosis& diagnosis, const std::string& name) {
    for (const NamedCause& one : diagnosis.verdict.causes)
      if (one.name == name) return &one;
    return nullptr;
  }

  ArmAtStem at_;
  std::map<std::string, std::string> more_;  // files in place of those of `at_`
  SceneNumerics numerics_;
  SceneSettings settings_;
  Experiment made_;
  bool stops_ = false;  // as soon as the search has begun
  std::atomic<bool> stop_ = false;
  int cut_ = 0;
};

}  // namespace pedicel::discrepancy
