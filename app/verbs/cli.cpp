#include "app/verbs/cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "app/bench/parallel_worlds.h"
#include "app/help/completion.h"
#include "app/help/man_page.h"
#include "app/help/manual.h"
#include "app/playback/log_film.h"
#include "app/playback/play_off_screen.h"
#include "app/report/version.h"
#include "app/session/document/document.h"
#include "app/session/document/plant_import.h"
#include "app/session/script.h"
#include "app/session/session_files.h"
#include "app/session/session_films.h"
#include "app/verbs/cluster.h"
#include "app/verbs/dataset.h"
#include "app/verbs/diagnose.h"
#include "app/verbs/effective_scene.h"
#include "app/verbs/fit.h"
#include "app/verbs/import.h"
#include "app/verbs/lab.h"
#include "app/verbs/observe.h"
#include "app/verbs/param_sweep.h"
#include "app/verbs/part_arguments.h"
#include "app/verbs/pick.h"
#include "app/verbs/ros_arguments.h"
#include "app/verbs/run_arguments.h"
#include "app/verbs/save_plants.h"
#include "app/verbs/sweep.h"
#include "app/verbs/transfer.h"
#include "app/verbs/validate.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/verbosity.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/output_check.h"
#include "engine/io/output_folder.h"
#include "engine/io/output_kind.h"
#include "engine/render/image.h"
#include "engine/world/settings.h"
#include "plugins/simulation/plants/rod_options.h"

