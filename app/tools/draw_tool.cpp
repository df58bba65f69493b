#include "app/tools/draw_tool.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/editors/stem_editor.h"
#include "app/session/live/organ_place.h"
#include "app/ui/widgets.h"
#include "app/view/picking.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/point_kind.h"

namespace pedicel::app {

namespace {

constexpr float point_reach = 7.0f;   // px
constexpr double organ_reach = 60.0;  // px, of an organ from the stem that it goes to

bool mouse_moved() {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  return moved.x != 0.0f || moved.y != 0.0f;
}

constexpr double shortest_stem = 0.004;  // m
constexpr double farthest = 5.0;         // m, of a stroke from its start
constexpr double nearest = 2e-4;         // m, of two places of a stroke

std::string unused_name(const Session& session, const std::string& plant,
                        const std::string& wanted) {
  const plant::PlantFile* file = plant_file(session, plant);
  return file ? plant::free_name(*file, wanted) : wanted;
}

std::string unused_plant(const Session& session) {
  std::string name = "plant";
  for (int i = 2; session.document().plant_index(name) >= 0; ++i)
    name = "plant_" + std::to_string(i);
  return name;
}

double length_of(const std::vector<plant::StrokeSample>& stroke) {
  double length = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i)
    length += (stroke[i].position - stroke[i - 1].position).norm();
  return length;
}

/// m, of the stem that a stroke begins on, there.
double radius_at(const Session& session, const StemHit& foot) {
  const auto curve = drawn_curve(session, foot.plant, foot.stem);
  return curve ? curve->radius(foot.at * curve->length()) : 0.0;
}

/// A branch is no thicker than what it grows from.
void keep_thinner(std::vector<double>& radius, double parent) {
  if (radius.empty() || !(parent > 0.0) || radius.front() <= parent) return;
  const double share = parent / radius.front();
  for (double& one : radius) one *= share;
}

ProjectorOptions projector_options(const DrawMode& d, double height) {
  ProjectorOptions options;
  const bool creeps = d.depth == DrawDepth::surface && !d.only_first;
  if (creeps)
    options.plane = StrokePlane::surface;
  else if (d.plane == PlaneChoice::ground)
    options.plane = StrokePlane::ground;
  else if (d.plane == PlaneChoice::tangent)
    options.plane = StrokePlane::tangent;
  else if (d.plane == PlaneChoice::view)
    options.plane = StrokePlane::view;
  options.only_first = d.only_first;
  options.offset = creeps ? d.offset : 0.0;
  options.ground = height;
  return options;
}

/// What a hand draws is no finer, and files are read by people: "0.0123", not 17 digits.
double to_micrometre(double value) {
  return std::round(1e6 * value) / 1e6 + 0.0;  // not -0
}
Vec3 to_micrometres(const Vec3& point) {
  return {to_micrometre(point.x()), to_micrometre(point.y()), to_micrometre(point.z())};
}

using render::Colour;

constexpr render::Shading snap{Colour::hex(0x39c46a), 0.5f, 0.3f};
constexpr render::Shading handle{Colour::hex(0xf4f6f8), 0.5f, 0.2f};
constexpr render::Shading chosen_handle{Colour::hex(0xffb020), 0.5f, 0.2f};
constexpr render::Shading node{Colour::hex(0x2f6fd0), 0.6f, 0.2f};
constexpr render::Shading radius_handle{Colour::hex(0x37b6d6), 0.5f, 0.2f};
constexpr render::Shading cut{Colour::hex(0xf0402d), 0.5f, 0.2f};
constexpr Colour line{Colour::hex(0xffffff)}, outline{Colour::hex(0x37b6d6)};

/// m, of a ball that covers so many pixels there.
double size_of(const SceneFrame& frame, const Vec3& place, double px) {
  return px * (place - frame.camera.eye).norm() / frame.camera.focal_length(frame.height());
}

void add_curve_line(render::DrawList& list, const geometry::Curve& curve, const Pose& pose) {
  const std::vector<double> arcs = curve.sample_arcs(std::max(curve.length() / 60.0, 1e-4));
  for (std::size_t i = 1; i < arcs.size(); ++i)
    list.lines.push_back(
        {pose * curve.point(arcs[i - 1]), pose * curve.point(arcs[i]), line, 1.5f});
}

/// The stem's edges in the picture, as it is drawn: they follow a dragged radius at once, before
/// the simulation has built the stem anew.
void add_outline(render::DrawList& list, const geometry::Curve& curve, const Pose& pose,
                 const SceneFrame& frame) {
  const std::vector<double> arcs = curve.sample_arcs(std::max(curve.length() / 60.0, 1e-4));
  for (const double side : {-1.0, 1.0}) {
    std::optional<Vec3> last;
    for (const double arc : arcs) {
      const Vec3 centre = pose * curve.point(arc);
      const Vec3 across = (pose.rotation * curve.tangent(arc)).cross(centre - frame.camera.eye);
      const Vec3 edge = centre + side * curve.radius(arc) * across.normalized();
      if (last) list.lines.push_back({*last, edge, outline, 1.0f});
      last = edge;
    }
  }
}

}  // namespace

