#include "app/verbs/run_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/gltf/gltf_film.h"
#include "app/h5/h5_log.h"
#include "app/session/document/document.h"
#include "app/session/document/plant_import.h"
#include "app/topics/mcap_log.h"
#include "app/verbs/cluster.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/core/verbosity.h"
#include "engine/io/asset_folder.h"
#include "engine/io/atomic_file.h"
#include "engine/io/bounds.h"
#include "engine/io/output_check.h"
#include "engine/io/output_kind.h"
#include "engine/world/scene_reader.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

void add_number(CLI::App& app, RunArguments& a, const std::string& option, const std::string& key,
                const std::string& help) {
  app.add_option_function<std::string>(
         option, [&a, key](const std::string& text) { a.numbers.emplace_back(key, text); }, help)
      ->type_name("NUMBER");
}

void add_table_options(CLI::App& app, RunArguments& a) {
  app.add_option(
      "--log", a.log,
      "a copy of log.csv there, at the end of the run; *.mcap, *.h5: what ROS 2's topics would "
      "say, while it runs");
  app.add_option("--gltf", a.gltf, "the moving scene there (*.glb), for Blender and browsers");
  app.add_option("--events", a.events, "a copy of events.csv there, at the end of the run");
  app.add_option("--trajectory", a.trajectory,
                 "joint positions over time (CSV) that the robot follows, in place of the scene's "
                 "program");
  app.add_option("--compare", a.compare,
                 "measured values (CSV: time_s, and columns of the log); with --tolerance");
  app.add_option("--tolerance", a.tolerance,
                 "how far the log may be from them, in each column's unit; beyond: exit code 5");
  app.add_option("--save-state", a.save_state, "the state at the end there, to go on from");
  app.add_option(
      "--load-state", a.load_state,
      "goes on from a saved state of the same scene, to the same bits (its steps are done "
      "again)");
  app.add_option("--param-sweep", a.param_sweep,
                 "a run for each row of a table (CSV) whose columns are keys of --set");
}

}  // namespace

std::string RunArguments::number(const std::string& key) const {
  const auto found = std::ranges::find(numbers, key, &std::pair<std::string, std::string>::first);
  return found == numbers.end() ? "" : found->second;
}

bool RunArguments::has_one_of(std::initializer_list<const char*> options) const {
  return std::ranges::any_of(options, [&](const char* name) {
    const CLI::Option* option = app->get_option_no_throw(name);
    return option && option->count() > 0;
  });
}

void RunArguments::refuse(std::initializer_list<const char*> options,
                          const std::string& why) const {
  for (const char* option : options)
    if (has_one_of({option})) throw UsageError(std::string(option) + ": " + why);
}

bool RunArguments::asks_for_run() const {
  return has_one_of({"--out", "--script", "--log", "--events", "--gltf", "--compare",
                     "--save-state", "--save-plants", "--load-state", "--param-sweep",
                     "--trajectory", "--headless", "--json", "--quiet", "--print-scene",
                     "--steps"});
}

CLI::Option* finds_shipped(CLI::Option* option) {
  const auto find = [](std::string& name) {
    name = io::shipped_file(name);
    return std::string();
  };
  return option->transform(CLI::Validator(find, ""));
}

void add_run_options(CLI::App& app, RunArguments& a) {
  a.app = &app;
  app.add_option(
      "--out", a.out,
      "folder for everything that is written (default: out/<scene>); what an earlier run "
      "wrote there is replaced, other files stay");
  app.add_option("--set", a.set,
                 "key=value: duration, dt, seed, threads, log_rate, rods.KEY, coupling.KEY, "
                 "robot.gripper_force, plants.NAME.KEY, or a key of every plant such as "
                 "detach.stretch; may be repeated")
      ->allow_extra_args(false);
  add_number(app, a, "--duration", "duration", "simulated time, s");
  app.add_option("--steps", a.steps, "steps to do, in place of the duration");
  add_number(app, a, "--dt", "dt", "time step, s");
  add_number(app, a, "--seed", "seed", "seed of everything random");
  add_number(app, a, "--threads", "threads", "threads for the plants");
  add_number(app, a, "--log-rate", "log_rate", "rows a simulated second in log.csv, Hz");
  add_table_options(app, a);
  add_instruction_set_option(app);
  app.add_option("--package", a.packages, "NAME=PATH: where package://NAME lies; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--unit", a.unit,
                 "of the lengths in a lone table or MTG: m, cm, mm or how many metres one is");
  app.add_option("--fps", a.fps, "frames a simulated second of the video, Hz");
  app.add_option("--size", a.size, "WxH of pictures and video, px");
  app.add_option("--camera", a.camera,
                 "of the scene's, for the video, the film and the picture (default: the scene's "
                 "choice)");
  app.add_flag("--no-video", a.no_video, "take no video");
  app.add_flag("--no-pictures", a.no_pictures, "take neither pictures nor video");
  app.add_flag("--no-sweep", a.no_sweep, "leave out the scene's sweep");
  app.add_flag("--print-scene", a.print_scene,
               "the scene with its defaults and these options as YAML on standard output, without "
               "running it");
  app.add_option(
      "--save-plants", a.save_plants,
      "writes every plant of the scene into that folder, each of a grid as a file of its "
      "own, and the scene that has them, without running it");
  app.add_flag("--json", a.json, "the result as JSON on standard output");
  app.add_flag("--quiet", a.quiet, "no progress, no start and end lines: as -v 2");
  app.add_option("-v", a.verbosity,
                 "0 nothing, 1 errors, 2 warnings, 3 start, end and progress, 4 every picture and "
                 "break, too")
      ->check(CLI::Range(0, 4));
}

