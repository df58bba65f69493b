#include <array>
#include <cstdio>

#include "app/panels/layout.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

void field(const Ui& ui, const char* name, const std::string& value, const std::string& what,
           const ImVec4& colour) {
  ImGui::TextColored(palette().dim, "%s", name);
  tip(what);
  ImGui::SameLine(0, 5.0f * ui.scale);
  ImGui::TextColored(colour, "%s", value.c_str());
  tip(what);
  ImGui::SameLine(0, 16.0f * ui.scale);
}

std::string rounded(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

ImVec4 mode_colour(RunMode mode) {
  if (mode == RunMode::playing) return palette().good;
  if (mode == RunMode::unstable) return palette().error;
  return mode == RunMode::building || mode == RunMode::replaying ? palette().warning
                                                                 : palette().text;
}

void speeds(const Ui& ui) {
  const Snapshot& s = *ui.snapshot;
  field(ui, "RTF", rounded("%.2f", s.real_time_factor),
        "Real-time factor: simulated over wall time, last half second", palette().text);
  field(ui, "step", rounded("%.2f ms", s.ms_per_step),
        "Wall time a step, mean of the last half second", palette().text);
}

}  // namespace

void draw_status_bar(Ui& ui) {
  const Snapshot& s = *ui.snapshot;
  const ImVec4 plain = palette().text;
  std::string mode = to_string(s.mode);
  constexpr double soon = 0.7;  // s
  if (ui.session.control().building_for() > soon) mode = to_string(RunMode::building);
  // A film is made of steps, between which the run is held.
  if (ui.filmed && s.mode == RunMode::paused && s.step > 0) mode = to_string(RunMode::playing);
  if (s.mode == RunMode::replaying) mode += rounded(" %.0f %%", 100.0 * s.replay_share);
  if (s.pull.active) mode += ", pulling";
  if (ui.draw.on) mode += ", drawing";
  field(ui, "", mode, "What the simulation does", mode_colour(s.mode));
  field(ui, "t", rounded("%.3f s", s.time), "Simulated time", plain);
  if (!ui.filmed) speeds(ui);
  field(ui, "contacts", std::to_string(s.report.contacts), "Between plants and other things",
        plain);
  field(ui, "strain", rounded("%.3f", s.largest_strain),
        "Largest strain at a surface: " + s.largest_strain_organ, plain);
  if (!ui.filmed && ui.times.platform == "window")  // off screen nobody waits for a picture
    field(ui, "picture", rounded("%.0f/s", ui.times.picture > 0 ? 1.0 / ui.times.picture : 0.0),
          "Pictures a second; the simulation does not wait for them", plain);
  std::string right;
  if (ui.selection)
    right = describe(ui.selection, s);
  else if (ui.hover)
    right = describe(ui.hover, s);
  if (right.empty()) {
    ImGui::NewLine();
    return;
  }
  const float room = ImGui::GetContentRegionAvail().x;
  const std::string shown = elide(right, room);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - ImGui::CalcTextSize(shown.c_str()).x);
  ImGui::TextColored(ui.selection ? palette().warning : palette().dim, "%s", shown.c_str());
}

}  // namespace pedicel::app