namespace pedicel::app {

namespace {

constexpr const char* cache_place =
    "Distance grids of collision meshes are kept in the folder that PEDICEL_CACHE names (\"off\": "
    "nowhere), else in $XDG_CACHE_HOME/pedicel, else in ~/.cache/pedicel; at most 512 MB, those "
    "used longest ago go first.";

/// `pedicel --script FILE [SCENE]`: commands in place of a window, see session/script.h.
int script_verb(const RunArguments& a, const MakeFilms& make_films) {
  SessionOptions options;
  options.packages = a.packages;
  options.waits = true;
  stop_in_good_order();
  Session session(options);
  std::unique_ptr<FilmMaker> films;
  if (make_films) films = make_films(session);
  session.films().set_maker(films.get());
  if (!a.scene.empty() && !session.files().open(a.scene, unit_of_text(a.unit, "--unit"))) {
    std::fprintf(stderr, "%s\n", session.messages().all().back().text.c_str());
    return exit_invalid;
  }
  for (const std::string& assignment : a.set) {
    const auto [key, value] = world::split_assignment(assignment);
    const Result result = session.run(Command("set", {{"key", key}, {"value", value}}));
    if (!result) throw UsageError(result.text);
  }
  return run_script(a.script, session, std::cout, std::cerr);
}

int run_verb(const RunArguments& a, const MakeFilms& make_films) {
  if (!a.script.empty()) return script_verb(a, make_films);
  if (a.scene.empty()) throw UsageError("no scene given, expected one (see pedicel --help)");
  const RunOptions options = options_of_run(a);
  const world::Scene scene = load_scene(a);
  if (a.print_scene) {
    std::cout << effective_scene(scene) << std::flush;
    return exit_ok;
  }
  if (!a.save_plants.empty()) {
    std::cout << save_plants(scene, options.simulation, a.save_plants) << std::endl;
    return exit_ok;
  }
  if (a.param_sweep.empty()) return end_of_run(scene, a, options, run_with_sweep(scene, options));
  return end_of_run(scene, a, options,
                    run_param_sweep(scene, read_param_sweep(a.param_sweep), options));
}

void add_window_options(CLI::App& app, DesktopRequest& window, bool& paused) {
  app.add_flag("--paused", paused, "the window opens with the simulation held");
  app.add_option("--screenshot", window.screenshot, "writes a picture there (PNG), off screen");
  app.add_option("--record", window.record,
                 "writes a film there, off screen: *.mp4, or pictures (frame_%05d.png)");
  app.add_flag("--with-ui", window.with_interface,
               "the picture or the film shows the window with its panels");
  app.add_option("--at", window.time, "simulated time of the picture, s")
      ->check(CLI::Range(0.0, 1e4));
  app.add_option("--show", window.show, "a panel to bring to the front (Plots); may be repeated")
      ->allow_extra_args(false);
  app.add_option("--colours", window.colours, "of stems in the window")
      ->check(CLI::IsMember({"strain", "margin", "contact", "residual"}));
  app.add_option("--theme", window.theme, "of the window")->check(CLI::IsMember({"dark", "light"}));
  app.add_option("--scale", window.scale, "of the window's texts (default: as the monitor says)")
      ->check(CLI::Range(0.5, 4.0));
  app.add_option("--platform", window.platform, "where the window is shown")
      ->check(CLI::IsMember({"window", "offscreen", "null"}));
}

std::optional<double> duration_of(const RunArguments& a) {
  const std::string text = a.number("duration");
  if (text.empty()) return std::nullopt;
  world::Scene scene;
  world::apply_override(scene, "duration", text, "--");
  return scene.duration;
}

/// What neither a picture or a film of the window nor a log does.
constexpr std::initializer_list<const char*> of_runs = {
    "--steps",      "--log",        "--events",      "--gltf",        "--trajectory", "--compare",
    "--save-state", "--load-state", "--param-sweep", "--print-scene", "--save-plants"};

/// A log as a film or a picture, off screen; without either a film below --out.
int play_verb(const RunArguments& a, const DesktopRequest& window) {
  a.refuse({"--set", "--json", "--script", "--with-ui"},
           "is of a scene, expected it without a log");
  a.refuse(of_runs, "is of a scene, expected it without a log");
  PlayRequest request;
  request.log = a.scene;
  request.packages = a.packages;
  request.film = window.record;
  request.picture = window.screenshot;
  if (request.film.empty() && request.picture.empty()) {
    const std::filesystem::path out = a.out.empty()
                                          ? std::filesystem::path("out") / io::name_of_file(a.scene)
                                          : std::filesystem::path(a.out);
    std::filesystem::create_directories(out);
    request.film = (out / "playback.mp4").string();
    request.picture = (out / "playback.png").string();
  }
  if (window.time > 0.0) request.at = window.time;
  if (a.fps) request.fps = *a.fps;
  if (const auto size = run_options(a).size) request.size = *size;
  request.quiet = a.quiet;
  return play_off_screen(request);
}

/// "frame_%05d.png" is a name for each of many.
void check_picture_places(const DesktopRequest& window) {
  if (!window.screenshot.empty()) io::check_output_file(window.screenshot, io::OutputKind::picture);
  if (window.record.empty()) return;
  if (window.record.find('%') == std::string::npos)
    io::check_output_file(window.record, io::OutputKind::film);
  else
    io::check_place_for_files(std::filesystem::absolute(window.record).parent_path());
}

/// The window, or a run off screen: with --headless, with what only a run can give, and where no
/// window can be opened.
int window_verb(const RunArguments& a, DesktopRequest window, bool paused,
                const OpenDesktop& open_desktop, const MakeFilms& make_films) {
  check_run_arguments(a);
  apply_verbosity(a);
  const bool picture = !window.screenshot.empty() || !window.record.empty();
  if (is_playable(a.scene) && (picture || a.asks_for_run() || !open_desktop)) {
    check_picture_places(window);
    return play_verb(a, window);
  }
  if (picture)
    a.refuse(of_runs, "is of a run off screen, expected it without --screenshot and --record");
  if (!window.record.empty() && a.scene.empty())
    throw UsageError("--record: no scene given, expected one to make a film of");
  if (!open_desktop || (a.asks_for_run() && !picture)) return run_verb(a, make_films);
  if (!window.screenshot.empty() && !window.screenshot.ends_with(".png"))
    throw UsageError("--screenshot " + window.screenshot + ": expected a name that ends in .png");
  check_picture_places(window);
  window.file = a.scene;
  window.unit = unit_of_text(a.unit, "--unit");
  window.script = a.script;
  window.set = a.set;
  for (const char* key : {"dt", "seed", "threads"})
    if (const std::string text = a.number(key); !text.empty())
      window.set.push_back(std::string(key) + "=" + text);
  window.packages = a.packages;
  window.playing = !a.scene.empty() && !paused;
  if (const auto size = run_options(a).size) window.size = *size, window.sized = true;
  window.duration = duration_of(a);
  window.fps = a.fps;
  window.camera = a.camera;
  window.quiet = a.quiet;
  if (const std::optional<int> code = open_desktop(window)) return *code;
  if (is_playable(a.scene)) return play_verb(a, window);
  if (!a.scene.empty()) return run_verb(a, make_films);
  throw std::runtime_error("there is no window to open; give a scene to run it off screen");
}

CLI::Range range_of(std::string_view key) {
  const io::Bounds bounds = world::scene_bounds(key);
  return CLI::Range(bounds.minimum, bounds.maximum);
}

/// What the command line says of a benchmark. What is not given is the bench's or the scene's own.
struct BenchArguments {
  BenchOptions options;
  std::optional<int> worlds, threads;
  std::optional<double> dt, duration;
  std::vector<std::string> set, packages;
  bool json = false;
};

void add_bench_options(CLI::App& bench, BenchArguments& a) {
  std::string list;
  for (const std::string& name : bench_names()) list += name + ", ";
  finds_shipped(bench.add_option("name", a.options.name,
                                 "one of " + list + "or a scene file (*.scene.yaml)"));
  bench.add_option("--worlds", a.worlds, "independent copies, each stepped by one thread")
      ->check(CLI::Range(1, 100000));
  bench.add_option("--threads", a.threads, "threads (default: 1; with --worlds all cores)")
      ->check(CLI::Range(1, 1024));
  bench.add_option("--dt", a.dt, "time step, s")->check(range_of("dt"));
  bench.add_option("--duration", a.duration, "simulated time, s")->check(range_of("duration"));
  bench.add_option("--set", a.set, "rods.KEY=VALUE, of a scene any of its keys; may be repeated")
      ->allow_extra_args(false);
  bench.add_option("--package", a.packages, "NAME=PATH: where package://NAME lies")
      ->allow_extra_args(false);
  bench.add_flag("--self-contact", a.options.self_contact,
                 "organs of one plant may touch each other");
  bench.add_flag("!--no-accuracy", a.options.accuracy, "measure the speed only");
  bench.add_flag("--json", a.json, "as JSON");
}

BenchOptions bench_options(const BenchArguments& a) {
  BenchOptions options = a.options;
  options.threads = a.threads.value_or(options.threads);
  options.dt = a.dt.value_or(options.dt);
  options.duration = a.duration.value_or(options.duration);
  std::vector<world::Setting> rods;
  for (const std::string& assignment : a.set) {
    const auto [key, value] = world::split_assignment(assignment);
    if (!key.starts_with("rods."))
      throw UsageError("--set " + assignment + ": expected rods.KEY=VALUE");
    rods.push_back({key.substr(5), value, {"--set " + assignment}});
  }
  Diagnostics diagnostics;
  simulation::apply_rod_settings(rods, options.rods, diagnostics);
  if (diagnostics.has_errors()) throw UsageError(diagnostics.text());
  return options;
}

/// All cores, as far as there are worlds for them.
WorldsOptions worlds_options(const BenchArguments& a, double dt, double duration) {
  const int worlds = a.worlds.value_or(1);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return {worlds, a.threads.value_or(std::min(worlds, cores)), dt, duration};
}

WorldsResult bench_scene(const BenchArguments& a) {
  if (a.options.self_contact)
    throw UsageError("--self-contact: expected --set coupling.self_contact=1 for a scene");
  RunArguments run;
  run.scene = a.options.name;
  run.set = a.set;
  if (a.dt) run.numbers.emplace_back("dt", io::exact_number(*a.dt));
  if (a.duration) run.numbers.emplace_back("duration", io::exact_number(*a.duration));
  const world::Scene scene = load_scene(run);
  return run_worlds(scene_worlds(scene, {a.packages, {}, asset_leaf_folders()}),
                    worlds_options(a, scene.dt, scene.duration));
}

int bench_verb(const BenchArguments& a) {
  const auto print = [&a](const auto& result) {
    std::cout << (a.json ? to_json(result) : to_text(result)) << std::endl;
    return exit_ok;
  };
  if (a.options.name.ends_with(".scene.yaml")) return print(bench_scene(a));
  const BenchOptions options = bench_options(a);
  if (!a.worlds) return print(run_bench(options));
  return print(run_worlds(rod_worlds(options), worlds_options(a, options.dt, options.duration)));
}

/// What a shell and `man` want to know of the program.
struct TellArguments {
  std::string shell;
  bool man_page = false;
};

void add_tell_options(CLI::App& app, TellArguments& a) {
  app.add_option("--completion", a.shell, "print what completes this program in a shell")
      ->check(CLI::IsMember({"bash", "zsh"}));
  app.add_flag("--man-page", a.man_page, "print the man page, as roff");
}

int tell_verb(const CLI::App& app, const TellArguments& a) {
  const CommandWords words = command_words(app);
  if (a.man_page)
    std::cout << man_page(words, version());
  else
    std::cout << (a.shell == "bash" ? bash_completion(words) : zsh_completion(words));
  return std::cout.flush() ? exit_ok : exit_unwritable;
}

/// The bounds of options let pass what is no number, since it is neither below nor above.
void check_finite(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_type_name().starts_with("FLOAT")) continue;
    for (const std::string& text : option->results()) {
      if (!std::isfinite(std::strtod(text.c_str(), nullptr)))
        throw UsageError(option->get_name() + " " + text + ": expected a finite number");
    }
  }
  for (const CLI::App* verb : app.get_subcommands()) check_finite(*verb);
}

