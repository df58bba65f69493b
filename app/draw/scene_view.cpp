#include "app/draw/scene_view.h"

#include <algorithm>
#include <cstdio>

#include "app/draw/tint.h"
#include "plugins/simulation/place.h"

namespace pedicel::app {

SceneView::SceneView(const simulation::Simulation& simulation)
    : simulation_(simulation), things_(simulation) {
  plants_.reserve(simulation.plants().size());
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const simulation::PlantInfo& plant = simulation.plants()[p];
    plants_.emplace_back(simulation.rods().model(p), plant.blades,
                         tinted(PlantLook::of(plant.look), simulation.scene().look));
    label_plant(p);
  }
  if (simulation.robot()) links_ = robot_shapes(simulation.robot()->description());
}

void SceneView::label_plant(int plant) {
  const cosserat::RodModel& model = simulation_.rods().model(plant);
  std::vector<render::Label> organs, fruits;
  for (int o = 0; o < static_cast<int>(model.organs.size()); ++o)
    organs.push_back(things_.organ(plant, o));
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
    fruits.push_back(things_.fruit(plant, f));
  plants_.back().set_labels(std::move(organs), std::move(fruits));
}

void SceneView::fill(Frame& frame, bool strain) {
  frame.time = simulation_.world().time();
  if (frame.list.ground && simulation_.scene().ground)
    frame.list.ground->height = simulation_.scene().ground->height;
  for (std::size_t p = 0; p < plants_.size(); ++p)
    plants_[p].add_to(frame.list, simulation_.rods().state(static_cast<int>(p)),
                      strain ? std::optional(strain_scale_) : std::nullopt);
  for (const simulation::SceneTies::One& tie : simulation_.ties().all())
    if (const auto course = simulation_.ties().course(tie))
      add_string(frame.list, course->from_W, course->to_W, course->length, twine);
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const render::DrawList::Counts before = frame.list.counts();
    add_at(frame.list, links_[l], simulation_.robot()->link_pose(static_cast<int>(l)));
    frame.list.label_since(before, things_.link(static_cast<int>(l)));
  }
  frame.list.ground.reset();
  if (const auto& ground = simulation_.scene().ground) {
    frame.list.ground.emplace();
    frame.list.ground->height = ground->height;
    frame.list.ground->label = things_.ground();
  }
  add_bodies(frame.list);
  add_texts(frame, strain);
}

void SceneView::add_bodies(render::DrawList& list) {
  const world::SimWorld& world = simulation_.world();
  for (int b = static_cast<int>(bodies_.size()); b < world.body_count(); ++b) {
    bodies_.push_back(body_shape(world.body(b)));
    if (b < static_cast<int>(simulation_.scene().bodies.size()))
      bodies_.back().label_since({}, things_.body(b));
    for (const simulation::Detached& fruit : simulation_.plant_step().detached()) {
      if (fruit.body != b) continue;
      const double radius = simulation_.rods().model(fruit.plant).fruits[fruit.event.fruit].radius;
      bodies_.back() = fruit_shape(
          tinted(PlantLook::of(simulation_.plants()[fruit.plant].look), simulation_.scene().look)
              .fruit,
          fruit.event.fruit, radius, fruit.event.stub_length, fruit.event.stub_radius);
      label_fruit(bodies_.back(), fruit);
    }
  }
  for (int b = 0; b < world.body_count(); ++b) add_at(list, bodies_[b], world.body_pose(b));
}

/// The stub that came off with it goes on being its stalk.
void SceneView::label_fruit(render::DrawList& shape, const simulation::Detached& fruit) const {
  shape.label_since({}, things_.fruit(fruit.plant, fruit.event.fruit));
  const render::Label stub =
      things_.stub(simulation_.rods().model(fruit.plant), fruit.plant, fruit.event.fruit);
  for (render::Capsule& one : shape.capsules) one.label = stub;
  for (render::TubeSegment& one : shape.tubes) one.label = stub;
}

void SceneView::add_texts(Frame& frame, bool strain) const {
  char text[160];
  std::snprintf(text, sizeof text, "t = %.2f s", frame.time);
  frame.caption = text;
  double most = 0.0;
  std::string name;
  for (int p = 0; p < simulation_.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation_.rods().model(p);
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      const double used = cosserat::margin_used(model, simulation_.rods().state(p), f);
      if (used <= most) continue;
      most = used;
      name = simulation::fruit_name(model, f);
    }
  }
  if (most > 0.0) {
    std::snprintf(text, sizeof text, "  %s at %.0f %% of its threshold", name.c_str(),
                  100.0 * most);
    frame.caption += text;
  }
  const auto& detached = simulation_.plant_step().detached();
  if (!detached.empty()) {
    std::snprintf(text, sizeof text, "\n%s off at %.2f s (%s)", detached.back().fruit.c_str(),
                  detached.back().event.time, detached.back().event.cause.c_str());
    frame.caption += text;
  }
  if (strain) frame.legend = render::Legend{"surface strain", 0.0, strain_scale_, -1.0};
}

render::Camera SceneView::camera(const std::string& name, const Frame& frame) const {
  for (const world::SceneCamera& camera : simulation_.scene().cameras) {
    if (!name.empty() && camera.name != name) continue;
    const auto anchor = camera.follow.kind == world::Anchor::Kind::none
                            ? std::nullopt
                            : simulation::place_of(simulation_, camera.follow);
    return camera_of(camera, anchor.value_or(Vec3::Zero()));
  }
  return render::frame(frame.list.bounds());
}

}  // namespace pedicel::app
