#include "app/verbs/import.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/verbs/import_log.h"
#include "app/verbs/import_words.h"
#include "app/verbs/run_arguments.h"
#include "app/verbs/validate.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/io/output_check.h"
#include "engine/io/output_folder.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/import/experiment_import.h"
#include "plugins/discrepancy/import/recording_reader.h"
#include "plugins/discrepancy/import/world_frame.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

namespace {

using discrepancy::ImportedTrial;
using discrepancy::ImportNotes;
using discrepancy::ImportRequest;

discrepancy::Statements statements_of(const ImportArguments& a, Diagnostics& diagnostics) {
  discrepancy::Statements said;
  if (!a.units.empty()) said.unit = length_of_text(a.units, "--units");
  said.rate = a.rate;
  said.scale = a.scale;
  if (!a.axes.empty()) said.axes = discrepancy::turn_of_axes(a.axes, "--axes");
  if (!a.up.empty()) said.axes = discrepancy::turn_of_up(a.up.front());
  if (!a.origin.empty()) said.origin = discrepancy::numbers3_of_text(a.origin, "--origin");
  if (!a.origin_pixel.empty())
    said.origin_pixel = discrepancy::numbers2_of_text(a.origin_pixel, "--origin-pixel");
  if (!a.plane.empty()) said.plane = discrepancy::plane_of_text(a.plane, "--plane");
  if (!a.camera.empty()) said.camera = discrepancy::read_picture_camera(a.camera, diagnostics);
  return said;
}

discrepancy::ForceStatements force_statements_of(const ImportArguments& a) {
  discrepancy::ForceStatements said;
  if (!a.force_column.empty()) said.column = a.force_column;
  if (!a.extension.empty()) said.extension = a.extension;
  if (!a.force_unit.empty())
    said.unit = factor_of_text(a.force_unit, io::Quantity::force, "--force-unit");
  if (!a.time_unit.empty())
    said.time_unit = factor_of_text(a.time_unit, io::Quantity::time, "--time-unit");
  if (!a.force_direction.empty())
    said.direction = discrepancy::direction_of_text(a.force_direction, "--force-direction");
  if (!a.force_axes.empty()) said.axes = discrepancy::turn_of_axes(a.force_axes, "--force-axes");
  return said;
}

/// The file's name without the ending that says its kind: "pull_0.1" of pull_0.1.tsv.
std::string trial_name(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  const bool is_kind =
      std::ranges::any_of(std::array{".csv", ".tsv", ".txt", ".c3d"},
                          [&](const char* known) { return io::same_but_case(known, ending); });
  return (is_kind ? file.stem() : file.filename()).string();
}

std::vector<std::string> trial_names(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) {
    const std::string name = trial_name(file);
    if (name.empty() || name == "." || name == "..")
      throw UsageError("import: " + in_quotes(file) +
                       " gives a trial no name, expected another name");
    if (std::ranges::find(names, name) != names.end())
      throw UsageError("import: two files give the trial " + in_quotes(name) +
                       ", expected files of different names");
    names.push_back(name);
  }
  return names;
}

std::vector<ImportedTrial> read_trials(const ImportArguments& a, Diagnostics& diagnostics,
                                       ImportNotes& notes) {
  const std::vector<std::string> names = trial_names(a.files);
  const TrialWords begins(a.begins, names, "--begin"), releases(a.releases, names, "--release"),
      forces(a.forces, names, "--force"), force_begins(a.force_begins, names, "--force-begin");
  if (names.size() > 1 && forces.is_for_all())
    throw UsageError("--force: there are " + std::to_string(names.size()) +
                     " trials, expected --force TRIAL=FILE");
  const discrepancy::RecordingOptions options{a.likelihood};
  const discrepancy::ForceStatements force = force_statements_of(a);
  std::vector<ImportedTrial> trials;
  for (std::size_t i = 0; i < names.size(); ++i) {
    ImportedTrial trial;
    trial.name = names[i];
    try {
      if (auto read = discrepancy::read_recording(a.files[i], a.format, options, diagnostics))
        trial.recording = std::move(*read);
      if (const auto file = forces.of(trial.name))
        trial.force = discrepancy::read_force_record(*file, force, diagnostics, notes);
    } catch (const InvalidFile& fault) {
      diagnostics.add(fault);
    }
    trial.begin = begins.number(trial.name);
    trial.release = releases.number(trial.name);
    trial.force_begin = force_begins.number(trial.name);
    trials.push_back(std::move(trial));
  }
  return trials;
}

