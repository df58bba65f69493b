#pragma once

#include <limits>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "plugins/discrepancy/settings/scene_settings.h"

namespace pedicel::discrepancy {

/// The source of what was chosen by trying, before figures were kept.
inline constexpr const char* bench = "bench of hidden effects; no figure was kept";

/// The rows of one part of the settings, in the order of its fields.
class SettingRows {
 public:
  SettingRows(std::string part, std::vector<DiagnosisSetting>& rows)
      : part_(std::move(part)), rows_(rows) {}

  struct Why {
    SettingKind kind;
    std::string source, doubled;
  };
  /// Nats, from 0 on.
  void nats(const char* name, double& value, const char* sentence, Why why) {
    add(name, "nats", &value, 0.0, 1.0e6, sentence, std::move(why));
  }
  /// Deviations, noise units and other plain numbers from 0 on.
  void number(const char* name, double& value, const char* sentence, Why why) {
    add(name, "1", &value, 0.0, 1.0e6, sentence, std::move(why));
  }
  /// Part of a whole.
  void share(const char* name, double& value, const char* sentence, Why why) {
    add(name, "1", &value, 0.0, 1.0, sentence, std::move(why));
  }
  void seconds(const char* name, double& value, const char* sentence, Why why) {
    add(name, "s", &value, 1.0e-5, 0.1, sentence, std::move(why));
  }
  /// s, m, rad and px of what was measured.
  void measure(const char* name, const char* unit, double& value, const char* sentence, Why why) {
    add(name, unit, &value, 1.0e-5, 10.0, sentence, std::move(why));
  }
  /// A step, above 0 because something is divided by it.
  void step(const char* name, double& value, const char* sentence, Why why) {
    add(name, "1", &value, 1.0e-6, 1.0, sentence, std::move(why));
  }
  void count(const char* name, int& value, const char* sentence, Why why) {
    add(name, "1", &value, 1.0, 1.0e5, sentence, std::move(why));
  }

 private:
  void add(const char* name, const char* unit, std::variant<double*, int*, bool*> value, double low,
           double high, const char* sentence, Why why) {
    rows_.push_back({{part_ + "." + name, unit, value, low, high, sentence},
                     why.kind,
                     std::move(why.source),
                     std::move(why.doubled)});
  }

  std::string part_;
  std::vector<DiagnosisSetting>& rows_;
};

/// Sets one of `rows` from "NAME=NUMBER". `example` and `page` of the manual stand in the
/// UsageError that says what was expected.
void assign_setting(const std::vector<DiagnosisSetting>& rows, const std::string& assignment,
                    const std::string& example, const std::string& page);

void add_levels(Levels& levels, std::vector<DiagnosisSetting>& rows);
void add_evidence(Evidence& evidence, std::vector<DiagnosisSetting>& rows);
void add_budget(Budget& budget, std::vector<DiagnosisSetting>& rows);
void add_accuracy(Accuracy& accuracy, std::vector<DiagnosisSetting>& rows);

void add_scene_search(SceneSearchSettings& search, std::vector<DiagnosisSetting>& rows);
void add_scene_fit(SceneFitSettings& fit, std::vector<DiagnosisSetting>& rows);
void add_outside_force(OutsideForceSettings& outside, std::vector<DiagnosisSetting>& rows);
void add_robot_alone(RobotAloneSettings& robot, std::vector<DiagnosisSetting>& rows);
void add_scene_symptoms(SceneSymptomSettings& symptoms, std::vector<DiagnosisSetting>& rows);

}  // namespace pedicel::discrepancy
