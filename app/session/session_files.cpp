#include "app/session/session_files.h"

#include <algorithm>

#include "app/session/commands/measured_commands.h"
#include "app/session/commands/scene_things.h"
#include "app/session/document/document_parameters.h"
#include "app/session/document/plant_export.h"
#include "app/session/document/plant_import.h"
#include "app/session/document/plant_save.h"
#include "app/session/document/scene_save.h"
#include "app/session/journal.h"
#include "app/session/session.h"
#include "app/session/session_core.h"
#include "app/session/session_measured.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/world/scene_reader.h"
#include "engine/world/scene_writer.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none);
}

/// Its own plant file; empty: it has none.
fs::path file_of(const DocumentPlant& one) {
  return is_plant_file(one.entry.file) ? one.entry.file : fs::path();
}

bool is_drawn(const DocumentPlant& one) {
  return one.file && !one.file->curves.empty();
}

/// Whether its file, of whatever kind, says the same.
bool is_as_read(const DocumentPlant& one) {
  const fs::path source = simulation::source_of(one.entry);
  if (source.empty() || !is_there(source)) return false;
  Diagnostics diagnostics;
  const auto there = read_plant(source, diagnostics, one.entry.unit);
  return there && *there == *one.file;
}

std::string names_of(const Document& document) {
  std::string names;
  for (const DocumentPlant& one : document.plants)
    if (is_drawn(one)) names += (names.empty() ? "" : ", ") + one.entry.name;
  return names;
}

/// The only plant that is drawn, else the only one of them without a file; empty: neither.
std::string meant_plant(const Document& document) {
  std::vector<std::string> drawn, without_file;
  for (const DocumentPlant& one : document.plants) {
    if (!is_drawn(one)) continue;
    drawn.push_back(one.entry.name);
    if (one.entry.file.empty()) without_file.push_back(one.entry.name);
  }
  if (drawn.size() == 1) return drawn.front();
  return without_file.size() == 1 ? without_file.front() : std::string();
}

/// Whether nothing but plants was put into a scene that was made up. Its ground may lie lower,
/// under a plant that lies.
bool is_bare(const Document& document) {
  world::Scene scene = *document.scene;
  if (scene.ground) scene.ground->height = 0.0;
  return world::scene_text_without_plants(scene, {}) ==
         world::scene_text_without_plants(*empty_document().scene, {});
}

/// The plant that is all that there is to be saved; null: there is more, or nothing.
const DocumentPlant* only_plant(const Document& document) {
  const auto drawn = [](const DocumentPlant& one) { return is_drawn(one); };
  if (is_scene(document.path) || !is_bare(document) ||
      std::ranges::count_if(document.plants, drawn) != 1)
    return nullptr;
  return &*std::ranges::find_if(document.plants, drawn);
}

bool is_empty(const Document& document) {
  const auto drawn = [](const DocumentPlant& one) { return is_drawn(one) || !one.file; };
  return document.path.empty() && std::ranges::none_of(document.plants, drawn) && is_bare(document);
}

/// Whether another plant, which says something else, comes from the same file.
bool is_shared(const Document& document, std::size_t index) {
  const DocumentPlant& one = document.plants[index];
  for (std::size_t p = 0; p < document.plants.size(); ++p)
    if (p != index && is_same_file(document.plants[p].entry.file, one.entry.file) &&
        document.plants[p].file && !(*document.plants[p].file == *one.file))
      return true;
  return false;
}

/// STEM.ENDING, or the first number with which it is free.
fs::path free_file(const fs::path& folder, const std::string& stem, const std::string& ending) {
  fs::path file = folder / (stem + ending);
  for (int i = 2; is_there(file); ++i) file = folder / (stem + "_" + std::to_string(i) + ending);
  return file;
}

/// What was done, for people.
struct Saved {
  std::vector<fs::path> written, kept;
  bool lost_comments = false;

  std::string text() const {
    if (written.empty() && kept.empty()) return "nothing to save";
    const std::string names = joined(written.empty() ? kept : written,
                                     [&](const fs::path& file) { return file.string(); });
    return (written.empty() ? "unchanged " : "saved ") + names +
           (lost_comments ? " (anew, the comments are in NAME~)" : "");
  }
};

Result refusal_to_overwrite(const fs::path& file, bool changed) {
  const std::string why =
      changed ? " was changed by another program since it was read, expected reload, or "
              : " is there already, expected a new name, or ";
  return {false, file.string() + why + "overwrite=1 to write over it", false, true};
}

/// The text of a plant for a file: what is `there` already, with what has changed.
std::string text_for(const fs::path& there, const plant::PlantFile& plant, Saved& saved) {
  if (there.empty() || !is_there(there)) return plant::plant_text(plant);
  bool keeps = true;
  const std::string text = changed_plant_text(io::read_file(there), plant, keeps);
  saved.lost_comments = saved.lost_comments || !keeps;
  return text;
}