void read_places(const ImportArguments& a, ImportRequest& request) {
  for (const std::string& text : a.places) {
    const auto [point, place] = placed_point(text, "--place");
    request.places.push_back({point, point, place});
  }
  for (const std::string& text : a.names) {
    const auto [point, name] = split_words(text, '=', "--map", "POINT=NAME");
    const auto found = std::ranges::find(request.places, point, &discrepancy::PlacedPoint::point);
    if (found == request.places.end())
      throw UsageError("--map " + in_quotes(text) + ": " + in_quotes(point) +
                       " has no place, expected --place for it");
    found->name = name;
  }
  for (std::size_t i = 0; i < request.places.size(); ++i)
    check_marker_name(request.places[i].name, request.places, i);
  for (const std::string& text : a.holds) {
    const auto [point, place] = placed_point(text, "--hold");
    request.holds.push_back({point, place, a.stiffness});
  }
  if (!a.lead.empty()) request.holds.push_back({"", curve_place(a.lead, "--lead"), a.stiffness});
}

ImportRequest request_of(const ImportArguments& a, ImportNotes& notes) {
  Diagnostics diagnostics;
  ImportRequest request;
  request.title = a.title;
  request.plant_path = a.plant;
  read_places(a, request);
  request.statements = statements_of(a, diagnostics);
  if (auto plant = plant::read_plant_file(a.plant, diagnostics)) request.plant = std::move(*plant);
  request.trials = read_trials(a, diagnostics, notes);
  if (!a.force_direction.empty())
    request.extension_direction =
        discrepancy::direction_of_text(a.force_direction, "--force-direction");
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  if (const std::string notices = diagnostics.text(); !notices.empty())
    std::fprintf(stderr, "%s\n", notices.c_str());
  return request;
}

}  // namespace

namespace {

/// What is not there is told before anything that is asked of it.
void check_files_are_there(const ImportArguments& a) {
  Diagnostics diagnostics;
  for (const std::string& file : a.files) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
      diagnostics.error({file}, "is a folder, expected a recording");
    else if (error)
      diagnostics.error({file}, "cannot be read: " + error.message());
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
}

}  // namespace

int import_verb(const ImportArguments& a) {
  check_files_are_there(a);
  io::check_output_folder(a.out, {"experiment.yaml"});
  if (are_logs(a)) return import_log_verb(a);
  if (!a.scene.empty())
    throw UsageError("--scene: is for logs (MCAP), expected --plant beside recordings of points");
  if (a.plant.empty())
    throw UsageError(
        "import: an experiment needs its nominal plant, expected "
        "--plant with a plant file (pedicel draws one, or reads an MTG or a table)");
  ImportNotes notes;
  const ImportRequest request = request_of(a, notes);
  const discrepancy::Experiment experiment = discrepancy::import_experiment(request, notes);
  refuse_missing(notes.missing);
  if (!a.quiet)
    for (const std::string& sentence : notes.said) std::fprintf(stderr, "%s\n", sentence.c_str());
  stop_in_good_order();
  const std::string replaced = io::write_folder(a.out, [&](const std::filesystem::path& in) {
    discrepancy::write_experiment(in, experiment);
  });
  if (!replaced.empty()) std::fprintf(stderr, "%s\n", replaced.c_str());
  std::fprintf(stderr, "written to %s\n", a.out.c_str());
  // What a diagnosis would say of the data, while the laboratory's files are still at hand.
  return validate_files({a.out}, {}, std::cerr);
}

std::function<int()> add_import_verb(CLI::App& app) {
  const auto a = std::make_shared<ImportArguments>();
  CLI::App* verb =
      app.add_subcommand("import", "make an experiment folder of a laboratory's files");
  verb->add_option(
          "files", a->files,
          "recordings of points, or logs of a robot (MCAP), one a trial, named by the file")
      ->required();
  verb->add_option("--out", a->out, "experiment folder to write")->required();
  finds_shipped(verb->add_option("--plant", a->plant, "plant file of the nominal plant"));
  finds_shipped(verb->add_option("--scene", a->scene,
                                 "scene file of the nominal scene, for logs of a robot"));
  verb->add_option("--title", a->title, "title of the experiment");
  verb->add_option("--format", a->format, "of the recordings (default: told from the content)")
      ->check(CLI::IsMember({"motive", "qualisys", "vicon", "deeplabcut", "tracker", "c3d"}));
  add_frame_options(*verb, *a);
  add_place_options(*verb, *a);
  add_force_options(*verb, *a);
  verb->add_flag("--quiet", a->quiet, "does not say what was taken from where");
  return [a] { return import_verb(*a); };
}

}  // namespace pedicel::app
