#include "tests/discrepancy/scene_cases/scored_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "engine/io/csv.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/discrepancy/score_table.h"

namespace pedicel::scene_case {

namespace {

using discrepancy::NamedCause;
using discrepancy::Outcome;
using discrepancy::SceneDiagnosis;
using discrepancy::Verdict;
using nlohmann::ordered_json;
using Names = std::vector<std::string>;

// Noise units: twice what two honest solvers differ by, the smallest size that can be told at all.
constexpr double clear = 0.7;
constexpr double near = 0.03;  // m

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text.empty() ? "nothing" : text;
}

std::string call_of(const SceneScore& s, Outcome outcome) {
  const auto is_hidden = [&](const std::string& name) {
    return std::ranges::find(s.hidden, name) != s.hidden.end();
  };
  const bool nothing_wrong = std::ranges::all_of(s.said, is_hidden);
  if (s.kind == "null") return outcome == Outcome::adequate ? "right" : "false_alarm";
  if (outcome == Outcome::unknown) return s.kind == "outside" ? "right" : "unknown";
  if (outcome == Outcome::adequate) return "missed";
  if (s.kind == "outside") {
    // The modulus alone, where it was off, misses what is outside; any other name is wrong.
    return nothing_wrong && outcome == Outcome::named ? "missed" : "wrong";
  }
  if (outcome == Outcome::ambiguous)
    return std::ranges::includes(s.said, s.hidden) ? "held" : "not_held";
  if (outcome != Outcome::named) return "failed";
  if (s.said == s.hidden) return "right";
  return nothing_wrong ? "partial" : "wrong";
}

// Of causes that were named rightly: true numbers within their intervals.
void count_numbers(const Setting& setting, const Verdict& verdict, SceneScore& score) {
  for (const Hidden& hidden : setting.hidden)
    for (const NamedCause& cause : verdict.causes) {
      if (cause.name != hidden.name) continue;
      for (const auto& [key, values] : hidden.numbers) {
        const auto found = cause.parameters.find(key);
        if (found == cause.parameters.end()) continue;
        Names joints = {"shoulder", "elbow", "lift"};
        for (std::size_t i = 0; i < values.size(); ++i) {
          // A case writes an encoder's zero, or friction, for all joints; the verdict names one.
          const bool one_joint = hidden.name == "joint_offset" || hidden.name == "joint_friction";
          if (one_joint && (!cause.words.contains("joint") || cause.words.at("joint") != joints[i]))
            continue;
          const std::size_t at = one_joint ? 0 : i;
          if (at >= found->second.size()) continue;
          ++score.entries;
          score.inside += values[i] >= found->second[at].low && values[i] <= found->second[at].high;
        }
      }
    }
}

std::string notes_of(const Setting& setting, const SceneDiagnosis& found, const SceneScore& score) {
  std::string text = "seed " + std::to_string(setting.seed) + "\n";
  for (const Hidden& one : setting.hidden) {
    text += "hidden: " + one.name;
    for (const auto& [key, values] : one.numbers) {
      text += " " + key + "=";
      for (std::size_t i = 0; i < values.size(); ++i)
        text += (i > 0 ? "," : "") + io::format_number(values[i], 10);
    }
    text += "\n";
  }
  return text + "\n" + found.text + "\n" + discrepancy::to_json(found.verdict) + "\n" +
         to_line(score) + "\n";
}

ordered_json optional_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

std::string percent(double share) {
  // Bounds of none are 0 but for rounding.
  return io::format_number(share < 1.0e-9 ? 0.0 : 100.0 * share, 3) + " %";
}

}  // namespace