int guarded(const std::function<int()>& verb) {
  try {
    const int code = verb();
    return stop_requested ? stop_exit_code() : code;
  } catch (const PartDone&) {
    return exit_ok;
  } catch (const Stopped&) {
    return stop_exit_code();
  } catch (const InvalidFile& error) {
    say(Verbosity::errors, "%s", error.what());
    return exit_invalid;
  } catch (const UsageError& error) {
    say(Verbosity::errors, "error: %s", error.what());
    return exit_usage;
  } catch (const UnstableWorld& error) {
    say(Verbosity::errors, "error: %s", error.what());
    return exit_unstable;
  } catch (const io::WriteError& error) {
    say(Verbosity::errors, "error: %s", error.what());
    return exit_unwritable;
  } catch (const render::OutputError& error) {
    say(Verbosity::errors, "error: %s", error.what());
    return exit_unwritable;
  } catch (const NoPictures& error) {
    say(Verbosity::errors, "%s", error.what());
    return exit_no_pictures;
  } catch (const std::exception& error) {
    say(Verbosity::errors, "error: %s", error.what());
    return exit_failure;
  }
}

std::function<int()> add_bench_verb(CLI::App& app) {
  const auto a = std::make_shared<BenchArguments>();
  add_bench_options(
      *app.add_subcommand("bench", "measure speed and, at the same settings, accuracy"), *a);
  return [a] { return bench_verb(*a); };
}

