#include "app/ui/ui.h"

#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/commands/measured_commands.h"
#include "app/session/document/scene_references.h"
#include "app/session/session_files.h"
#include "engine/core/check.h"
#include "engine/io/asset_folder.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

bool Ui::run(const Command& command) {
  return report(session.run(command));
}

bool Ui::report(const Result& result) {
  if (!result.ok) say(result.text), session.messages().tell(result.text);
  return result.ok;
}

void Ui::leave_document(std::function<void()> next) {
  if (!session.files().dirty()) return next();
  after_leaving = std::move(next);
  dialog = Dialog::unsaved;
}

std::filesystem::path Ui::output_stem() const {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path open = session.files().path();
  if (open.empty()) return fs::current_path(none) / "pedicel";
  std::string name = open.filename().string();
  for (const char* ending : {".yaml", ".scene", ".plant", ".csv", ".mtg"})
    if (name.ends_with(ending)) name.resize(name.size() - std::string(ending).size());
  const fs::path folder = fs::weakly_canonical(fs::absolute(open), none).parent_path();
  const fs::path shipped = fs::weakly_canonical(io::asset_folder(), none);
  const std::string from_shipped = fs::relative(folder, shipped, none).string();
  const bool is_shipped = !from_shipped.empty() && !from_shipped.starts_with("..");
  return (is_shipped ? fs::current_path(none) : folder) / (name.empty() ? "pedicel" : name);
}

void Ui::leave_now() {
  const auto next = std::move(after_leaving);
  after_leaving = nullptr;
  if (next) next();
}

void Ui::save() {
  if (session.files().needs_name())
    dialog = Dialog::save_as;
  else
    save_to({});
}

void Ui::save_to(const std::filesystem::path& path, bool overwrite) {
  SaveWishes wishes;
  wishes.overwrite = overwrite;
  if (!path.empty() && !is_scene(path)) wishes.plant = chosen_plant();
  const Result saved = session.files().save(path, wishes);
  say(saved.text);
  if (saved.overwrites) {
    overwrite_path = path;
    overwrite_text = saved.text;
    dialog = Dialog::overwrite;
  } else if (saved.ok) {
    dialog = Dialog::none;
    if (!session.files().dirty()) leave_now();
  }
}

void Ui::ask_export(const std::string& plant, const std::string& ending) {
  export_plant = plant, export_ending = ending;
  export_path = output_stem().parent_path() / (plant + ending);
  dialog = Dialog::export_plant;
}

void Ui::export_to(const std::filesystem::path& path, bool overwrite) {
  std::error_code none;
  export_path = path;
  if (!overwrite && std::filesystem::exists(path, none)) {
    overwrite_path = path;
    overwrite_text = path.string() + " is there already";
    dialog = Dialog::overwrite;
    return;
  }
  dialog = Dialog::none;
  const Result result =
      session.run(Command("export", {{"plant", export_plant}, {"file", path.string()}}));
  export_plant.clear();
  if (report(result)) say(result.text);
}

bool Ui::remove(const Command& command) {
  Document without = session.document();
  const std::vector<std::string> broken_before = broken_references(without);
  std::vector<Command> before;
  std::string with;
  const auto clear = [&](const std::string& name) {
    const std::string by = references_to(without, name);
    if (by.empty()) return;
    with += (with.empty() ? "" : ", ") + by;
    before.push_back(Command("clear references", {{"name", name}}));
    clear_references(without, name);
  };
  for (const char* thing : {"plant", "body"})
    if (command.verb() == std::string("delete ") + thing) clear(command.word(thing));
  if (command.verb() == "delete robot") clear("robot");
  try {
    apply_command(without, command);
  } catch (const UsageError&) {
    return run(command);  // says why
  }
  for (const std::string& name : broken_references(without))
    if (std::ranges::find(broken_before, name) == broken_before.end()) clear(name);
  session.begin_gesture();
  bool done = true;
  for (const Command& one : before) done = done && run(one);
  done = done && run(command);
  session.end_gesture();
  if (done && !with.empty())
    say("with it went " + with + ": " + keys_of(Action::undo) + " brings all back");
  return done;
}

std::string Ui::chosen_plant() const {
  const auto there = [&](const std::string& name) {
    return session.document().plant_index(name) >= 0;
  };
  if (there(selection.plant_name)) return selection.plant_name;
  const std::string organ = describe(selection, *snapshot);
  if (const std::string name = organ.substr(0, organ.find('/')); there(name)) return name;
  return there(draw.plant) ? draw.plant : std::string();
}

void Ui::open(const std::filesystem::path& path) {
  if (is_experiment(path))
    session.files().open(path);
  else
    leave_document([this, path] { session.files().open(path); });
}

void Ui::import_plant(const std::filesystem::path& path) {
  // Not by the session's call: a command that is refused is an answer.
  if (run(Command("import", {{"file", path.string()}})))
    frame_plant = session.document().plants.back().entry.name;
}

std::string describe(const Selection& s, const Snapshot& snapshot) {
  using Kind = Selection::Kind;
  const auto plant = [&]() -> const cosserat::RodModel* {
    const bool known = s.plant >= 0 && s.plant < static_cast<int>(snapshot.plants.size());
    return known ? snapshot.plants[static_cast<std::size_t>(s.plant)].model.get() : nullptr;
  };
  switch (s.kind) {
    case Kind::none:
      return "nothing";
    case Kind::element:
      if (const auto* model = plant(); model && s.element < model->size())
        return model->organs[static_cast<std::size_t>(
            model->elements[static_cast<std::size_t>(s.element)].organ)];
      return "a stem";
    case Kind::fruit:
      if (const auto* model = plant(); model && s.fruit < static_cast<int>(model->fruits.size()))
        return simulation::fruit_name(*model, s.fruit);
      return "a fruit";
    case Kind::link:
      if (snapshot.assets && snapshot.assets->robot &&
          s.link < static_cast<int>(snapshot.assets->robot->links.size()))
        return snapshot.assets->robot->links[static_cast<std::size_t>(s.link)].name;
      return "a link";
    case Kind::plant:
      return s.plant_name;
    case Kind::camera:
      return s.thing;
    case Kind::tie:
      return "tie_" + std::to_string(s.tie + 1);
    case Kind::ground:
      return "ground";
    case Kind::body:
      if (!s.thing.empty()) return s.thing;
      if (s.body < static_cast<int>(snapshot.bodies.size()))
        return snapshot.bodies[static_cast<std::size_t>(s.body)].info->description.name;
      return "a body";
    case Kind::curve:
      return s.plant_name + "/" + s.curve;
    case Kind::curve_point:
      return s.plant_name + "/" + s.curve + ", point " + std::to_string(s.point);
  }
  return "";
}

}  // namespace pedicel::app
