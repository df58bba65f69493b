#include "tests/discrepancy/harvest/hidden_stalk.h"

#include <cmath>
#include <numbers>

#include "engine/core/diagnostics.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "plugins/discrepancy/scene_procedure/robot_alone.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"
#include "tests/discrepancy/scene_cases/draw.h"
#include "tests/discrepancy/scene_cases/harvest_case.h"
#include "tests/discrepancy/score_table.h"

namespace pedicel::harvest {

namespace {

using discrepancy::Estimate;
using discrepancy::Experiment;
using discrepancy::SceneDiagnosis;
using discrepancy::SymptomNumber;
using scene_case::Draw;
using scene_case::Run;
using scene_case::Setting;

constexpr double farthest = 0.012, softest = 0.75, weakest = 0.6;  // m, 1, 1
constexpr double interval95 = 1.96;

Experiment read(const std::filesystem::path& folder) {
  Diagnostics diagnostics;
  auto experiment = discrepancy::read_experiment(folder, diagnostics);
  if (!experiment) throw InvalidFile(diagnostics);
  return std::move(*experiment);
}

Told told(const SymptomNumber& symptom, double truth) {
  const double off = symptom.value - truth;
  return {off, std::abs(off) <= interval95 * symptom.error};
}

bool holds(const Estimate& said, double truth) {
  return truth >= said.low && truth <= said.high;
}

// The finger stands still where it has pushed the stem farthest.
void look_at_holds(StalkTold& stalk, const SceneDiagnosis& found, const std::vector<Run>& runs) {
  const std::vector<scene_case::Drive> drives = drives_of(stalk.pushed);
  for (const SymptomNumber& symptom : found.verdict.symptoms)
    for (std::size_t t = 0; t < runs.size(); ++t) {
      if (symptom.of != drives[t].name || symptom.name != "hold_place") continue;
      const double middle = 0.5 * (drives[t].time[1] + drives[t].time[2]);
      stalk.hold.push_back(told(symptom, runs[t].pushed[runs[t].step(middle)]));
    }
}

void look_at_attachment(StalkTold& stalk, const SceneDiagnosis& found,
                        const std::vector<Run>& runs) {
  const Setting& s = stalk.pushed;
  scene_case::Vec3 off, said_way, way;
  bool is_inside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto said = found.verdict.parameters.find(std::string("bush_root_") + "xyz"[axis]);
    if (said == found.verdict.parameters.end()) return;
    const auto a = static_cast<long>(axis);
    way[a] = hidden_number(s, "plant_pose", "offset", 0.0, axis);
    const double truth = s.root[a] + way[a];
    said_way[a] = said->second.value - s.root[a];
    off[a] = said->second.value - truth;
    is_inside = is_inside && holds(said->second, truth);
  }
  stalk.attachment = Told{off.norm(), is_inside};
  // As from the first push, of the stalk as it stands.
  const scene_case::Drive push = drives_of(s).front();
  const double hold = runs.front().pushed[runs.front().step(0.5 * (push.time[1] + push.time[2]))];
  const scene_case::Vec3 down(0.0, 0.0, -hold);
  stalk.bearing =
      Told{std::acos(std::clamp(down.normalized().dot((down + off).normalized()), -1.0, 1.0)),
           is_inside};
  const Eigen::Vector2d a = said_way.head<2>(), b = way.head<2>();
  stalk.direction = Told{std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))), is_inside};
}

void look_at_modulus(StalkTold& stalk, const SceneDiagnosis& found) {
  const auto said = found.verdict.parameters.find("youngs_modulus");
  if (said == found.verdict.parameters.end()) return;
  const double truth =
      stalk.pushed.modulus * hidden_number(stalk.pushed, "youngs_modulus", "factor", 1.0);
  stalk.modulus = Told{said->second.value / truth - 1.0, holds(said->second, truth)};
}

// By wrench and joints alone, with no model of the plant.
void look_at_moments(StalkTold& stalk, const Experiment& experiment, const std::vector<Run>& runs) {
  discrepancy::SceneSimulator simulator(experiment, {}, 1);
  const discrepancy::SceneDataSet data(experiment);
  const std::vector<scene_case::Drive> drives = drives_of(stalk.pulled);
  for (const SymptomNumber& symptom :
       robot_alone(simulator, {}, data.deviation(discrepancy::SceneChannel::force),
                   data.deviation(discrepancy::SceneChannel::moment), Vec3::Zero(),
                   discrepancy::default_scene_settings().robot))
    for (std::size_t t = 0; t < runs.size(); ++t)
      if (symptom.name == "force_breaks_off" && symptom.of == drives[t].name && runs[t].came_off)
        stalk.moment.push_back(told(symptom, *runs[t].came_off));
}

std::string number(double value, int digits = 2) {
  return io::format_number(value, digits);
}

std::string cell(const std::optional<Told>& one, double unit) {
  if (!one) return "";
  return number(unit * one->off) + (one->is_inside ? "" : " !");
}

std::string cell(const std::vector<Told>& all, double unit) {
  std::string text;
  for (const Told& one : all) text += (text.empty() ? "" : ", ") + cell(std::optional(one), unit);
  return text;
}

