#include "app/editors/robot_program_part.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// "2 s   truss/fruit_5, gripper 12 mm".
std::string text_of(const world::SceneWaypoint& one) {
  std::string text = number_text(one.time, 4) + " s   ";
  const Vec3 mm = 1e3 * one.position;
  const std::string place = number_text(mm.x(), 3) + ", " + number_text(mm.y(), 3) + ", " +
                            number_text(mm.z(), 3) + " mm";
  if (one.at.kind == world::Anchor::Kind::none)
    text += place;
  else
    text += (one.at.name.empty() ? std::string("tool") : one.at.name) +
            (one.position.isZero() ? "" : " + " + place);
  if (one.gripper) text += ", gripper " + number_text(1e3 * *one.gripper, 3) + " mm";
  return text;
}

}  // namespace

void RobotProgramPart::draw(Ui& ui) {
  heading(ui, "Program");
  draw_playing(ui);
  draw_waypoints(ui);
  draw_file(ui);
}

void RobotProgramPart::record(Ui& ui) {
  const std::vector<RobotWaypoint>& points = ui.session.document().waypoints;
  const double time = points.empty() ? 1.0 : points.back().time + 1.0;
  ui.run(Command("add waypoint", {{"time", time}, {"joints", pose(ui)}}));
}

std::vector<double> RobotProgramPart::pose(const Ui& ui) {
  const RobotSnapshot& robot = ui.snapshot->robot;
  const Eigen::VectorXd& q = robot.goal.size() && !robot.follows_program ? robot.goal : robot.q;
  return {q.begin(), q.end()};
}

void RobotProgramPart::draw_playing(Ui& ui) {
  const RobotSnapshot& robot = ui.snapshot->robot;
  const bool none = ui.session.document().waypoints.empty();
  if (ImGui::Button("Record")) record(ui);
  tip("Adds a waypoint where the robot is to be now, a second after the last one");
  ImGui::SameLine();
  ImGui::BeginDisabled(none);
  if (ImGui::Button("Play") && ui.run(Command("play waypoints", {{"loop", loop_ ? 1 : 0}})) &&
      ui.snapshot->mode != RunMode::playing)
    ui.session.control().play();  // a robot that moves is what was asked for
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
    waypoint_row(ui, points, static_cast<int>(i));
    ImGui::PopID();
  }
  if (points.empty()) note("No waypoints yet: move the robot and record.");
  scene_program(ui);
}

/// Its number, its time to be typed, where it goes, and what may be done with it.
void RobotProgramPart::waypoint_row(Ui& ui, const std::vector<RobotWaypoint>& points, int i) {
  const RobotWaypoint& one = points[static_cast<std::size_t>(i)];
  const float gap = 3.0f * ui.scale, letters = ImGui::GetFontSize();
  ImGui::AlignTextToFramePadding();
  ImGui::Text("%d", i + 1);
  ImGui::SameLine(1.6f * letters);
  ImGui::SetNextItemWidth(3.4f * letters);
  double time = one.time;
  if (number_field("##time", time, "%.4g s") && time != one.time)
    ui.run(Command("set waypoint", {{"index", i}, {"time", time}}));
  tip("s after the program's start");
  ImGui::SameLine(0, gap);
  if (ImGui::Button("Go")) ui.run(Command("joints", {{"values", one.joints}}));
  tip("Moves the robot there");
  ImGui::SameLine(0, gap);
  if (ImGui::Button("Set")) ui.run(Command("set waypoint", {{"index", i}, {"joints", pose(ui)}}));
  tip("Makes it where the robot is to be now");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(i == 0);
  if (ImGui::ArrowButton("up", ImGuiDir_Up))
    ui.run(Command("move waypoint", {{"index", i}, {"to", i - 1}}));
  ImGui::EndDisabled();
  tip("Earlier: the times stay, the poses change places");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(i + 1 == static_cast<int>(points.size()));
  if (ImGui::ArrowButton("down", ImGuiDir_Down))
    ui.run(Command("move waypoint", {{"index", i}, {"to", i + 1}}));
  ImGui::EndDisabled();
  tip("Later: the times stay, the poses change places");
  ImGui::SameLine(0, gap);
  if (icon_button("delete", Icon::cross, "Takes it away"))
    ui.run(Command("delete waypoint", {{"index", i}}));
}

/// What the scene file has the robot do, which is planned when the scene is built.
void RobotProgramPart::scene_program(Ui& ui) {
  if (!ui.snapshot->assets || !ui.snapshot->assets->scene.robot) return;
  const std::vector<world::SceneWaypoint>& program = ui.snapshot->assets->scene.robot->waypoints;
  if (program.empty()) return;
  heading(ui, "The scene's own program");
  for (std::size_t i = 0; i < program.size(); ++i) {
    const world::SceneWaypoint& one = program[i];
    elided(std::to_string(i + 1) + "   " + text_of(one), rest_width());
  }
  if (ImGui::Button("Restart")) ui.run(Command("reset", {}));
  tip("Back to time 0, where this program begins");
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