std::string line(const Command& command) {
  return command.text() + "\n";
}

std::string set_line(const std::string& key, double value) {
  return line(Command("set", {{"key", key}, {"value", io::exact_number(value)}}));
}

std::string gravity_text(const Document& document) {
  const Vec3& g = document.scene->gravity;
  return io::exact_number(g.x()) + "," + io::exact_number(g.y()) + "," + io::exact_number(g.z());
}

/// Sets a key that the scene file has got since back to what it was; a comment where that is no
/// number. One of every plant (`detach.stretch`) is one of each.
std::string key_back(const Document& first, const std::string& key) {
  if (key == "dt") return set_line(key, first.scene->dt);
  if (key == "gravity") return line(Command("set", {{"key", key}, {"value", gravity_text(first)}}));
  std::string text;
  for (const SessionParameter& one : document_parameters(first, first))
    if (one.key == key || (one.key.starts_with("plants.") && one.key.ends_with("." + key)))
      text += set_line(one.key, one.value);
  return text.empty() ? "# " + key + " stays as the file says it now\n" : text;
}

/// From a scene as it was saved to what it was when it was opened.
std::string way_back(const Document& first, const Document& saved) {
  std::string text;
  for (const DocumentPlant& one : saved.plants)
    if (first.plant_index(one.entry.name) < 0)
      text += line(Command("delete plant", {{"plant", one.entry.name}}));
  if (!saved.waypoints.empty()) text += line(Command("clear waypoints", {}));
  text += state_commands(first);
  for (const DocumentPlant& one : first.plants)
    if (!one.file && saved.plant_index(one.entry.name) >= 0)
      text +=
          line(Command("move plant", {{"plant", one.entry.name}, {"to", one.entry.pose.position}}));
  for (const auto& [key, value] : saved.settings) text += key_back(first, key);
  return text;
}

/// A setting that was taken back would be again what the file says, which has it now.
std::string line_of_log(const std::string& one, const Document& first,
                        const std::optional<Document>& saved) {
  if (saved && is_scene(first.path))
    for (const auto& [key, value] : saved->settings)
      if (one == Command("unset", {{"key", key}}).text()) return key_back(first, key);
  return one + "\n";
}

}  // namespace

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

bool SessionFiles::needs_name() const {
  if (is_scene(document().path) || is_empty(document())) return false;
  const DocumentPlant* one = only_plant(document());
  return document().path.empty() || !one || file_of(*one).empty();
}

fs::path SessionFiles::suggested_name() const {
  std::error_code none;
  const fs::path folder = document().path.empty() ? fs::current_path(none)
                                                  : fs::absolute(document().path).parent_path();
  if (is_scene(document().path)) return fs::absolute(document().path);
  const DocumentPlant* one = only_plant(document());
  if (one && !document().path.empty())
    return file_of(*one).empty() ? free_file(folder, one->entry.name, ".plant.yaml")
                                 : fs::absolute(file_of(*one));
  const std::string stem = document().plants.empty() ? "scene" : document().plants[0].entry.name;
  return free_file(folder, stem, ".scene.yaml");
}

Result SessionFiles::save(const fs::path& path, const SaveWishes& wishes) {
  core_.editor.end_gesture();
  try {
    if (is_scene(path)) return save_scene(path, wishes.overwrite);
    if (!path.empty() && !is_plant_file(path))
      return {false, path.string() +
                         ", expected *.scene.yaml for the scene or *.plant.yaml for a plant (see "
                         "export for other files)"};
    if (!path.empty()) return save_plant(path, wishes);
    if (is_scene(document().path)) return save_scene(document().path, wishes.overwrite);
    if (is_empty(document())) return {true, "nothing to save"};
    const DocumentPlant* one = only_plant(document());
    if (!needs_name()) return save_plant(file_of(*one), wishes);
    return {false, one ? "plant \"" + one->entry.name + "\" has no file yet, expected a path"
                       : "the scene has no file yet, expected a path *.scene.yaml"};
  } catch (const UsageError& fault) {
    return {false, fault.what()};
  } catch (const InvalidFile& fault) {
    return {false, sentences(fault.all()), true};
  } catch (const io::WriteError& fault) {
    return {false, fault.what()};
  }
}

