#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/editors/organ_numbers.h"
#include "app/editors/robot_program_part.h"
#include "app/panels/panel.h"
#include "app/session/session_robot.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// Joints, tool, gripper and waypoints.
class RobotPanel : public Panel {
 public:
  std::string_view name() const override { return "Robot"; }
  Dock dock() const override { return Dock::right; }
  bool useful(const Ui& ui) const override {
    return ui.snapshot->assets && ui.snapshot->assets->robot;
  }

  void draw(Ui& ui) override {
    const RobotSnapshot& robot = ui.snapshot->robot;
    if (robot.follows_program) note("Follows a program. Moving it by hand takes over.");
    joints(ui);
    tool(ui);
    program_.draw(ui);
    ui.view.robot_panel = true;
  }
  void idle(Ui& ui) override { ui.view.robot_panel = false; }

 private:
  void joints(Ui& ui) {
    heading(ui, "Joints");
    const robot::RobotDescription& description = *ui.snapshot->assets->robot;
    const std::string& gripper = ui.snapshot->assets->scene.robot->gripper;
    // Degrees of freedom are the joints that move by themselves, in the order of the file.
    int dof = 0;
    for (const robot::Joint& joint : description.joints) {
      if (!joint.moves() || joint.mimic) continue;
      if (dof < ui.snapshot->robot.q.size()) one_joint(ui, joint, dof, joint.name == gripper);
      ++dof;
    }
  }

  void one_joint(Ui& ui, const robot::Joint& joint, int dof, bool is_gripper) {
    const RobotSnapshot& robot = ui.snapshot->robot;
    const bool turns = joint.type != robot::JointType::prismatic;
    const bool degrees = turns && ui.preferences.degrees;
    const double unit = degrees ? 180.0 / M_PI : turns ? 1.0 : 1e3;
    const char* format = degrees ? "%.1f\xC2\xB0" : turns ? "%.3f rad" : "%.1f mm";
    const double now = robot.q[dof];
    const double goal = robot.goal.size() > dof ? robot.goal[dof] : now;
    double shown = unit * (dragged_ == joint.name ? dragged_value_ : goal);
    const double low = unit * std::max(joint.lower, -2 * M_PI);
    const double high = unit * std::min(joint.upper, 2 * M_PI);
    const std::string name = is_gripper ? joint.name + " (gripper)" : joint.name;
    if (slider(ui, name, shown, low, high, format, ImGuiSliderFlags_AlwaysClamp)) {
      dragged_ = joint.name, dragged_value_ = shown / unit;
      ui.run(Command("joint", {{"name", joint.name}, {"value", dragged_value_}}));
    }
    if (!ImGui::IsItemActive() && dragged_ == joint.name) dragged_.clear();
    mark_measured((unit * now - low) / (high - low));
  }

  /// A tick at the measured position: the slider shows where the joint is to go.
  static void mark_measured(double share) {
    const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
    const float x = a.x + (b.x - a.x) * static_cast<float>(std::clamp(share, 0.0, 1.0));
    const float tall = 0.27f * ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddLine(ImVec2(x, b.y - tall), ImVec2(x, b.y),
                                        colour_u32(palette().warning), 0.5f * tall);
  }

