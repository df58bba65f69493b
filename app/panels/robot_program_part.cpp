#include "app/panels/robot_program_part.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/panels/ui.h"
#include "app/panels/widgets.h"

namespace pedicel::app {

void RobotProgramPart::draw(Ui& ui) {
  heading(ui, "Program");
  draw_playing(ui);
  draw_waypoints(ui);
  draw_file(ui);
}

void RobotProgramPart::record(Ui& ui) {
  const std::vector<RobotWaypoint>& points = ui.session.document().waypoints;
  const RobotSnapshot& robot = ui.snapshot->robot;
  const Eigen::VectorXd& q = robot.goal.size() && !robot.follows_program ? robot.goal : robot.q;
  const double time = points.empty() ? 1.0 : points.back().time + 1.0;
  ui.run(Command("add waypoint",
                 {{"time", time}, {"joints", std::vector<double>(q.begin(), q.end())}}));
}

void RobotProgramPart::draw_playing(Ui& ui) {
  const RobotSnapshot& robot = ui.snapshot->robot;
  const bool none = ui.session.document().waypoints.empty();
  if (ImGui::Button("Record")) record(ui);
  tip("Adds a waypoint where the robot is to be now, a second after the last one");
  ImGui::SameLine();
  ImGui::BeginDisabled(none);
  if (ImGui::Button("Play")) ui.run(Command("play waypoints", {{"loop", loop_ ? 1 : 0}}));
  tip("Plays the waypoints from now on");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!robot.follows_program);
  if (ImGui::Button("Stop")) ui.run(Command("stop robot", {}));
  tip("The robot stays where it is");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::Checkbox("Loop", &loop_);
  tip("Over and over, with a way back from the last waypoint to the first");
  if (!robot.follows_program || !(robot.program_duration > 0.0)) return;
  const double time = std::min(robot.program_time, robot.program_duration);
  const std::string text =
      number_text(time, 3) + " of " + number_text(robot.program_duration, 3) + " s";
  ImGui::ProgressBar(static_cast<float>(time / robot.program_duration), ImVec2(-1, 0),
                     (text + (robot.loops ? ", over and over" : "")).c_str());
}

void RobotProgramPart::draw_waypoints(Ui& ui) {
  const std::vector<RobotWaypoint> points = ui.session.document().waypoints;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%d   at %.1f s", static_cast<int>(i) + 1, points[i].time);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("Go").x -
                    2 * ImGui::GetStyle().FramePadding.x - 1.25f * ImGui::GetFrameHeight() -
                    ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button("Go")) ui.run(Command("joints", {{"values", points[i].joints}}));
    tip("Moves the robot there");
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 1.25f * ImGui::GetFrameHeight());
    if (icon_button("delete", Icon::cross, "Takes it away"))
      ui.run(Command("delete waypoint", {{"index", static_cast<int>(i)}}));
    ImGui::PopID();
  }
  if (points.empty()) note("No waypoints yet: move the robot and record.");
}

/// One name for all of it: the table of waypoints is a trajectory.
void RobotProgramPart::draw_file(Ui& ui) {
  ImGui::SetNextItemWidth(-1);
  text_field("##file", file_, "table time_s,JOINT,... (*.csv)");
  tip("A table of joint positions over time: time_s, then one column a joint, rad or m");
  const bool named = !file_.empty(), none = ui.session.document().waypoints.empty();
  ImGui::BeginDisabled(!named || none);
  if (ImGui::Button("Save") && ui.run(Command("save waypoints", {{"file", file_}})))
    ui.say("waypoints in " + std::filesystem::absolute(file_).string());
  tip("Writes the waypoints to the table");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!named);
  if (ImGui::Button("Load")) ui.run(Command("load waypoints", {{"file", file_}}));
  tip("Takes the table's rows as the waypoints");
  ImGui::SameLine();
  if (ImGui::Button("Play file"))
    ui.run(Command("play trajectory", {{"file", file_}, {"loop", loop_ ? 1 : 0}}));
  tip("Plays the table from now on; the waypoints stay");
  ImGui::EndDisabled();
  if (none) return;
  ImGui::SameLine();
  if (ImGui::Button("Clear")) ui.run(Command("clear waypoints", {}));
  tip("Takes all waypoints away");
}

}  // namespace pedicel::app
