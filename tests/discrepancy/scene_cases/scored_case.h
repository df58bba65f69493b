#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/discrepancy/scene_cases/drawn_case.h"

namespace pedicel::scene_case {

/// What a verdict was worth: right, held ("cannot tell", and the truth is among the names),
/// not_held, partial (one of two, nothing wrong), wrong (a wrong name with confidence), unknown,
/// missed, false_alarm, failed.
struct SceneScore {
  int number = 0;
  std::uint64_t seed = 0;
  std::string kind;
  std::vector<std::string> hidden, said;  ///< sorted
  std::string outcome, call;
  double nominal = 0.0, size = 0.0, left = 0.0;  ///< noise units beyond the noise: as the files
                                                 ///< say; with the material refitted; as concluded
  std::optional<double> place_off, time_off;     ///< m and s, of something outside
  int inside = 0, entries = 0;  ///< true numbers, and those within their 95 % intervals
  double seconds = 0.0;
  std::string fault;  ///< why there is no verdict
};

/// Makes the case in `folder`, diagnoses it from its files alone and scores the verdict.
/// `notes`: what was hidden, the fits, the verdict. A diagnosis that throws is scored `failed`.
SceneScore run_case(const Order& order, std::uint64_t seed, const std::filesystem::path& folder,
                    int threads, std::string& notes, const std::atomic<bool>* stop = nullptr);

std::string to_line(const SceneScore& score);
/// Throws std::exception where the line is no score.
SceneScore from_line(const std::string& line);

/// Rates with 95 % bounds, and what was hidden against what was said, in Markdown.
std::string rates_text(const std::vector<SceneScore>& scores);
std::string confusion_text(const std::vector<SceneScore>& scores);
/// A line a case.
std::string cases_text(const std::vector<SceneScore>& scores);

}  // namespace pedicel::scene_case
