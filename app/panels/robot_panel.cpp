#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/panels/panel.h"
#include "app/panels/theme.h"
#include "app/panels/ui.h"
#include "app/panels/widgets.h"

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
    if (robot.follows_program) note("Follows the scene's program. Moving it by hand takes over.");
    joints(ui);
    tool(ui);
    waypoints(ui);
  }

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
    float shown = static_cast<float>(unit * (dragged_ == joint.name ? dragged_value_ : goal));
    ImGui::PushID(joint.name.c_str());
    elided(is_gripper ? joint.name + " (gripper)" : joint.name, rest_width());
    ImGui::SetNextItemWidth(-1);
    const float low = static_cast<float>(unit * std::max(joint.lower, -2 * M_PI));
    const float high = static_cast<float>(unit * std::min(joint.upper, 2 * M_PI));
    if (ImGui::SliderFloat("##q", &shown, low, high, format, ImGuiSliderFlags_AlwaysClamp)) {
      dragged_ = joint.name, dragged_value_ = shown / unit;
      ui.run(Command("joint", {{"name", joint.name}, {"value", dragged_value_}}));
    }
    if (!ImGui::IsItemActive() && dragged_ == joint.name) dragged_.clear();
    mark_measured(static_cast<float>(unit * now), low, high);
    ImGui::PopID();
  }

  /// A tick at the measured position: the slider shows where the joint is to go.
  static void mark_measured(float now, float low, float high) {
    const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
    const float x = a.x + (b.x - a.x) * std::clamp((now - low) / (high - low), 0.0f, 1.0f);
    ImGui::GetWindowDrawList()->AddLine(ImVec2(x, b.y - 4.0f), ImVec2(x, b.y),
                                        colour_u32(palette().warning), 2.0f);
  }

  void tool(Ui& ui) {
    heading(ui, "Tool");
    const Vec3 p = 1e3 * ui.snapshot->robot.tool.position;
    row("Place, mm",
        number_text(p.x(), 4) + ", " + number_text(p.y(), 4) + ", " + number_text(p.z(), 4));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Step");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##step", &step_mm_, 1.0f, 100.0f, "%.0f mm", ImGuiSliderFlags_Logarithmic);
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
    if (!problem_.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, palette().error);
      ImGui::TextWrapped("%s", problem_.c_str());
      ImGui::PopStyleColor();
    }
  }

  void jog(Ui& ui, const Vec3& shift, const Vec3& turn) {
    const Result result = ui.session.run(Command("jog", {{"shift", shift}, {"turn", turn}}));
    problem_ = result.ok ? "" : result.text;
  }

  void waypoints(Ui& ui) {
    heading(ui, "Waypoints");
    const std::vector<RobotWaypoint> points = ui.session.document().waypoints;
    if (ImGui::Button("Record")) {
      const Eigen::VectorXd& q =
          ui.snapshot->robot.goal.size() ? ui.snapshot->robot.goal : ui.snapshot->robot.q;
      const double time = points.empty() ? 1.0 : points.back().time + 1.0;
      ui.run(Command("add waypoint",
                     {{"time", time}, {"joints", std::vector<double>(q.begin(), q.end())}}));
    }
    tip("Adds where the robot is to be now, a second after the last one");
    ImGui::SameLine();
    ImGui::BeginDisabled(points.empty());
    if (ImGui::Button("Play")) ui.run(Command("play waypoints", {}));
    ImGui::SameLine();
    if (ImGui::Button("Clear")) ui.run(Command("clear waypoints", {}));
    ImGui::EndDisabled();
    for (std::size_t i = 0; i < points.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      ImGui::AlignTextToFramePadding();
      ImGui::Text("%d   at %.1f s", static_cast<int>(i) + 1, points[i].time);
      ImGui::SameLine(ImGui::GetContentRegionMax().x - 1.25f * ImGui::GetFrameHeight());
      if (icon_button("delete", Icon::cross, "Takes it away"))
        ui.run(Command("delete waypoint", {{"index", static_cast<int>(i)}}));
      ImGui::PopID();
    }
    if (points.empty()) note("None yet: move the robot and record.");
  }

  std::string dragged_, problem_;
  double dragged_value_ = 0.0;
  float step_mm_ = 10.0f;
};

}  // namespace

std::unique_ptr<Panel> make_robot_panel() {
  return std::make_unique<RobotPanel>();
}

}  // namespace pedicel::app
