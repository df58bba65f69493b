#pragma once

#include <algorithm>
#include <functional>
#include <list>
#include <string>

#include "app/ros/command_queue.h"
#include "app/ros/dds_node.h"
#include "engine/ros_messages/action_messages.h"
#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/type_hash.h"

namespace pedicel::app {

/// The server's side of an action of ROS 2: three services and two topics. One goal is followed at
/// a time; a new one ends the one before it.
template <class Action>
class ActionServer {
 public:
  /// How a goal stands, and what is told of it while it goes on and once it has ended.
  struct Answer {
    std::int8_t status = ros::GoalStatus::executing;
    typename Action::Feedback feedback;
    typename Action::Result result;
  };
  struct Handlers {
    /// Begins a goal; false, with the reason, where it makes no sense.
    std::function<bool(const typename Action::Goal&, std::string& fault)> begin;
    /// How the goal that was begun stands now.
    std::function<Answer()> look;
    /// Ends it where it is.
    std::function<void()> cancel;
    std::function<void(const std::string& what, const std::string& why)> refuse;
    std::function<double()> time;  ///< s, simulated
  };
  static constexpr std::size_t goals_kept = 20;
  static constexpr double feedback_time = 0.05;  ///< s, simulated

  /// Node and queue must outlive it.
  ActionServer(DdsNode& node, CommandQueue& queue, const std::string& name, Handlers handlers)
      : node_(node), queue_(queue), name_(name), do_(std::move(handlers)) {
    const std::string base = name + "/_action/", type = Action::action;
    status_ = node.publish(base + "status", ros::GoalStatusArray::name,
                           ros::type_hash_of<ros::GoalStatusArray>(), Delivery::latched);
    const std::string feedback = type + "_FeedbackMessage";
    feedback_ =
        node.publish(base + "feedback", feedback,
                     ros::type_hash_of<ros::FeedbackMessage<Action>>(feedback), Delivery::reliable);
    send_ = serve<ros::SendGoalRequest<Action>, ros::SendGoalResponse>(
        base + "send_goal", type + "_SendGoal",
        [this](const RequestId& id, const auto& request) { goal(id, request); });
    result_ = serve<ros::GetResultRequest, ros::GetResultResponse<Action>>(
        base + "get_result", type + "_GetResult",
        [this](const RequestId& id, const auto& request) { result(id, request.goal_id); });
    cancel_ = serve<ros::CancelGoal::Request, ros::CancelGoal::Response>(
        base + "cancel_goal", ros::CancelGoal::service,
        [this](const RequestId& id, const auto& request) { cancel(id, request.goal_info); });
  }

  /// After every step.
  void after_step() {
    if (!active_) return;
    const Answer now = do_.look();
    if (now.status != ros::GoalStatus::executing) return end(now.status, now.result);
    if (do_.time() < last_feedback_ + feedback_time && do_.time() >= last_feedback_) return;
    last_feedback_ = do_.time();
    node_.write(feedback_,
                ros::to_cdr(ros::FeedbackMessage<Action>{active_->info.goal_id, now.feedback}));
  }

  /// The goal is given up, because the simulation begins anew.
  void abort() {
    if (active_) end(ros::GoalStatus::aborted, do_.look().result);
  }

 private:
  struct Known {
    ros::GoalInfo info;
    std::int8_t status = ros::GoalStatus::executing;
    typename Action::Result result;
    std::vector<RequestId> waiting;  // for the result
  };
  static constexpr std::size_t most_waiting = 100;

  template <class Request, class Response, class Take>
  int serve(const std::string& service, const std::string& type, Take take) {
    const ServiceHashes hashes{ros::type_hash_of<Request>(type + "_Request"),
                               ros::type_hash_of<Response>(type + "_Response")};
    return node_.serve(service, type, hashes,
                       [this, service, take](const RequestId& id, std::string bytes) {
                         queue_.put([this, service, take, id, bytes = std::move(bytes)] {
                           const auto request = ros::from_cdr<Request>(bytes);
                           if (!request) return do_.refuse(service, "no request of that kind");
                           take(id, *request);
                         });
                       });
  }

  Known* find(const ros::UUID& id) {
    const auto found =
        std::ranges::find_if(goals_, [&](const Known& goal) { return goal.info.goal_id == id; });
    return found == goals_.end() ? nullptr : &*found;
  }

  void goal(const RequestId& to, const ros::SendGoalRequest<Action>& request) {
    ros::SendGoalResponse response;
    response.stamp = ros::stamp_of(do_.time());
    std::string fault = find(request.goal_id) ? "the goal's id was used before" : "";
    if (fault.empty()) {
      // Only a goal that makes sense ends the one before it.
      Known* const before = active_;
      const Answer last = before ? do_.look() : Answer{};
      response.accepted = do_.begin(request.goal, fault);
      if (response.accepted && before) {
        active_ = nullptr;
        finish(*before, ros::GoalStatus::aborted, last.result);
      }
    }
    if (!response.accepted) do_.refuse(name_, fault);
    if (response.accepted) {
      if (goals_.size() == goals_kept) goals_.pop_front();
      goals_.push_back({{request.goal_id, response.stamp}, ros::GoalStatus::executing, {}, {}});
      active_ = &goals_.back();
      last_feedback_ = do_.time();
      tell_status();
    }
    node_.reply(send_, to, ros::to_cdr(response));
  }

  void result(const RequestId& to, const ros::UUID& id) {
    Known* const known = find(id);
    if (known && known == active_ && known->waiting.size() < most_waiting)
      return known->waiting.push_back(to);
    ros::GetResultResponse<Action> response;
    if (known) response.status = known->status, response.result = known->result;
    node_.reply(result_, to, ros::to_cdr(response));
  }

  // An id of zeros stands for all goals.
  void cancel(const RequestId& to, const ros::GoalInfo& which) {
    ros::CancelGoal::Response response;
    const bool all = which.goal_id == ros::UUID{};
    if (active_ && (all || active_->info.goal_id == which.goal_id)) {
      response.goals_canceling.push_back(active_->info);
      const Answer last = do_.look();
      do_.cancel();
      end(ros::GoalStatus::canceled, last.result);
    } else if (!all) {
      response.return_code =
          find(which.goal_id) ? ros::CancelGoal::terminated : ros::CancelGoal::unknown_goal;
    }
    node_.reply(cancel_, to, ros::to_cdr(response));
  }

  void end(std::int8_t status, const typename Action::Result& result) {
    Known& known = *active_;
    active_ = nullptr;
    finish(known, status, result);
  }

  void finish(Known& known, std::int8_t status, const typename Action::Result& result) {
    known.status = status;
    known.result = result;
    const std::string bytes = ros::to_cdr(ros::GetResultResponse<Action>{status, result});
    for (const RequestId& one : known.waiting) node_.reply(result_, one, bytes);
    known.waiting.clear();
    tell_status();
  }

  void tell_status() {
    ros::GoalStatusArray all;
    for (const Known& known : goals_) all.status_list.push_back({known.info, known.status});
    node_.write(status_, ros::to_cdr(all));
  }

  DdsNode& node_;
  CommandQueue& queue_;
  std::string name_;
  Handlers do_;
  int status_ = 0, feedback_ = 0, send_ = 0, result_ = 0, cancel_ = 0;
  std::list<Known> goals_;
  Known* active_ = nullptr;  // of goals_, the last
  double last_feedback_ = 0.0;
};

}  // namespace pedicel::app
