#include "app/view/scene_marks.h"

#include <algorithm>
#include <array>

#include "app/session/live/organ_place.h"

namespace pedicel::app {

namespace {

using render::Colour;
using render::DrawList;

constexpr Colour chosen_colour = Colour::hex(0xffd24a), pointed_colour = Colour::hex(0xfff1c0);
constexpr render::Shading pull_arrow{Colour::hex(0xff8c1a), 0.5f, 0.3f};
constexpr render::Shading contact_arrow{Colour::hex(0x2a8be0), 0.5f, 0.3f};
constexpr render::Shading culprit_mark{Colour::hex(0xe0322d), 0.5f, 0.3f};

void add_rods(DrawList& list, const PlantSnapshot& plant) {
  const cosserat::RodModel& model = *plant.model;
  for (int e = 0; e < model.size(); ++e) {
    if (!plant.state.alive[e]) continue;
    const Vec3& end = plant.state.position[e];
    list.lines.push_back({start_of(model, plant.state, e), end, Colour::hex(0x1b2a3a), 2.0f});
    const double size = std::clamp(0.7 * model.elements[e].radius_far, 4e-4, 3e-3);
    list.spheres.push_back({end, size * 2.0, {Colour::hex(0x2f6fd0), 0.6f, 0.2f}});
  }
}

void add_contacts(DrawList& list, const Snapshot& snapshot) {
  for (const ContactSnapshot& contact : snapshot.contacts) {
    const double force = contact.force_W.norm();
    if (force < 1e-3) continue;
    // Square root: a light touch beside a firm grip can both be seen.
    const double length = 0.03 * std::sqrt(force);
    const Vec3 tip = contact.place_W;
    list.add_arrow(tip - length * contact.force_W / force, tip, 0.0012, contact_arrow);
  }
}

void add_pull(DrawList& list, const PullSnapshot& pull) {
  if (!pull.active) return;
  list.lines.push_back({pull.point_W, pull.target_W, pull_arrow.colour, 2.0f});
  list.spheres.push_back({pull.point_W, 0.004, pull_arrow});
  if ((pull.target_W - pull.point_W).norm() > 0.004)
    list.add_arrow(pull.point_W, pull.target_W, 0.0018, pull_arrow);
}

/// A ball at what is left of the stalk.
void add_breaks(DrawList& list, const Snapshot& snapshot) {
  for (const world::Event& event : recent_breaks(snapshot))
    if (const auto place = place_of_break(snapshot, event))
      list.spheres.push_back({*place, 0.006, culprit_mark});
}

void add_culprit(DrawList& list, const Snapshot& snapshot) {
  const int p = snapshot.culprit_plant, e = snapshot.culprit_element;
  if (p < 0 || e < 0 || p >= static_cast<int>(snapshot.plants.size())) return;
  const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(p)];
  if (e >= plant.state.size() || !plant.state.position[e].allFinite()) return;
  list.spheres.push_back({plant.state.position[e], 0.012, culprit_mark});
}

}  // namespace

std::vector<world::Event> recent_breaks(const Snapshot& snapshot) {
  constexpr double shown = 1.5;  // s, simulated
  constexpr std::size_t most = 6;
  std::vector<world::Event> recent;
  if (!snapshot.events) return recent;
  for (std::size_t i = snapshot.events->size(); i-- > 0 && recent.size() < most;)
    if (const world::Event& event = (*snapshot.events)[i]; snapshot.time - event.time <= shown)
      recent.push_back(event);
  return recent;
}

void add_axes(DrawList& list, const Pose& X_WF, double length) {
  constexpr std::array<Colour, 3> colours = {Colour::hex(0xd8342b), Colour::hex(0x37a837),
                                             Colour::hex(0x2b62d8)};
  for (int axis = 0; axis < 3; ++axis)
    list.lines.push_back({X_WF.position, X_WF * Vec3(length * Vec3::Unit(axis)),
                          colours[static_cast<std::size_t>(axis)], 2.5f});
}

void add_cage(DrawList& list, const Eigen::AlignedBox3d& box, const Colour& colour, float width) {
  using Corner = Eigen::AlignedBox3d::CornerType;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(corner & axis))
        list.lines.push_back({box.corner(static_cast<Corner>(corner)),
                              box.corner(static_cast<Corner>(corner | axis)), colour, width});
}

void add_marks(DrawList& list, const Snapshot& snapshot, const ViewState& view) {
  if (view.rods)
    for (const PlantSnapshot& plant : snapshot.plants) add_rods(list, plant);
  if (view.contacts) add_contacts(list, snapshot);
  if (view.frames) {
    for (const Pose& link : snapshot.robot.links) add_axes(list, link, 0.05);
    if (snapshot.robot.present) add_axes(list, snapshot.robot.tool, 0.08);
  }
  add_pull(list, snapshot.pull);
  add_breaks(list, snapshot);
  add_culprit(list, snapshot);
}

void add_selection(DrawList& list, const Eigen::AlignedBox3d& box, const Selection& selection,
                   bool chosen) {
  using Kind = Selection::Kind;
  if (box.isEmpty() || (selection.kind != Kind::fruit && selection.kind != Kind::link &&
                        selection.kind != Kind::body))
    return;
  add_cage(list, box, chosen ? chosen_colour : pointed_colour, chosen ? 1.8f : 1.0f);
}

}  // namespace pedicel::app