// Plants first: a scene file names files that are there.
Result SessionFiles::save_scene(const fs::path& path, bool overwrite) {
  const bool same = is_same_file(path, document().path);
  if (!same && is_there(path) && !overwrite) return refusal_to_overwrite(path, false);
  if (same && files_.has_changed(path) && !overwrite) {
    Diagnostics diagnostics;  // a faulty one says its fault
    if (!world::read_scene(path, diagnostics)) throw InvalidFile(diagnostics);
    return refusal_to_overwrite(path, true);
  }
  Saved saved;
  std::vector<std::pair<std::size_t, fs::path>> targets;
  for (std::size_t p = 0; p < document().plants.size(); ++p) {
    const DocumentPlant& one = document().plants[p];
    if (!is_drawn(one)) continue;
    if (is_as_read(one)) {
      if (same) saved.kept.push_back(one.entry.file);
      continue;
    }
    const bool own = same && !file_of(one).empty() && !is_shared(document(), p);
    if (own && files_.has_changed(file_of(one)) && !overwrite)
      return refusal_to_overwrite(file_of(one), true);
    targets.emplace_back(
        p, own ? file_of(one) : free_file(path.parent_path(), one.entry.name, ".plant.yaml"));
  }
  const fs::path before = document().path;
  Document changed = document();
  for (const auto& [p, file] : targets) {
    DocumentPlant& one = changed.plants[p];
    const std::string text = text_for(file_of(one), *one.file, saved);
    write_with_backup(file, text);
    files_.remember(file, text);
    saved.written.push_back(file);
    one.entry.file = file;
    one.entry.source = world::ScenePlant::Source::file;
    one.entry.unit = 0.0;
    one.entry.optional = false, one.entry.fallback.clear();
  }
  const bool has_text = is_scene(before) && is_there(before);
  changed.path = path;
  const std::string was = same && is_there(path) ? io::read_file(path) : std::string();
  const std::string text = has_text ? changed_scene_text(changed, io::read_file(before),
                                                         files_.known(before), before, path)
                                    : new_scene_text(changed, path);
  if (text != was) write_with_backup(path, text);
  (text == was ? saved.kept : saved.written).push_back(path);
  files_.remember(path, text);
  core_.editor.set_files(std::move(changed));
  saved_settings_ = document().settings;
  mark_saved(!saved.written.empty());
  return {true, saved.text()};
}

Result SessionFiles::save_plant(const fs::path& path, const SaveWishes& wishes) {
  const DocumentPlant* only = only_plant(document());
  const std::string name = wishes.plant.empty() ? meant_plant(document()) : wishes.plant;
  if (name.empty())
    return {false, names_of(document()).empty()
                       ? "no plant to save, expected one with a stem"
                       : "which plant, expected plant=NAME, one of: " + names_of(document())};
  Document changed = document();
  const plant::PlantFile& plant = changed.plant(name);
  const auto index = static_cast<std::size_t>(changed.plant_index(name));
  DocumentPlant& one = changed.plants[index];
  if (plant.curves.empty()) return {false, "plant \"" + name + "\" has no stem yet"};
  const bool own = is_same_file(path, file_of(one));
  if (!own && is_there(path) && !wishes.overwrite) return refusal_to_overwrite(path, false);
  if (own && files_.has_changed(path) && !wishes.overwrite) return refusal_to_overwrite(path, true);
  Saved saved;
  if (own && is_as_read(one)) {
    saved.kept.push_back(path);
  } else {
    const std::string text = text_for(file_of(one), plant, saved);
    write_with_backup(path, text);
    files_.remember(path, text);
    saved.written.push_back(path);
  }
  const bool alone = only == &document().plants[index];
  if (alone || file_of(one).empty()) {
    one.entry.file = path;
    one.entry.source = world::ScenePlant::Source::file;
    one.entry.unit = 0.0;
    one.entry.optional = false, one.entry.fallback.clear();
  }
  if (alone) changed.path = path;
  core_.editor.set_files(std::move(changed));
  if (!alone) return {true, saved.text() + ", the plant \"" + name + "\" alone"};
  mark_saved(!saved.written.empty());
  return {true, saved.text()};
}

// Scripts begin with what was opened: where that was written over, with commands that make it.
void SessionFiles::mark_saved(bool wrote) {
  saved_hash_ = core_.editor.hash();
  if (wrote) {
    const bool over_first = first_.path.empty() || is_same_file(document().path, first_.path);
    if (over_first)
      saved_ = document();
    else if (!saved_)
      saved_ = first_;
  }
  core_.autosave.begin(document());
}

std::string SessionFiles::script() const {
  const bool scene = is_scene(first_.path);
  std::string text;
  if (!first_.path.empty() && (scene || !saved_)) {
    const auto file = std::filesystem::absolute(first_.path).lexically_normal();
    std::map<std::string, Value> arguments;
    arguments.emplace("file", file.string());
    if (first_.unit > 0.0) arguments.emplace("unit", io::exact_number(first_.unit));
    text = line(Command("open", std::move(arguments)));
    if (saved_) text += way_back(first_, *saved_);
  } else {
    text = line(Command("new", {})) + state_commands(first_);
  }
  for (const std::string& one : core_.editor.log().lines())
    text += line_of_log(one, first_, saved_);
  return text;
}

}  // namespace pedicel::app
