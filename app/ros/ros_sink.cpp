#include "app/ros/ros_sink.h"

#include "engine/ros_messages/type_hash.h"

namespace pedicel::app {

int RosSink::add(const Topic& topic) {
  const auto known = topics_.find(topic.name);
  if (known != topics_.end()) return known->second;
  const int number = node_.publish(topic.name, topic.definitions.front().name,
                                   ros::type_hash(topic.definitions), topic.delivery);
  topics_[topic.name] = number;
  return number;
}

void RosSink::write(int topic, double, std::string_view cdr) {
  node_.write(topic, cdr);
}

}  // namespace pedicel::app
