#include "plugins/discrepancy/pick/pick_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  // JSON has no word for what is not finite, and a zero in its place would be a measurement.
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

// Beside the outcome, which has the words of public data sets and no word for a slip.
const char* name_of(Pick::End end) {
  switch (end) {
    case Pick::End::came_off:
      return "came_off";
    case Pick::End::slipped:
      return "slipped";
    case Pick::End::held:
      return "held";
    case Pick::End::unclear:
      break;
  }
  return "unclear";
}

Json json_of(const JudgedPick& judged) {
  const Pick& pick = judged.pick;
  const Fall* fall = pick.fall ? &*pick.fall : nullptr;
  const auto of_fall = [fall](double Fall::*value) {
    return fall ? number(fall->*value) : Json(nullptr);
  };
  const bool has_time = pick.time().has_value();
  // A fall that went slowly has levels and no time. Its zero would read as a sudden one.
  const bool timed = fall && fall->half;
  return {{"format", "pedicel-pick"},
          {"version", 1},
          {"file", judged.record.file},
          {"columns", judged.record.columns},
          {"outcome", pick.outcome()},
          {"end", name_of(pick.end)},
          {"probability_detached", number(pick.probability)},
          {"moment_s", number(pick.time())},
          // An error without its number would be taken for one of something else.
          {"moment_error_s", has_time ? number(fall->onset_error) : Json(nullptr)},
          {"peak_force_N", number(pick.peak_force)},
          // Of one sample, as the peak is one.
          {"peak_force_error_N", number(pick.noise)},
          {"peak_time_s", number(pick.peak_time)},
          {"load_before_N", of_fall(&Fall::before)},
          {"load_after_N", of_fall(&Fall::after)},
          {"half_time_s", timed ? number(*fall->half) : Json(nullptr)},
          {"half_time_error_s", timed ? number(fall->half_error) : Json(nullptr)},
          {"half_time_limit_s", pick.limit > 0.0 ? number(pick.limit) : Json(nullptr)},
          {"interval_s", number(pick.interval)},
          {"sentence", pick.sentence()}};
}

std::string cell(const char* format, const std::optional<double>& value) {
  // A dash, since an empty cell would shift the columns for programs that part at blanks.
  return value ? text(format, *value) : "-";
}

}  // namespace

std::string to_text(const JudgedPick& judged) {
  const Pick& pick = judged.pick;
  std::string lines =
      judged.record.file + ": " + pick.sentence() + "\n" +
      // Twice the standard error, as people read plus and minus. JSON has it once, as programs do.
      text("  peak force    %.4g N (+- %.2g N)", pick.peak_force, 2.0 * pick.noise) +
      text(" at %.3f s\n", pick.peak_time);
  // Without a fall the sentence has said all.
  if (!pick.fall) return lines;
  const Fall& fall = *pick.fall;
  // Along the pull before it, so that what is left may be below zero.
  lines += text("  the fall      from %.4g N to %.4g N along the pull\n", fall.before, fall.after);
  if (fall.half && pick.limit > 0.0)
    lines +=
        text("  half of it    in %.3g ms (+- %.2g ms)", 1e3 * *fall.half, 2e3 * fall.half_error) +
        // With the limit beside it, which a slow record has longer than others.
        text("; a break takes less than %.3g ms\n", 1e3 * pick.limit);
  return lines;
}

std::string to_table(const std::vector<JudgedPick>& all) {
  // Files are told by their names without folders: all of a table mostly lie in one.
  std::size_t widest = 4;
  for (const JudgedPick& judged : all)
    widest = std::max(widest, std::filesystem::path(judged.record.file).filename().string().size());
  const auto line = [widest](const std::vector<std::string>& cells) {
    // Numbers to the right, so that a season's records read down a column.
    constexpr int widths[] = {8, 8, 10, 9, 9, 9, 8};
    std::string row = cells.front();
    row.resize(std::max(row.size(), widest), ' ');
    for (std::size_t i = 1; i < cells.size(); ++i) {
      char padded[80];
      std::snprintf(padded, sizeof padded, "  %*s", widths[i - 1], cells[i].c_str());
      row += padded;
    }
    return row + "\n";
  };
  std::string table =
      line({"file", "outcome", "end", "P detached", "time, s", "peak, N", "half, ms", "lost, %"});
  for (const JudgedPick& judged : all) {
    const Pick& pick = judged.pick;
    // Also of a record without a probability, where there is one: what was measured is told
    // whatever came of it.
    const std::optional<double> half = pick.fall ? pick.fall->half : std::nullopt;
    table += line({std::filesystem::path(judged.record.file).filename().string(), pick.outcome(),
                   name_of(pick.end), cell("%.3f", pick.probability), cell("%.3f", pick.time()),
                   text("%.4g", pick.peak_force), half ? text("%.3g", 1e3 * *half) : "-",
                   pick.fall ? text("%.0f", 100.0 * pick.fall->share) : "-"});
  }
  return table;
}

std::string to_json(const std::vector<JudgedPick>& all) {
  // An object for one file, so that the plainest use needs no index.
  if (all.size() == 1) return json_of(all.front()).dump(2);
  Json list = Json::array();
  for (const JudgedPick& judged : all) list.push_back(json_of(judged));
  return list.dump(2);
}

}  // namespace pedicel::discrepancy
