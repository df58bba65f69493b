#include "app/verbs/dataset.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/dataset/data_set.h"
#include "app/session/film.h"
#include "app/verbs/cluster.h"
#include "app/verbs/dataset_tasks.h"
#include "app/verbs/run_arguments.h"
#include "engine/cluster/cluster_options.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/files_read.h"
#include "engine/core/stop.h"
#include "engine/core/verbosity.h"
#include "engine/io/output_folder.h"
#include "engine/render/offscreen.h"
#include "engine/world/settings.h"
#include "plugins/plant/plant_numbers.h"
#include "plugins/plant/plant_shape.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::app {

namespace {

struct DatasetArguments {
  RunArguments run;
  std::string randomise, at;
  long count = 100;
  std::string seed;  // as it was typed, like the numbers of a run
  cluster::ClusterOptions cluster;
  int part = -1;  // of the set, which a task of --cluster makes
};

void add_options(CLI::App& verb, DatasetArguments& a) {
  finds_shipped(verb.add_option("scene", a.run.scene, "scene file (*.scene.yaml)"))->required();
  verb.add_option("--count", a.count, "pictures (default: 100)")->check(CLI::Range(1l, 1000000l));
  finds_shipped(verb.add_option(
      "--randomise", a.randomise,
      "what varies from picture to picture: a file with `vary` (pedicel-variation)"));
  verb.add_option("--out", a.run.out, "folder (default: out/NAME-dataset); a set there goes on");
  verb.add_option("--seed", a.seed, "picture i is drawn from this plus i (default: the scene's)")
      ->type_name("INT")
      ->check(CLI::Range(0, 1000000000));
  verb.add_option("--at", a.at,
                  "simulated time of the pictures, s, or FROM:TO to draw it between (default: "
                  "within the scene's duration)");
  verb.add_option("--size", a.run.size, "WxH in pixels, in place of the cameras' own");
  verb.add_option("--camera", a.run.camera, "of the scene (default: all in turn)");
  verb.add_option("--set", a.run.set, "KEY=VALUE, as for a run; may be repeated")
      ->allow_extra_args(false);
  verb.add_option("--package", a.run.packages, "NAME=PATH: where package://NAME lies")
      ->allow_extra_args(false);
  verb.add_flag("--json", a.run.json, "print the result as JSON");
  verb.add_flag("--quiet", a.run.quiet, "warnings and errors only");
  add_instruction_set_option(verb);
  cluster::add_cluster_options(verb, a.cluster);
  verb.add_option("--part", a.part, "only this part of the set: what a task of --cluster calls")
      ->check(CLI::NonNegativeNumber);
}

/// What the file varies comes after what the scene varies, and in place of its equal keys.
void add_variation(world::Scene& scene, const std::string& file) {
  if (file.empty()) return;
  const world::Variation variation = world::Variation::read(file);
  for (const world::VariedNumber& one : variation.numbers()) {
    std::erase_if(scene.vary,
                  [&](const world::VariedNumber& known) { return known.key == one.key; });
    scene.vary.push_back(one);
  }
  // An unknown key is found before the first picture; an impossible value leaves out a picture.
  Diagnostics faults;
  const world::Scene drawn = world::drawn_scene(scene);
  for (const world::ScenePlant& one : drawn.plants)
    for (const world::Setting& setting : one.set) {
      if (faults.has_errors() || plant::find_plant_number(setting.key) ||
          plant::find_shape_factor(setting.key))
        continue;
      plant::PlantFile nothing;
      simulation::apply_plant_overrides(nothing, {setting}, faults);  // says which there are
    }
  if (faults.has_errors()) throw InvalidFile(faults);
}

std::array<double, 2> times_of(const std::string& text, double duration) {
  if (text.empty()) return {0.0, duration};
  const std::size_t colon = text.find(':');
  const auto from = world::to_number(text.substr(0, colon));
  const auto to = colon == std::string::npos ? from : world::to_number(text.substr(colon + 1));
  if (!from || !to || !(*from >= 0.0 && *to >= *from && *to <= 1.0e6))
    throw UsageError("--at " + text + ": expected a time in s, or FROM:TO with 0 <= FROM <= TO");
  return {*from, *to};
}

DataSetOptions options_of(const DatasetArguments& a) {
  DataSetOptions options;
  RunArguments run = a.run;
  run.camera.clear();  // that of a run is the video's
  if (!a.seed.empty()) run.numbers.emplace_back("seed", a.seed);
  const RunOptions of_run = run_options(run);
  options.scene = load_scene(run);
  options.simulation = of_run.simulation;
  options.size = of_run.size;
  options.out = a.run.out.empty()
                    ? std::filesystem::path("out") / (io::name_of_file(a.run.scene) + "-dataset")
                    : std::filesystem::path(a.run.out);
  options.count = a.count;
  options.seed = options.scene.seed;
  if (!a.run.camera.empty()) check_camera(options.scene, a.run.camera);
  options.camera = a.run.camera;
  options.at = times_of(a.at, options.scene.duration);
  options.quiet = a.run.quiet;
  add_variation(options.scene, a.randomise);
  return options;
}

std::string to_json(const DataSetOptions& options, const DataSetResult& result) {
  const nlohmann::ordered_json json = {
      {"pictures", result.pictures},       {"made", result.made},
      {"annotations", result.annotations}, {"left_out", result.left_out},
      {"seconds", result.seconds},         {"out", options.out.string()}};
  return json.dump(2);
}

int run(DatasetArguments a, const CLI::App& verb) {
  a.cluster = cluster::with_profile(a.cluster);
  if (a.run.quiet) set_verbosity(Verbosity::warnings);
  std::optional<FilesRead> inputs;
  if (a.cluster.wanted()) inputs.emplace();
  DataSetOptions options = options_of(a);
  if (a.part >= 0) options = options_of_part(options, a.part);
  std::string why;
  if (!render::OffscreenContext::create(why)) throw NoPictures(why);
  stop_in_good_order();
  bool whole = true;
  const DataSetResult result =
      a.cluster.wanted() ? make_data_set_as_tasks(options, verb, a.cluster, *inputs, whole)
                         : make_data_set(options);
  if (a.run.json) std::cout << to_json(options, result) << std::endl;
  if (result.left_out > 0)
    say(Verbosity::warnings, "%ld of %ld pictures are left out; labels/NUMBER.json says why",
        result.left_out, options.count);
  if (a.part < 0 && result.pictures == 0 && result.left_out > 0) {
    say(Verbosity::errors, "error: nothing that was drawn can stand, expected a narrower vary");
    return exit_unstable;
  }
  say(Verbosity::lines, "%ld pictures (%ld of them new, in %.1f s), %ld annotations, written to %s",
      result.pictures, result.made, result.seconds, result.annotations,
      options.out.string().c_str());
  if (a.part >= 0) throw_if_stopped();  // a part that was stopped is no result
  if (stop_requested) return stop_exit_code();
  return whole || a.cluster.no_wait ? exit_ok : exit_failure;
}

}  // namespace

std::function<int()> add_dataset_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("dataset", "make labelled pictures of a scene that varies");
  const auto arguments = std::make_shared<DatasetArguments>();
  add_options(*verb, *arguments);
  return [arguments, verb] { return run(*arguments, *verb); };
}

}  // namespace pedicel::app
