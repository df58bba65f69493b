// scene_case --out FOLDER [--seed N] [--trials N] [--hide "NAME KEY=V[,V,V] ..."]... [--bench N]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <sstream>

#include "discrepancy/scene_cases/drawn_case.h"

namespace {

using pedicel::scene_case::Hidden;

Hidden hidden_of(const std::string& text) {
  Hidden one;
  std::istringstream words(text);
  words >> one.name;
  for (std::string word; words >> word;) {
    const std::size_t cut = word.find('=');
    if (cut == std::string::npos) throw std::invalid_argument("--hide: expected KEY=VALUE");
    std::vector<double> values;
    std::istringstream list(word.substr(cut + 1));
    for (std::string value; std::getline(list, value, ',');) values.push_back(std::stod(value));
    one.numbers.emplace_back(word.substr(0, cut), values);
  }
  return one;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a measured run of an arm at a stem, made by MuJoCo, with something hidden");
  std::string out;
  pedicel::scene_case::Setting setting;
  std::vector<std::string> hide;
  int bench = -1;
  app.add_option("--out", out, "folder to write")->required();
  app.add_option("--seed", setting.seed, "of sizes and noise");
  app.add_option("--trials", setting.trials, "how many")->check(CLI::Range(1, 4));
  auto* hidden = app.add_option("--hide", hide, "\"NAME KEY=V[,V,V]\": an effect, post or string")
                     ->allow_extra_args(false);
  app.add_option("--bench", bench, "the case of this number of `scene_bench --seed N`")
      ->check(CLI::Range(0, 99))
      ->excludes(hidden);
  CLI11_PARSE(app, argc, argv);
  try {
    if (bench >= 0) {
      const int trials = setting.trials;
      setting = drawn(pedicel::scene_case::orders()[static_cast<std::size_t>(bench)], setting.seed);
      setting.trials = trials;
    } else {
      pedicel::scene_case::draw(setting);
    }
    for (const std::string& text : hide) setting.hidden.push_back(hidden_of(text));
    pedicel::scene_case::write_case(out, setting);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 1;
  }
  return 0;
}
