#include <array>

#include "app/panels/panel.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

template <class Choice, std::size_t count>
void choose(const char* id, Choice& value, const std::array<const char*, count>& names) {
  int index = static_cast<int>(value);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::Combo(id, &index, names.data(), static_cast<int>(count)))
    value = static_cast<Choice>(index);
}

class ViewPanel : public Panel {
 public:
  std::string_view name() const override { return "View"; }
  Dock dock() const override { return Dock::right; }

  void draw(Ui& ui) override {
    colours(ui);
    shown(ui);
    cameras(ui);
    pictures(ui);
    quality(ui);
    window(ui);
    mouse(ui);
  }

 private:
  static void colours(Ui& ui) {
    heading(ui, "Colours of stems");
    choose("##colours", ui.view.colours,
           std::array<const char*, 5>{"as they are", "strain", "margin to break", "contact force",
                                      "residual of measured data"});
    if (ui.view.colours == ColourMap::strain)
      slider(ui, "Upper end, strain", ui.view.strain_scale, 0.005, 0.5, "%.3f");
    if (ui.view.colours == ColourMap::contact)
      slider(ui, "Upper end, N", ui.view.contact_scale, 0.1, 50.0, "%.1f");
  }

  static void shown(Ui& ui) {
    heading(ui, "Shown");
    ImGui::Checkbox("Contact forces", &ui.view.contacts);
    tip("Key " + keys_of(Action::contacts));
    ImGui::Checkbox("Rods and nodes", &ui.view.rods);
    tip("Key " + keys_of(Action::rods));
    ImGui::Checkbox("Frames of links", &ui.view.frames);
    tip("Key " + keys_of(Action::frames));
    ImGui::Checkbox("Leaves", &ui.view.leaves);
    ImGui::Checkbox("Shadows", &ui.view.shadows);
  }

  static void cameras(Ui& ui) {
    heading(ui, "Camera");
    if (ImGui::Button("Frame all")) ui.ask(Action::frame_all);
    tip(keys_of(Action::frame_all));
    ImGui::SameLine();
    if (ImGui::Button("Frame selection")) ui.ask(Action::frame_selection);
    tip(keys_of(Action::frame_selection));
    if (!ui.snapshot->assets || ui.snapshot->assets->scene.cameras.empty()) return;
    note("[ and ] go through the scene's cameras.");
  }

  static void pictures(Ui& ui) {
    heading(ui, "Pictures and films");
    if (ImGui::Button("Picture")) ui.ask(Action::screenshot);
    tip("Into the working folder: " + keys_of(Action::screenshot));
    ImGui::SameLine();
    if (ImGui::Button(ui.recording ? "End the film" : "Record a film")) ui.ask(Action::video);
    tip("Into the working folder: " + keys_of(Action::video) +
        ". The run goes on from picture to picture, so that the film is smooth on a slow machine");
    ImGui::BeginDisabled(ui.recording);
    ImGui::Checkbox("With the panels", &ui.view.panels_in_pictures);
    ImGui::EndDisabled();
    tip("Else of the scene alone, 1280 x 720");
  }

  static void quality(Ui& ui) {
    heading(ui, "Quality");
    ImGui::Checkbox("By the time that a picture takes", &ui.view.automatic_quality);
    ImGui::BeginDisabled(ui.view.automatic_quality);
    double level = ui.view.quality;
    if (slider(ui, "Level (0 is best)", level, 0.0, 5.0, "%.0f"))
      ui.view.quality = static_cast<int>(std::lround(level));
    ImGui::EndDisabled();
  }

  void window(Ui& ui) {
    heading(ui, "Window");
    choose("##theme", ui.preferences.theme, std::array<const char*, 2>{"dark", "light"});
    text_size(ui);
    if (wide_button("Reset layout")) {
      const Preferences fresh;
      Preferences& p = ui.preferences;
      p.left_width = fresh.left_width, p.right_width = fresh.right_width;
      p.bottom_height = fresh.bottom_height, p.font_scale = fresh.font_scale;
      p.show_left = p.show_right = true, p.show_bottom = false, p.seen_hint = false;
    }
  }

  /// Taken over when the slider is let go, so that it does not move under the hand.
  void text_size(Ui& ui) {
    if (!sizing_) text_scale_ = ui.preferences.font_scale;
    slider(ui, "Size of text", text_scale_, 0.7, 2.0, "%.2f");
    const bool held = ImGui::IsItemActive();
    if (sizing_ && !held) ui.preferences.font_scale = text_scale_;
    sizing_ = held;
  }

  static void mouse(Ui& ui) {
    heading(ui, "Mouse");
    choose("##mouse", ui.preferences.mouse,
           std::array<const char*, 2>{"Gazebo, MuJoCo", "Blender"});
    slider(ui, "Turning", ui.preferences.orbit_sensitivity, 0.2, 3.0, "%.2f");
    slider(ui, "Strength of pulling, N/m", ui.preferences.pull_stiffness, 1.0, 500.0, "%.0f");
    ImGui::Checkbox("Invert up and down", &ui.preferences.invert_orbit);
    ImGui::Checkbox("Invert wheel", &ui.preferences.invert_wheel);
    ImGui::Checkbox("Angles in degrees", &ui.preferences.degrees);
  }

  double text_scale_ = 1.0;
  bool sizing_ = false;
};

}  // namespace

std::unique_ptr<Panel> make_view_panel() {
  return std::make_unique<ViewPanel>();
}

}  // namespace pedicel::app
