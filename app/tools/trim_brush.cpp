#include "app/tools/trim_brush.h"

#include <algorithm>

#include "app/session/live/organ_place.h"

namespace pedicel::app {

namespace {

using render::Colour;

constexpr Colour going = Colour::hex(0xf0402d);

double cross(const ImVec2& a, const ImVec2& b) {
  return static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
}
ImVec2 between(const ImVec2& a, const ImVec2& b) {
  return {b.x - a.x, b.y - a.y};
}

/// Where the line from c to d is crossed by that from a to b, as a fraction from c; nothing where
/// it is not.
std::optional<double> crossed(const ImVec2& a, const ImVec2& b, const ImVec2& c, const ImVec2& d) {
  const ImVec2 brush = between(a, b), stem = between(c, d), off = between(a, c);
  const double turn = cross(brush, stem);
  if (turn == 0.0) return {};
  const double along_brush = cross(off, stem) / turn, along_stem = cross(off, brush) / turn;
  if (along_brush < 0.0 || along_brush > 1.0 || along_stem < 0.0 || along_stem > 1.0) return {};
  return along_stem;
}

}  // namespace

void TrimBrush::begin(const ImVec2& at) {
  clear();
  last_ = at;
  way_ = {at};
}

void TrimBrush::clear() {
  cuts_.clear();
  way_.clear();
}

void TrimBrush::add(const StemHit& place) {
  const auto held = std::ranges::find_if(cuts_, [&](const StemHit& one) {
    return one.plant == place.plant && one.stem == place.stem;
  });
  if (held == cuts_.end())
    cuts_.push_back(place);
  else if (place.from_foot < held->from_foot)
    *held = place;
}

void TrimBrush::cut(const StemHit& place) {
  cuts_ = {place};
}

void TrimBrush::extend(const Ui& ui, const SceneFrame& frame, const ImVec2& to) {
  if (to.x == last_.x && to.y == last_.y) return;
  for (std::size_t p = 0; p < ui.snapshot->plants.size(); ++p) {
    const PlantSnapshot& plant = ui.snapshot->plants[p];
    for (int e = 0; e < plant.model->size(); ++e) {
      if (!plant.state.alive[e]) continue;
      const Vec3 near = start_of(*plant.model, plant.state, e), far = plant.state.position[e];
      const auto a = frame.project(near), b = frame.project(far);
      if (!a || !b) continue;
      const auto along = crossed(last_, to, *a, *b);
      if (!along) continue;
      Selection hit;
      hit.kind = Selection::Kind::element;
      hit.plant = static_cast<int>(p), hit.element = e;
      hit.back = (1.0 - *along) * plant.model->elements[static_cast<std::size_t>(e)].length;
      hit.place_W = near + *along * (far - near);
      if (const auto place = stem_hit(ui, hit)) add(*place);
    }
  }
  last_ = to;
  way_.push_back(to);
}

/// A stem that another cut has taken with it is no longer there to be cut.
void TrimBrush::apply(Ui& ui) {
  if (cuts_.empty()) {
    ui.say("Nothing was cut: draw across a stem, or click on one");
    return clear();
  }
  ui.session.begin_gesture();
  for (const StemHit& cut : cuts_) {
    const plant::PlantFile* file = plant_file(ui.session, cut.plant);
    if (file && file->curve_index(cut.stem) >= 0)
      ui.run(Command("trim stem", {{"plant", cut.plant}, {"stem", cut.stem}, {"at", cut.at}}));
  }
  ui.session.end_gesture();
  ui.selection = {};
  clear();
}

void TrimBrush::add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  for (std::size_t i = 1; i < way_.size(); ++i) {
    const geometry::Ray a = frame.ray(way_[i - 1]), b = frame.ray(way_[i]);
    const double near = 2.0 * frame.camera.near_plane;  // in front of everything
    list.lines.push_back(
        {a.origin + near * a.direction, b.origin + near * b.direction, going, 2.0f});
  }
  for (const StemHit& cut : cuts_) {
    list.spheres.push_back({cut.now_W,
                            4.0 * frame.angle(1.0) * (cut.now_W - frame.camera.eye).norm(),
                            {going, 0.5f, 0.2f}});
    add_beyond(list, *ui.snapshot, cut);
  }
}

void add_beyond(render::DrawList& list, const Snapshot& snapshot, const StemHit& place) {
  const auto from = find_organ(snapshot, place.plant + "/" + place.stem, place.from_foot);
  if (!from) return;
  const PlantSnapshot& plant = snapshot.plants[static_cast<std::size_t>(from->plant)];
  std::vector<char> beyond(plant.model->elements.size(), 0);
  for (int e = 0; e < plant.model->size(); ++e) {
    const int parent = plant.model->elements[static_cast<std::size_t>(e)].parent;
    const auto i = static_cast<std::size_t>(e);
    beyond[i] = e == from->element || (parent >= 0 && beyond[static_cast<std::size_t>(parent)]);
    if (!beyond[i] || !plant.state.alive[e]) continue;
    const cosserat::Element& element = plant.model->elements[i];
    const Vec3 start = e == from->element ? place.now_W : start_of(*plant.model, plant.state, e);
    // A little thicker than the stem, else it would be hidden in it.
    const auto skin = [](double radius) { return 1.15 * radius + 6e-4; };
    list.capsules.push_back({start,
                             plant.state.position[e],
                             skin(element.radius_near),
                             skin(element.radius_far),
                             {going, 0.6f, 0.2f}});
  }
}

}  // namespace pedicel::app
