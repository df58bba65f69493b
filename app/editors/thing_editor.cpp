#include "app/editors/thing_editor.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/editors/tie_editor.h"
#include "app/session/commands/scene_things.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "engine/world/scene_writer.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

constexpr double degree = std::numbers::pi / 180.0;  // rad

/// rad, about the world's X, then Y, then Z.
Vec3 angles_of(const Quat& turn) {
  const Mat3 r = turn.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  if (std::abs(r(2, 0)) > 1.0 - 1e-9)  // any sum of the other two is the same
    return {0.0, pitch, std::atan2(-r(0, 1), r(1, 1))};
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

/// Place and turn of a thing by the commands `move WORD` and `turn WORD`. An angle that is typed
/// leaves the other two.
void pose_numbers(Ui& ui, const char* word, const std::string& name, const Pose& pose) {
  const auto run = [&](const char* verb, Value to) {
    std::map<std::string, Value> arguments{{"to", std::move(to)}};
    if (!name.empty()) arguments.emplace(word, name);
    ui.run(Command(std::string(verb) + " " + word, std::move(arguments)));
  };
  Vec3 place = 1e3 * pose.position;
  if (three_numbers(ui, "Place x, y, z, mm", place)) run("move", Vec3(place / 1e3));
  Vec3 turn = angles_of(pose.rotation) / degree;
  for (double& angle : turn) angle = std::round(1e9 * angle) / 1e9 + 0.0;
  if (three_numbers(ui, "Turn about x, y, z, degrees", turn)) {
    turn *= degree;
    run("turn", std::vector<double>{turn.x(), turn.y(), turn.z()});
  }
}

/// A new name, once it was typed.
bool name_field(Ui& ui, const char* word, const std::string& name, std::string& to) {
  to = name;
  ImGui::TextColored(palette().dim, "Name");
  ImGui::SameLine(0.42f * ImGui::GetContentRegionMax().x);
  ImGui::SetNextItemWidth(rest_width());
  if (!text_field("##name", to) || to == name) return false;
  std::map<std::string, Value> arguments{{"to", to}};
  if (std::string(word) != "robot") arguments.emplace(word, name);
  return ui.run(Command(std::string("rename ") + word, std::move(arguments)));
}

void copy_and_delete(Ui& ui) {
  if (wide_button("Duplicate")) ui.ask(Action::duplicate);
  tip("(" + keys_of(Action::duplicate) + ")");
  if (wide_button("Delete")) ui.ask(Action::remove);
  tip("(" + keys_of(Action::remove) + ")");
}

void plant_details(Ui& ui, const DocumentPlant& plant) {
  const std::string name = plant.entry.name;
  std::string to;
  if (name_field(ui, "plant", name, to)) return choose_plant(ui, to);
  pose_numbers(ui, "plant", name, plant.entry.pose);
  row("File", plant.entry.file.empty() ? "none yet" : plant.entry.file.filename().string());
  tip(plant.entry.file.string());
  copy_and_delete(ui);
}

void extents(Ui& ui, const world::BodyDescription& body) {
  const auto number = [&](const char* label, const char* key, const char* unit, double value,
                          double factor) {
    double shown = factor * value;
    if (labelled_number(ui, label, unit, shown))
      ui.run(Command("set body", {{"body", body.name}, {"key", key}, {"value", shown / factor}}));
  };
  Vec3 size;
  double wall = 0.0;
  const world::BodyPart& part = body.parts.front();
  const bool tray = world::is_tray(body, size, wall);
  if (!tray) size = 2.0 * part.half_extents;
  if (tray || part.kind == world::BodyPart::Kind::box) {
    number("Size x", "size_x", "mm", size.x(), 1e3);
    number("Size y", "size_y", "mm", size.y(), 1e3);
    number("Size z", "size_z", "mm", size.z(), 1e3);
    if (tray) number("Wall", "wall", "mm", wall, 1e3);
  } else {
    number("Radius", "radius", "mm", part.radius, 1e3);
    if (part.kind != world::BodyPart::Kind::sphere)
      number("Length", "length", "mm", part.length, 1e3);
  }
  number("Mass", "mass", "kg", body.mass, 1.0);
  tip("0: it does not move");
  number("Friction", "friction", "", body.friction, 1.0);
}

void body_details(Ui& ui, const world::BodyDescription& body) {
  std::string to;
  if (name_field(ui, "body", body.name, to)) return choose_body(ui, to);
  pose_numbers(ui, "body", body.name, body.pose);
  extents(ui, body);
  ImGui::SetNextItemWidth(rest_width());
  if (ImGui::BeginCombo("##look", ("Look: " + body.look).c_str())) {
    for (const std::string& look : world::body_looks())
      if (ImGui::Selectable(look.c_str(), look == body.look))
        ui.run(Command("set look", {{"body", body.name}, {"look", look}}));
    ImGui::EndCombo();
  }
  copy_and_delete(ui);
}

void camera_details(Ui& ui, const world::SceneCamera& camera) {
  std::string to;
  if (name_field(ui, "camera", camera.name, to)) return choose_camera(ui, to);
  const auto move = [&](const Vec3& eye, const Vec3& target, double fov) {
    ui.run(Command("move camera",
                   {{"camera", camera.name}, {"eye", eye}, {"target", target}, {"fov", fov}}));
  };
  Vec3 eye = 1e3 * camera.eye, target = 1e3 * camera.target;
  if (three_numbers(ui, "Place x, y, z, mm", eye))
    move(eye / 1e3, camera.target, camera.field_of_view);
  if (three_numbers(ui, "Looks at x, y, z, mm", target))
    move(camera.eye, target / 1e3, camera.field_of_view);
  double fov = camera.field_of_view / degree;
  if (labelled_number(ui, "Field of view", "deg", fov))
    move(camera.eye, camera.target, degree * fov);
  if (wide_button("Put it where I look from")) move(ui.view_eye, ui.view_target, ui.view_fov);
  copy_and_delete(ui);
}

void ground_details(Ui& ui, const world::GroundPlane& ground) {
  double height = 1e3 * ground.height, friction = ground.friction;
  double restitution = ground.restitution;
  if (labelled_number(ui, "Height", "mm", height))
    ui.run(Command("set ground", {{"height", height / 1e3}}));
  if (labelled_number(ui, "Friction", "", friction))
    ui.run(Command("set ground", {{"friction", friction}}));
  if (labelled_number(ui, "Restitution", "", restitution))
    ui.run(Command("set ground", {{"restitution", restitution}}));
  if (wide_button("Delete")) ui.ask(Action::remove);
}

void robot_details(Ui& ui, const world::SceneRobot& robot) {
  heading(ui, "Robot");
  std::string to;
  if (name_field(ui, "robot", robot.name, to)) return;
  pose_numbers(ui, "robot", "", robot.base);
  const bool has_program = !robot.waypoints.empty() || !robot.trajectory.empty();
  if (has_program && wide_button("Clear its program")) ui.run(Command("clear program", {}));
  if (has_program) tip("Takes the waypoints of the scene away; then plants can be changed freely");
  if (wide_button("Delete the robot")) ui.ask(Action::remove);
}

const world::BodyDescription* chosen_body(const Ui& ui) {
  if (ui.selection.kind != Kind::body) return nullptr;
  const std::string name = describe(ui.selection, *ui.snapshot);
  for (const auto& body : ui.session.document().scene->bodies)
    if (body.name == name) return &body;
  return nullptr;
}

const world::SceneCamera* chosen_camera(const Ui& ui) {
  if (ui.selection.kind != Kind::camera) return nullptr;
  for (const auto& camera : ui.session.document().scene->cameras)
    if (camera.name == ui.selection.thing) return &camera;
  return nullptr;
}

/// 20 cm and a little beside it, along X.
Vec3 beside(const Pose& pose) {
  return pose.position + Vec3(0.2, 0.0, 0.0);
}

}  // namespace

