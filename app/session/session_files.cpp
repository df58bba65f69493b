#include "app/scene_plants.h"
#include "core/check.h"
#include "io/atomic_file.h"
#include "session/journal.h"
#include "session/measured_commands.h"
#include "session/plant_export.h"
#include "session/plant_import.h"
#include "session/scene_save.h"
#include "session/session.h"

/// What a session does with files.
namespace pedicel::app {

namespace {

/// The file a plant is saved to: its own, else `path`; empty: it has none.
std::filesystem::path file_of(const DocumentPlant& plant, const std::filesystem::path& path) {
  if (!plant.entry.file.empty() && is_plant_file(plant.entry.file)) return plant.entry.file;
  return path;
}

bool says_the_same(const std::filesystem::path& path, const plant::PlantFile& plant) {
  if (!std::filesystem::exists(path)) return false;
  Diagnostics diagnostics;
  const auto there = plant::read_plant_file(path, diagnostics);
  return there && *there == plant;
}

/// The one before stays as NAME~.
void write_with_backup(const std::filesystem::path& path, const std::string& text) {
  if (std::filesystem::exists(path)) {
    std::filesystem::path backup = path;
    backup += "~";
    io::write_file_atomically(backup, io::read_file(path));
  }
  io::write_file_atomically(path, text);
}

/// Whether there is nothing of a plant to be saved: no stems, or still as its file says.
bool is_as_read(const DocumentPlant& one) {
  if (!one.file || one.file->curves.empty()) return true;
  const std::filesystem::path source = app::source_of(one.entry);
  if (source.empty() || !std::filesystem::exists(source)) return false;
  Diagnostics diagnostics;
  const auto there = read_plant(source, diagnostics);
  return there && *there == *one.file;
}

struct Saved {
  std::vector<std::filesystem::path> written, kept;
  std::string refusal;  ///< why nothing could be done; empty: it was

  std::string text() const {
    if (written.empty() && kept.empty()) return "nothing to save";
    std::string names;
    for (const std::filesystem::path& file : written.empty() ? kept : written)
      names += (names.empty() ? "" : ", ") + file.string();
    return (written.empty() ? "unchanged " : "saved ") + names;
  }
};

Saved save_plants(Document& document, const std::filesystem::path& path) {
  Saved saved;
  int without_file = 0;
  for (const DocumentPlant& one : document.plants)
    if (file_of(one, {}).empty() && !is_as_read(one)) ++without_file;
  if (without_file > 1)
    saved.refusal = std::to_string(without_file) +
                    " plants have no file yet, expected them to be exported one by one";
  for (DocumentPlant& one : document.plants) {
    if (!saved.refusal.empty()) return saved;
    if (!one.file || one.file->curves.empty()) continue;
    const bool alone = document.plants.size() == 1 && !path.empty();
    if (!alone && file_of(one, {}).empty() && is_as_read(one)) continue;  // an MTG, say
    const std::filesystem::path file = alone ? path : file_of(one, path);
    if (file.empty()) {
      saved.refusal = "plant \"" + one.entry.name + "\" has no file yet, expected a path";
      continue;
    }
    const bool same = says_the_same(file, *one.file);
    if (!same) write_with_backup(file, plant::plant_text(*one.file));
    (same ? saved.kept : saved.written).push_back(file);
    one.entry.file = file;
    one.entry.source = world::ScenePlant::Source::file;
    if (document.path.empty()) document.path = file;
  }
  return saved;
}

/// After the plants, which have files now.
void save_scene(const Document& document, Saved& saved) {
  if (!is_scene(document.path)) return;
  const std::string before = io::read_file(document.path);
  const std::string text = changed_scene_text(document, before);
  if (text != before) write_with_backup(document.path, text);
  (text == before ? saved.kept : saved.written).push_back(document.path);
}

}  // namespace

bool Session::open(const std::filesystem::path& path) {
  if (is_experiment(path)) return open_experiment(path).ok;
  try {
    set_document(open_document(path));
    failed_path_.clear();
    forget_file_faults();
    if (options_.waits) control_.wait();
    return true;
  } catch (const InvalidFile& fault) {
    failed_path_ = path;
    say(fault.all(), true);
  } catch (const UsageError& fault) {
    failed_path_ = path;
    say(Severity::error, path.string() + ": " + fault.what(), true);
  }
  return false;
}

void Session::open_empty() {
  failed_path_.clear();
  set_document(empty_document());
  if (options_.waits) control_.wait();
}

bool Session::reload() {
  const Command again("reload", {});
  forget_file_faults();
  if (!failed_path_.empty()) return open(failed_path_);
  if (document_.path.empty()) {
    control_.reset();
    log_.push_back(again.text());
    return true;
  }
  try {
    const Document before = document_;
    Document fresh = open_document(document_.path);
    gesture_.reset();
    document_ = std::move(fresh);
    history_.add({{again}, before, document_});
    log_.push_back(again.text());
    built_ = false;
    rebuild(true);
    saved_hash_ = hash_;
    saved_settings_.clear();
    begin_journal();
    return true;
  } catch (const InvalidFile& fault) {
    say(fault.all(), true);
  }
  return false;
}

Result Session::save(const std::filesystem::path& path) {
  end_gesture();
  Saved saved;
  try {
    saved = save_plants(document_, path);
    if (!saved.refusal.empty()) return {false, saved.refusal};
    save_scene(document_, saved);
  } catch (const UsageError& fault) {
    return {false, fault.what()};
  } catch (const InvalidFile& fault) {
    return {false, sentences(fault.all()), true};
  } catch (const io::WriteError& fault) {
    return {false, fault.what()};
  }
  saved_hash_ = hash_;
  if (!saved.written.empty()) saved_ = document_;
  if (is_scene(document_.path)) saved_settings_ = document_.settings;
  begin_journal();
  return {true, saved.text()};
}

Result Session::export_plant(const std::string& plant, const std::filesystem::path& path) {
  write_plant_as(path, document_.plant(plant));
  return {true, "written to " + path.string()};
}

Result Session::import_plant(const std::filesystem::path& path, const std::string& name) {
  Diagnostics diagnostics;
  const auto file = read_plant(path, diagnostics);
  if (!file) {
    if (!options_.waits) say(diagnostics.all(), false);  // whole, and to stay
    return {false, sentences(diagnostics.all()), true};
  }
  // The text goes into the command, so that the log does not depend on the file.
  const Command command("add plant", {{"plant", name.empty() ? file->name : name},
                                      {"text", plant::plant_text(*file)}});
  return change_document(command);
}

}  // namespace pedicel::app
