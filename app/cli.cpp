#include "app/cli.h"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "app/bench.h"
#include "app/headless.h"
#include "app/rod_options.h"
#include "app/validate.h"
#include "app/version.h"
#include "core/check.h"
#include "io/atomic_file.h"
#include "render/image.h"
#include "world/scene_reader.h"
#include "world/settings.h"

namespace pedicel::app {

namespace {

enum Exit { ok = 0, failure = 1, usage = 2, invalid = 3, unwritable = 6 };

constexpr const char* exit_codes =
    "Exit codes: 0 ok, 1 runtime failure, 2 usage, 3 a file is invalid or missing, 4 the "
    "simulation "
    "is unstable, 5 an expectation is not met, 6 output cannot be written, 77 pictures were asked "
    "for and there is no OpenGL, 130 stopped by Ctrl-C.";

extern "C" void request_stop(int) {
  stop_requested = true;
}

/// What the command line says of a run; names as in the options.
struct RunArguments {
  std::string scene, out, size;
  std::vector<std::string> set, packages;
  std::optional<double> duration, dt, fps, log_rate;
  std::optional<int> seed, threads;
  bool headless = false, json = false, quiet = false, no_video = false, no_pictures = false,
       no_sweep = false, print_scene = false;
};

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

std::optional<std::array<int, 2>> parse_size(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::array<int, 2> size{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2 || size[0] < 16 ||
      size[1] < 16 || size[0] > 8192 || size[1] > 8192)
    throw UsageError("--size " + text + ": expected WxH in pixels, 16 to 8192 each (1280x720)");
  return size;
}

world::Scene load_scene(const RunArguments& a) {
  Diagnostics diagnostics;
  std::optional<world::Scene> scene = world::read_scene(a.scene, diagnostics);
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
    world::apply_override(*scene, key, value);
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
  options.out = a.out;
  if (options.out.empty()) {
    std::string name = std::filesystem::path(a.scene).filename().string();
    options.out = std::filesystem::path("out") / name.substr(0, name.find('.'));
  }
  options.pictures = !a.no_pictures;
  options.video = !a.no_video;
  options.fps = a.fps;
  options.size = parse_size(a.size);
  options.quiet = a.quiet;
  return options;
}

int run_verb(const RunArguments& a) {
  if (a.scene.empty()) throw UsageError("no scene given, expected one (see pedicel --help)");
  const RunOptions options = run_options(a);
  const world::Scene scene = load_scene(a);
  if (!a.headless && !a.quiet)
    std::fprintf(stderr,
                 "this version has no window yet: it runs off screen, as with --headless\n");
  const RunResult result = run_with_sweep(scene, options);
  if (a.json) std::cout << to_json(scene, result) << std::endl;
  if (!a.quiet) std::fprintf(stderr, "written to %s\n", options.out.string().c_str());
  return result.exit_code;
}

/// `pedicel sweep SCENE --set key=v1,v2,...`: the scene's own sweep is replaced by this one.
int sweep_verb(RunArguments a) {
  std::optional<world::SceneSweep> sweep;
  std::vector<std::string> plain;
  for (const std::string& assignment : a.set) {
    const auto [key, values] = world::split_assignment(assignment);
    if (values.find(',') == std::string::npos) {
      plain.push_back(assignment);
      continue;
    }
    if (sweep) throw UsageError("--set " + key + ": expected one key with several values");
    sweep = world::SceneSweep{key, {}, {}};
    for (std::size_t start = 0; start <= values.size();) {
      const std::size_t end = std::min(values.find(',', start), values.size());
      const auto value = world::to_number(values.substr(start, end - start));
      if (!value) throw UsageError("--set " + assignment + ": expected numbers between the commas");
      sweep->values.push_back(*value);
      start = end + 1;
    }
  }
  if (!sweep) throw UsageError("sweep: expected --set key=value,value,...");
  a.set = plain;
  const RunOptions options = run_options(a);
  world::Scene scene = load_scene(a);
  if (scene.sweep && scene.sweep->key != sweep->key)
    std::erase_if(scene.expectations, [](const auto& e) { return e.over_sweep(); });
  scene.sweep = sweep;
  const RunResult result = run_with_sweep(scene, options);
  if (a.json) std::cout << to_json(scene, result) << std::endl;
  return result.exit_code;
}

int bench_verb(BenchOptions options, const std::vector<std::string>& set, bool json) {
  std::vector<world::Setting> rods;
  for (const std::string& assignment : set) {
    const auto [key, value] = world::split_assignment(assignment);
    if (!key.starts_with("rods."))
      throw UsageError("--set " + assignment + ": expected rods.KEY=VALUE");
    rods.push_back({key.substr(5), value, {"--set " + assignment}});
  }
  Diagnostics diagnostics;
  apply_rod_settings(rods, options.rods, diagnostics);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  const BenchResult result = run_bench(options);
  std::cout << (json ? to_json(result) : to_text(result)) << std::endl;
  return ok;
}

int guarded(const std::function<int()>& verb) {
  try {
    return verb();
  } catch (const InvalidFile& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return invalid;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return usage;
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return unwritable;
  } catch (const render::OutputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return failure;
  }
}

}  // namespace

int run_cli(int argc, char** argv) {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  CLI::App app("Pedicel: a sandbox where robots handle plants.");
  app.footer(exit_codes);
  app.set_version_flag("--version", "pedicel " + version() + " (" + git_hash() + ")");

  RunArguments run;
  app.add_option("scene", run.scene, "scene file (*.scene.yaml)");
  app.add_flag("--headless", run.headless, "run off screen");
  add_run_options(app, run);

  RunArguments swept;
  CLI::App* sweep = app.add_subcommand("sweep", "run a scene for several values of one setting");
  sweep->add_option("scene", swept.scene, "scene file")->required();
  add_run_options(*sweep, swept);

  std::vector<std::string> files, packages;
  CLI::App* validate = app.add_subcommand("validate", "load and check files without running them");
  validate->add_option("files", files, "plants, scenes, leaf templates, URDFs")->required();
  validate->add_option("--package", packages, "NAME=PATH: where package://NAME lies")
      ->allow_extra_args(false);

  BenchOptions bench_options;
  bool json = false;
  CLI::App* bench =
      app.add_subcommand("bench", "measure speed and, at the same settings, accuracy");
  std::string bench_list;
  for (const std::string& name : bench_names())
    bench_list += (bench_list.empty() ? "" : ", ") + name;
  bench->add_option("name", bench_options.name, "one of " + bench_list);
  bench->add_option("--threads", bench_options.threads, "threads");
  bench->add_option("--dt", bench_options.dt, "time step, s")->check(CLI::Range(1e-6, 0.1));
  bench->add_option("--duration", bench_options.duration, "simulated time, s")
      ->check(CLI::Range(1e-3, 1e4));
  std::vector<std::string> bench_set;
  bench->add_option("--set", bench_set, "rods.KEY=VALUE as in a scene; may be repeated")
      ->allow_extra_args(false);
  bench->add_flag("--self-contact", bench_options.self_contact,
                  "organs of one plant may touch each other");
  bench->add_flag("!--no-accuracy", bench_options.accuracy, "measure the speed only");
  bench->add_flag("--json", json, "as JSON");
  app.require_subcommand(0, 1);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ok : usage;
  }
  if (*sweep) return guarded([&] { return sweep_verb(swept); });
  if (*validate) return guarded([&] { return validate_files(files, packages, std::cerr); });
  if (*bench) return guarded([&] { return bench_verb(bench_options, bench_set, json); });
  return guarded([&] { return run_verb(run); });
}

}  // namespace pedicel::app
