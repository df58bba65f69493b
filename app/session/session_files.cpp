#include "pedicel/app/session/session_files.h"

#include <algorithm>

#include "pedicel/app/session/commands/measured_commands.h"
#include "pedicel/app/session/commands/scene_things.h"
#include "pedicel/app/session/document/plant_export.h"
#include "pedicel/app/session/document/plant_import.h"
#include "pedicel/app/session/session.h"
#include "pedicel/app/session/session_measured.h"
#include "pedicel/core/check.h"
#include "pedicel/io/atomic_file.h"

namespace pedicel::app {

const Document& SessionFiles::document() const {
  return core_.editor.document();
}

const std::filesystem::path& SessionFiles::path() const {
  return document().path;
}

bool SessionFiles::dirty() const {
  return core_.editor.hash() != saved_hash_;
}

void SessionFiles::give_up_edits() {
  saved_hash_ = core_.editor.hash();
}

void SessionFiles::begin(Document document) {
  core_.editor.open(std::move(document));
  saved_hash_ = core_.editor.hash();
  saved_settings_.clear();
  first_ = core_.editor.document();
  saved_.reset();
  files_.remember(first_);
  core_.autosave.begin(first_);
}

bool SessionFiles::open(const std::filesystem::path& path, double unit) {
  if (is_experiment(path)) return session_.measured().open(path).ok;
  try {
    Diagnostics remarks;
    begin(open_document(path, unit, &remarks));
    failed_path_.clear();
    core_.messages.forget_file_faults();
    session_.measured().leave();
    core_.messages.say_remarks(remarks);
    if (core_.options.waits) core_.control.wait();
    return true;
  } catch (const InvalidFile& fault) {
    failed_path_ = path;
    core_.messages.say(fault.all(), true);
  } catch (const UsageError& fault) {
    failed_path_ = path;
    core_.messages.say(Severity::error, path.string() + ": " + fault.what(), true);
  }
  return false;
}

void SessionFiles::open_empty() {
  failed_path_.clear();
  begin(empty_document());
  session_.measured().leave();
  if (core_.options.waits) core_.control.wait();
}

bool SessionFiles::reload() {
  const Command again("reload", {});
  core_.messages.forget_file_faults();
  if (!failed_path_.empty()) return open(failed_path_);
  if (path().empty()) {
    core_.control.reset();
    core_.editor.log().add(again.text());
    return true;
  }
  try {
    Diagnostics remarks;
    core_.editor.reload(open_document(path(), document().unit, &remarks), again);
    saved_hash_ = core_.editor.hash();
    saved_settings_.clear();
    files_.remember(document());
    core_.autosave.begin(document());
    core_.messages.say_remarks(remarks);
    return true;
  } catch (const InvalidFile& fault) {
    core_.messages.say(fault.all(), true);
  }
  return false;
}

Result SessionFiles::export_plant(const std::string& plant, const std::filesystem::path& path) {
  write_plant_as(path, document().plant(plant));
  return {true, "written to " + path.string()};
}

Result SessionFiles::import_plant(const std::filesystem::path& path, const std::string& name,
                                  double unit) {
  Diagnostics diagnostics;
  const auto file = read_plant(path, diagnostics, unit);
  if (!file) {
    if (!core_.options.waits) core_.messages.say(diagnostics.all(), false);  // whole, and to stay
    return {false, sentences(diagnostics.all()), true};
  }
  // The text goes into the command, so that the log does not depend on the file.
  std::string as = name.empty() ? file->name : name;
  if (name.empty()) {
    std::ranges::replace(as, '.', '_');  // scenes have none in a name
    as = free_name(document(), ThingKind::plant, as);
  }
  std::map<std::string, Value> arguments{{"plant", as}, {"text", plant::plant_text(*file)}};
  if (is_plant_file(path)) {
    const auto whole = std::filesystem::absolute(path).lexically_normal();
    arguments.emplace("file", whole.string());
    files_.remember(whole, io::read_file(whole));
  }
  Result result = core_.editor.change(Command("add plant", std::move(arguments)));
  if (!result) return result;
  core_.messages.say_remarks(diagnostics);
  if (result.text.empty()) result.text = lines_of(diagnostics.all());
  return result;
}

}  // namespace pedicel::app
