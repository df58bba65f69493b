#pragma once

#include <map>

#include "app/ros/dds_node.h"

namespace pedicel::app {

/// Topics as publishers of a node. A topic that is added again is the same one, so that a
/// simulation that begins anew goes on with its publishers.
class RosSink : public TopicSink {
 public:
  /// The node must outlive it.
  explicit RosSink(DdsNode& node) : node_(node) {}
  int add(const Topic& topic) override;
  void write(int topic, double time, std::string_view cdr) override;

 private:
  DdsNode& node_;
  std::map<std::string, int> topics_;
};

}  // namespace pedicel::app
