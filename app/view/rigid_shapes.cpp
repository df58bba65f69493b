#include "app/view/rigid_shapes.h"

#include "app/draw/drawing.h"

namespace pedicel::app {

namespace {

RigidShapes::Shape with_box(render::DrawList list) {
  list.ground.reset();
  const Eigen::AlignedBox3d box = list.bounds();
  return {std::move(list), box};
}

render::DrawList look_of(const BodyInfo& info, const simulation::SceneAssets& assets) {
  if (info.fruit < 0 || info.description.parts.empty()) return body_shape(info.description);
  const plant::Look look = assets.plants[static_cast<std::size_t>(info.plant)].look;
  return fruit_shape(FruitLook::of(look), info.fruit, info.description.parts.front().radius,
                     info.stub_length, info.stub_radius);
}

}  // namespace

void RigidShapes::follow(const Snapshot& snapshot) {
  if (assets_ != snapshot.assets) {
    assets_ = snapshot.assets;
    links_.clear();
    infos_.clear();
    if (assets_ && assets_->robot)
      for (render::DrawList& shape : robot_shapes(*assets_->robot))
        links_.push_back(with_box(std::move(shape)));
  }
  infos_.resize(snapshot.bodies.size());
  bodies_.resize(snapshot.bodies.size());
  for (std::size_t b = 0; b < infos_.size(); ++b) {
    if (infos_[b] == snapshot.bodies[b].info) continue;
    infos_[b] = snapshot.bodies[b].info;
    bodies_[b] = with_box(look_of(*infos_[b], *assets_));
  }
}

}  // namespace pedicel::app