void choose_plant(Ui& ui, const std::string& name) {
  ui.selection = {};
  ui.selection.kind = Kind::plant;
  ui.selection.plant_name = ui.draw.plant = name;
}

void choose_body(Ui& ui, const std::string& name) {
  ui.selection = {};
  ui.selection.kind = Kind::body;
  ui.selection.thing = name;
  for (std::size_t b = 0; b < ui.snapshot->bodies.size(); ++b)
    if (ui.snapshot->bodies[b].info->description.name == name)
      ui.selection.body = static_cast<int>(b);
}

void choose_camera(Ui& ui, const std::string& name) {
  ui.selection = {};
  ui.selection.kind = Kind::camera;
  ui.selection.thing = name;
}

void choose_ground(Ui& ui) {
  ui.selection = {};
  ui.selection.kind = Kind::ground;
}

void duplicate_thing(Ui& ui) {
  const Document& document = ui.session.document();
  if (const world::BodyDescription* body = chosen_body(ui)) {
    const std::string name = free_name(document, ThingKind::body, body->name);
    if (ui.run(Command("copy body",
                       {{"body", body->name}, {"as", name}, {"position", beside(body->pose)}})))
      choose_body(ui, name);
  } else if (const world::SceneCamera* camera = chosen_camera(ui)) {
    const std::string name = free_name(document, ThingKind::camera, camera->name);
    if (ui.run(Command("copy camera", {{"camera", camera->name}, {"as", name}})))
      choose_camera(ui, name);
  } else if (const int index = document.plant_index(ui.chosen_plant());
             index >= 0 && ui.selection) {
    const DocumentPlant plant = document.plants[static_cast<std::size_t>(index)];
    const std::string name = free_name(document, ThingKind::plant, plant.entry.name);
    if (ui.run(Command(
            "copy plant",
            {{"plant", plant.entry.name}, {"as", name}, {"position", beside(plant.entry.pose)}})))
      choose_plant(ui, name);
  } else {
    ui.say("nothing is chosen to be duplicated: choose a plant, a body or a camera");
  }
}

