#pragma once

#include <set>

#include "app/topics/topic_source.h"

namespace pedicel::app {

/// /tf and /tf_static: the robot's links by their URDF names, each in its parent's frame; rigid
/// bodies, fruits ("truss/fruit_3") and the far ends of organs ("truss/stem") in the world's. A
/// fruit's frame goes on with the fruit that came off.
class FrameTopics : public TopicSource {
 public:
  /// Fruits, and organs, beyond this many are left out.
  static constexpr std::size_t most_organs = 300;

  FrameTopics(const simulation::Simulation& simulation, TopicSink& sink);
  void begin(double time) override;
  void tell(double time) override;

 private:
  struct OnPlant {
    int plant = 0, element = 0;
    double back = 0.0;  // m
    int fruit = -1;     // -1: an organ's end
    std::string frame;
  };
  void add_links(double time, bool moving, ros::TFMessage& frames) const;
  void add_bodies(double time, ros::TFMessage& frames);
  void add_organs();

  const simulation::Simulation& simulation_;
  Teller<ros::TFMessage> moving_, fixed_;
  std::vector<OnPlant> on_plants_;
  std::vector<std::string> body_frames_;
  std::set<std::string> links_;
};

}  // namespace pedicel::app
