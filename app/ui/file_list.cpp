#include "app/ui/file_list.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/session/session_files.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"
#include "engine/robot/read/read_robot.h"

namespace pedicel::app {

namespace fs = std::filesystem;

namespace {

bool can_be_opened(const fs::path& path, bool robots) {
  const std::string name = path.filename().string();
  const auto ends = [&name](const char* with) { return name.ends_with(with); };
  if (robots) return robot::is_robot_name(path);
  return ends(".scene.yaml") || ends(".plant.yaml") || ends(".csv") || ends(".mtg") ||
         ends(".ply") || ends(".xml") || name == "experiment.yaml";
}

std::string what_is_saved(const Ui& ui) {
  if (!ui.export_plant.empty())
    return "The plant \"" + ui.export_plant +
           "\": *.plant.yaml, *.csv (skeleton), *.obj or *.ply (surface).";
  const std::string plant = ui.chosen_plant();
  return "NAME.scene.yaml: the scene with everything. NAME.plant.yaml: " +
         (plant.empty() ? std::string("a plant") : "the plant \"" + plant + "\"") + " alone.";
}

}  // namespace

void FileList::read() {
  entries_.clear();
  problem_.clear();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    std::error_code ignored;
    const bool is_folder = entry.is_directory(ignored);
    if (entry.path().filename().string().starts_with('.')) continue;
    if (is_folder || can_be_opened(entry.path(), robots_))
      entries_.push_back({entry.path(), is_folder});
  }
  if (error) problem_ = folder_.string() + ": " + error.message();
  std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
    return std::pair(!a.is_folder, a.path) < std::pair(!b.is_folder, b.path);
  });
}

std::optional<fs::path> FileList::draw(Ui& ui, bool saves, bool robots) {
  robots_ = robots;
  if (folder_.empty() || ImGui::IsWindowAppearing()) {
    const fs::path open = ui.session.files().path();
    std::error_code ignored;
    folder_ = fs::absolute(open.empty() ? fs::path(".") : open, ignored);
    folder_ = open.empty() ? fs::current_path(ignored) : folder_.parent_path();
    const bool exports = !ui.export_plant.empty();
    if (exports) folder_ = ui.export_path.parent_path();
    const fs::path suggested = exports ? ui.export_path : ui.session.files().suggested_name();
    typed_ = saves ? suggested.string() : "";
    read();
  }
  std::optional<fs::path> chosen;
  const char* verb = saves ? "Save" : robots ? "Add" : "Open";
  const float button = ImGui::CalcTextSize(verb).x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(rest_width(button + ImGui::GetStyle().ItemSpacing.x));
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  bool taken = ImGui::InputTextWithHint("##path", "a path, or choose below", &typed_,
                                        ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  taken = ImGui::Button(verb) || taken;
  if (taken && !typed_.empty()) {
    fs::path path(typed_);
    if (path.is_relative()) path = folder_ / path;
    std::error_code ignored;
    const bool is_folder = fs::is_directory(path, ignored);
    if (saves && !is_folder && !path.has_extension())
      path += !ui.export_plant.empty() ? ui.export_ending
              : ui.session.files().suggested_name().string().ends_with(".plant.yaml")
                  ? ".plant.yaml"
                  : ".scene.yaml";
    problem_.clear();
    if (is_folder)
      folder_ = path, typed_.clear(), read();
    else if (saves || fs::exists(path, ignored))
      chosen = path;
    else
      problem_ = path.string() + ": no such file";
  }
  if (saves) note(what_is_saved(ui));
  note(folder_.string());
  if (!problem_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().error);
    ImGui::TextWrapped("%s", problem_.c_str());
    ImGui::PopStyleColor();
  }
  if (ImGui::BeginChild("files", ImVec2(0, 0), true)) {
    if (folder_.has_parent_path() && folder_ != folder_.root_path() &&
        ImGui::Selectable(".. (up)")) {
      folder_ = folder_.parent_path();
      read();
    }
    std::optional<Entry> clicked;
    for (const Entry& entry : entries_) {
      const std::string name = entry.path.filename().string() + (entry.is_folder ? "/" : "");
      if (ImGui::Selectable(name.c_str())) clicked = entry;
    }
    if (clicked && clicked->is_folder)
      folder_ = clicked->path, read();
    else if (clicked && saves)
      typed_ = clicked->path.string();
    else if (clicked)
      chosen = clicked->path;
  }
  ImGui::EndChild();
  return chosen;
}

}  // namespace pedicel::app
