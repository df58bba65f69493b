#include "plugins/discrepancy/settings/scene_settings.h"

#include <cstdio>

#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

const SceneSettings& default_scene_settings() {
  static const SceneSettings settings;
  return settings;
}

std::vector<DiagnosisSetting> described(SceneSettings& settings) {
  std::vector<DiagnosisSetting> rows;
  add_scene_search(settings.search, rows);
  add_scene_fit(settings.fit, rows);
  add_outside_force(settings.outside, rows);
  add_robot_alone(settings.robot, rows);
  add_scene_symptoms(settings.symptoms, rows);
  return rows;
}

void set_setting(SceneSettings& settings, const std::string& assignment) {
  assign_setting(described(settings), assignment, "search.floor=0.5", "scene_settings");
}

std::vector<std::string> changed_settings(SceneSettings settings) {
  SceneSettings defaults;
  const std::vector<DiagnosisSetting> own = described(settings), usual = described(defaults);
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i].get() == usual[i].get()) continue;
    char values[64];
    std::snprintf(values, sizeof values, " is %.6g in place of %.6g", own[i].get(), usual[i].get());
    sentences.push_back("setting " + own[i].name + values);
  }
  return sentences;
}

}  // namespace pedicel::discrepancy
