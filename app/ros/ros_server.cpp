#include "app/ros/ros_server.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/ros/ros_services.h"
#include "app/topics/camera_topics.h"
#include "engine/core/exit_code.h"
#include "engine/core/stop.h"
#include "engine/core/verbosity.h"
#include "engine/io/csv.h"
#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/type_hash.h"

namespace pedicel::app {

namespace {

constexpr double longest_wait = 0.05;  // s, until a stop is heard
constexpr double late = 0.25;          // s behind its pace, from which on it is not made up for

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

RosServer::RosServer(const world::Scene& scene, const RosOptions& options)
    : options_(options),
      edits_(scene, options.simulation),
      assets_(std::make_shared<const simulation::SceneAssets>(scene, options.simulation)),
      state_(options.paused ? State::paused : State::playing),
      node_(std::make_unique<DdsNode>(options.node)),
      sink_(std::make_unique<RosSink>(*node_)) {
  if (assets_->robot)
    actions_ = std::make_unique<ArmActions>(
        *node_, queue_, scene.robot && !scene.robot->gripper.empty(),
        [this](const std::string& what, const std::string& why) { refuse(what, why); });
  if (!options.log.empty()) {
    log_ = std::make_unique<McapSink>(options.log);
    both_ = std::make_unique<BothSinks>(*sink_, *log_);
  }
  if (options.pictures && has_sensing_camera(scene)) {
    taker_ = std::make_unique<PictureTaker>();
    if (!taker_->available()) say(Verbosity::warnings, "no cameras: %s", taker_->why().c_str());
  }
  begin();
  for (const std::string& note : simulation_->notes()) say(Verbosity::warnings, "%s", note.c_str());
  const auto definitions = ros::definitions_of<ros::JointTrajectory>();
  node_->subscribe("/joint_trajectory", ros::JointTrajectory::name, ros::type_hash(definitions),
                   [this](std::string bytes) {
                     queue_.put([this, bytes = std::move(bytes)] {
                       const auto message = ros::from_cdr<ros::JointTrajectory>(bytes);
                       if (!message) return refuse("/joint_trajectory", "no joint trajectory");
                       follow(*message);
                     });
                   });
  services_ = std::make_unique<RosServices>(*this);
}

RosServer::~RosServer() {
  // Nothing may arrive once the rest goes.
  node_.reset();
}

void RosServer::begin() {
  told_.reset();
  // Each telling adds its topics anew, and finds them.
  if (both_) both_ = std::make_unique<BothSinks>(*sink_, *log_);
  // What was led until now stays until nobody looks at it any more.
  const auto before = std::move(simulation_);
  const auto follower_before = std::move(follower_);
  simulation_ = std::make_unique<simulation::Simulation>(assets_);
  if (simulation::RobotControl* robot = simulation_->robot()) {
    follower_ = std::make_unique<JointFollower>(*robot);
    simulation_->world().add(*follower_);
    actions_->lead(*simulation_, *robot, *follower_);
  }
  const double rate = simulation_->scene().log_rate;
  const TopicRates rates{.states = rate, .joints = rate};
  TopicSink& sink = both_ ? static_cast<TopicSink&>(*both_) : *sink_;
  told_ = std::make_unique<SimulationTopics>(*simulation_, sink, rates, taker_.get());
  told_->begin();
  pace_wall_ = 0.0;
}

bool RosServer::rebuild(const SceneEdits& edits, std::string& fault) {
  std::shared_ptr<const simulation::SceneAssets> assets;
  try {
    assets = std::make_shared<const simulation::SceneAssets>(edits.scene(), edits.options());
    // Bodies, loads and contacts are checked by what is built of them.
    const simulation::Simulation trial(assets);
  } catch (const std::exception& refused) {
    fault = refused.what();
    return false;
  }
  edits_.take(edits);
  assets_ = std::move(assets);
  begin();
  return true;
}

bool RosServer::step() {
  const world::WorldReport& report = simulation_->step();
  told_->after_step();
  if (actions_) actions_->after_step();
  if (!(report.errors & world::fatal_errors)) return true;
  failure_ = "unstable at " + io::format_number(report.time, 6) + " s: " + report.culprit + ": " +
             report.cause;
  return false;
}

// From a wall time and a simulated time that belong together; anew where it fell far behind, so
// that a slow spell is not followed by a rush.
void RosServer::wait_for_pace() {
  if (!(options_.pace > 0.0)) return;
  const double time = simulation_->world().time();
  if (pace_wall_ == 0.0) pace_wall_ = wall_seconds(), pace_time_ = time;
  const double due = pace_wall_ + (time - pace_time_) / options_.pace;
  double left = due - wall_seconds();
  if (left < -late) pace_wall_ = 0.0;
  while (left > 0.0 && !stop_requested) {
    queue_.wait(std::min(left, longest_wait));
    queue_.run();
    // A reset or a pause while it waited.
    if (pace_wall_ == 0.0 || state_ != State::playing) return;
    left = due - wall_seconds();
  }
}

bool RosServer::is_over() const {
  return options_.duration &&
         simulation_->world().time() >= *options_.duration - 0.5 * simulation_->world().dt();
}

void RosServer::refuse(const std::string& what, const std::string& why) {
  ++malformed_;
  say(Verbosity::everything, "%s: refused: %s", what.c_str(), printable(why).c_str());
}

void RosServer::follow(const ros::JointTrajectory& message) {
  if (!follower_) return refuse("/joint_trajectory", "the scene has no robot");
  // As joint_trajectory_controller takes it: without points it stops where it is.
  std::vector<int> joints;
  const double now = simulation_->world().time();
  if (message.points.empty()) {
    for (const std::string& name : message.joint_names)
      if (const int joint = simulation_->robot()->robot().model().joint_index(name); joint >= 0)
        joints.push_back(joint);
    return follower_->hold(joints);
  }
  std::string fault;
  auto plan = follower_->plan(message, now, fault);
  if (!plan) return refuse("/joint_trajectory", fault);
  follower_->follow(std::move(*plan));
}

int RosServer::run() {
  if (!options_.quiet)
    say(Verbosity::lines, "ROS 2 on domain %d, %s; Ctrl-C ends it", options_.node.domain,
        options_.node.interface.empty()    ? "this machine only"
        : options_.node.interface == "any" ? "all interfaces"
                                           : options_.node.interface.c_str());
  int code = exit_ok;
  while (!stop_requested && !quits_ && !is_over()) {
    queue_.run();
    if (state_ != State::playing) {
      queue_.wait(longest_wait);
      continue;
    }
    if (!step()) {
      say(Verbosity::errors, "error: %s", failure_.c_str());
      code = exit_unstable;
      break;
    }
    wait_for_pace();
  }
  if (log_) log_->close();
  say_end();
  return stop_requested ? stop_exit_code() : code;
}

void RosServer::say_end() const {
  if (options_.quiet) return;
  const std::uint64_t refused = malformed_ + node_->refused() + queue_.refused();
  say(Verbosity::lines, "%.3f s simulated, %llu message%s refused, state %016llx",
      simulation_->world().time(), static_cast<unsigned long long>(refused),
      refused == 1 ? "" : "s", static_cast<unsigned long long>(simulation_->state_hash()));
}

}  // namespace pedicel::app
