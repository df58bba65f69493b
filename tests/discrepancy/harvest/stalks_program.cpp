// stalks [--out DIR] [--seed N] [--count N] [--harvest] [--threads N]
// Hidden stalks from the robot alone: joints and a wrist's wrench, and no marker. Each stands
// elsewhere and is stiffer or softer than its scene says. Writes one line a stalk into
// DIR/stalks.md: where the tool is said to hold, where the stalk to be attached, its stiffness, and
// when the force broke off, each with its error.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "discrepancy/scene_cases/harvest_case.h"
#include "pedicel/core/exit_code.h"
#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"

namespace {

using namespace pedicel;
namespace fs = std::filesystem;
using discrepancy::SceneDiagnosis;
using scene_case::Setting;

struct Arguments {
  fs::path out = "out/stalks";
  std::uint64_t seed = 1;
  int count = 5, threads = 1;
  bool harvest = false;
};

/// What is hidden: up to `farthest` in the plane, and a factor on the modulus.
Setting hidden_stalk(const Arguments& a, std::uint64_t seed) {
  constexpr double farthest = 0.012, softest = 0.75;
  Setting s;
  s.seed = seed;
  s.unseen = true;
  scene_case::draw(s);
  if (a.harvest) scene_case::make_harvest(s);
  std::mt19937_64 random(seed * 3571 + 11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  const double far = between(0.4, 1.0) * farthest, turn = between(0.0, 2.0 * std::numbers::pi);
  std::vector<std::pair<std::string, std::vector<double>>> pose = {
      {"offset", {far * std::cos(turn), far * std::sin(turn), 0.0}}};
  s.hidden.push_back({"plant_pose", pose});
  s.hidden.push_back({"youngs_modulus", {{"factor", {std::pow(softest, between(-1.0, 1.0))}}}});
  return s;
}

std::string number(double value, int digits = 3) {
  return std::isfinite(value) ? io::format_number(value, digits) : std::string();
}

/// One line of the table.
std::string line_of(const Arguments& a, std::uint64_t seed) {
  const Setting setting = hidden_stalk(a, seed);
  const fs::path folder = a.out / ("stalk_" + std::to_string(seed));
  const std::vector<scene_case::Run> runs = make_case(folder, setting);
  const std::vector<scene_case::Drive> drives = drives_of(setting);
  Diagnostics diagnostics;
  const auto experiment = discrepancy::read_scene_experiment(folder, diagnostics);
  if (!experiment) throw InvalidFile(diagnostics);
  discrepancy::SceneDiagnosisOptions options;
  options.threads = a.threads;
  const SceneDiagnosis found = diagnose_scene(*experiment, options);
  io::write_file_atomically(folder / "findings.txt", found.text);

  std::string holds, breaks;
  for (const discrepancy::SymptomNumber& symptom : found.verdict.symptoms)
    for (std::size_t t = 0; t < runs.size(); ++t) {
      if (symptom.of != drives[t].name) continue;
      if (symptom.name == "hold_place") {
        // The finger stands still where it has pushed the stem farthest.
        const double middle = 0.5 * (drives[t].time[1] + drives[t].time[2]);
        const double truth = runs[t].pushed[runs[t].step(middle)];
        holds += (holds.empty() ? "" : ", ") + number(1e3 * (symptom.value - truth));
      }
      if (symptom.name == "force_breaks_off" && runs[t].came_off)
        breaks += (breaks.empty() ? "" : ", ") + number(1e3 * (symptom.value - *runs[t].came_off));
    }
  double square = 0.0;
  bool is_inside = true, is_said = true;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto said = found.verdict.parameters.find(std::string("bush_root_") + "xy"[axis]);
    if (said == found.verdict.parameters.end()) {
      is_said = false;
      continue;
    }
    const double truth = setting.root[static_cast<long>(axis)] +
                         hidden_number(setting, "plant_pose", "offset", 0.0, axis);
    square += (said->second.value - truth) * (said->second.value - truth);
    is_inside = is_inside && truth >= said->second.low && truth <= said->second.high;
  }
  const auto modulus = found.verdict.parameters.find("youngs_modulus");
  const double factor = hidden_number(setting, "youngs_modulus", "factor", 1.0);
  const double off = modulus == found.verdict.parameters.end()
                         ? std::nan("")
                         : 100.0 * (modulus->second.value / (factor * setting.modulus) - 1.0);
  const double moved = std::hypot(hidden_number(setting, "plant_pose", "offset", 0.0, 0),
                                  hidden_number(setting, "plant_pose", "offset", 0.0, 1));
  return "| " + std::to_string(seed) + " | " + number(1e3 * moved) + ", " + number(factor) + " | " +
         to_string(found.verdict.outcome) + " | " + holds + " | " +
         (is_said ? number(1e3 * std::sqrt(square)) + (is_inside ? "" : " (outside)") : "") +
         " | " + number(off) + " | " + breaks + " |\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Where a tool holds a hidden stalk, from the robot's own sensors alone."};
  Arguments a;
  app.add_option("--out", a.out, "folder of everything")->capture_default_str();
  app.add_option("--seed", a.seed, "of the first stalk");
  app.add_option("--count", a.count, "stalks")->check(CLI::Range(1, 1000));
  app.add_flag("--harvest", a.harvest, "a fruit is pulled off, in place of pushes");
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    std::string text =
        "| stalk | moved by, mm, modulus times | verdict | place of hold off, mm, by trial | "
        "attachment off, mm | modulus off, % | moment of detachment off, ms |\n"
        "|---|---|---|---|---|---|---|\n";
    for (int i = 0; i < a.count; ++i) {
      const std::string line = line_of(a, a.seed + static_cast<std::uint64_t>(i));
      std::printf("%s", line.c_str());
      std::fflush(stdout);
      text += line;
      io::write_file_atomically(a.out / "stalks.md", text);
    }
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
  return exit_ok;
}
