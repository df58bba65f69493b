// hide_effects EXPERIMENT --set "{name: leaf_drag, ...}" --outside "{kind: string, ...}" --out DIR
// Does the trials of an experiment again by the reference simulator, on its plant with something
// hidden in it, and writes them as an experiment folder that gives nothing away.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/io/atomic_file.h"
#include "engine/io/yaml.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/plant/effect_reader.h"
#include "tests/discrepancy/resimulated.h"

namespace {

using namespace pedicel;
using reference::OutsideEffect;

struct Arguments {
  std::string experiment, out;
  std::vector<std::string> set, outside;
  hidden::MeasuringOptions options;
};

plant::Effect parse_effect(const std::string& text, Diagnostics& diagnostics) {
  const io::YamlNode node = io::parse_yaml(text, "--set", diagnostics);
  const bool named = node.is_map() && node.raw()["name"] && node.raw()["name"].IsScalar();
  const effects::EffectDefinition* known =
      named ? effects::find_effect(node.raw()["name"].Scalar()) : nullptr;
  return plant::read_effect(node, known ? known->file : effects::EffectFile::plant);
}

OutsideEffect parse_outside(const std::string& text, Diagnostics& diagnostics) {
  using enum OutsideEffect::Kind;
  io::YamlMap map(io::parse_yaml(text, "--outside", diagnostics), "something from outside");
  const std::string kind = map.choice("kind", {"string", "stake", "push", "attraction"}, "string");
  OutsideEffect s;
  for (const OutsideEffect::Kind k : {string, stake, push, attraction})
    if (kind == reference::name_of(k)) s.kind = k;
  s.place = {map.text("curve"), map.number("at", io::fraction), {}};
  s.size = map.number("size", io::positive);
  if (s.kind != push) s.point = map.vector("point");
  if (s.kind == string) s.slack = map.number("slack", io::not_negative, 0.0);
  if (s.kind == push) s.frequency = map.number("frequency", io::positive);
  if (s.kind == push || s.kind == stake) s.direction = map.vector("direction").normalized();
  map.finish();
  return s;
}

void hide(const Arguments& a) {
  Diagnostics diagnostics;
  auto experiment = discrepancy::read_experiment(a.experiment, diagnostics);
  std::vector<plant::Effect> effects;
  std::vector<OutsideEffect> outside;
  for (const std::string& text : a.set) effects.push_back(parse_effect(text, diagnostics));
  for (const std::string& text : a.outside) outside.push_back(parse_outside(text, diagnostics));
  if (!experiment || diagnostics.has_errors()) throw InvalidFile(diagnostics);
  experiment->title = std::filesystem::path(a.out).filename().string();
  write_experiment(a.out, hidden::resimulated(std::move(*experiment), effects, outside, a.options));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Hides effects in an experiment: its trials, done again by the reference simulator."};
  Arguments a;
  app.add_option("experiment", a.experiment, "folder whose plant, trials and stated noise to take")
      ->required();
  app.add_option("--set", a.set, "an effect to hide, as a plant file has it")
      ->allow_extra_args(false);
  app.add_option("--outside", a.outside,
                 "{kind: string, curve, at, point, slack, size} | {kind: stake, curve, at, point, "
                 "direction, size} | {kind: push, curve, at, direction, frequency, size} | {kind: "
                 "attraction, curve, at, point, size}; m, N/m or N, Hz")
      ->allow_extra_args(false);
  app.add_option("--seed", a.options.seed, "of the noise")->capture_default_str();
  app.add_option("--rho", a.options.rho, "of the markers' noise, from sample to sample")
      ->check(CLI::Range(0.0, 0.99))
      ->capture_default_str();
  app.add_option("--mesh", a.options.mesh, "longest segment, as a share of the plant's `distance`")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--dt", a.options.dt, "longest step, s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("!--keep-holds", a.options.follow_plant,
               "hold paths stay; else they start where the plant stands with what is hidden");
  app.add_option("--out", a.out, "folder to write")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    hide(a);
    return 0;
  } catch (const InvalidFile& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 3;
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 6;
  }
}
