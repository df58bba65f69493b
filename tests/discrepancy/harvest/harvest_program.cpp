// harvest --out DIR make|diagnose|compare [--seed N] [--trials N] [--hide "NAME KEY=V[,V]"]...
// [--nothing]
//         [--threads N]
// make: writes the real harvest into DIR/experiment. diagnose: writes its diagnosis into
// DIR/diagnosis. compare: writes table.md and pictures into DIR.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/exit_code.h"
#include "engine/io/atomic_file.h"
#include "engine/io/text_file.h"
#include "tests/discrepancy/harvest/harvest.h"

namespace {

using namespace pedicel;
namespace fs = std::filesystem;

struct Arguments {
  std::string what;
  fs::path out = "out/harvest";
  harvest::Options options;
  std::vector<std::string> hide;
  bool nothing = false;
  int threads = 1;
};

void make(const Arguments& a, const scene_case::Setting& setting) {
  const std::vector<scene_case::Run> runs = make_case(a.out / "experiment", setting);
  const std::vector<scene_case::Drive> drives = drives_of(setting);
  for (std::size_t t = 0; t < runs.size(); ++t) {
    if (runs[t].came_off)
      std::printf("%s: the fruit comes off at %.4f s\n", drives[t].name.c_str(), *runs[t].came_off);
    else
      std::printf("%s: the fruit stays on\n", drives[t].name.c_str());
  }
}

void compare(const Arguments& a, const scene_case::Setting& setting) {
  std::vector<scene_case::Run> runs;
  for (const scene_case::Drive& drive : drives_of(setting))
    runs.push_back(simulate(setting, drive));
  const std::string verdict = io::read_text_file(a.out / "diagnosis/verdict.json");
  fs::path extended = a.out / "diagnosis/extended.scene.yaml";
  if (!fs::exists(extended)) extended.clear();
  const harvest::Comparison found =
      harvest::compare(a.out / "experiment", extended, setting, runs, a.threads);
  // `unknown`: its scene is what came nearest.
  const bool is_believed = verdict.find("\"verdict\": \"unknown\"") == std::string::npos;
  const std::string text =
      harvest::tables(harvest::said_of(setting, verdict), verdict) +
      harvest::tables(found, is_believed ? "`extended.scene.yaml`" : "what came nearest");
  io::write_file_atomically(a.out / "table.md", text);
  for (const harvest::Trial& trial : found.trials) {
    io::write_file_atomically(a.out / (trial.name + "_force.svg"), harvest::force_picture(trial));
    io::write_file_atomically(a.out / (trial.name + "_side.svg"),
                              harvest::shape_picture(trial, true));
    io::write_file_atomically(a.out / (trial.name + "_front.svg"),
                              harvest::shape_picture(trial, false));
  }
  std::printf("%swritten to %s\n", text.c_str(), a.out.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A harvest made by MuJoCo beside what scenes foretell of it."};
  Arguments a;
  app.add_option("what", a.what, "make, diagnose or compare")
      ->required()
      ->check(CLI::IsMember({"make", "diagnose", "compare"}));
  app.add_option("--out", a.out, "folder of everything")->capture_default_str();
  app.add_option("--seed", a.options.seed, "what sizes and noise are drawn from");
  app.add_option("--trials", a.options.trials, "2 or 3; the second is held out")
      ->check(CLI::Range(2, 3));
  app.add_option("--hide", a.hide, "\"NAME KEY=V[,V]\": in place of the three that are hidden")
      ->allow_extra_args(false);
  app.add_flag("--nothing", a.nothing, "nothing is hidden");
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    if (!a.nothing) a.options.hidden = harvest::hidden_by_default();
    if (!a.hide.empty()) a.options.hidden.clear();
    for (const std::string& text : a.hide) a.options.hidden.push_back(scene_case::hidden_of(text));
    const scene_case::Setting setting = harvest::setting_of(a.options);
    if (a.what == "make") make(a, setting);
    if (a.what == "diagnose")
      std::printf(
          "%s",
          harvest::diagnose(a.out / "experiment", a.out / "diagnosis", a.threads).findings.c_str());
    if (a.what == "compare") compare(a, setting);
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
  return exit_ok;
}
