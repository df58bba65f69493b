#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/editors/add_menu.h"
#include "app/panels/layout.h"
#include "app/report/manual.h"
#include "app/report/version.h"
#include "app/session/session_files.h"
#include "app/session/session_recovery.h"
#include "app/ui/file_list.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// A window in the middle with a title and a cross; closes by the cross or Esc.
bool begin_dialog(Ui& ui, const char* title, float width, float height) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(width * ui.scale, 0.94f * size.x),
                                  std::min(height * ui.scale, 0.92f * size.y)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(16 * ui.scale, 12 * ui.scale));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  const bool open = ImGui::Begin(
      title, nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(2);
  if (!open) return false;
  ImGui::PushFont(ui.bold);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  ImGui::PopFont();
  ImGui::SameLine(ImGui::GetContentRegionMax().x - 1.25f * ImGui::GetFrameHeight());
  if (icon_button("close", Icon::cross, "Close (Esc)")) ui.dialog = Dialog::none;
  ImGui::Separator();
  return true;
}

void keys_table(const char* group) {
  if (!ImGui::BeginTable(group, 2, ImGuiTableFlags_SizingFixedFit)) return;
  Action last = Action::none;
  for (const Binding& binding : bindings()) {
    if (std::string(binding.group) != group || binding.action == last) continue;
    last = binding.action;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(palette().accent, "%s", keys_of(binding.action).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(binding.sentence);
  }
  ImGui::EndTable();
}

void mouse_table(bool blender) {
  if (!ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingStretchProp)) return;
  for (const MouseHabit& habit : mouse_habits(blender)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::TextWrapped("%s", habit.gesture);
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", habit.sentence);
  }
  ImGui::EndTable();
}

void help_section(Ui& ui, const std::string& title) {
  heading(ui, title.c_str());
  if (title == "Mouse in the scene")
    mouse_table(ui.preferences.mouse == MousePreset::blender);
  else
    keys_table(title.c_str());
}

void manual_button(Ui& ui) {
  if (!ImGui::Button("Open the manual")) return;
  const std::filesystem::path page = manual_html("index");
  if (page.empty() || !open_in_browser(page))
    ui.say("No browser opens it here: \"pedicel manual\" prints it in a terminal");
}

void help(Ui& ui) {
  if (begin_dialog(ui, "Help", 1200, 640)) {
    constexpr std::array titles = {"Simulation", "File", "Edit",
                                   "Windows",    "View", "Mouse in the scene"};
    constexpr float column = 24.0f;  // letters that an explanation takes
    const float room = ImGui::GetContentRegionAvail().x / (column * ImGui::GetFontSize());
    const int columns = std::clamp(static_cast<int>(room), 1, 3);
    if (ImGui::BeginTable("columns", columns, ImGuiTableFlags_SizingStretchSame)) {
      const std::size_t each = titles.size() / static_cast<std::size_t>(columns);
      for (std::size_t i = 0; i < titles.size(); ++i) {
        if (i % each == 0) ImGui::TableNextColumn();
        help_section(ui, titles[i]);
      }
      ImGui::EndTable();
    }
    manual_button(ui);
  }
  ImGui::End();
}

void info(Ui& ui) {
  if (begin_dialog(ui, "About", 560, 420)) {
    row("Pedicel", version() + " (" + git_hash() + ")");
    row("OpenGL", ui.times.renderer.empty() ? "none" : ui.times.renderer);
    row("Platform", ui.times.platform);
    row("File", ui.session.files().path().empty() ? "none" : ui.session.files().path().string());
    if (ui.snapshot->assets) {
      const simulation::SceneAssets& assets = *ui.snapshot->assets;
      row("Time step", quantity_text(assets.scene.dt, "s"));
      row("Plants", std::to_string(ui.snapshot->plants.size()));
      int elements = 0, fruits = 0;
      for (const PlantSnapshot& plant : ui.snapshot->plants)
        elements += plant.model->size(), fruits += static_cast<int>(plant.model->fruits.size());
      row("Rods", std::to_string(elements));
      row("Fruits", std::to_string(fruits));
      heading(ui, "What the scene is for");
      ImGui::TextWrapped("%s", assets.scene.purpose.c_str());
      for (const std::string& text : assets.notes) note(text);
    }
  }
  ImGui::End();
}