struct ValidateArguments {
  std::vector<std::string> files, packages;
  std::string unit;
};

std::function<int()> add_validate_verb(CLI::App& app) {
  const auto a = std::make_shared<ValidateArguments>();
  CLI::App* verb = app.add_subcommand("validate", "load and check files without running them");
  finds_shipped(verb->add_option(
                    "files", a->files,
                    "plants, experiments, scenes, leaf templates, URDFs, meshes, tables, scripts"))
      ->required();
  verb->add_option("--unit", a->unit, "of the lengths in skeletons: m, cm, mm or metres");
  verb->add_option("--package", a->packages, "NAME=PATH: where package://NAME lies")
      ->allow_extra_args(false);
  return [a] {
    return validate_files(a->files, a->packages, std::cerr, unit_of_text(a->unit, "--unit"));
  };
}

std::function<int()> add_observe_verb(CLI::App& app) {
  const auto a = std::make_shared<ObserveArguments>();
  add_observe_options(
      *app.add_subcommand("observe", "simulate an experiment and write it as measured data"), *a);
  return [a] { return observe_verb(*a); };
}

}  // namespace

int run_cli(int argc, char** argv, const OpenDesktop& open_desktop, const MakeFilms& make_films) {
  hear_stop_signals();
  CLI::App app("Pedicel: a sandbox where robots handle plants.");
  app.footer(exit_codes_text() + "\n" + cache_place);
  app.set_version_flag("--version", "pedicel " + version() + " (" + git_hash() + ")");

  RunArguments run;
  finds_shipped(app.add_option("scene", run.scene,
                               "scene file (*.scene.yaml), or a log that is played (*.mcap)"));
  finds_shipped(
      app.add_option("--script", run.script, "run commands from a file, one a line, off screen"));
  app.add_flag("--headless")
      ->description("no window: run off screen (so do --out, --json and --quiet)");
  DesktopRequest window;
  bool paused = false;
  add_window_options(app, window, paused);
  add_run_options(app, run);
  RosArguments ros;
  add_ros_options(app, ros);
  TellArguments told;
  add_tell_options(app, told);

  const std::pair<const char*, std::function<int()>> verbs[] = {
      {"sweep", add_sweep_verb(app)},       {"validate", add_validate_verb(app)},
      {"bench", add_bench_verb(app)},       {"cluster", add_cluster_verb(app)},
      {"diagnose", add_diagnose_verb(app)}, {"fit", add_fit_verb(app)},
      {"import", add_import_verb(app)},     {"lab", add_lab_verb(app)},
      {"transfer", add_transfer_verb(app)}, {"pick", add_pick_verb(app)},
      {"dataset", add_dataset_verb(app)},   {"manual", add_manual_verb(app)},
      {"observe", add_observe_verb(app)}};
  app.require_subcommand(0, 1);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }
  if (const int code = guarded([&] { return check_finite(app), static_cast<int>(exit_ok); }))
    return code;
  if (!told.shell.empty() || told.man_page) return tell_verb(app, told);
  for (const auto& [name, verb] : verbs)
    if (app.got_subcommand(name)) return guarded(verb);
  return guarded([&] {
    if (!ros.ros) return window_verb(run, window, paused, open_desktop, make_films);
    check_run_arguments(run);
    apply_verbosity(run);
    return ros_verb(ros, run, paused);
  });
}

}  // namespace pedicel::app