bool DrawTool::update(Ui& ui, const SceneFrame& frame) {
  if (!ui.draw.on) {
    if (hand_ != Hand::idle) cancel(ui);
    foot_.reset();
    return false;
  }
  if (hand_ == Hand::idle) {
    foot_ = stem_hit(ui, ui.hover);
    const bool camera = ImGui::GetIO().KeyAlt || ImGui::GetIO().KeyCtrl;
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0) && !camera) press(ui, frame);
    return true;
  }
  drag(ui, frame);
  if (!ImGui::IsMouseDown(0)) release(ui);
  return true;
}

void DrawTool::press(Ui& ui, const SceneFrame& frame) {
  pressed_at_ = ImGui::GetIO().MousePos;
  travel_ = 0.0f;
  if (ui.draw.thing == DrawThing::trim) {
    hand_ = Hand::trim;
    trim_.begin(pressed_at_);
    return;
  }
  if (ui.draw.thing == DrawThing::tie) {
    if (tie_.begin(ui)) hand_ = Hand::tie;
    return;
  }
  if (press_handle(ui, frame)) return;
  if (point_ = point_under(ui, frame); point_ >= 0) {
    choose_point(ui, point_);
    hand_ = Hand::point;
    ui.session.begin_gesture();
    return;
  }
  if (press_organ(ui, frame)) return;
  if (foot_ && ImGui::GetIO().KeyShift) {
    if (ui.run(Command("insert point",
                       {{"plant", foot_->plant}, {"stem", foot_->stem}, {"at", foot_->at}})))
      choose_curve(ui, foot_->plant, foot_->stem);
    return;
  }
  if (ui.draw.thing == DrawThing::stem) return begin_stroke(ui, frame);
  if (foot_)
    put_organ(ui, *foot_);
  else
    ui.say("Click on a stem to put it there");
}

void DrawTool::drag(Ui& ui, const SceneFrame& frame) {
  ImGuiIO& io = ImGui::GetIO();
  travel_ =
      std::max(travel_, std::hypot(io.MousePos.x - pressed_at_.x, io.MousePos.y - pressed_at_.y));
  switch (hand_) {
    case Hand::idle:
      break;
    case Hand::stroke:
      thicken(io.MouseWheel);
      io.MouseWheel = 0.0f;  // not the camera's now
      extend_stroke(ui, frame);
      break;
    case Hand::point:
      move_point(ui, frame);
      break;
    case Hand::radius:
      move_radius(ui);
      break;
    case Hand::organ:
      move_organ(ui, frame);
      break;
    case Hand::trim:
      trim_.extend(ui, frame, io.MousePos);
      break;
    case Hand::tie:
      tie_.lead(ui, frame, io.MousePos);
      break;
  }
}

void DrawTool::release(Ui& ui) {
  constexpr float click_reach = 4.0f;  // px, that a hand may slip in a click
  const ImVec2 at = ImGui::GetIO().MousePos;
  const bool click = travel_ < click_reach * ui.scale;
  if (hand_ == Hand::stroke && click) {
    stroke_.clear();
    if (foot_) choose_curve(ui, foot_->plant, foot_->stem);
  } else if (hand_ == Hand::stroke) {
    end_stroke(ui);
  } else if (hand_ == Hand::trim) {
    if (foot_ && click) trim_.cut(*foot_);
    trim_.apply(ui);
  } else if (hand_ == Hand::tie) {
    tie_.apply(ui);
  } else {
    ui.session.end_gesture();
    // The rods of a leaf that was moved have other numbers.
    const bool moved = at.x != pressed_at_.x || at.y != pressed_at_.y;
    if (hand_ == Hand::organ && moved && ui.selection.kind == Selection::Kind::element)
      ui.selection = {};
  }
  hand_ = Hand::idle;
}

