#include <imgui.h>

#include <array>

#include "app/panels/panel.h"
#include "app/panels/stem_editor.h"
#include "app/panels/theme.h"
#include "app/panels/ui.h"
#include "app/panels/widgets.h"

namespace pedicel::app {

namespace {

/// What broke, when and why.
class EventsPanel : public Panel {
 public:
  std::string_view name() const override { return "Events"; }
  Dock dock() const override { return Dock::bottom; }

  void draw(Ui& ui) override {
    const auto& events = ui.snapshot->events;
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
    for (std::size_t i = events->size(); i-- > 0;) event_row((*events)[i]);
    ImGui::EndTable();
  }

 private:
  static void event_row(const world::Event& event) {
    const std::array<std::string, 6> cells = {number_text(event.time, 5) + " s",
                                              event.organ,
                                              event.cause,
                                              number_text(event.stretch, 3),
                                              quantity_text(event.force, "N"),
                                              quantity_text(event.moment, "N m")};
    ImGui::TableNextRow();
    for (const std::string& cell : cells) {
      ImGui::TableNextColumn();
      elided(cell, rest_width());
    }
  }
};

}  // namespace

std::unique_ptr<Panel> make_events_panel() {
  return std::make_unique<EventsPanel>();
}

}  // namespace pedicel::app
