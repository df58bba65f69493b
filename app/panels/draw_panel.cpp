#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/panels/panel.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

template <class Choice, std::size_t count>
void radio_row(const Ui& ui, Choice& value, const std::array<const char*, count>& names) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i) ImGui::SameLine(0, 12.0f * ui.scale);
    if (ImGui::RadioButton(names[i], value == static_cast<Choice>(i)))
      value = static_cast<Choice>(i);
  }
}

/// Millimetres for a length in metres.
void millimetres(const Ui& ui, const char* name, double& metres, double low, double high,
                 const char* what, const char* format = "%.1f mm") {
  double shown = 1e3 * metres;
  if (slider(ui, name, shown, low, high, format, ImGuiSliderFlags_Logarithmic, what))
    metres = shown / 1e3;
}

void share(const Ui& ui, const char* name, double& value, const char* what) {
  slider(ui, name, value, 0.0, 1.0, "%.2f", 0, what);
}

/// The draw mode and its options, with Blender's names.
class DrawPanel : public Panel {
 public:
  std::string_view name() const override { return "Draw"; }
  Dock dock() const override { return Dock::left; }

  void draw(Ui& ui) override {
    DrawMode& d = ui.draw;
    if (d.on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
    const bool was = d.on;
    if (wide_button(d.on ? "Drawing (Esc leaves)" : "Draw (D)")) d.on = !d.on;
    if (was) ImGui::PopStyleColor();
    heading(ui, "What");
    thing_buttons(d);
    if (d.thing == DrawThing::stem) stem_options(ui, d);
    if (d.thing == DrawThing::fruit) fruit_options(ui, d);
    if (d.thing == DrawThing::tie) tie_options(ui, d);
    if (d.thing == DrawThing::leaf) leaf_templates(d);
    if (d.thing == DrawThing::leaf)
      millimetres(ui, "Size", d.leaf_size, 5.0f, 400.0f, "From the foot of its stalk to its tip");
    heading(ui, "How");
    how(d.thing);
  }

 private:
  static void thing_buttons(DrawMode& d) {
    // In the order of DrawThing.
    constexpr std::array<const char*, 5> names = {"Stem", "Fruit", "Leaf", "Cut", "Tie"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool chosen = d.thing == static_cast<DrawThing>(i);
      if (i) stay_in_row(names[i]);
      if (chosen)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
      if (ImGui::Button(names[i])) d.thing = static_cast<DrawThing>(i);
      if (chosen) ImGui::PopStyleColor();
    }
  }

  static void how(DrawThing thing) {
    switch (thing) {
      case DrawThing::stem:
        note(
            "Drag: a stem. Begun on a stem (green ball) it becomes its branch, elsewhere a plant "
            "of its own. Wheel, Up or Down meanwhile: thicker or thinner from there on (a pen's "
            "pressure does not come through).");
        note(
            "Click a stem: its points. Drag a white ball to move a point, a blue one beside it to "
            "change the radius there. Shift+click adds a point. With one chosen: " +
            keys_of(Action::point_kind) + " corner or smooth, " + keys_of(Action::insert_point) +
            " another, " + keys_of(Action::smooth) + " smoother, " + keys_of(Action::remove) +
            " away.");
        note("Drag a fruit or leaf along its stem.");
        return;
      case DrawThing::fruit:
      case DrawThing::leaf:
        note("Click on a stem to put it there. Drag a fruit or leaf to move it along.");
        return;
      case DrawThing::trim:
        note(
            "Draw across stems, or click on one: what lies beyond goes (red), with all that is on "
            "it.");
        return;
      case DrawThing::tie:
        note(
            "Drag from a stem or fruit to another one, to a post, or to a point in the air: a "
            "string. Click on a "
            "string with no tool in hand to change it; " +
            keys_of(Action::remove) + " takes it away.");
        return;
    }
  }
  static void stem_options(Ui& ui, DrawMode& d) {
    heading(ui, "Stroke");
    millimetres(ui, "Tolerance", d.tolerance, 0.2f, 30.0f,
                "How far the stem may be from the stroke: less gives more points");
    ImGui::Checkbox("Detect corners", &d.detect_corners);
    heading(ui, "Radius");
    millimetres(ui, "Max", d.radius_max, 0.2f, 40.0f, "At the foot", "%.2f mm");
    millimetres(ui, "Min", d.radius_min, 0.2f, 40.0f, "At the tip", "%.2f mm");
    share(ui, "Taper start", d.taper_start, "Where along the stem it begins to get thinner");
    share(ui, "Taper end", d.taper_end, "Where along the stem it has its smallest radius");
    heading(ui, "Projection plane");
    planes(d);
    heading(ui, "Depth");
    radio_row(ui, d.depth, std::array<const char*, 2>{"Cursor", "Surface"});
    if (d.depth != DrawDepth::surface) return;
    ImGui::Checkbox("Only first", &d.only_first);
    tip("The depth is taken where the stroke begins; else the stroke creeps over what it crosses");
    if (!d.only_first)
      millimetres(ui, "Offset", d.offset, 0.1f, 50.0f, "From the surface towards the eye");
  }

  static void planes(DrawMode& d) {
    struct Plane {
      const char *name, *what;
    };
    constexpr std::array<Plane, 4> planes = {
        {{"Upright", "The upright plane that faces the camera: what is drawn upright stands so"},
         {"View", "The plane of the picture: leans with the camera"},
         {"Ground", "Level, at the height where the stroke begins"},
         {"Tangent", "The plane along the stem that the stroke begins on"}}};
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (i) stay_in_row(planes[i].name);
      if (ImGui::RadioButton(planes[i].name, d.plane == static_cast<PlaneChoice>(i)))
        d.plane = static_cast<PlaneChoice>(i);
      tip(planes[i].what);
    }
  }

