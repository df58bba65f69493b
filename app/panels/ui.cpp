#include "app/panels/ui.h"

#include "app/plant_step.h"
#include "session/measured_commands.h"

namespace pedicel::app {

bool Ui::run(const Command& command) {
  return report(session.run(command));
}

bool Ui::report(const Result& result) {
  if (!result.ok) say(result.text);
  return result.ok;
}

void Ui::leave_document(std::function<void()> next) {
  if (!session.dirty()) return next();
  after_leaving = std::move(next);
  dialog = Dialog::unsaved;
}

void Ui::open(const std::filesystem::path& path) {
  if (is_experiment(path))
    session.open(path);
  else
    leave_document([this, path] { session.open(path); });
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
        return fruit_name(*model, s.fruit);
      return "a fruit";
    case Kind::link:
      if (snapshot.assets && snapshot.assets->robot &&
          s.link < static_cast<int>(snapshot.assets->robot->links.size()))
        return snapshot.assets->robot->links[static_cast<std::size_t>(s.link)].name;
      return "a link";
    case Kind::body:
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
