#include "plugins/discrepancy/scene_next/motion_designs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "engine/io/csv.h"
#include "engine/robot/inverse_kinematics.h"
#include "plugins/discrepancy/scene_next/arm_way.h"

namespace pedicel::discrepancy {

namespace {

constexpr double quarter = 0.5 * std::numbers::pi;  // rad
constexpr double still = 0.5;                       // s, between turns in the free
constexpr double long_hold = 2.0;                   // s, of a contact
constexpr double free_swing = 0.3;                  // rad, of a joint that is no wrist
constexpr double free_slide = 0.05;                 // m
constexpr double free_gap = 5.0e-3;                 // m, to plants
constexpr double touching = 1.0e-3;                 // m
constexpr double other_side_error = 5.0e-3;         // m
constexpr double least_turn_time = 0.5;             // s
/// A smooth turn's greatest speed over its mean one, and what of a joint's limit it may take.
constexpr double peak = 1.875, of_limit = 0.8;
constexpr int most_wrists = 3;

// From 0 to 1 with speed and acceleration 0 at both ends.
double smooth_share(double s) {
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

bool takes_hold(const Trial& trial) {
  return std::ranges::any_of(trial.events,
                             [](const MeasuredEvent& one) { return one.event == "grasped"; });
}

/// Makes the motions of one trial.
class Designs {
 public:
  Designs(const Experiment& experiment, const Trial& base)
      : base_(base),
        way_(measured_way(experiment, base)),
        check_(experiment, base, way_),
        model_(check_.arm().model()) {
    find_wrists();
    swing_ = way_.q.front();
    for (const Eigen::VectorXd& q : way_.q)
      if ((q - way_.q.front()).norm() > (swing_ - way_.q.front()).norm()) swing_ = q;
  }

  std::vector<MotionDesign> run() {
    const std::string like = " as in " + base_.name;
    faster(0.5, "do" + like + " at half the speed");
    faster(2.0, "do" + like + " at twice the speed");
    // What is held would not be where the hand is.
    if (takes_hold(base_)) return std::move(designs_);
    scaled(0.5, "swing half as far" + like);
    scaled(1.5, "swing half as far again" + like);
    scaled(-1.0, "swing to the other side" + like);
    held("do" + like + ", and hold for " + io::format_number(long_hold) +
         " s where it goes farthest");
    for (const int wrist : wrists_) turned_before(wrist, like);
    if (!wrists_.empty()) turned_after(wrists_.front(), like);
    other_side("push from the plant's other side" + like);
    in_the_free();
    return std::move(designs_);
  }

 private:
  // Turning joints that move the tool, from it back.
  void find_wrists() {
    const std::vector<robot::KinematicModel::Element>& all = model_.elements();
    for (int link = check_.arm().tool(); link >= 0;) {
      const auto own = std::ranges::find(all, link, &robot::KinematicModel::Element::link);
      if (own == all.end()) return;
      if (own->dof >= 0 && own->type != robot::JointType::prismatic &&
          static_cast<int>(wrists_.size()) < most_wrists)
        wrists_.push_back(own->dof);
      if (own->dof >= 0) chain_.push_back(own->dof);
      link = own->parent;
    }
  }

  const std::string& name(int dof) const {
    return model_.joint_names()[static_cast<std::size_t>(dof)];
  }

  void faster(double times, const std::string& action) {
    ArmWay way = way_;
    const double end = way_.end() / times;
    way.q.clear();
    for (int i = 0; i * way.step < end + 0.5 * way.step; ++i)
      way.q.push_back(way_.at(std::min(i * way.step * times, way_.end())));
    add(way, action, times);
  }

  void scaled(double share, const std::string& action) {
    ArmWay way = way_;
    for (Eigen::VectorXd& q : way.q) q = way_.q.front() + share * (q - way_.q.front());
    add(way, action);
  }

  // One joint goes on from where the way ends; the others stay.
  double turn_time(int dof, double by) const {
    const double limit = model_.velocity_limits()[dof];
    const double least = limit > 0.0 ? peak * std::abs(by) / (of_limit * limit) : 0.0;
    return std::max({least_turn_time, std::abs(by), least});
  }
  void turn(ArmWay& way, int dof, double by) const {
    const Eigen::VectorXd from = way.back();
    const int steps = static_cast<int>(std::ceil(turn_time(dof, by) / way.step));
    for (int i = 1; i <= steps; ++i) {
      way.q.push_back(from);
      way.q.back()[dof] += by * smooth_share(static_cast<double>(i) / steps);
    }
  }
  static void wait(ArmWay& way, double time) {
    const Eigen::VectorXd at = way.back();
    for (int i = 0; i * way.step < time; ++i) way.q.push_back(at);
  }

  void held(const std::string& action) {
    ArmWay way = way_;
    way.q.clear();
    bool waited = false;
    for (const Eigen::VectorXd& q : way_.q) {
      way.q.push_back(q);
      if (waited || q != swing_) continue;
      wait(way, long_hold);
      waited = true;
    }
    add(way, action);
  }

  void turned_before(int wrist, const std::string& like) {
    for (const double by : {quarter, -quarter}) {
      ArmWay way = way_;
      for (Eigen::VectorXd& q : way.q) q[wrist] += by;
      // The other way round where the joint's limit or the ground is in between.
      if (add(way, "begin with " + name(wrist) + " turned by " + (by < 0.0 ? "-90" : "90") +
                       " degrees, and go on" + like))
        return;
    }
  }

  void turned_after(int wrist, const std::string& like) {
    for (const double by : {quarter, -quarter}) {
      ArmWay way = way_;
      turn(way, wrist, by);
      wait(way, still);
      if (add(way, "do" + like + ", then turn " + name(wrist) + " by " + (by < 0.0 ? "-90" : "90") +
                       " degrees and hold"))
        return;
    }
  }

  // Each joint in turn by as much as keeps the arm off the plants: wrists and hold, so that weight
  // shows in several directions.
  void in_the_free() {
    ArmWay way;
    way.step = way_.step;
    way.q = {way_.q.front()};
    if (!is_free(way)) return;
    wait(way, still);
    std::string joints;
    std::vector<int> turned(
        chain_.begin(),
        chain_.begin() + std::min<long>(most_wrists + 1, static_cast<long>(chain_.size())));
    for (const int dof : turned) {
      const bool wrist = std::ranges::find(wrists_, dof) != wrists_.end();
      const double far = model_.joint_type(dof) == robot::JointType::prismatic ? free_slide
                         : wrist && chain_.size() > 1                          ? quarter
                                                                               : free_swing;
      for (const double by : {far, -far, 0.5 * far, -0.5 * far}) {
        ArmWay longer = way;
        turn(longer, dof, by);
        wait(longer, still);
        turn(longer, dof, -by);
        if (!check_.allows(longer) || !is_free(longer)) continue;
        way = longer;
        joints += (joints.empty() ? "" : ", ") + name(dof);
        break;
      }
    }
    if (joints.empty()) return;
    wait(way, still);
    add(way,
        "touch nothing, and turn " + joints + " to and fro, one after another, each with a hold");
    ArmWay quick = way;
    quick.q.clear();
    for (int i = 0; i * way.step <= 0.5 * way.end(); ++i)
      quick.q.push_back(way.at(2.0 * i * way.step));
    add(quick, "touch nothing, and turn " + joints + " to and fro quickly");
  }

  bool is_free(const ArmWay& way) const {
    return std::ranges::all_of(
        way.q, [&](const Eigen::VectorXd& q) { return check_.clearance(q) >= free_gap; });
  }

  // The tool's way, mirrored at the upright plane through the touched point across the push.
  void other_side(const std::string& action) {
    const int tool = check_.arm().tool();
    const Vec3 begin = model_.link_pose(way_.q.front(), tool).position;
    Vec3 push = model_.link_pose(swing_, tool).position - begin;
    push.z() = 0.0;
    const auto touch = std::ranges::find_if(
        way_.q, [&](const Eigen::VectorXd& q) { return check_.clearance(q) < touching; });
    if (touch == way_.q.end() || push.norm() < touching) return;
    push.normalize();
    const Vec3 at = check_.nearest_plant(*touch);
    ArmWay way;
    way.step = way_.step;
    Eigen::VectorXd q = way_.q.front();
    for (const Eigen::VectorXd& own : way_.q) {
      const Pose pose = model_.link_pose(own, tool);
      robot::IkTarget target;
      target.link = tool;
      target.position_W = pose.position - 2.0 * push * push.dot(pose.position - at);
      // An arm with fewer joints cannot keep the tool's direction.
      if (model_.dofs() >= 6) target.orientation_W = pose.rotation;
      const robot::IkResult found = way.q.empty() ? robot::inverse_kinematics(model_, target, q)
                                                  : robot::descend(model_, target, q);
      if (found.position_error > other_side_error) return;
      q = found.q;
      way.q.push_back(q);
    }
    add(way, action);
  }

  // False where the arm may not go it. `times`: how much faster than the trial it is.
  bool add(const ArmWay& way, const std::string& action, double times = 1.0) {
    if (!check_.allows(way)) return false;
    MotionDesign design;
    design.action = action;
    Trial& trial = design.trial;
    trial.name = "motion_" + std::to_string(designs_.size() + 1);
    trial.folder = trial.name;
    trial.clock = base_.clock + base_.duration();
    trial.masses = base_.masses;
    trial.poses = base_.poses;
    trial.effects = base_.effects;
    trial.follows_commands = base_.follows_commands;
    for (MeasuredEvent event : base_.events) {
      if (event.event != "grasped" && event.event != "released") continue;
      event.time /= times;
      trial.events.push_back(event);
    }
    if (base_.follows_commands) {
      trial.commands = table(way, trial.command_columns);
      trial.joint_columns = base_.joint_columns;
      trial.joints = empty(base_.joints, way.end());
    } else {
      trial.joints = table(way, trial.joint_columns);
    }
    trial.torque_columns = base_.torque_columns;
    trial.torques = empty(base_.torques, way.end());
    trial.markers = empty(base_.markers, way.end());
    for (const Samples& own : base_.pixels) trial.pixels.push_back(empty(own, way.end()));
    for (const Samples& own : base_.wrenches) trial.wrenches.push_back(empty(own, way.end()));
    designs_.push_back(std::move(design));
    return true;
  }

  // Of all joints: one that the trial's own table lacks may be turned.
  static Samples table(const ArmWay& way, std::vector<int>& columns) {
    const long dofs = way.q.front().size();
    columns.resize(static_cast<std::size_t>(dofs));
    std::iota(columns.begin(), columns.end(), 0);
    Samples samples;
    samples.value.resize(static_cast<long>(way.q.size()), dofs);
    for (std::size_t r = 0; r < way.q.size(); ++r) {
      samples.time.push_back(way.step * static_cast<double>(r));
      samples.value.row(static_cast<long>(r)) = way.q[r].transpose();
    }
    return samples;
  }

  // As often as it was sampled, from its first time on, to the end of the motion.
  static Samples empty(const Samples& like, double end) {
    Samples samples;
    if (like.size() < 2) return samples;
    const double step =
        (like.time.back() - like.time.front()) / static_cast<double>(like.size() - 1);
    // Never before the motion begins.
    const double first = std::max(like.time.front(), 0.0);
    for (int i = 0; first + i * step <= end + 1.0e-9; ++i) samples.time.push_back(first + i * step);
    samples.value.setConstant(static_cast<long>(samples.time.size()), like.value.cols(),
                              std::numeric_limits<double>::quiet_NaN());
    return samples;
  }

  const Trial& base_;
  ArmWay way_;
  WayCheck check_;
  const robot::KinematicModel& model_;
  std::vector<int> wrists_, chain_;  // degrees of freedom, from the tool back
  Eigen::VectorXd swing_;            // where the way is farthest from its begin
  std::vector<MotionDesign> designs_;
};

}  // namespace

std::vector<MotionDesign> motion_designs(const Experiment& experiment, int trial) {
  return Designs(experiment, experiment.trials[static_cast<std::size_t>(trial)]).run();
}

}  // namespace pedicel::discrepancy
