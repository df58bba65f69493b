#include "app/view/snapshot_view.h"

#include <algorithm>

#include "app/session/live/robot_goal.h"
#include "app/ui/selection_follow.h"
#include "app/view/scene_marks.h"
#include "engine/render/colormap.h"

namespace pedicel::app {

namespace {

using render::Colour;

Colour lighter(const Colour& colour, float share) {
  const auto mix = [share](float part, float to) { return part + share * (to - part); };
  return {mix(colour.r, 1.0f), mix(colour.g, 0.92f), mix(colour.b, 0.35f)};
}

/// The share of its threshold that each element's stalk has used; elements without fruit: 0.
std::vector<double> margins(const cosserat::RodModel& model, const PlantSnapshot& plant) {
  std::vector<double> used(model.elements.size(), 0.0);
  for (std::size_t f = 0; f < model.fruits.size() && f < plant.margin_used.size(); ++f)
    for (int e = model.fruits[f].element; e >= 0; e = model.elements[e].parent) {
      if (model.elements[e].organ != model.elements[model.fruits[f].element].organ) break;
      used[e] = std::max(used[e], plant.margin_used[f]);
    }
  return used;
}

std::vector<double> contact_forces(const Snapshot& snapshot, int plant, int elements) {
  std::vector<double> force(static_cast<std::size_t>(elements), 0.0);
  for (const ContactSnapshot& contact : snapshot.contacts)
    if (contact.plant == plant && contact.element < elements)
      force[static_cast<std::size_t>(contact.element)] += contact.force_W.norm();
  return force;
}

/// Of every element: whether it is chosen.
std::vector<bool> chosen_elements(const Selection& selection, const cosserat::RodModel& model,
                                  int plant) {
  std::vector<bool> chosen(model.elements.size(), false);
  if (selection.to_tip && selection.kind == Selection::Kind::element) {
    if (selection.plant != plant) return chosen;
    for (int e = selection.element; e >= 0 && e < model.size(); ++e) {
      const auto i = static_cast<std::size_t>(e);
      const int parent = model.elements[i].parent;
      chosen[i] =
          e == selection.element || (parent >= 0 && chosen[static_cast<std::size_t>(parent)]);
    }
    return chosen;
  }
  const int organ = chosen_organ(selection, model, plant);
  if (organ < 0) return chosen;
  for (std::size_t e = 0; e < chosen.size(); ++e) chosen[e] = model.elements[e].organ == organ;
  return chosen;
}

void highlight(std::vector<Colour>& colours, const cosserat::RodModel& model, int plant,
               const Selection& selection, const Selection& hover) {
  const std::vector<bool> chosen = chosen_elements(selection, model, plant);
  const std::vector<bool> pointed = chosen_elements(hover, model, plant);
  for (std::size_t e = 0; e < chosen.size(); ++e)
    if (chosen[e] || pointed[e]) colours[e] = lighter(colours[e], chosen[e] ? 0.75f : 0.4f);
}

}  // namespace

void SnapshotView::follow(const Snapshot& snapshot) {
  shapes_.follow(snapshot);
  plants_.resize(snapshot.plants.size());
  for (std::size_t p = 0; p < plants_.size(); ++p) {
    if (plants_[p].model == snapshot.plants[p].model) continue;
    const simulation::PlantInfo& info = snapshot.assets->plants[p];
    plants_[p] = {snapshot.plants[p].model, snapshot.assets,
                  std::make_unique<PlantDrawing>(*snapshot.plants[p].model, info.blades,
                                                 PlantLook::of(info.look))};
  }
}

std::vector<Colour> SnapshotView::colours(const Snapshot& snapshot, int plant,
                                          const ViewState& view) const {
  const PlantSnapshot& shown = snapshot.plants[static_cast<std::size_t>(plant)];
  const cosserat::RodModel& model = *shown.model;
  std::vector<Colour> result = plants_[static_cast<std::size_t>(plant)].drawing->plain_colours();
  std::vector<double> values;
  double scale = 1.0;
  if (view.colours == ColourMap::margin) values = margins(model, shown);
  if (view.colours == ColourMap::contact) {
    values = contact_forces(snapshot, plant, model.size());
    scale = view.contact_scale;
  }
  if (view.colours == ColourMap::strain) {
    scale = view.strain_scale;
    for (int e = 0; e < model.size(); ++e)
      values.push_back(shown.state.alive[e] ? simulation::surface_strain(model, shown.state, e)
                                            : 0.0);
  }
  if (view.colours == ColourMap::residual && plant == view.residual_plant &&
      static_cast<int>(view.residual.size()) == model.size()) {
    values = view.residual;
    scale = view.measured.residual_scale;
  }
  for (std::size_t e = 0; e < values.size(); ++e)
    result[e] = render::strain_colour(values[e] / scale);
  return result;
}

/// Of a program the end is shown only to who looks at the robot.
void SnapshotView::add_ghost(render::DrawList& list, const Snapshot& snapshot,
                             const ViewState& view) const {
  if (snapshot.robot.follows_program && !view.robot_panel) return;
  const std::optional<RobotGhost> ghost = robot_ghost(snapshot);
  if (!ghost) return;
  auto shape = std::make_shared<render::DrawList>();
  for (std::size_t l = 0; l < shapes_.links().size() && l < ghost->links.size(); ++l)
    add_at(*shape, shapes_.links()[l].list, ghost->links[l]);
  const Colour colour = !view.goal_hits.empty() ? Colour::hex(0xd92b2b)
                        : view.goal_missed      ? Colour::hex(0xe8622d)
                                                : Colour::hex(0x3d9be9);
  const auto tint = [&](auto& things) {
    for (auto& thing : things) thing.material.colour = colour;
  };
  tint(shape->capsules), tint(shape->spheres), tint(shape->boxes), tint(shape->meshes);
  list.ghost = std::move(shape);
}

void SnapshotView::fill(render::DrawList& list, const Snapshot& snapshot, const ViewState& view,
                        const Selection& selection, const Selection& hover) {
  list.ground.reset();
  if (!snapshot.assets) {
    list.ground.emplace();
    return;
  }
  follow(snapshot);
  if (const auto& ground = snapshot.assets->scene.ground) {
    list.ground.emplace();
    list.ground->height = ground->height;
  }
  for (int p = 0; p < static_cast<int>(plants_.size()); ++p) {
    if (view.hides_plants || p == view.hidden_plant) continue;
    const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(p)];
    std::vector<Colour> tints = colours(snapshot, p, view);
    highlight(tints, *plant.model, p, selection, hover);
    plants_[static_cast<std::size_t>(p)].drawing->add_to(list, plant.state, tints, view.leaves);
  }
  const std::vector<Pose>& links = view.links.empty() ? snapshot.robot.links : view.links;
  for (std::size_t l = 0; l < shapes_.links().size() && l < links.size(); ++l)
    add_at(list, shapes_.links()[l].list, links[l]);
  if (view.ghost) add_ghost(list, snapshot, view);
  for (std::size_t b = 0; b < snapshot.bodies.size(); ++b)
    add_at(list, shapes_.bodies()[b].list, snapshot.bodies[b].pose);
  const auto is_of = [](const Selection& s, const TieSnapshot& tie) {
    return s.kind == Selection::Kind::tie && s.tie == tie.number;
  };
  for (const TieSnapshot& tie : snapshot.ties) {
    const float share = is_of(selection, tie) ? 0.75f : is_of(hover, tie) ? 0.4f : 0.0f;
    add_string(list, tie.course.from_W, tie.course.to_W, tie.course.length, lighter(twine, share));
  }
  add_marks(list, snapshot, view);
  if (!hover.same_thing(selection))
    add_selection(list, bounds_of(hover, snapshot, shapes_), hover, false);
  add_selection(list, bounds_of(selection, snapshot, shapes_), selection, true);
}

