#include "app/topics/plant_topics.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/draw/drawing.h"
#include "app/draw/plant_drawing.h"

namespace pedicel::app {

namespace {

ros::ColorRGBA colour_of(const render::Colour& colour) {
  return {colour.r, colour.g, colour.b, 1.0F};
}

/// Whether there is anything to draw; where not, what was drawn before goes.
void finish(ros::Marker& marker) {
  if (marker.points.empty()) marker.action = ros::Marker::remove;
}

}  // namespace

MarkerTopics::MarkerTopics(const simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation),
      plants_(sink, "/plant", Delivery::reliable),
      bodies_(sink, "/bodies", Delivery::reliable) {}

ros::Marker MarkerTopics::marker(const std::string& ns, int id, std::int32_t type) const {
  ros::Marker one;
  one.header = {ros::stamp_of(time_), world_frame};
  one.ns = ns;
  one.id = id;
  one.type = type;
  one.scale = {1.0, 1.0, 1.0};
  return one;
}

// One list of lines an organ: a list has one width.
void MarkerTopics::add_stems(int plant, ros::MarkerArray& all) const {
  const cosserat::RodModel& model = simulation_.rods().model(plant);
  const cosserat::RodState& state = simulation_.rods().state(plant);
  const PlantLook look = PlantLook::of(simulation_.plants()[plant].look);
  const std::size_t first = all.markers.size();
  std::vector<double> length(model.organs.size(), 0.0), area(model.organs.size(), 0.0);
  for (std::size_t o = 0; o < model.organs.size(); ++o) {
    all.markers.push_back(
        marker(model.name + "/stems", static_cast<int>(o), ros::Marker::line_list));
    all.markers.back().color = colour_of(look.stem.colour);
  }
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    const cosserat::Element& element = model.elements[e];
    ros::Marker& lines = all.markers[first + static_cast<std::size_t>(element.organ)];
    lines.points.push_back(point_of(start_of(model, state, e)));
    lines.points.push_back(point_of(state.position[e]));
    length[element.organ] += element.length;
    area[element.organ] += element.length * (element.radius_near + element.radius_far);
  }
  for (std::size_t o = 0; o < model.organs.size(); ++o) {
    ros::Marker& lines = all.markers[first + o];
    if (length[o] > 0.0) lines.scale.x = area[o] / length[o];
    finish(lines);
  }
}

void MarkerTopics::add_leaves(int plant, ros::MarkerArray& all) const {
  const simulation::PlantInfo& info = simulation_.plants()[plant];
  if (info.blades.empty()) return;
  const cosserat::RodModel& model = simulation_.rods().model(plant);
  const cosserat::RodState& state = simulation_.rods().state(plant);
  ros::Marker leaves = marker(model.name + "/leaves", 0, ros::Marker::triangle_list);
  leaves.color = colour_of(PlantLook::of(info.look).blade.colour);
  for (const simulation::Blade& blade : info.blades) {
    if (!std::ranges::all_of(blade, [&](const simulation::BladeCorner& corner) {
          return bool(state.alive[corner.element]);
        }))
      continue;
    for (const simulation::BladeCorner& corner : blade)
      leaves.points.push_back(point_of(point_on(model, state, corner.element, corner.back)));
  }
  finish(leaves);
  all.markers.push_back(std::move(leaves));
}

void MarkerTopics::add_fruits(int plant, ros::MarkerArray& all) const {
  const cosserat::RodModel& model = simulation_.rods().model(plant);
  const cosserat::RodState& state = simulation_.rods().state(plant);
  const PlantLook look = PlantLook::of(simulation_.plants()[plant].look);
  for (std::size_t f = 0; f < model.fruits.size(); ++f) {
    const cosserat::Fruit& fruit = model.fruits[f];
    ros::Marker ball = marker(model.name + "/fruits", static_cast<int>(f), ros::Marker::sphere);
    ball.color = colour_of(look.fruit.skin.colour);
    const double width = 2.0 * fruit.radius;
    ball.scale = {width, width, width};
    if (state.fruit_gone[f] || !state.alive[fruit.element])
      ball.action = ros::Marker::remove;
    else
      ball.pose = pose_of(
          {point_on(model, state, fruit.element, fruit.back), state.orientation[fruit.element]});
    all.markers.push_back(std::move(ball));
  }
}