SceneScore run_case(const Order& order, std::uint64_t seed, const std::filesystem::path& folder,
                    int threads, std::string& notes, const std::atomic<bool>* stop) {
  const Setting setting = drawn(order, seed);
  SceneScore score;
  score.number = order.number;
  score.seed = seed;
  score.kind = order.kind;
  score.hidden = hidden_names(setting);
  try {
    const std::vector<Outside> outside = write_case(folder, setting);
    if (order.kind == "outside" && std::ranges::none_of(outside, &Outside::acts))
      throw std::logic_error("what is outside acts in no trial, so there is nothing to find");
    Diagnostics diagnostics;
    const auto experiment = discrepancy::read_experiment(folder, diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    discrepancy::SceneDiagnosisOptions options;
    options.threads = threads;
    options.stop = stop;
    const SceneDiagnosis found = diagnose_scene(*experiment, options);
    const Verdict& verdict = found.verdict;
    std::set<std::string> said;
    for (const NamedCause& cause : verdict.causes) said.insert(cause.name);
    score.said.assign(said.begin(), said.end());
    score.outcome = to_string(verdict.outcome);
    score.call = call_of(score, verdict.outcome);
    score.nominal = found.findings.nominal_excess;
    score.size = found.findings.baseline_excess;
    score.left = discrepancy::SceneDataSet::beyond_noise(found.findings.model().misfit());
    if (score.call == "right") count_numbers(setting, verdict, score);
    if (const int trial = found.findings.outside.trial; verdict.unknown && trial >= 0)
      if (const Outside& truth = outside[static_cast<std::size_t>(trial)]; truth.acts) {
        score.place_off = (verdict.unknown->position - truth.place).norm();
        score.time_off = verdict.unknown->from - truth.from;
      }
    score.seconds = verdict.seconds;
    notes = notes_of(setting, found, score);
  } catch (const std::exception& error) {
    score.fault = error.what();
    score.call = order.kind == "null" ? "false_alarm" : "failed";
    notes = score.fault + "\n";
  }
  return score;
}

std::string to_line(const SceneScore& s) {
  const ordered_json json = {{"case", s.number},
                             {"seed", s.seed},
                             {"kind", s.kind},
                             {"hidden", s.hidden},
                             {"said", s.said},
                             {"verdict", s.outcome},
                             {"call", s.call},
                             {"nominal", s.nominal},
                             {"size", s.size},
                             {"left", s.left},
                             {"place_off", optional_number(s.place_off)},
                             {"time_off", optional_number(s.time_off)},
                             {"inside", s.inside},
                             {"entries", s.entries},
                             {"seconds", s.seconds},
                             {"fault", s.fault}};
  return json.dump();
}

SceneScore from_line(const std::string& line) {
  const ordered_json json = ordered_json::parse(line);
  SceneScore s;
  json.at("case").get_to(s.number);
  json.at("seed").get_to(s.seed);
  json.at("kind").get_to(s.kind);
  json.at("hidden").get_to(s.hidden);
  json.at("said").get_to(s.said);
  json.at("verdict").get_to(s.outcome);
  json.at("call").get_to(s.call);
  json.at("nominal").get_to(s.nominal);
  json.at("size").get_to(s.size);
  json.at("left").get_to(s.left);
  if (!json.at("place_off").is_null()) s.place_off = json.at("place_off").get<double>();
  if (!json.at("time_off").is_null()) s.time_off = json.at("time_off").get<double>();
  json.at("inside").get_to(s.inside);
  json.at("entries").get_to(s.entries);
  json.at("seconds").get_to(s.seconds);
  json.at("fault").get_to(s.fault);
  return s;
}

std::string rates_text(const std::vector<SceneScore>& scores) {
  using Wanted = std::function<bool(const SceneScore&)>;
  std::string text = "| figure | reached | 95 % bounds | cases | wanted |\n|---|---|---|---|---|\n";
  const auto row = [&](const std::string& figure, const char* wanted, const Wanted& among,
                       const Wanted& counted) {
    int count = 0, of = 0;
    for (const SceneScore& s : scores)
      if (among(s)) ++of, count += counted(s);
    const hidden::Share share = hidden::share(count, of);
    text += "| " + figure + " | " +
            (of > 0 ? std::to_string(count) + ", " + percent(share.value) + " | " +
                          percent(share.low) + " to " + percent(share.high)
                    : std::string("- | -")) +
            " | " + std::to_string(of) + " | " + wanted + " |\n";
  };
  const auto kind = [](const char* wanted) {
    return [wanted](const SceneScore& s) { return s.kind == wanted; };
  };
  const auto call = [](const char* wanted) {
    return [wanted](const SceneScore& s) { return s.call == wanted; };
  };
  // What the material takes away leaves nothing for a size.
  const auto is_clear = [](const SceneScore& s) {
    return s.kind == "effect" && std::max(s.size, s.hidden.size() == 1 ? s.nominal : 0.0) >= clear;
  };
  row("false alarms where nothing is hidden", "0 of 30", kind("null"), call("false_alarm"));
  row("one effect: the hidden set and no other name", "", kind("effect"), call("right"));
  row("- of 0.7 noise units or more", "85 %", is_clear, call("right"));
  row("- a wrong name with confidence", "3 %", kind("effect"), call("wrong"));
  row("- \"cannot tell\", the truth among the names", "", kind("effect"), call("held"));
  row("- \"cannot tell\", the truth not among them", "", kind("effect"), call("not_held"));
  row("- unknown, missed, or one of two names", "", kind("effect"), [](const SceneScore& s) {
    return s.call == "unknown" || s.call == "missed" || s.call == "partial";
  });
  row("two effects: both and no other name", "", kind("pair"), call("right"));
  row("- a wrong name with confidence", "3 %", kind("pair"), call("wrong"));
  row("outside the list: unknown", "80 %", kind("outside"), call("right"));
  row("- its place within 3 cm", "70 %", kind("outside"),
      [](const SceneScore& s) { return s.call == "right" && s.place_off && *s.place_off <= near; });
  row("- a name with confidence", "", kind("outside"), call("wrong"));
  int inside = 0, entries = 0;
  double seconds = 0.0, longest = 0.0;
  for (const SceneScore& s : scores) {
    inside += s.inside;
    entries += s.entries;
    seconds += s.seconds;
    longest = std::max(longest, s.seconds);
  }
  const hidden::Share held = hidden::share(inside, entries);
  text +=
      "| true numbers within their 95 % intervals | " +
      (entries > 0 ? percent(held.value) + " | " + percent(held.low) + " to " + percent(held.high)
                   : std::string("- | -")) +
      " | " + std::to_string(entries) + " numbers | |\n";
  if (!scores.empty())
    text += "\nA diagnosis took " +
            io::format_number(seconds / static_cast<double>(scores.size()), 3) +
            " s on average, and at most " + io::format_number(longest, 3) + " s.\n";
  return text;
}

std::string confusion_text(const std::vector<SceneScore>& scores) {
  std::map<std::string, std::map<std::string, int>> cells;
  for (const SceneScore& s : scores) {
    const std::string said = !s.fault.empty()           ? "no verdict"
                             : s.outcome == "adequate"  ? "nothing"
                             : s.outcome == "named"     ? joined(s.said)
                             : s.outcome == "ambiguous" ? "cannot tell: " + joined(s.said)
                             : s.said.empty()           ? s.outcome
                                                        : s.outcome + " and " + joined(s.said);
    ++cells[joined(s.hidden)][said];
  }
  std::string text = "| hidden | said (cases) |\n|---|---|\n";
  for (const auto& [hidden, row] : cells) {
    std::vector<std::pair<std::string, int>> sorted(row.begin(), row.end());
    std::ranges::stable_sort(sorted, std::ranges::greater{},
                             [](const auto& c) { return c.second; });
    text += "| " + hidden + " | ";
    for (std::size_t i = 0; i < sorted.size(); ++i)
      text += (i > 0 ? "; " : "") + sorted[i].first + " " + std::to_string(sorted[i].second);
    text += " |\n";
  }
  return text;
}

std::string cases_text(const std::vector<SceneScore>& scores) {
  std::string text =
      "| case | hidden | as the files say, refitted, left | verdict | said | worth | place off |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SceneScore& s : scores)
    text += "| " + std::to_string(s.number) + " | " + joined(s.hidden) + " | " +
            io::format_number(s.nominal, 3) + ", " + io::format_number(s.size, 3) + ", " +
            io::format_number(s.left, 3) + " | " + (s.fault.empty() ? s.outcome : s.fault) + " | " +
            joined(s.said) + " | " + s.call + " | " +
            (s.place_off ? io::format_number(1000.0 * *s.place_off, 2) + " mm" : "") + " |\n";
  return text;
}

}  // namespace pedicel::scene_case
