#pragma once

#include "app/topics/topic_source.h"
#include "engine/ros_messages/control_messages.h"
#include "engine/ros_messages/marker_messages.h"
#include "plugins/simulation/quantities.h"

namespace pedicel::app {

/// /plant: stems, leaves, fruits and strings as RViz draws them; /bodies: rigid bodies and fruits
/// that came off.
class MarkerTopics : public TopicSource {
 public:
  MarkerTopics(const simulation::Simulation& simulation, TopicSink& sink);
  void tell(double time) override;

 private:
  void add_stems(int plant, ros::MarkerArray& all) const;
  void add_leaves(int plant, ros::MarkerArray& all) const;
  void add_fruits(int plant, ros::MarkerArray& all) const;
  void add_strings(ros::MarkerArray& all) const;
  ros::MarkerArray bodies(double time) const;
  ros::Marker marker(const std::string& ns, int id, std::int32_t type) const;

  const simulation::Simulation& simulation_;
  Teller<ros::MarkerArray> plants_, bodies_;
  double time_ = 0.0;
};

/// /organ_forces: of every organ and fruit that something touches or that may come off, its contact
/// forces (N, on the plant, world) and the share of its threshold that is used (1).
class OrganTopic : public TopicSource {
 public:
  OrganTopic(const simulation::Simulation& simulation, TopicSink& sink);
  void tell(double time) override;

 private:
  struct Told {
    const simulation::Quantity& quantity;
    std::vector<std::string> names;
  };
  ros::InterfaceValue told_of(const simulation::Row& row, simulation::Rows kind) const;

  const simulation::Simulation& simulation_;
  const simulation::RowLayout layout_;
  std::vector<Told> told_;
  Teller<ros::DynamicJointState> forces_;
};

/// /events: what happened, as JSON in a text: {"time": 2.31, "event": "detached", "what":
/// "truss/fruit_1", "by": "", "cause": "stretch", ...}.
class EventTopic : public TopicSource {
 public:
  EventTopic(const simulation::Simulation& simulation, TopicSink& sink);
  void begin(double time) override;
  void after_step(double time) override;

 private:
  const simulation::Simulation& simulation_;
  Teller<ros::String> events_;
  std::size_t told_ = 0;
};

}  // namespace pedicel::app