  /// Those that lie beside the program.
  static void leaf_templates(DrawMode& d) {
    static const std::vector<std::string> names = [] {
      std::vector<std::string> found;
      const std::string ending = ".leaf.yaml";
      for (const auto& folder : asset_leaf_folders())
        for (const auto& entry : std::filesystem::directory_iterator(folder))
          if (const std::string file = entry.path().filename().string(); file.ends_with(ending))
            found.push_back(file.substr(0, file.size() - ending.size()));
      std::ranges::sort(found);
      return found;
    }();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i) stay_in_row(names[i].c_str());
      if (ImGui::RadioButton(names[i].c_str(), d.leaf_template == names[i]))
        d.leaf_template = names[i];
    }
  }

  static void tie_options(Ui& ui, DrawMode& d) {
    heading(ui, "String");
    slider(ui, "Stiffness", d.tie_stiffness, 1.0, 1.0e6, "%.0f N/m", ImGuiSliderFlags_Logarithmic,
           "How hard it pulls for each metre that it is longer");
    double slack = 1e3 * d.tie_slack;
    if (slider(ui, "Slack", slack, 0.0, 200.0, "%.0f mm", 0, "How much longer than its way it is"))
      d.tie_slack = slack / 1e3;
  }

  static void fruit_options(Ui& ui, DrawMode& d) {
    heading(ui, "Fruit");
    millimetres(ui, "Radius", d.fruit_radius, 2.0f, 60.0f, "Of the fruit");
    slider(ui, "Density", d.fruit_density, 200.0, 1500.0, "%.0f kg/m3");
    slider(ui, "Comes off at a force of", d.fruit_force, 0.2, 50.0, "%.1f N",
           ImGuiSliderFlags_Logarithmic, "A ripe cherry tomato 1 to 5 N, an apple 10 to 30 N");
    slider(ui, "or at a strain of", d.fruit_stretch, 0.01, 1.0, "%.2f");
  }
};

}  // namespace

std::unique_ptr<Panel> make_draw_panel() {
  return std::make_unique<DrawPanel>();
}

}  // namespace pedicel::app
