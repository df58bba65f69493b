#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/editors/add_menu.h"
#include "app/editors/stem_editor.h"
#include "app/editors/thing_editor.h"
#include "app/editors/tie_editor.h"
#include "app/panels/panel.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// What there is: plants with their stems, fruits and leaves; below, the chosen one in numbers.
class PlantsPanel : public Panel {
 public:
  std::string_view name() const override { return "Plants"; }
  Dock dock() const override { return Dock::left; }

  void draw(Ui& ui) override {
    if (ImGui::Button("Add")) ImGui::OpenPopup("add");
    tip("Adds a robot, a body, a camera, a plant");
    if (ImGui::BeginPopup("add")) {
      draw_add_menu(ui);
      ImGui::EndPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Import")) ui.dialog = Dialog::import_plant;
    tip("Adds the plant of a plant file or a skeleton: CSV, MTG, PLY, XML of Helios");
    ImGui::SameLine();
    if (ImGui::Button("Export")) ImGui::OpenPopup("export");
    tip("Writes the chosen plant as plant file, skeleton table, OBJ or PLY");
    export_menu(ui);
    const float list_height =
        ui.selection ? 0.48f * ImGui::GetContentRegionAvail().y : ImGui::GetContentRegionAvail().y;
    if (ImGui::BeginChild("tree", ImVec2(0, list_height), true)) {
      for (const DocumentPlant& plant : ui.session.document().plants) plant_node(ui, plant);
      if (ui.session.document().plants.empty()) note("No plants yet. Press D and draw one.");
      robot_node(ui);
      scene_nodes(ui);
    }
    ImGui::EndChild();
    if (ui.selection && ImGui::BeginChild("details")) draw_details(ui);
    if (ui.selection) ImGui::EndChild();
  }

 private:
  void export_menu(Ui& ui) {
    if (!ImGui::BeginPopup("export")) return;
    const auto& plants = ui.session.document().plants;
    if (plants.empty()) ImGui::TextUnformatted("No plant to export");
    std::string name = ui.draw.plant;
    if (ui.session.document().plant_index(name) < 0 && !plants.empty())
      name = plants.front().entry.name;
    for (const char* ending : {".plant.yaml", ".csv", ".obj", ".ply"})
      if (!plants.empty() && ImGui::MenuItem((name + ending).c_str())) ui.ask_export(name, ending);
    ImGui::EndPopup();
  }

  static bool leaf(const std::string& text, bool chosen) {
    ImGui::TreeNodeEx(text.c_str(), ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                        ImGuiTreeNodeFlags_SpanFullWidth |
                                        (chosen ? ImGuiTreeNodeFlags_Selected : 0));
    return ImGui::IsItemClicked();
  }

  static void plant_node(Ui& ui, const DocumentPlant& plant) {
    const std::string& name = plant.entry.name;
    const bool open = ImGui::TreeNodeEx(
        name.c_str(),
        ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_SpanFullWidth |
            ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_OpenOnDoubleClick |
            (ui.selection.kind == Selection::Kind::plant && ui.selection.plant_name == name
                 ? ImGuiTreeNodeFlags_Selected
                 : 0) |
            (ui.draw.plant == name ? ImGuiTreeNodeFlags_Framed : 0));
    if (ImGui::IsItemClicked()) choose_plant(ui, name);
    tip("Strokes go to the plant that is framed");
    if (!open) return;
    if (plant.file) {
      for (const plant::PlantCurve& curve : plant.file->curves)
        if (leaf(curve.name, is_stem(ui, name, curve.name))) choose_curve(ui, name, curve.name);
      for (const plant::PlantFruit& fruit : plant.file->fruits)
        if (leaf(fruit.name + "  on " + fruit.place.curve, is_fruit(ui, name, fruit.name)))
          choose_fruit(ui, name, fruit.name);
      for (const plant::PlantLeaf& one : plant.file->leaves)
        if (leaf(one.name + "  on " + one.place.curve, is_leaf(ui, name, one.name)))
          choose_leaf(ui, name, one.name);
    } else {
      note("built in, cannot be edited");
    }
    ImGui::TreePop();
  }

  static bool is_stem(const Ui& ui, const std::string& plant, const std::string& stem) {
    if (ui.selection.kind == Selection::Kind::element)
      return describe(ui.selection, *ui.snapshot) == plant + "/" + stem;
    return ui.selection.plant_name == plant && ui.selection.curve == stem;
  }

  static bool is_fruit(const Ui& ui, const std::string& plant, const std::string& fruit) {
    return ui.selection.kind == Selection::Kind::fruit &&
           describe(ui.selection, *ui.snapshot) == plant + "/" + fruit;
  }

  static bool is_leaf(const Ui& ui, const std::string& plant, const std::string& leaf) {
    return ui.selection.kind == Selection::Kind::element &&
           describe(ui.selection, *ui.snapshot) == plant + "/" + leaf;
  }

  /// Bodies, ground, strings and cameras of the document.
  static void scene_nodes(Ui& ui) {
    const world::Scene& scene = *ui.session.document().scene;
    const auto is = [&](Selection::Kind kind, const std::string& name) {
      return ui.selection.kind == kind && describe(ui.selection, *ui.snapshot) == name;
    };
    for (const auto& body : scene.bodies)
      if (leaf(body.name, is(Selection::Kind::body, body.name))) choose_body(ui, body.name);
    if (scene.ground && leaf("ground", ui.selection.kind == Selection::Kind::ground))
      choose_ground(ui);
    for (int i = 0; i < static_cast<int>(scene.ties.size()); ++i)
      if (leaf(
              "tie_" + std::to_string(i + 1) + "  " + scene.ties[static_cast<std::size_t>(i)].organ,
              ui.selection.kind == Selection::Kind::tie && ui.selection.tie == i)) {
        choose_tie(ui, i);
        break;
      }
    for (const auto& camera : scene.cameras)
      if (leaf(camera.name + "  (camera)", is(Selection::Kind::camera, camera.name)))
        choose_camera(ui, camera.name);
  }

  static void robot_node(Ui& ui) {
    if (!ui.snapshot->assets || !ui.snapshot->assets->robot) return;
    const auto& links = ui.snapshot->assets->robot->links;
    const bool open =
        ImGui::TreeNodeEx(ui.snapshot->assets->scene.robot->name.c_str(),
                          ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_OpenOnArrow);
    if (ImGui::IsItemClicked() && !links.empty()) {
      ui.selection = {};
      ui.selection.kind = Selection::Kind::link;
      ui.selection.link = std::max(ui.snapshot->assets->robot->root, 0);
    }
    if (!open) return;
    for (std::size_t l = 0; l < links.size(); ++l) {
      const bool chosen =
          ui.selection.kind == Selection::Kind::link && ui.selection.link == static_cast<int>(l);
      if (!leaf(links[l].name, chosen)) continue;
      ui.selection = {};
      ui.selection.kind = Selection::Kind::link;
      ui.selection.link = static_cast<int>(l);
    }
    ImGui::TreePop();
  }
};

}  // namespace

std::unique_ptr<Panel> make_plants_panel() {
  return std::make_unique<PlantsPanel>();
}

}  // namespace pedicel::app