void files(Ui& ui) {
  static FileList list;
  const bool exports = ui.dialog == Dialog::export_plant;
  const bool saves = ui.dialog == Dialog::save_as || exports;
  const bool imports = ui.dialog == Dialog::import_plant, robots = ui.dialog == Dialog::add_robot;
  const char* title = exports   ? "Export a plant"
                      : saves   ? "Save as"
                      : imports ? "Import a plant"
                      : robots  ? "Add a robot (URDF)"
                                : "Open";
  if (begin_dialog(ui, title, 640, 480)) {
    const auto chosen = list.draw(ui, saves, robots);
    if (chosen) {
      ui.dialog = Dialog::none;
      if (imports) {
        ui.import_plant(*chosen);
      } else if (robots) {
        add_robot(ui, *chosen);
      } else if (exports) {
        ui.export_to(*chosen);
      } else if (saves) {
        ui.dialog = Dialog::save_as;  // until it is saved
        ui.save_to(*chosen);
      } else {
        ui.open(*chosen);
      }
    }
  }
  ImGui::End();
}

void problem(Ui& ui) {
  if (begin_dialog(ui, "This file cannot be read", 640, 300)) {
    const float buttons = ImGui::GetFrameHeightWithSpacing();
    if (ImGui::BeginChild("text", ImVec2(0, -buttons))) {
      ImGui::PushStyleColor(ImGuiCol_Text, palette().error);
      ImGui::TextWrapped("%s", ui.problem.c_str());
      ImGui::PopStyleColor();
      note("What was open stays. Mend the file and read it again (" + keys_of(Action::reload) +
           ").");
    }
    ImGui::EndChild();
    if (ImGui::Button("Read it again")) ui.dialog = Dialog::none, ui.ask(Action::reload);
    ImGui::SameLine();
    if (ImGui::Button("Close")) ui.dialog = Dialog::none;
  }
  ImGui::End();
}

void recover(Ui& ui) {
  if (begin_dialog(ui, "Edits that were not saved", 560, 300)) {
    note("The program ended before these were saved.");
    const std::vector<LostDocument> all = ui.session.recovery().lost_documents();
    if (all.empty()) ui.dialog = Dialog::none;
    for (std::size_t i = 0; i < all.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      const std::string name =
          all[i].document.empty() ? "new scene" : all[i].document.filename().string();
      row(name.c_str(), std::to_string(all[i].commands) + " edits, " + all[i].when);
      const bool taken = ImGui::Button("Recover");
      if (taken) ui.session.recovery().recover(all[i]);
      ImGui::SameLine();
      if (ImGui::Button("Forget")) ui.session.recovery().forget(all[i]);
      ImGui::PopID();
      if (taken) {
        ui.dialog = Dialog::none;
        break;
      }
    }
  }
  ImGui::End();
}

void unsaved(Ui& ui) {
  if (begin_dialog(ui, "Edits that are not saved", 460, 125)) {
    const std::string name = ui.session.files().path().filename().string();
    note((name.empty() ? "The new scene" : name) + " was changed since it was saved.");
    ImGui::Spacing();
    if (ImGui::Button("Save")) ui.save();
    ImGui::SameLine();
    if (ImGui::Button("Do not save")) {
      ui.dialog = Dialog::none;
      ui.leave_now();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) ui.dialog = Dialog::none;
  }
  ImGui::End();
}

void overwrite(Ui& ui) {
  if (begin_dialog(ui, "Write over a file?", 520, 190)) {
    const std::string& text = ui.overwrite_text;
    const bool changed = text.find("another program") != std::string::npos;
    note(text.substr(0, text.find(", expected")) + ".");
    const bool exports = !ui.export_plant.empty();
    note(exports ? "What it says now is lost." : "What it says now stays beside it, as NAME~.");
    ImGui::Spacing();
    if (ImGui::Button("Write over it"))
      exports ? ui.export_to(ui.overwrite_path, true) : ui.save_to(ui.overwrite_path, true);
    ImGui::SameLine();
    if (changed) {
      if (ImGui::Button("Read it anew")) ui.dialog = Dialog::none, ui.ask(Action::reload);
    } else if (ImGui::Button("Another name")) {
      ui.dialog = exports ? Dialog::export_plant : Dialog::save_as;
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) ui.dialog = Dialog::none;
  }
  ImGui::End();
}

}  // namespace

void draw_dialogs(Ui& ui) {
  switch (ui.dialog) {
    case Dialog::none:
      ui.after_leaving = nullptr;  // the question was closed without an answer
      ui.export_plant.clear();
      return;
    case Dialog::overwrite:
      return overwrite(ui);
    case Dialog::open:
    case Dialog::save_as:
    case Dialog::import_plant:
    case Dialog::add_robot:
    case Dialog::export_plant:
      return files(ui);
    case Dialog::help:
      return help(ui);
    case Dialog::info:
      return info(ui);
    case Dialog::problem:
      return problem(ui);
    case Dialog::recover:
      return recover(ui);
    case Dialog::unsaved:
      return unsaved(ui);
  }
}

}  // namespace pedicel::app