  void tool(Ui& ui) {
    heading(ui, "Tool");
    const Vec3 p = 1e3 * ui.snapshot->robot.tool.position;
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.1f, %.1f, %.1f", p.x(), p.y(), p.z());
    row("Place, mm", text.data());
    goal(ui);
    if (ImGui::Button("Home")) ui.run(Command("home robot", {}));
    tip("All joints to where they start");
    ImGui::SameLine();
    tool_to_selection_button(ui);
    slider(ui, "Step", step_mm_, 1.0, 100.0, "%.0f mm", ImGuiSliderFlags_Logarithmic);
    constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
    const float width = (ImGui::GetContentRegionAvail().x - 5 * 4.0f * ui.scale) / 6.0f;
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {-1, 1}) {
        if (axis || sign > 0) ImGui::SameLine(0, 4.0f * ui.scale);
        const std::string label =
            axes[static_cast<std::size_t>(axis)] + std::string(sign < 0 ? "-" : "+");
        if (ImGui::Button(label.c_str(), ImVec2(width, 0)))
          jog(ui, sign * 1e-3 * step_mm_ * Vec3::Unit(axis), Vec3::Zero());
        tip("Moves the tool along the world's " +
            std::string(axes[static_cast<std::size_t>(axis)]));
      }
    for (int axis = 0; axis < 3; ++axis)
      for (const int sign : {-1, 1}) {
        if (axis || sign > 0) ImGui::SameLine(0, 4.0f * ui.scale);
        const std::string label =
            "r" + std::string(axes[static_cast<std::size_t>(axis)]) + (sign < 0 ? "-" : "+");
        if (ImGui::Button(label.c_str(), ImVec2(width, 0)))
          jog(ui, Vec3::Zero(), sign * 0.0873 * Vec3::Unit(axis));
        tip("Turns the tool by 5 degrees about the world's " +
            std::string(axes[static_cast<std::size_t>(axis)]));
      }
    ImGui::Checkbox("Handles", &ui.view.tool_handles);
    tip("Arrows, rings and a knob in the scene to drag the tool by, key " +
        keys_of(Action::tool_handles));
    stay_in_row("Tool's axes");
    ImGui::Checkbox("Tool's axes", &ui.view.tool_axes);
    tip("The handles turn with the tool; else they are the world's");
    stay_in_row("Ghost");
    ImGui::Checkbox("Ghost", &ui.view.ghost);
    tip("Shows the robot where it is told to go while it is not there");
  }

  /// Where the tool is to go, to be typed in; and what is out of reach.
  void goal(Ui& ui) {
    const std::optional<ToolGoal> goal = ui.session.robot().tool_goal();
    if (!goal) return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Goal, mm");
    const float spacing = 4.0f * ui.scale;
    const float width =
        (ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Goal, mm").x - 3 * spacing) / 3.0f;
    for (int axis = 0; axis < 3; ++axis) {
      ImGui::SameLine(0, spacing);
      ImGui::SetNextItemWidth(width);
      ImGui::PushID(axis);
      double value = std::round(1e4 * goal->asked_W.position[axis]) / 10.0 + 0.0;  // no -0.0
      if (number_field("##goal", value, "%.1f")) {
        Vec3 to = goal->asked_W.position;
        to[axis] = value / 1e3;
        const Result result = ui.session.run(Command("tool", {{"to", to}, {"near", 1}}));
        if (!result.ok) ui.report(result);
      }
      ImGui::PopID();
    }
    if (goal->asked_W.position != problem_at_) problem_.clear();
    // Its room is always kept: buttons must not go away from under the pointer.
    const std::string& text = goal->reached ? problem_ : goal->sentence;
    const float room = 2.0f * ImGui::GetTextLineHeightWithSpacing();
    if (ImGui::BeginChild("problem", ImVec2(0, room), false, ImGuiWindowFlags_NoScrollbar)) {
      ImGui::PushStyleColor(ImGuiCol_Text, palette().error);
      ImGui::TextWrapped("%s", text.c_str());
      ImGui::PopStyleColor();
    }
    ImGui::EndChild();
    tip(text);
  }

  void jog(Ui& ui, const Vec3& shift, const Vec3& turn) {
    const Result result = ui.session.run(Command("jog", {{"shift", shift}, {"turn", turn}}));
    problem_ = result.ok ? "" : result.text;
    if (const auto goal = ui.session.robot().tool_goal()) problem_at_ = goal->asked_W.position;
  }

  RobotProgramPart program_;
  std::string dragged_, problem_;
  Vec3 problem_at_ = Vec3::Zero();  // m, the goal when it arose
  double dragged_value_ = 0.0;
  double step_mm_ = 10.0;
};

}  // namespace

std::unique_ptr<Panel> make_robot_panel() {
  return std::make_unique<RobotPanel>();
}

}  // namespace pedicel::app
