// scene_case --out FOLDER [--seed N] [--trials N] [--hide "NAME KEY=V[,V,V] ..."]... [--bench N]
//            [--harvest] [--commands] [--torques]
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/discrepancy/scene_cases/drawn_case.h"
#include "tests/discrepancy/scene_cases/harvest_case.h"

int main(int argc, char** argv) {
  CLI::App app("Writes a measured run of an arm at a stem, made by MuJoCo, with something hidden");
  std::string out;
  pedicel::scene_case::Setting setting;
  std::vector<std::string> hide;
  int bench = -1;
  bool harvest = false;
  app.add_option("--out", out, "folder to write")->required();
  app.add_option("--seed", setting.seed, "of sizes and noise");
  app.add_option("--trials", setting.trials, "how many")->check(CLI::Range(1, 4));
  app.add_flag("--commands", setting.commands, "the arm's controller is told where to go");
  app.add_flag("--torques", setting.torques, "the motors' torques are measured");
  auto* harvests = app.add_flag("--harvest", harvest, "the finger takes a fruit and pulls it off");
  auto* hidden = app.add_option("--hide", hide, "\"NAME KEY=V[,V,V]\": an effect, post or string")
                     ->allow_extra_args(false);
  app.add_option("--bench", bench, "the case of this number of `scene_bench --seed N`")
      ->check(CLI::Range(0, static_cast<int>(pedicel::scene_case::orders().size()) - 1))
      ->excludes(hidden)
      ->excludes(harvests);
  CLI11_PARSE(app, argc, argv);
  try {
    if (bench >= 0) {
      const int trials = setting.trials;
      setting = drawn(pedicel::scene_case::orders()[static_cast<std::size_t>(bench)], setting.seed);
      setting.trials = trials;
    } else {
      pedicel::scene_case::draw(setting);
      if (harvest) pedicel::scene_case::make_harvest(setting);
    }
    for (const std::string& text : hide)
      setting.hidden.push_back(pedicel::scene_case::hidden_of(text));
    pedicel::scene_case::write_case(out, setting);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
  return 0;
}