// Each has as many places in every message, so that what lies between two can be shown.
void MarkerTopics::add_strings(ros::MarkerArray& all) const {
  const std::vector<simulation::SceneTies::One>& ties = simulation_.ties().all();
  for (std::size_t t = 0; t < ties.size(); ++t) {
    ros::Marker line = marker("ties", static_cast<int>(t), ros::Marker::line_strip);
    line.color = colour_of(twine);
    line.scale.x = 2.0 * string_radius;
    if (const auto course = simulation_.ties().course(ties[t]))
      for (const Vec3& place : string_course(course->from_W, course->to_W, course->length))
        line.points.push_back(point_of(place));
    finish(line);
    all.markers.push_back(std::move(line));
  }
}

ros::MarkerArray MarkerTopics::bodies(double) const {
  ros::MarkerArray all;
  const world::SimWorld& world = simulation_.world();
  for (int b = 0; b < world.body_count(); ++b) {
    const world::BodyDescription& body = world.body(b);
    if (body.look == "hidden") continue;
    for (std::size_t i = 0; i < body.parts.size(); ++i) {
      const world::BodyPart& part = body.parts[i];
      using Kind = world::BodyPart::Kind;
      const std::int32_t type = part.kind == Kind::box      ? ros::Marker::cube
                                : part.kind == Kind::sphere ? ros::Marker::sphere
                                                            : ros::Marker::cylinder;
      ros::Marker one = marker(body.name, static_cast<int>(i), type);
      one.color = colour_of(shading_of(body.look).colour);
      one.pose = pose_of(world.body_pose(b) * part.pose);
      const double width = 2.0 * part.radius;
      if (part.kind == Kind::box)
        one.scale = vector_of(2.0 * part.half_extents);
      else
        one.scale = {width, width, part.kind == Kind::sphere ? width : part.length};
      all.markers.push_back(std::move(one));
    }
  }
  return all;
}

void MarkerTopics::tell(double time) {
  time_ = time;
  ros::MarkerArray all;
  for (int p = 0; p < simulation_.rods().size(); ++p) {
    add_stems(p, all);
    add_leaves(p, all);
    add_fruits(p, all);
  }
  add_strings(all);
  if (!all.markers.empty()) plants_.tell(time, all);
  if (const ros::MarkerArray things = bodies(time); !things.markers.empty())
    bodies_.tell(time, things);
}

OrganTopic::OrganTopic(const simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation),
      layout_(simulation),
      forces_(sink, "/organ_forces", Delivery::sensor) {
  for (const simulation::Quantity& one : simulation::quantities()) {
    std::istringstream names{std::string(one.topic)};
    told_.push_back({one, {std::istream_iterator<std::string>(names), {}}});
  }
}

ros::InterfaceValue OrganTopic::told_of(const simulation::Row& row, simulation::Rows kind) const {
  ros::InterfaceValue all;
  for (const auto& [quantity, names] : told_) {
    if (quantity.rows != kind || names.empty()) continue;
    all.interface_names.insert(all.interface_names.end(), names.begin(), names.end());
    all.values.resize(all.interface_names.size());
    quantity.read(row, &all.values.end()[-quantity.columns]);
  }
  return all;
}

// What is not touched and cannot come off is not told.
void OrganTopic::tell(double time) {
  ros::DynamicJointState all;
  all.header = {ros::stamp_of(time), world_frame};
  for (const simulation::Rows kind : {simulation::Rows::organ, simulation::Rows::fruit})
    simulation::each_row(simulation_, layout_, kind, [&](const simulation::Row& row, int number) {
      ros::InterfaceValue told = told_of(row, kind);
      if (std::ranges::all_of(told.values, [](double value) { return value == 0.0; })) return;
      all.joint_names.push_back(layout_.of(kind)[static_cast<std::size_t>(number)]);
      all.interface_values.push_back(std::move(told));
    });
  forces_.tell(time, all);
}

EventTopic::EventTopic(const simulation::Simulation& simulation, TopicSink& sink)
    : simulation_(simulation), events_(sink, "/events", Delivery::reliable) {}

void EventTopic::begin(double) {
  told_ = simulation_.plant_step().detached().size();
}

void EventTopic::after_step(double time) {
  const auto& all = simulation_.plant_step().detached();
  for (; told_ < all.size(); ++told_) {
    const simulation::Detached& one = all[told_];
    const nlohmann::ordered_json event = {
        {"time", one.event.time},     {"event", "detached"},
        {"what", one.fruit},          {"by", ""},
        {"cause", one.event.cause},   {"stretch", one.event.stretch},
        {"bend_rad", one.event.bend}, {"force_N", one.event.force}};
    events_.tell(time, {event.dump()});
  }
}

}  // namespace pedicel::app
