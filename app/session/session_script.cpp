#include "pedicel/app/session/document/document_parameters.h"
#include "pedicel/app/session/journal.h"
#include "pedicel/app/session/session_core.h"
#include "pedicel/app/session/session_files.h"
#include "pedicel/io/csv.h"

/// What was done since the document was opened, as a script.
namespace pedicel::app {

namespace {

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