/// A line of the summary. What is not told is not within the aim.
class Count {
 public:
  void add(const std::optional<Told>& one, double aim) {
    ++of_;
    within_ += one && std::abs(one->off) <= aim ? 1 : 0;
    inside_ += one && one->is_inside ? 1 : 0;
  }
  void add(const std::vector<Told>& all, std::size_t wanted, double aim) {
    for (std::size_t i = 0; i < std::max(wanted, all.size()); ++i)
      add(i < all.size() ? std::optional(all[i]) : std::nullopt, aim);
  }
  std::string line(const std::string& what) const {
    const hidden::Share share = hidden::share(within_, of_);
    return "| " + what + " | " + std::to_string(within_) + " of " + std::to_string(of_) + " (" +
           number(100.0 * share.low, 3) + " to " + number(100.0 * share.high, 3) + " %) | " +
           std::to_string(inside_) + " |\n";
  }

 private:
  int within_ = 0, inside_ = 0, of_ = 0;
};

}  // namespace

Setting pushed_stalk(std::uint64_t seed) {
  Setting s;
  s.seed = seed;
  s.unseen = true;
  scene_case::draw(s);
  Draw draw(seed * 3571 + 11);
  const double far = draw.between(0.4, 1.0) * farthest,
               turn = draw.between(0.0, 2.0 * std::numbers::pi);
  s.hidden.push_back(
      {"plant_pose", {{"offset", {far * std::cos(turn), far * std::sin(turn), 0.0}}}});
  s.hidden.push_back(
      {"youngs_modulus", {{"factor", {std::pow(softest, draw.between(-1.0, 1.0))}}}});
  return s;
}

Setting pulled_stalk(std::uint64_t seed) {
  Setting s;
  s.seed = seed;
  s.unseen = true;
  s.trials = 2;
  scene_case::draw(s);
  scene_case::make_harvest(s);
  Draw draw(seed * 6173 + 29);
  s.hidden.push_back({"detachment_threshold", {{"factor", {draw.between(weakest, 1.0)}}}});
  return s;
}

StalkTold look_at_stalk(const std::filesystem::path& folder, std::uint64_t seed, int threads) {
  StalkTold stalk;
  stalk.pushed = pushed_stalk(seed);
  stalk.pulled = pulled_stalk(seed);
  const std::vector<Run> pushes = make_case(folder / "pushes", stalk.pushed);
  const std::vector<Run> pulls = make_case(folder / "pulls", stalk.pulled);
  const Experiment experiment = read(folder / "pushes");
  discrepancy::SceneDiagnosisOptions options;
  options.threads = threads;
  const SceneDiagnosis found = diagnose_scene(experiment, options);
  stalk.outcome = to_string(found.verdict.outcome);
  stalk.findings = found.text;
  look_at_holds(stalk, found, pushes);
  look_at_attachment(stalk, found, pushes);
  look_at_modulus(stalk, found);
  look_at_moments(stalk, read(folder / "pulls"), pulls);
  return stalk;
}

std::string table(const std::vector<StalkTold>& stalks) {
  std::string text =
      "| stalk | length, radius, mm | modulus, MPa | moved by, mm | verdict | hold off, mm | "
      "attachment off, mm | bearing off, degrees | displacement's direction off, degrees | modulus "
      "off, % | detachment off, ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  Count holds, attachments, bearings, directions, moduli, moments;
  for (const StalkTold& one : stalks) {
    const Setting& s = one.pushed;
    const double moved = std::hypot(hidden_number(s, "plant_pose", "offset", 0.0, 0),
                                    hidden_number(s, "plant_pose", "offset", 0.0, 1));
    text += "| " + std::to_string(s.seed) + " | " + number(1e3 * s.height, 3) + ", " +
            number(1e3 * s.radius, 3) + " | " +
            number(1e-6 * s.modulus * hidden_number(s, "youngs_modulus", "factor", 1.0), 3) +
            " | " + number(1e3 * moved, 3) + " | " + one.outcome + " | " + cell(one.hold, 1e3) +
            " | " + cell(one.attachment, 1e3) + " | " +
            cell(one.bearing, 180.0 / std::numbers::pi) + " | " +
            cell(one.direction, 180.0 / std::numbers::pi) + " | " + cell(one.modulus, 100.0) +
            " | " + cell(one.moment, 1e3) + " |\n";
    holds.add(one.hold, static_cast<std::size_t>(s.trials), hold_aim);
    attachments.add(one.attachment, hold_aim);
    bearings.add(one.bearing, direction_aim);
    directions.add(one.direction, direction_aim);
    moduli.add(one.modulus, modulus_aim);
    moments.add(one.moment, static_cast<std::size_t>(one.pulled.trials), moment_aim);
  }
  return text + "\n`!`: the truth is outside of the 95 % interval.\n\n" +
         "| what | within the aim, 95 % by Wilson | intervals that hold the truth "
         "|\n|---|---|---|\n" +
         holds.line("place of hold, 1 cm") + attachments.line("attachment, 1 cm") +
         bearings.line("bearing of the attachment from the hold, 5 degrees") +
         directions.line("direction in which it is displaced, 5 degrees") +
         moduli.line("modulus, 5 %") + moments.line("moment of detachment, 30 ms");
}

}  // namespace pedicel::harvest