Eigen::AlignedBox3d bounds_of(const Selection& s, const Snapshot& snapshot,
                              const RigidShapes& shapes) {
  using Kind = Selection::Kind;
  const auto at = [](const auto& all, int index) {
    return index >= 0 && index < static_cast<int>(all.size())
               ? &all[static_cast<std::size_t>(index)]
               : nullptr;
  };
  Eigen::AlignedBox3d box;
  const auto* shape = s.kind == Kind::link   ? at(shapes.links(), s.link)
                      : s.kind == Kind::body ? at(shapes.bodies(), s.body)
                                             : nullptr;
  if (shape && !shape->box.isEmpty()) {
    const Pose pose = s.kind == Kind::link ? snapshot.robot.links[static_cast<std::size_t>(s.link)]
                                           : snapshot.bodies[static_cast<std::size_t>(s.body)].pose;
    for (int corner = 0; corner < 8; ++corner)
      box.extend(pose * shape->box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  const PlantSnapshot* plant = at(snapshot.plants, s.plant);
  if (!plant) return box;
  if (s.kind == Kind::element) {
    const std::vector<bool> chosen = chosen_elements(s, *plant->model, s.plant);
    for (int e = 0; e < plant->model->size(); ++e)
      if (plant->state.alive[e] && chosen[static_cast<std::size_t>(e)]) {
        box.extend(plant->state.position[e]);
        box.extend(start_of(*plant->model, plant->state, e));
      }
  }
  if (s.kind != Kind::fruit || !at(plant->model->fruits, s.fruit) ||
      plant->state.fruit_gone[static_cast<std::size_t>(s.fruit)])
    return box;
  const cosserat::Fruit& fruit = plant->model->fruits[static_cast<std::size_t>(s.fruit)];
  const Vec3 centre = point_on(*plant->model, plant->state, fruit.element, fruit.back);
  box.extend(centre - Vec3::Constant(fruit.radius));
  box.extend(centre + Vec3::Constant(fruit.radius));
  return box;
}

}  // namespace pedicel::app
