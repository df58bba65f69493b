#include <imgui.h>

#include <array>
#include <cmath>

#include "app/panels/panel.h"
#include "app/panels/stem_editor.h"
#include "app/panels/theme.h"
#include "app/panels/ui.h"
#include "app/panels/widgets.h"

namespace pedicel::app {

namespace {

/// What there is: plants with their stems, fruits and leaves; below, the chosen one in numbers.
class PlantsPanel : public Panel {
 public:
  std::string_view name() const override { return "Plants"; }
  Dock dock() const override { return Dock::left; }

  void draw(Ui& ui) override {
    if (ImGui::Button("New plant")) new_plant(ui);
    tip("Adds a plant without stems, to draw");
    ImGui::SameLine();
    if (ImGui::Button("Import")) ui.dialog = Dialog::import_plant;
    tip("Adds the plant of a plant file, a skeleton table (CSV) or an MTG");
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
    }
    ImGui::EndChild();
    if (ui.selection && ImGui::BeginChild("details")) draw_details(ui);
    if (ui.selection) ImGui::EndChild();
  }

 private:
  static void new_plant(Ui& ui) {
    std::string name = "plant";
    for (int i = 2; ui.session.document().plant_index(name) >= 0; ++i)
      name = "plant_" + std::to_string(i);
    if (!ui.run(Command("new plant", {{"plant", name}}))) return;
    ui.draw.plant = name;
    ui.draw.on = true;
    ui.show_panel = "Draw";
  }

  void export_menu(Ui& ui) {
    if (!ImGui::BeginPopup("export")) return;
    const auto& plants = ui.session.document().plants;
    if (plants.empty()) ImGui::TextUnformatted("No plant to export");
    std::string name = ui.draw.plant;
    if (ui.session.document().plant_index(name) < 0 && !plants.empty())
      name = plants.front().entry.name;
    for (const char* ending : {".plant.yaml", ".csv", ".obj", ".ply"})
      if (!plants.empty() && ImGui::MenuItem((name + ending).c_str())) {
        const Result result = ui.session.export_plant(name, name + ending);
        ui.say(result.ok ? "written: " + std::filesystem::absolute(name + ending).string()
                         : result.text);
      }
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
        name.c_str(), ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_SpanFullWidth |
                          (ui.draw.plant == name ? ImGuiTreeNodeFlags_Framed : 0));
    if (ImGui::IsItemClicked()) ui.draw.plant = name;
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

  static void robot_node(Ui& ui) {
    if (!ui.snapshot->assets || !ui.snapshot->assets->robot) return;
    const auto& links = ui.snapshot->assets->robot->links;
    if (!ImGui::TreeNodeEx("robot", ImGuiTreeNodeFlags_SpanFullWidth)) return;
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
