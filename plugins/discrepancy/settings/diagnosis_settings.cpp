#include "plugins/discrepancy/settings/diagnosis_settings.h"

#include <charconv>

#include "engine/core/check.h"
#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

const DiagnosisSettings& default_settings() {
  static const DiagnosisSettings settings;
  return settings;
}

std::string_view to_string(SettingKind kind) {
  switch (kind) {
    case SettingKind::derived:
      return "derived";
    case SettingKind::measured:
      return "measured";
    case SettingKind::budget:
      return "budget";
  }
  return "";
}

std::vector<DiagnosisSetting> described(DiagnosisSettings& settings) {
  std::vector<DiagnosisSetting> rows;
  add_levels(settings.levels, rows);
  add_evidence(settings.evidence, rows);
  add_budget(settings.budget, rows);
  add_accuracy(settings.accuracy, rows);
  return rows;
}

void assign_setting(const std::vector<DiagnosisSetting>& rows, const std::string& assignment,
                    const std::string& example, const std::string& page) {
  const std::size_t equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  double value = 0.0;
  const char* first =
      assignment.data() + (equals == std::string::npos ? assignment.size() : equals + 1);
  const char* last = assignment.data() + assignment.size();
  const auto read = std::from_chars(first, last, value);
  if (first == last || read.ec != std::errc() || read.ptr != last)
    throw UsageError("--set " + assignment + ": expected NAME=NUMBER, as " + example);
  for (const DiagnosisSetting& setting : rows) {
    if (setting.name != name) continue;
    if (const auto refusal = set_parameter(setting, value)) throw UsageError("--set " + *refusal);
    return;
  }
  throw UsageError("--set " + assignment + ": no setting of this diagnosis is called \"" + name +
                   "\"; expected one of `pedicel manual " + page + "`");
}

void set_setting(DiagnosisSettings& settings, const std::string& assignment) {
  assign_setting(described(settings), assignment, "levels.clear_odds=4", "diagnosis_settings");
}

}  // namespace pedicel::discrepancy