std::string DrawTool::label(const Ui& ui) const {
  if (hand_ == Hand::stroke) {
    double length = 0.0;
    for (std::size_t i = 1; i < stroke_.size(); ++i)
      length += (stroke_[i].position - stroke_[i - 1].position).norm();
    std::string text = std::to_string(static_cast<int>(std::lround(1e3 * length))) + " mm";
    if (thickness_ != 1.0) text += ", " + number_text(thickness_, 3) + " times as thick";
    return text;
  }
  if (hand_ == Hand::radius) {
    std::string plant;
    const plant::PlantCurve* curve = chosen_curve(ui, plant);
    if (!curve || curve->radius.empty()) return "";
    const auto point = std::min(static_cast<std::size_t>(point_), curve->radius.size() - 1);
    return "radius " + number_text(1e3 * curve->radius[point], 3) + " mm";
  }
  if (hand_ == Hand::trim) {
    const std::size_t cuts = trim_.cuts().size();
    return cuts == 0 ? "" : std::to_string(cuts) + (cuts == 1 ? " stem" : " stems");
  }
  if (hand_ == Hand::tie) return tie_.label();
  if (hand_ == Hand::organ && foot_)
    return foot_->stem + ", " + number_text(100.0 * foot_->at, 3) + " %";
  if (hand_ != Hand::idle || !foot_) return "";
  const char* verb = ui.draw.thing == DrawThing::trim ? "cuts " : "on ";
  return verb + foot_->plant + "/" + foot_->stem;
}

Vec3 DrawTool::label_place() const {
  if (hand_ == Hand::stroke && !stroke_.empty()) return stroke_.back().position;
  if (hand_ == Hand::radius) return handle_.surface;
  if (hand_ == Hand::trim && !trim_.cuts().empty()) return trim_.cuts().back().now_W;
  if (hand_ == Hand::tie) return tie_.place();
  return foot_ ? foot_->now_W : Vec3(Vec3::Zero());
}

bool DrawTool::thicken(double steps) {
  if (hand_ != Hand::stroke) return false;
  thickness_ = std::clamp(thickness_ * std::pow(1.1, steps), 0.1, 10.0);
  return true;
}

bool DrawTool::cancel(Ui& ui) {
  if (hand_ == Hand::idle) return false;
  if (hand_ == Hand::stroke)
    stroke_.clear();
  else if (hand_ == Hand::trim)
    trim_.clear();
  else if (hand_ == Hand::tie)
    tie_.clear();
  else
    ui.session.cancel_gesture();
  hand_ = Hand::idle;
  return true;
}

void DrawTool::choose_point(Ui& ui, int point) {
  stem_ = chosen_curve(ui, plant_)->name;
  ui.selection = {};
  ui.selection.kind = Selection::Kind::curve_point;
  ui.selection.plant_name = plant_, ui.selection.curve = stem_, ui.selection.point = point;
}

int DrawTool::point_under(const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return -1;
  const Pose pose = plant_pose(ui.session, plant);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  int best = -1;
  float least = point_reach * ui.scale;
  for (const plant::ControlPoint& one : plant::control_points(*curve)) {
    const auto at = frame.project(pose * curve->points[static_cast<std::size_t>(one.index)]);
    if (!at) continue;
    const float off = std::hypot(at->x - mouse.x, at->y - mouse.y);
    if (off < least) least = off, best = one.index;
  }
  return best;
}

bool DrawTool::press_handle(Ui& ui, const SceneFrame& frame) {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve || point_under(ui, frame) >= 0) return false;
  const auto found =
      handle_at(radius_handles(*curve, plant_pose(ui.session, plant), frame, ui.scale), pressed_at_,
                ui.scale);
  if (!found) return false;
  handle_ = *found;
  point_ = handle_.point;
  choose_point(ui, point_);
  hand_ = Hand::radius;
  ui.session.begin_gesture();
  return true;
}

void DrawTool::move_radius(Ui& ui) {
  if (!mouse_moved()) return;
  const double radius = handle_.dragged(pressed_at_, ImGui::GetIO().MousePos);
  ui.run(Command("set radius",
                 {{"plant", plant_}, {"stem", stem_}, {"radius", radius}, {"point", point_}}));
}

