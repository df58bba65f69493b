#pragma once

#include "app/sense/scene_sensors.h"
#include "app/topics/topic_source.h"
#include "engine/ros_messages/sensor_messages.h"

namespace pedicel::app {

/// Whether a scene has a camera whose pictures are wanted.
bool has_sensing_camera(const world::Scene& scene);

/// What a scene's cameras with `sensors` see, each at its own rate: /CAMERA/camera_info, and as
/// its sensors say /CAMERA/image, /CAMERA/depth_image, /CAMERA/points, /CAMERA/instances and
/// /CAMERA/classes. All in the frame CAMERA_optical_frame (x right, y down, z forward), which is in
/// /tf. Stamps are those of what is seen: a late camera's are in the past.
class CameraTopics : public TopicSource {
 public:
  /// All must outlive it.
  CameraTopics(const simulation::Simulation& simulation, TopicSink& sink, PictureTaker& taker);
  ~CameraTopics() override;
  void begin(double time) override;
  void after_step(double time) override;

 private:
  struct Camera;
  void take(Camera& camera, double time);

  const simulation::Simulation& simulation_;
  PictureTaker& taker_;
  SceneSensors sensors_;
  Teller<ros::TFMessage> frames_;
  std::vector<Camera> cameras_;
};

}  // namespace pedicel::app