namespace {

/// A value that is the next option was forgotten, and of two tables in one file one would be lost.
void check_files(const RunArguments& a) {
  const std::pair<const char*, const std::string*> named[] = {{"--out", &a.out},
                                                              {"--log", &a.log},
                                                              {"--events", &a.events},
                                                              {"--gltf", &a.gltf},
                                                              {"--save-state", &a.save_state}};
  for (const auto& [option, name] : named)
    if (name->starts_with("--"))
      throw UsageError(std::string(option) + ": found the option " + *name +
                       ", expected a name (./" + *name + " where it is meant)");
  for (const auto& [option, name] : named)
    for (const auto& [other, same] : named)
      if (option != other && !name->empty() && *name == *same)
        throw UsageError(std::string(option) + " and " + other + ": both are " + *name +
                         ", expected two names");
}

}  // namespace

void check_run_arguments(const RunArguments& a) {
  const auto set = [&](const std::string& key) {
    return !a.number(key).empty() || std::ranges::any_of(a.set, [&](const std::string& one) {
      return one.starts_with(key + "=");
    });
  };
  for (std::size_t i = 0; i < a.numbers.size(); ++i)
    for (const std::string& one : a.set)
      if (one.starts_with(a.numbers[i].first + "="))
        throw UsageError("--set " + one + ": " + a.numbers[i].first +
                         " is given by its own option, too, expected one of them");
  if (a.steps && set("duration"))
    throw UsageError("--steps: the duration is given, too, expected one of them");
  if (a.steps && *a.steps < 0)
    throw UsageError("--steps " + std::to_string(*a.steps) + ": expected a whole number from 0 on");
  if (a.compare.empty() != !a.tolerance)
    throw UsageError("--compare and --tolerance: expected both or none");
  if (a.tolerance && !(*a.tolerance >= 0.0 && std::isfinite(*a.tolerance)))
    throw UsageError("--tolerance " + io::format_number(*a.tolerance) +
                     ": expected a number from 0 on");
  if (a.fps && !io::within(*a.fps, world::video_rates))
    throw UsageError("--fps " + io::format_number(*a.fps) + ": expected " +
                     io::bounds_text(world::video_rates) + " Hz");
  check_files(a);
  if (a.quiet && a.verbosity) throw UsageError("--quiet and -v: expected one of them");
  if (!a.param_sweep.empty())
    a.refuse({"--log", "--events", "--gltf", "--compare", "--save-state", "--load-state"},
             "is of one run, expected it without --param-sweep");
}

namespace {

/// With what the scene says of steps and duration in agreement.
void apply_steps(const RunArguments& a, world::Scene& scene) {
  if (!a.steps) return;
  const double duration = static_cast<double>(*a.steps) * scene.dt;
  const double most = world::scene_bounds("duration").maximum;
  if (duration > most)
    throw UsageError("--steps " + std::to_string(*a.steps) + ": are " +
                     io::format_number(duration) + " s, expected at most " +
                     io::format_number(most) + " s");
  if (*a.steps > 0) scene.duration = std::max(duration, world::scene_bounds("duration").minimum);
}

void apply_trajectory(const RunArguments& a, world::Scene& scene) {
  if (a.trajectory.empty()) return;
  if (!scene.robot)
    throw UsageError("--trajectory: the scene has no robot, expected one to follow it");
  scene.robot->trajectory = a.trajectory;
  scene.robot->waypoints.clear();
}

}  // namespace

void check_camera(const world::Scene& scene, const std::string& name) {
  if (std::ranges::count(scene.cameras, name, &world::SceneCamera::name) > 0) return;
  throw UsageError("--camera " + name + ": the scene has none of that name, expected " +
                   (scene.cameras.empty()
                        ? "a scene with cameras"
                        : "one of: " + joined(scene.cameras, &world::SceneCamera::name)));
}