bool DrawTool::press_organ(Ui& ui, const SceneFrame& frame) {
  const auto organ = organ_of(ui, ui.hover);
  if (!organ) return false;
  const auto curve = drawn_curve(ui.session, organ->plant, organ->place.curve);
  if (!curve) return false;
  plant_ = organ->plant, organ_ = organ->name;
  const Pose pose = plant_pose(ui.session, plant_);
  const Vec3 drawn = pose * curve->point(organ->place.at * curve->length());
  // Where the drawing's place is in the simulation: near enough along the same rods.
  Vec3 now = drawn;
  if (const auto at =
          find_organ(*ui.snapshot, plant_ + "/" + organ->place.curve, organ->place.at)) {
    const PlantSnapshot& plant = ui.snapshot->plants[static_cast<std::size_t>(at->plant)];
    now = point_on(*plant.model, plant.state, at->element, at->back);
  }
  moved_ = now - drawn;
  const ImVec2 foot = frame.project(now).value_or(pressed_at_);
  grip_ = ImVec2(pressed_at_.x - foot.x, pressed_at_.y - foot.y);
  stems_.emplace(*plant_file(ui.session, plant_));
  foot_ = StemHit{plant_, organ->place.curve, organ->place.at, organ->place.at, drawn, now};
  ui.selection = ui.hover;
  hand_ = Hand::organ;
  ui.session.begin_gesture();
  return true;
}