bool remove_thing(Ui& ui) {
  const Kind kind = ui.selection.kind;
  bool done = false;
  if (kind == Kind::plant) {
    done = ui.remove(Command("delete plant", {{"plant", ui.selection.plant_name}}));
  } else if (const world::BodyDescription* body = chosen_body(ui)) {
    done = ui.remove(Command("delete body", {{"body", body->name}}));
  } else if (const world::SceneCamera* camera = chosen_camera(ui)) {
    done = ui.remove(Command("delete camera", {{"camera", camera->name}}));
  } else if (kind == Kind::tie) {
    done = chosen_tie(ui) && ui.run(Command("delete tie", {{"tie", ui.selection.tie + 1}}));
  } else if (kind == Kind::ground) {
    done = ui.remove(Command("delete ground", {}));
  } else if (kind == Kind::link) {
    done = ui.remove(Command("delete robot", {}));
  } else {
    return false;
  }
  if (done) ui.selection = {};
  return true;
}

// Commands replace the document: what is drawn from is copied.
bool draw_thing(Ui& ui) {
  const Document& document = ui.session.document();
  if (ui.selection.kind == Kind::tie) {
    draw_tie(ui);
  } else if (ui.selection.kind == Kind::plant) {
    const int index = document.plant_index(ui.selection.plant_name);
    if (index < 0) return true;
    const DocumentPlant plant = document.plants[static_cast<std::size_t>(index)];
    plant_details(ui, plant);
  } else if (const world::BodyDescription* found = chosen_body(ui)) {
    const world::BodyDescription body = *found;
    if (!ui.selection.thing.empty())
      choose_body(ui, body.name);  // it may stand elsewhere in the list
    body_details(ui, body);
  } else if (const world::SceneCamera* seen = chosen_camera(ui)) {
    const world::SceneCamera camera = *seen;
    camera_details(ui, camera);
  } else if (ui.selection.kind == Kind::ground && document.scene->ground) {
    const world::GroundPlane ground = *document.scene->ground;
    ground_details(ui, ground);
  } else if (ui.selection.kind == Kind::link && document.scene->robot) {
    const world::SceneRobot robot = *document.scene->robot;
    robot_details(ui, robot);
  } else {
    return ui.selection.kind == Kind::body || ui.selection.kind == Kind::camera;
  }
  return true;
}

}  // namespace pedicel::app
