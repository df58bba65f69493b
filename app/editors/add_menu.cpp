#include "app/editors/add_menu.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "app/editors/thing_editor.h"
#include "app/session/commands/scene_things.h"
#include "app/session/robot_placing.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;

double ground_of(const Ui& ui) {
  const auto& ground = ui.session.document().scene->ground;
  return ground ? ground->height : 0.0;
}

/// Whether something else of the scene stands there.
bool is_taken(const Ui& ui, const Vec3& place) {
  constexpr double apart = 0.15;  // m
  const Document& document = ui.session.document();
  const auto near = [&](const Vec3& other) { return (other - place).head<2>().norm() < apart; };
  const auto& robot = document.scene->robot;
  return std::ranges::any_of(document.scene->bodies,
                             [&](const auto& body) { return near(body.pose.position); }) ||
         std::ranges::any_of(document.plants,
                             [&](const auto& plant) { return near(plant.entry.pose.position); }) ||
         (robot && near(robot->base.position));
}

/// On the ground under what is looked at, or beside it to the right where something stands there.
Vec3 place_for(const Ui& ui, double half_height) {
  Vec3 place = (1e3 * ui.view_target).array().round() / 1e3;
  place.z() = ground_of(ui) + half_height;
  Vec3 right = (ui.view_target - ui.view_eye).cross(Vec3::UnitZ());
  right = right.norm() > 1e-6 ? Vec3(right.normalized()) : Vec3(Vec3::UnitX());
  for (int i = 0; i < 40 && is_taken(ui, place); ++i)
    place = (1e3 * (place + 0.05 * right)).array().round() / 1e3;
  return place;
}

void add_body(Ui& ui, const char* shape, std::map<std::string, Value> arguments, double height) {
  const std::string name = free_name(ui.session.document(), ThingKind::body, shape);
  arguments.emplace("body", name);
  arguments.emplace("position", place_for(ui, height));
  if (ui.run(Command(std::string("add ") + shape, std::move(arguments)))) choose_body(ui, name);
}

void body_items(Ui& ui) {
  if (ImGui::MenuItem("Box")) add_body(ui, "box", {{"size", Vec3(0.1, 0.1, 0.1)}}, 0.05);
  if (ImGui::MenuItem("Sphere")) add_body(ui, "sphere", {{"radius", 0.05}}, 0.05);
  if (ImGui::MenuItem("Cylinder"))
    add_body(ui, "cylinder", {{"radius", 0.05}, {"length", 0.2}}, 0.1);
  if (ImGui::MenuItem("Capsule"))
    add_body(ui, "capsule", {{"radius", 0.03}, {"length", 0.14}}, 0.1);
  if (ImGui::MenuItem("Tray"))
    add_body(ui, "tray", {{"size", Vec3(0.24, 0.2, 0.06)}, {"wall", 0.006}}, 0.0);
}

void add_camera(Ui& ui) {
  const std::string name = free_name(ui.session.document(), ThingKind::camera, "camera");
  if (ui.run(Command("add camera", {{"camera", name},
                                    {"eye", ui.view_eye},
                                    {"target", ui.view_target},
                                    {"fov", ui.view_fov}})))
    choose_camera(ui, name);
}

void new_plant(Ui& ui) {
  const std::string name = free_name(ui.session.document(), ThingKind::plant, "plant");
  if (!ui.run(Command("new plant", {{"plant", name}}))) return;
  ui.draw.plant = name;
  ui.draw.on = true;
  ui.show_panel = "Draw";
}

void robot_items(Ui& ui) {
  const bool there = ui.session.document().scene->robot.has_value();
  if (there) {
    ImGui::MenuItem("Robot (there is one)", nullptr, false, false);
    return;
  }
  for (const fs::path& file : shipped_robots())
    if (ImGui::MenuItem(("Robot " + file.stem().string()).c_str())) add_robot(ui, file);
  if (ImGui::MenuItem("Robot from a URDF ...")) ui.dialog = Dialog::add_robot;
}

}  // namespace

void draw_add_menu(Ui& ui) {
  if (ImGui::MenuItem("Plant to draw")) new_plant(ui);
  if (ImGui::MenuItem("Plant from a file ...")) ui.dialog = Dialog::import_plant;
  ImGui::Separator();
  robot_items(ui);
  ImGui::Separator();
  body_items(ui);
  if (!ui.session.document().scene->ground && ImGui::MenuItem("Ground"))
    ui.run(Command("set ground", {{"height", 0.0}}));
  if (ImGui::MenuItem("Camera as it is seen now")) add_camera(ui);
}

void add_robot(Ui& ui, const fs::path& file) {
  const Result result = ui.session.run(Command("add robot", {{"file", file.string()}}));
  if (result.bad_file) {
    ui.problem = result.text;
    ui.dialog = Dialog::problem;
  } else if (ui.report(result)) {
    ui.show_panel = "Robot";
    ui.frame_robot = true;
  }
}

}  // namespace pedicel::app