/// Along the stem that the organ's foot is led over; it stays where it was while none is near.
void DrawTool::move_organ(Ui& ui, const SceneFrame& frame) {
  if (!mouse_moved()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const geometry::Ray ray = frame.ray(ImVec2(mouse.x - grip_.x, mouse.y - grip_.y));
  const Pose pose = plant_pose(ui.session, plant_), to_plant = pose.inverse();
  const auto place =
      stems_->under_ray(to_plant * Vec3(ray.origin - moved_), to_plant.rotation * ray.direction,
                        0.0, frame.angle(organ_reach * ui.scale));
  if (!place) return;
  const Vec3 drawn = pose * place->point;
  foot_ = StemHit{plant_, place->stem, place->at, place->at, drawn, drawn + moved_};
  ui.run(Command("move organ",
                 {{"plant", plant_}, {"name", organ_}, {"stem", place->stem}, {"at", place->at}}));
}

void DrawTool::move_point(Ui& ui, const SceneFrame& frame) {
  const plant::PlantFile* file = plant_file(ui.session, plant_);
  const int c = file ? file->curve_index(stem_) : -1;
  if (c < 0 || !mouse_moved() ||
      point_ >= static_cast<int>(file->curves[static_cast<std::size_t>(c)].points.size()))
    return;
  const Pose pose = plant_pose(ui.session, plant_);
  const Vec3 now =
      pose * file->curves[static_cast<std::size_t>(c)].points[static_cast<std::size_t>(point_)];
  const Vec3 view = frame.camera.target - frame.camera.eye;
  const DrawPlane plane = ui.draw.plane == PlaneChoice::ground    ? ground_plane(now.z())
                          : ui.draw.plane == PlaneChoice::upright ? upright_plane(view, now)
                                                                  : view_plane(view, now);
  if (const auto to = meet(frame.ray(ImGui::GetIO().MousePos), plane))
    ui.run(Command("move point", {{"plant", plant_},
                                  {"stem", stem_},
                                  {"point", point_},
                                  {"to", Vec3(pose.inverse() * *to)}}));
}

void DrawTool::remove_selected(Ui& ui) {
  std::string plant;
  if (const auto organ = organ_of(ui, ui.selection)) {
    if (ui.remove(Command("delete organ", {{"plant", organ->plant}, {"name", organ->name}})))
      ui.selection = {};
    return;
  }
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return;
  const std::string stem = curve->name;
  if (ui.selection.to_tip) {
    const auto place = stem_hit(ui, ui.selection);
    if (place &&
        ui.remove(Command("trim stem", {{"plant", plant}, {"stem", stem}, {"at", place->at}})))
      ui.selection = {};
  } else if (ui.selection.kind == Selection::Kind::curve_point) {
    if (ui.run(Command("delete point",
                       {{"plant", plant}, {"stem", stem}, {"point", ui.selection.point}})))
      choose_curve(ui, plant, stem);
  } else if (ui.remove(Command("delete stem", {{"plant", plant}, {"stem", stem}}))) {
    ui.selection = {};
  }
}

/// Its depth is that of the stem it begins on, of what lies under the pointer, or of the orbit's
/// centre.
void DrawTool::begin_stroke(Ui& ui, const SceneFrame& frame) {
  hand_ = Hand::stroke;
  thickness_ = 1.0;
  const Vec3 view = (frame.camera.target - frame.camera.eye).normalized();
  const Vec3 start = foot_                                 ? foot_->now_W
                     : ui.draw.depth == DrawDepth::surface ? ui.hover.place_W
                                                           : Vec3(frame.camera.target);
  const ProjectorOptions options = projector_options(ui.draw, start.z());
  surfaces_.reset();
  if (options.plane == StrokePlane::surface) surfaces_ = std::make_unique<Surfaces>(*ui.snapshot);
  projector_.emplace(options, view, surfaces_.get());
  projector_->set_fallback(start);
  if (foot_) {
    Vec3 along = Vec3::UnitZ();
    if (const auto curve = drawn_curve(ui.session, foot_->plant, foot_->stem))
      along = plant_pose(ui.session, foot_->plant).rotation *
              curve->tangent(foot_->at * curve->length());
    projector_->start_on_stem(foot_->now_W, along);
  }
  const auto first = projector_->place(frame.ray(ImGui::GetIO().MousePos));
  stroke_ = {{first.value_or(start), 1.0}};
}

void DrawTool::extend_stroke(const Ui&, const SceneFrame& frame) {
  const auto at = projector_->place(frame.ray(ImGui::GetIO().MousePos));
  if (!at || (*at - stroke_.front().position).norm() > farthest) return;
  if ((*at - stroke_.back().position).norm() > nearest) stroke_.push_back({*at, thickness_});
}

/// A stroke that starts on a stem becomes its branch; any other one the first stem of a plant of
/// its own. Points are moved by what the simulation has moved the foot from its drawing.
void DrawTool::end_stroke(Ui& ui) {
  const std::vector<plant::StrokeSample> stroke = std::move(stroke_);
  stroke_.clear();
  if (length_of(stroke) < shortest_stem) return;
  const DrawMode& d = ui.draw;
  const auto shape = shape_of(stroke, d);
  if (!shape) return;
  std::vector<Vec3> points = shape->points;
  std::vector<double> radius = shape->radius;
  if (foot_) keep_thinner(radius, radius_at(ui.session, *foot_));
  for (double& value : radius) value = std::max(to_micrometre(value), 1e-6);
  ui.session.begin_gesture();
  bool taken = true;
  std::string plant = foot_ ? foot_->plant : d.plant;
  const plant::PlantFile* file = plant_file(ui.session, plant);
  const Vec3 start = to_micrometres(points.front());
  if (!foot_) {
    if (!file || !file->curves.empty()) {
      plant = unused_plant(ui.session);
      taken = ui.run(Command("new plant", {{"plant", plant}, {"position", start}}));
    } else {
      taken = ui.run(Command("move plant", {{"plant", plant}, {"to", start}}));
    }
  }
  const Vec3 offset = foot_ ? Vec3(foot_->drawn_W - foot_->now_W) : Vec3(Vec3::Zero());
  const Pose to_plant = plant_pose(ui.session, plant).inverse();
  for (Vec3& point : points) point = to_micrometres(to_plant * Vec3(point + offset));
  const std::string stem = unused_name(ui.session, plant, foot_ ? "branch" : "stem");
  taken = taken && ui.run(Command(
                       "draw stem",
                       {{"plant", plant}, {"stem", stem}, {"points", points}, {"radius", radius}}));
  if (!taken) return ui.session.cancel_gesture();
  ui.session.end_gesture();
  ui.draw.plant = plant;
  // Not chosen: its points would be in the way of the next branch.
  ui.selection = {};
}

void DrawTool::put_organ(Ui& ui, const StemHit& place) {
  const DrawMode& d = ui.draw;
  const bool fruit = d.thing == DrawThing::fruit;
  const std::string name = unused_name(ui.session, place.plant, fruit ? "fruit" : "leaf");
  if (fruit)
    ui.run(Command("add fruit", {{"plant", place.plant},
                                 {"name", name},
                                 {"stem", place.stem},
                                 {"at", place.at},
                                 {"radius", d.fruit_radius},
                                 {"density", d.fruit_density},
                                 {"stretch", d.fruit_stretch},
                                 {"force", d.fruit_force}}));
  else
    ui.run(Command("add leaf", {{"plant", place.plant},
                                {"name", name},
                                {"stem", place.stem},
                                {"at", place.at},
                                {"size", d.leaf_size},
                                {"template", d.leaf_template}}));
}

void DrawTool::add_points(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  std::string plant;
  const plant::PlantCurve* curve = chosen_curve(ui, plant);
  if (!curve) return;
  const Pose pose = plant_pose(ui.session, plant);
  const auto drawn = drawn_curve(ui.session, plant, curve->name);
  if (drawn) add_curve_line(list, *drawn, pose);
  if (drawn && !curve->radius.empty()) add_outline(list, *drawn, pose, frame);
  const bool point_chosen = ui.selection.kind == Selection::Kind::curve_point;
  for (const plant::ControlPoint& one : plant::control_points(*curve)) {
    const Vec3 centre = pose * curve->points[static_cast<std::size_t>(one.index)];
    // In front of the stem, which would hide it.
    const double radius = drawn ? drawn->radius(drawn->control_arc(one.index)) : 0.0;
    const Vec3 place = centre + 1.3 * radius * (frame.camera.eye - centre).normalized();
    const bool is_chosen = point_chosen && ui.selection.point == one.index;
    const render::Shading& look = is_chosen ? chosen_handle : handle;
    const double size = size_of(frame, place, is_chosen ? 6.0 : 4.5);
    if (one.kind == plant::PointKind::smooth)
      list.spheres.push_back({place, size, look});
    else
      list.boxes.push_back({{place, Quat::Identity()}, Vec3::Constant(0.8 * size), look});
  }
  for (const RadiusHandle& one : radius_handles(*curve, pose, frame, ui.scale)) {
    const bool held = hand_ == Hand::radius && one.point == point_;
    list.spheres.push_back(
        {one.place, size_of(frame, one.place, 3.5), held ? chosen_handle : radius_handle});
    list.lines.push_back({one.surface, one.place, outline, 1.0f});
  }
}

/// The stem that the stroke would become, as a tube, and the nodes that `distance` would keep.
void DrawTool::add_stroke(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  const Vec3& start = stroke_.front().position;
  list.spheres.push_back({start, size_of(frame, start, 5.0), snap});
  const auto shape = shape_of(stroke_, ui.draw);
  if (!shape) return;
  const geometry::Curve curve = geometry::Curve::smooth(shape->points, shape->radius);
  std::vector<render::TubePoint> tube;
  for (const double arc : curve.sample_arcs(std::max(curve.length() / 80.0, 1e-3)))
    tube.push_back({curve.point(arc), curve.radius(arc), Colour::hex(0x8fc25a)});
  list.add_tube(tube);
  const plant::PlantFile* file = plant_file(ui.session, foot_ ? foot_->plant : ui.draw.plant);
  const double distance = file && file->distance > 0.0 ? file->distance : 0.02;
  const int nodes = std::min(200, static_cast<int>(curve.length() / distance));
  for (int i = 1; i <= nodes; ++i) {
    const double arc = i * distance;
    list.spheres.push_back(
        {curve.point(arc), std::max(1.25 * curve.radius(arc), size_of(frame, start, 2.5)), node});
  }
}

void DrawTool::add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const {
  if (!ui.draw.on) return;
  add_points(list, ui, frame);
  const bool cuts = ui.draw.thing == DrawThing::trim;
  if (foot_ && (hand_ == Hand::idle || hand_ == Hand::organ)) {
    list.spheres.push_back({foot_->now_W, size_of(frame, foot_->now_W, 6.0), cuts ? cut : snap});
    if (cuts) add_beyond(list, *ui.snapshot, *foot_);
  }
  if (hand_ == Hand::stroke && stroke_.size() > 1) add_stroke(list, ui, frame);
  if (hand_ == Hand::trim) trim_.add_to(list, ui, frame);
  if (hand_ == Hand::tie) tie_.add_to(list);
}

}  // namespace pedicel::app