world::Scene load_scene(const RunArguments& a) {
  Diagnostics diagnostics;
  const double unit = unit_of_text(a.unit, "--unit");
  if (unit > 0.0 && !is_lone_plant(a.scene))
    throw UsageError(
        "--unit: expected beside a skeleton; a scene says the unit of each of its "
        "plants (unit: cm)");
  std::optional<world::Scene> scene = is_lone_plant(a.scene)
                                          ? scene_of(open_document(a.scene, unit, &diagnostics))
                                          : world::read_scene(a.scene, diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  for (const Diagnostic& remark : diagnostics.all())
    say(remark.severity == Severity::notice ? Verbosity::lines : Verbosity::warnings, "%s",
        to_string(remark).c_str());
  for (const auto& [key, text] : a.numbers) world::apply_override(*scene, key, text, "--");
  for (const std::string& assignment : a.set) {
    const auto [key, value] = world::split_assignment(assignment);
    world::apply_override(*scene, key, value, "--set ");
  }
  apply_steps(a, *scene);
  apply_trajectory(a, *scene);
  if (!a.camera.empty()) {
    check_camera(*scene, a.camera);
    scene->video.camera = a.camera;
  }
  if (a.fps) scene->video.fps = *a.fps;
  if (!a.size.empty()) scene->video.size = world::to_picture_size(a.size, "--size");
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
  if (a.log.ends_with(".mcap"))
    options.watchers.push_back(mcap_log(a.log));
  else if (a.log.ends_with(".h5"))
    options.watchers.push_back(h5_log(a.log));
  else
    options.log = a.log;
  options.events = a.events;
  if (!a.gltf.empty()) {
    if (!a.gltf.ends_with(".glb"))
      throw UsageError("--gltf " + a.gltf + ": expected a name that ends in .glb");
    options.watchers.push_back(gltf_film(a.gltf));
    options.moving_scene = a.gltf;
  }
  options.steps = a.steps;
  options.save_state = a.save_state;
  options.load_state = a.load_state;
  if (a.tolerance)
    options.comparison_with = ComparisonRequest{read_measured(a.compare), *a.tolerance};
  options.pictures = !a.no_pictures;
  options.video = !a.no_video;
  options.fps = a.fps;
  if (!a.size.empty()) options.size = world::to_picture_size(a.size, "--size");
  options.quiet = a.quiet;
  return options;
}

namespace {

bool is_same_place(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code none;
  const auto place = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), none);
  };
  return place(one) == place(other);
}

/// What is written elsewhere than in the folder: before the run, and none in the place of another.
void check_files_out(const RunArguments& a, const std::filesystem::path& out) {
  const std::pair<const char*, const std::string*> outputs[] = {{"--log", &a.log},
                                                                {"--events", &a.events},
                                                                {"--gltf", &a.gltf},
                                                                {"--save-state", &a.save_state}};
  const std::pair<const char*, const std::string*> inputs[] = {{"the scene", &a.scene},
                                                               {"--trajectory", &a.trajectory},
                                                               {"--compare", &a.compare},
                                                               {"--param-sweep", &a.param_sweep}};
  for (const auto& [option, name] : outputs) {
    if (name->empty()) continue;
    for (const auto& [input, file] : inputs)
      if (!file->empty() && is_same_place(*name, *file))
        throw UsageError(std::string(option) + " " + *name + ": is the file of " + input +
                         ", expected another name");
    if (is_same_place(*name, out))
      throw UsageError(std::string(option) + " " + *name +
                       ": is the folder of the run (--out), expected a file's name");
    const std::filesystem::path path = *name;
    const bool is_the_runs = is_same_place(std::filesystem::absolute(path).parent_path(), out) &&
                             std::ranges::count(files_of_a_run(), path.filename().string()) > 0;
    const bool is_itself = (name == &a.log && path.filename() == "log.csv") ||
                           (name == &a.events && path.filename() == "events.csv");
    if (is_the_runs && !is_itself)
      throw UsageError(std::string(option) + " " + *name +
                       ": the run writes a file of its own there, expected another name");
    const io::OutputKind kind = name == &a.events       ? io::OutputKind::events
                                : name == &a.save_state ? io::OutputKind::state
                                : name == &a.gltf       ? io::OutputKind::gltf
                                                  : io::kind_of_name(*name, io::OutputKind::log);
    io::check_output_file(path, kind, out);
  }
}

}  // namespace

RunOptions options_of_run(const RunArguments& a) {
  RunOptions options = run_options(a);
  if (!a.print_scene && a.save_plants.empty()) {
    check_files_out(a, options.out);
    io::check_output_folder(options.out, files_of_a_run());
  }
  if (is_lone_plant(a.scene))
    options.simulation.edited =
        options_of(open_document(a.scene, unit_of_text(a.unit, "--unit")), {}).edited;
  return options;
}

int end_of_run(const world::Scene& scene, const RunArguments& a, const RunOptions& options,
               const SceneResult& result) {
  if (a.json) std::cout << to_json(scene, result) << std::endl;
  if (!a.quiet) say(Verbosity::lines, "written to %s", printable(options.out.string()).c_str());
  return result.exit_code;
}

void apply_verbosity(const RunArguments& a) {
  if (a.quiet) set_verbosity(Verbosity::warnings);
  if (a.verbosity) set_verbosity(static_cast<Verbosity>(*a.verbosity));
}

}  // namespace pedicel::app
