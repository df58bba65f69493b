#include "app/topics/camera_topics.h"

#include <algorithm>
#include <optional>

#include "app/topics/camera_messages.h"

namespace pedicel::app {

bool has_sensing_camera(const world::Scene& scene) {
  return std::ranges::any_of(scene.cameras, [](const auto& one) { return !one.sensors.empty(); });
}

struct CameraTopics::Camera {
  Camera(const world::SceneCamera& camera, TopicSink& sink)
      : scene(camera),
        part(topic_part(camera.name)),
        frame(part + "_optical_frame"),
        info(sink, "/" + part + "/camera_info", Delivery::sensor) {
    const auto open = [&](auto& teller, world::Sensor sensor, const char* name) {
      if (wants(sensor)) teller.emplace(sink, "/" + part + "/" + name, Delivery::sensor);
    };
    open(image, world::Sensor::rgb, "image");
    open(depth, world::Sensor::depth, "depth_image");
    open(points, world::Sensor::points, "points");
    open(instances, world::Sensor::instances, "instances");
    open(classes, world::Sensor::classes, "classes");
  }
  bool wants(world::Sensor one) const { return std::ranges::count(scene.sensors, one) > 0; }

  const world::SceneCamera& scene;
  std::string part, frame;
  long taken = 0;
  double first = 0.0;  // s, of the simulation, when it was asked first
  Teller<ros::CameraInfo> info;
  std::optional<Teller<ros::Image>> image, depth, instances, classes;
  std::optional<Teller<ros::PointCloud2>> points;
};

CameraTopics::CameraTopics(const simulation::Simulation& simulation, TopicSink& sink,
                           PictureTaker& taker)
    : simulation_(simulation),
      taker_(taker),
      sensors_(simulation),
      frames_(sink, "/tf", Delivery::reliable) {
  for (const world::SceneCamera& one : simulation.scene().cameras)
    if (!one.sensors.empty()) cameras_.emplace_back(one, sink);
}

CameraTopics::~CameraTopics() = default;

void CameraTopics::begin(double time) {
  for (Camera& camera : cameras_) camera.first = time;
  after_step(time);
}

void CameraTopics::after_step(double time) {
  sensors_.remember();
  for (Camera& camera : cameras_)
    if (time >= camera.first + static_cast<double>(camera.taken) / camera.scene.rate - 1.0e-9)
      take(camera, time);
}

void CameraTopics::take(Camera& camera, double time) {
  ++camera.taken;
  SenseRequest request{camera.scene.name, {}, true, true};
  request.colours = camera.image || camera.points;
  const auto picture =
      sensors_.take(taker_, request, static_cast<std::uint64_t>(simulation_.scene().seed));
  if (!picture) return;
  const ros::Header header{ros::stamp_of(picture->time), camera.frame};
  frames_.tell(time,
               {{transform_of(picture->time, world_frame, camera.frame, picture->camera.pose)}});
  const auto tell = [&](auto& teller, auto message) {
    message.header = header;
    teller.tell(time, message);
  };
  tell(camera.info, camera_info_of(picture->camera));
  if (camera.image) tell(*camera.image, image_of(picture->image));
  if (camera.depth) tell(*camera.depth, depth_image_of(picture->map));
  if (camera.points) tell(*camera.points, points_of(*picture));
  if (camera.instances) tell(*camera.instances, mask_of(instance_mask(picture->map)));
  if (camera.classes) tell(*camera.classes, mask_of(class_mask(picture->map, sensors_.things())));
}

}  // namespace pedicel::app
