#include <algorithm>

#include "pedicel/app/session/commands/measured_commands.h"
#include "pedicel/app/session/commands/scene_things.h"
#include "pedicel/app/session/document/plant_export.h"
#include "pedicel/app/session/document/plant_import.h"
#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"
#include "pedicel/io/atomic_file.h"

/// What a session does with files.
namespace pedicel::app {

bool Session::open(const std::filesystem::path& path, double unit) {
  if (is_experiment(path)) return open_experiment(path).ok;
  try {
    Diagnostics remarks;
    set_document(open_document(path, unit, &remarks));
    failed_path_.clear();
    forget_file_faults();
    leave_experiment();
    say_remarks(remarks);
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
  leave_experiment();
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
    Diagnostics remarks;
    Document fresh = open_document(document_.path, document_.unit, &remarks);
    gesture_.reset();
    document_ = std::move(fresh);
    history_.add({{again}, before, document_});
    log_.push_back(again.text());
    built_ = false;
    rebuild(true);
    saved_hash_ = hash_;
    saved_settings_.clear();
    files_.remember(document_);
    begin_journal();
    say_remarks(remarks);
    return true;
  } catch (const InvalidFile& fault) {
    say(fault.all(), true);
  }
  return false;
}

Result Session::export_plant(const std::string& plant, const std::filesystem::path& path) {
  write_plant_as(path, document_.plant(plant));
  return {true, "written to " + path.string()};
}

void Session::say_remarks(const Diagnostics& remarks) {
  for (const Diagnostic& one : remarks.all()) say(one.severity, to_string(one));
}

Result Session::import_plant(const std::filesystem::path& path, const std::string& name,
                             double unit) {
  Diagnostics diagnostics;
  const auto file = read_plant(path, diagnostics, unit);
  if (!file) {
    if (!options_.waits) say(diagnostics.all(), false);  // whole, and to stay
    return {false, sentences(diagnostics.all()), true};
  }
  // The text goes into the command, so that the log does not depend on the file.
  std::string as = name.empty() ? file->name : name;
  if (name.empty()) {
    std::ranges::replace(as, '.', '_');  // scenes have none in a name
    as = free_name(document_, ThingKind::plant, as);
  }
  std::map<std::string, Value> arguments{{"plant", as}, {"text", plant::plant_text(*file)}};
  if (is_plant_file(path)) {
    const auto whole = std::filesystem::absolute(path).lexically_normal();
    arguments.emplace("file", whole.string());
    files_.remember(whole, io::read_file(whole));
  }
  Result result = change_document(Command("add plant", std::move(arguments)));
  if (!result) return result;
  say_remarks(diagnostics);
  if (result.text.empty()) result.text = lines_of(diagnostics.all());
  return result;
}

}  // namespace pedicel::app
