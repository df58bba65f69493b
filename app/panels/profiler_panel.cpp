#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "app/panels/panel.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

std::string ms(double seconds) {
  return quantity_text(seconds, "s", 3);
}

/// Where the time goes: of a step, and of a picture.
class ProfilerPanel : public Panel {
 public:
  std::string_view name() const override { return "Profiler"; }
  Dock dock() const override { return Dock::bottom; }

  void idle(Ui& ui) override { follow(*ui.snapshot); }

  void draw(Ui& ui) override {
    follow(*ui.snapshot);
    if (ui.filmed) return note("Nothing is measured while a film is made.");
    if (!ImGui::BeginTable("profiler", 2, ImGuiTableFlags_SizingStretchSame)) return;
    ImGui::TableNextColumn();
    step(ui);
    ImGui::TableNextColumn();
    picture(ui);
    ImGui::EndTable();
  }

 private:
  /// The time of each phase, over about the last twenty steps that were seen: beside means, a
  /// single step would mislead.
  void follow(const Snapshot& s) {
    if (s.number == number_) return;
    if (s.stage != stage_) seen_ = 0, stage_ = s.stage;
    number_ = s.number;
    if (s.report.wall_seconds() <= 0.0) return;
    const double weight = std::max(0.05, 1.0 / static_cast<double>(++seen_));
    for (int i = 0; i < world::phase_count; ++i) {
      double& mean = seconds_[static_cast<std::size_t>(i)];
      mean += weight * (s.report.seconds_of(static_cast<world::Phase>(i)) - mean);
    }
  }

  void step(Ui& ui) const {
    const Snapshot& s = *ui.snapshot;
    heading(ui, "A step of the simulation");
    row("mean, last half second", number_text(s.ms_per_step, 3) + " ms");
    row("95 % are below", number_text(s.ms_per_step_p95, 3) + " ms");
    row("steps a second", number_text(s.steps_per_second, 4));
    const double whole = std::accumulate(seconds_.begin(), seconds_.end(), 0.0);
    for (int i = 0; i < world::phase_count; ++i)
      bar(std::string(world::name_of(static_cast<world::Phase>(i))),
          seconds_[static_cast<std::size_t>(i)], whole);
  }

  static void picture(Ui& ui) {
    const FrameTimes& t = ui.times;
    heading(ui, "A picture");
    row("pictures a second", number_text(t.picture > 0 ? 1.0 / t.picture : 0.0, 3));
    row("snapshots a second", number_text(ui.snapshot->snapshots_per_second, 3));
    bar("draw list", t.list, t.picture);
    bar("scene", t.scene, t.picture);
    bar("panels", t.interface, t.picture);
    row("triangles", std::to_string(t.triangles));
    row("quality level", std::to_string(t.quality));
    row("OpenGL", t.renderer.empty() ? "none" : t.renderer);
  }

  static void bar(const std::string& name, double seconds, double whole) {
    row(name.c_str(), ms(seconds));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, tall = 0.2f * ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float share = whole > 0 ? static_cast<float>(std::min(1.0, seconds / whole)) : 0.0f;
    list.AddRectFilled(at, ImVec2(at.x + width, at.y + tall), colour_u32(palette().line));
    list.AddRectFilled(at, ImVec2(at.x + share * width, at.y + tall), colour_u32(palette().accent));
    ImGui::Dummy(ImVec2(width, tall));
  }

  std::array<double, world::phase_count> seconds_{};
  long seen_ = 0;
  std::uint64_t number_ = ~0ull, stage_ = ~0ull;
};

}  // namespace

std::unique_ptr<Panel> make_profiler_panel() {
  return std::make_unique<ProfilerPanel>();
}

}  // namespace pedicel::app
