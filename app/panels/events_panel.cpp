#include <imgui.h>

#include <array>

#include "app/editors/stem_editor.h"
#include "app/panels/panel.h"
#include "app/ui/selection_follow.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// What broke, when and why; a click on a row goes there.
class EventsPanel : public Panel {
 public:
  std::string_view name() const override { return "Events"; }
  Dock dock() const override { return Dock::bottom; }

  void draw(Ui& ui) override {
    const auto events = ui.view.seen.events;  // those of a time that was gone back from, too
    if (!events || events->empty()) {
      note("Nothing has come off yet. Press Space, or pull a fruit with Ctrl and the mouse.");
      return;
    }
    constexpr std::array<const char*, 6> columns = {"time",   "organ", "cause",
                                                    "strain", "force", "moment"};
    if (!ImGui::BeginTable(
            "events", static_cast<int>(columns.size()),
            ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp))
      return;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* name : columns) ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    for (std::size_t i = events->size(); i-- > 0;) event_row(ui, (*events)[i], i);
    ImGui::EndTable();
  }

 private:
  static void event_row(Ui& ui, const world::Event& event, std::size_t index) {
    const std::array<std::string, 6> cells = {number_text(event.time, 5) + " s",
                                              event.organ,
                                              event.cause,
                                              number_text(event.stretch, 3),
                                              quantity_text(event.force, "N"),
                                              quantity_text(event.moment, "N m")};
    ImGui::TableNextRow();
    const bool later = event.time > ui.snapshot->time;
    if (later) ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    for (const std::string& cell : cells) {
      ImGui::TableNextColumn();
      if (&cell == &cells.front()) {
        ImGui::PushID(static_cast<int>(index));
        if (ImGui::Selectable("##row", false, ImGuiSelectableFlags_SpanAllColumns)) go(ui, event);
        tip("Goes to that time and chooses it");
        ImGui::PopID();
        ImGui::SameLine(0, 0);
      }
      elided(cell, rest_width());
    }
    if (later) ImGui::PopStyleColor();
  }

  static void go(Ui& ui, const world::Event& event) {
    ui.selection = select_organ(event.organ, *ui.snapshot);
    ui.run(Command("go to", {{"time", event.time}}));
  }
};

}  // namespace

std::unique_ptr<Panel> make_events_panel() {
  return std::make_unique<EventsPanel>();
}

}  // namespace pedicel::app
