#include "core/check.h"
#include "io/atomic_file.h"
#include "session/journal.h"
#include "session/measured_commands.h"
#include "session/plant_export.h"
#include "session/plant_import.h"
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

}  // namespace

bool Session::open(const std::filesystem::path& path) {
  if (is_experiment(path)) return open_experiment(path).ok;
  try {
    set_document(open_document(path));
    failed_path_.clear();
    if (options_.waits) control_.wait();
    return true;
  } catch (const InvalidFile& fault) {
    failed_path_ = path;
    say(Severity::error, fault.what(), true);
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
  if (!failed_path_.empty()) return open(failed_path_);
  if (document_.path.empty()) {
    control_.reset();
    return true;
  }
  try {
    const Document before = document_;
    Document fresh = open_document(document_.path);
    gesture_.reset();
    document_ = std::move(fresh);
    history_.add({{Command("reload", {})}, before, document_});
    rebuild(true);
    saved_hash_ = hash_;
    begin_journal();
    return true;
  } catch (const InvalidFile& fault) {
    say(Severity::error, fault.what(), true);
  }
  return false;
}

Result Session::save(const std::filesystem::path& path) {
  end_gesture();
  int written = 0, without_file = 0;
  std::string where;
  for (const DocumentPlant& one : document_.plants)
    if (one.file && !one.file->curves.empty() && file_of(one, {}).empty()) ++without_file;
  if (without_file > 1)
    return {false, std::to_string(without_file) +
                       " plants have no file yet, expected them to be exported one by one"};
  for (std::size_t p = 0; p < document_.plants.size(); ++p) {
    DocumentPlant& one = document_.plants[p];
    if (!one.file || one.file->curves.empty()) continue;
    const bool alone = document_.plants.size() == 1 && !path.empty();
    const std::filesystem::path file = alone ? path : file_of(one, path);
    if (file.empty())
      return {false, "plant \"" + one.entry.name + "\" has no file yet, expected a path"};
    if (!says_the_same(file, *one.file)) {
      write_with_backup(file, plant::plant_text(*one.file));
      ++written;
    }
    one.entry.file = file;
    one.entry.source = world::ScenePlant::Source::file;
    where += (where.empty() ? "" : ", ") + file.string();
    if (document_.path.empty()) document_.path = file;
  }
  saved_hash_ = hash_;
  begin_journal();
  return {true, where.empty() ? "nothing to save" : (written ? "saved " : "unchanged ") + where};
}

Result Session::export_plant(const std::string& plant, const std::filesystem::path& path) {
  write_plant_as(path, document_.plant(plant));
  return {true, "written to " + path.string()};
}

Result Session::import_plant(const std::filesystem::path& path, const std::string& name) {
  Diagnostics diagnostics;
  const auto file = read_plant(path, diagnostics);
  if (!file) return {false, diagnostics.text()};
  // The text goes into the command, so that the log does not depend on the file.
  const Command command("add plant", {{"plant", name.empty() ? file->name : name},
                                      {"text", plant::plant_text(*file)}});
  return change_document(command);
}

}  // namespace pedicel::app
