#include "app/topics/frame_topics.h"

#include "plugins/simulation/instrument.h"

namespace pedicel::app {

FrameTopics::FrameTopics(const simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation),
      moving_(sink, "/tf", Delivery::reliable),
      fixed_(sink, "/tf_static", Delivery::latched) {
  if (const simulation::RobotControl* robot = simulation.robot())
    for (const robot::Link& link : robot->description().links) links_.insert(link.name);
  add_organs();
}

void FrameTopics::add_organs() {
  const cosserat::RodSystem& rods = simulation_.rods();
  std::size_t fruits = 0, organs = 0;
  for (int p = 0; p < rods.size(); ++p) {
    fruits += rods.model(p).fruits.size();
    organs += rods.model(p).organs.size();
  }
  for (int p = 0; p < rods.size(); ++p) {
    const cosserat::RodModel& model = rods.model(p);
    for (int f = 0; f < static_cast<int>(model.fruits.size()) && fruits <= most_organs; ++f)
      on_plants_.push_back(
          {p, model.fruits[f].element, model.fruits[f].back, f, simulation::fruit_name(model, f)});
    if (organs > most_organs) continue;
    std::vector<int> last(model.organs.size(), -1);
    for (int e = 0; e < model.size(); ++e) last[model.elements[e].organ] = e;
    for (std::size_t o = 0; o < last.size(); ++o)
      if (last[o] >= 0) on_plants_.push_back({p, last[o], 0.0, -1, model.organs[o]});
  }
}

void FrameTopics::add_links(double time, bool moving, ros::TFMessage& frames) const {
  const simulation::RobotControl* robot = simulation_.robot();
  if (!robot) return;
  const robot::RobotDescription& description = robot->description();
  const std::vector<Pose>& poses = robot->link_poses();
  const auto root = static_cast<std::size_t>(description.root);
  if (!moving && description.links[root].name != world_frame)
    frames.transforms.push_back(
        transform_of(time, world_frame, description.links[root].name, poses[root]));
  for (const robot::Joint& joint : description.joints) {
    if (joint.moves() != moving) continue;
    const auto parent = static_cast<std::size_t>(joint.parent),
               child = static_cast<std::size_t>(joint.child);
    frames.transforms.push_back(transform_of(time, description.links[parent].name,
                                             description.links[child].name,
                                             poses[parent].inverse() * poses[child]));
  }
}

void FrameTopics::add_bodies(double time, ros::TFMessage& frames) {
  const world::SimWorld& world = simulation_.world();
  for (int b = static_cast<int>(body_frames_.size()); b < world.body_count(); ++b) {
    const std::string& name = world.body(b).name;
    body_frames_.push_back(links_.contains(name) ? "body/" + name : name);
  }
  for (int b = 0; b < world.body_count(); ++b)
    frames.transforms.push_back(transform_of(
        time, world_frame, body_frames_[static_cast<std::size_t>(b)], world.body_pose(b)));
}

void FrameTopics::begin(double time) {
  ros::TFMessage frames;
  add_links(time, false, frames);
  if (!frames.transforms.empty()) fixed_.tell(time, frames);
}

void FrameTopics::tell(double time) {
  ros::TFMessage frames;
  add_links(time, true, frames);
  add_bodies(time, frames);
  for (const OnPlant& one : on_plants_) {
    const cosserat::RodModel& model = simulation_.rods().model(one.plant);
    const cosserat::RodState& state = simulation_.rods().state(one.plant);
    if (!state.alive[one.element] || (one.fruit >= 0 && state.fruit_gone[one.fruit])) continue;
    const Pose pose{point_on(model, state, one.element, one.back), state.orientation[one.element]};
    frames.transforms.push_back(transform_of(time, world_frame, one.frame, pose));
  }
  for (const auto& one : simulation_.instruments())
    if (const auto pose = one->own_frame())
      frames.transforms.push_back(
          transform_of(time, world_frame, simulation::own_frame_name(one->scene()), *pose));
  if (!frames.transforms.empty()) moving_.tell(time, frames);
}

}  // namespace pedicel::app
