#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ros_messages/cdr.h"

namespace pedicel::app {

/// How a topic is sent, as ROS does for its kind.
enum class Delivery {
  sensor,    ///< the newest counts, one may be lost: best effort
  reliable,  ///< each counts
  latched,   ///< each counts, and who comes later gets the last: transient local
};

/// A topic as ROS 2 names it.
struct Topic {
  std::string name;                          ///< "/joint_states"
  std::vector<ros::Definition> definitions;  ///< of its messages: their own first
  Delivery delivery = Delivery::sensor;
  std::map<std::string, std::string> metadata;  ///< told where the sink has a place for it
};

/// Where messages go: a log, or DDS.
class TopicSink {
 public:
  virtual ~TopicSink() = default;
  /// Returns the topic's number. Before the first write() to it.
  virtual int add(const Topic& topic) = 0;
  /// A message as CDR, with the simulated time (s) at which it is told.
  virtual void write(int topic, double time, std::string_view cdr) = 0;
  /// What is written goes on its way, where the sink gathers it.
  virtual void flush() {}
};

/// A topic of one type in a sink.
template <ros::Message M>
class Teller {
 public:
  Teller(TopicSink& sink, const std::string& name, Delivery delivery,
         std::map<std::string, std::string> metadata = {})
      : sink_(sink),
        topic_(sink.add({name, ros::definitions_of<M>(), delivery, std::move(metadata)})) {}
  void tell(double time, const M& message) { sink_.write(topic_, time, ros::to_cdr(message)); }

 private:
  TopicSink& sink_;
  int topic_;
};

}  // namespace pedicel::app
