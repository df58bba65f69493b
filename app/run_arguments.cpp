#include "app/run_arguments.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/check.h"
#include "io/atomic_file.h"
#include "session/document.h"
#include "world/scene_reader.h"
#include "world/settings.h"

namespace pedicel::app {

namespace {

std::optional<std::array<int, 2>> parse_size(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::array<int, 2> size{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2 || size[0] < 16 ||
      size[1] < 16 || size[0] > 8192 || size[1] > 8192)
    throw UsageError("--size " + text + ": expected WxH in pixels, 16 to 8192 each (1280x720)");
  return size;
}

}  // namespace

void add_run_options(CLI::App& app, RunArguments& a) {
  app.add_option("--out", a.out, "folder for everything that is written (default: out/<scene>)");
  app.add_option("--set", a.set,
                 "key=value: duration, dt, seed, threads, log_rate, rods.KEY, coupling.KEY, "
                 "plants.NAME.KEY, or a key of every plant such as detach.stretch; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--duration", a.duration, "simulated time, s");
  app.add_option("--dt", a.dt, "time step, s");
  app.add_option("--seed", a.seed, "seed of everything random");
  app.add_option("--threads", a.threads, "threads for the plants");
  app.add_option("--log-rate", a.log_rate, "rows a simulated second in log.csv, Hz");
  app.add_option("--package", a.packages, "NAME=PATH: where package://NAME lies; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--fps", a.fps, "frames a simulated second of the video, Hz");
  app.add_option("--size", a.size, "WxH of pictures and video, px");
  app.add_flag("--no-video", a.no_video, "take no video");
  app.add_flag("--no-pictures", a.no_pictures, "take neither pictures nor video");
  app.add_flag("--no-sweep", a.no_sweep, "leave out the scene's sweep");
  app.add_flag("--json", a.json, "the result as JSON on standard output");
  app.add_flag("--quiet", a.quiet, "no progress, no start and end lines");
}

world::Scene load_scene(const RunArguments& a) {
  Diagnostics diagnostics;
  std::optional<world::Scene> scene = is_lone_plant(a.scene)
                                          ? scene_of(open_document(a.scene))
                                          : world::read_scene(a.scene, diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  for (const Diagnostic& warning : diagnostics.all())
    std::fprintf(stderr, "%s\n", to_string(warning).c_str());
  const auto set = [&](const char* key, auto value) {
    if (value) world::apply_override(*scene, key, io::format_number(static_cast<double>(*value)));
  };
  set("duration", a.duration);
  set("dt", a.dt);
  set("log_rate", a.log_rate);
  set("seed", a.seed);
  set("threads", a.threads);
  for (const std::string& assignment : a.set) {
    const auto [key, value] = world::split_assignment(assignment);
    world::apply_override(*scene, key, value, "--set ");
  }
  if (a.no_sweep) {
    scene->sweep.reset();
    std::erase_if(scene->expectations, [](const auto& e) { return e.over_sweep(); });
  }
  return std::move(*scene);
}

RunOptions run_options(const RunArguments& a) {
  RunOptions options;
  options.simulation.packages = a.packages;
  options.simulation.leaf_folders = asset_leaf_folders();
  options.out = a.out;
  if (options.out.empty()) options.out = std::filesystem::path("out") / io::name_of_file(a.scene);
  options.pictures = !a.no_pictures;
  options.video = !a.no_video;
  options.fps = a.fps;
  options.size = parse_size(a.size);
  options.quiet = a.quiet;
  return options;
}

}  // namespace pedicel::app
