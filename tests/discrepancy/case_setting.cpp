#include "tests/discrepancy/case_setting.h"

#include <cmath>

namespace pedicel::hidden {

namespace {

using reference::HoldPlan;
using reference::Rows;
using reference::TrialPlan;

plant::PlantCurve curve(const std::string& name, std::vector<Vec3> points,
                        std::vector<double> radius) {
  plant::PlantCurve c;
  c.name = name;
  c.points = std::move(points);
  c.radius = std::move(radius);
  return c;
}

plant::PlantFile plant_of(const std::string& name, double E, double density, double damping_time,
                          double distance) {
  plant::PlantFile p;
  p.name = name;
  p.shape = plant::Shape::rest;
  p.material = {E, 0.35, density, damping_time};
  p.connect = 0.005;
  p.distance = distance;
  return p;
}

void mark(Setting& s, const std::string& name, std::initializer_list<double> places) {
  for (const double at : places)
    s.markers.push_back({"m" + std::to_string(s.markers.size() + 1), {name, at, {}}});
}

Setting single_stem(Random& random) {
  Setting s;
  const double L = 0.5 * random.uniform(0.9, 1.1);
  s.plant = plant_of("single stem", 5e8 * random.uniform(0.8, 1.25), 750, 0.003, L / 25);
  s.plant.curves = {
      curve("stem", {{0, 0, 0}, {0.01, 0.005, L / 2}, {0.04, 0.005, L}}, {0.004, 0.0035, 0.003})};
  s.hold = {"stem", 0.8, {}};
  s.reach = L;
  return s;
}

Setting stiff_stem(Random& random) {
  Setting s;
  const double L = 0.7 * random.uniform(0.9, 1.1);
  s.plant = plant_of("stiff stem", 4e9 * random.uniform(0.8, 1.25), 900, 0.001, L / 25);
  s.plant.curves = {
      curve("stem", {{0, 0, 0}, {0, 0, L / 2}, {0.01, 0, L}}, {0.005, 0.0045, 0.0035})};
  s.hold = {"stem", 0.75, {}};
  s.reach = L;
  return s;
}

Setting two_branches(Random& random) {
  Setting s;
  const double L = 0.5 * random.uniform(0.9, 1.1), b = 0.16 * random.uniform(0.9, 1.1);
  s.plant = plant_of("stem with two branches", 6e8 * random.uniform(0.8, 1.25), 700, 0.003, L / 16);
  s.plant.shape = plant::Shape::drawn;
  const Vec3 low(0.004, 0.004, 0.4 * L), high(0.01, 0.005, 0.65 * L);
  s.plant.curves = {
      curve("stem", {{0, 0, 0}, low, high, {0.022, 0.004, L}}, {0.0042, 0.0037, 0.0034, 0.003}),
      curve("branch_1", {low, low + b * Vec3(0.25, 0.42, 0.24), low + b * Vec3(0.5, 0.85, 0.44)},
            {0.0025, 0.002, 0.0015}),
      curve("branch_2", {high, high + b * Vec3(-0.48, 0, 0.2), high + b * Vec3(-0.97, 0.02, 0.36)},
            {0.0025, 0.002, 0.0015})};
  s.hold = {"stem", 0.8, {}};
  s.reach = L;
  return s;
}

Setting side_branch(Random& random) {
  Setting s;
  const double L = 0.3 * random.uniform(0.9, 1.1), b = 0.35 * random.uniform(0.9, 1.1);
  s.plant = plant_of("stem with a drooping branch", 1e9, 800, 0.002, (L + b) / 25);
  const Vec3 foot(0, 0, 0.7 * L);
  s.plant.curves = {
      curve("stem", {{0, 0, 0}, foot, {0, 0, L}}, {0.005, 0.0047, 0.004}),
      curve("branch", {foot, foot + b * Vec3(0.5, 0, 0.2), foot + b * Vec3(1, 0, 0.32)},
            {0.0028, 0.0023, 0.0018})};
  s.plant.curves[1].material.youngs_modulus = 3e8 * random.uniform(0.8, 1.25);
  s.plant.curves[1].material.damping_time = 0.004;
  s.hold = {"branch", 0.7, {}};
  s.reach = b;
  return s;
}

// 0 to 1 with no kink: its first two derivatives vanish at both ends.
double ease(double u) {
  if (u <= 0.0 || u >= 1.0) return u <= 0.0 ? 0.0 : 1.0;
  return u * u * u * (10 - 15 * u + 6 * u * u);
}

template <class Shift>
Rows rows(const Vec3& start, double until, double interval, const Shift& shift) {
  Rows r;
  for (int i = 0; i <= std::lround(until / interval); ++i) {
    r.time.push_back(i * interval);
    r.position.push_back(start + shift(i * interval));
  }
  return r;
}

HoldPlan held(const Setting& s, Rows path) {
  HoldPlan hold;
  hold.place = s.hold;
  hold.path = std::move(path);
  hold.stiffness = 150.0;
  return hold;
}

TrialPlan release(const Setting& s, const Vec3& start, const std::string& name, const Vec3& pull) {
  TrialPlan t;
  t.name = name;
  HoldPlan hold = held(
      s, rows(start, 1.0, t.interval, [&](double time) { return Vec3(ease(time / 0.8) * pull); }));
  hold.release = 1.0;
  t.holds = {hold};
  return t;
}

// Up in three steps and down again.
TrialPlan weights(const plant::CurvePlace& place, const std::string& name, const Vec3& most) {
  TrialPlan t;
  t.name = name;
  const double share[] = {0.33, 0.67, 1.0, 0.67, 0.33};
  for (int i = 0; i < 5; ++i)
    t.loads.push_back({place, share[i] * most, 0.4 + 0.8 * i, 0.4 + 0.8 * (i + 1)});
  return t;
}

TrialPlan push(const Setting& s, const Vec3& start, const std::string& name, const Vec3& far,
               double ramp) {
  TrialPlan t;
  t.name = name;
  t.measures_force = true;
  t.holds = {held(s, rows(start, t.duration, t.interval, [&](double time) {
                    return Vec3((ease((time - 0.2) / ramp) - ease((time - 4.6 + ramp) / ramp)) *
                                far);
                  }))};
  return t;
}

// The foot swings from slow to fast: phase 2 pi (f0 t + (f1 - f0) t^2 / 2T), eased in and out.
TrialPlan sweep(const std::string& name, const Vec3& amplitude, double from, double to) {
  TrialPlan t;
  t.name = name;
  t.interval = 0.01;
  t.base = rows(Vec3::Zero(), t.duration, t.interval, [&](double time) {
    const double phase = 2 * M_PI * (from * time + 0.5 * (to - from) * time * time / 4.5);
    return Vec3(ease(time / 0.5) * ease((4.5 - time) / 0.5) * std::sin(phase) * amplitude);
  });
  return t;
}

// Pulled, let go, and in mid swing when the record begins; a weight hangs on it for a while, so
// that the record holds a force.
TrialPlan swing(const Setting& s, const Vec3& start, const std::string& name, const Vec3& pull,
                double begins, const Vec3& weight) {
  TrialPlan t = release(s, start, name, pull);
  t.begins = begins;
  t.loads = {{s.tip, weight, 3.0, 4.0}};
  return t;
}

// A probe on a slide; one that only pushes comes from `gap` (m) beside the stem and goes back.
TrialPlan probe(const Setting& s, const Vec3& start, const std::string& name, const Vec3& far,
                double gap, double ramp) {
  TrialPlan t;
  t.name = name;
  t.measures_force = true;
  const Vec3 axis = far.normalized() + Vec3::Zero();  // no zero with a sign
  const Vec3 back = gap * axis;
  t.holds = {held(s, rows(start - back, t.duration, t.interval, [&](double time) {
                    return Vec3((ease((time - 0.2) / ramp) - ease((time - 4.6 + ramp) / ramp)) *
                                (far + back));
                  }))};
  t.holds[0].axes = {axis};
  t.holds[0].one_sided = gap > 0.0;
  return t;
}

TrialPlan on_plate(TrialPlan t) {
  t.measures_force = false;
  t.measures_wrench = true;
  return t;
}

// Led from deflection to deflection; `load` (N) hangs at the tip all the time.
TrialPlan deflections(const Setting& s, const Vec3& start, const std::string& name,
                      const Vec3& most, const Vec3& load) {
  TrialPlan t;
  t.name = name;
  t.is_static = true;
  t.measures_force = true;
  t.interval = 1.0;
  t.duration = 11.0;
  t.holds = {held(s, rows(start, t.duration, t.interval,
                          [&](double row) { return Vec3(row / t.duration * most); }))};
  if (!load.isZero(0.0)) t.loads = {{s.tip, load}};
  return t;
}

}  // namespace

const char* name_of(PlantKind kind) {
  constexpr const char* names[] = {"stem", "two_branches", "side_branch", "stiff_stem"};
  return names[static_cast<int>(kind)];
}

const char* name_of(PackKind kind) {
  constexpr const char* names[] = {"release", "weights", "push",  "sweep",  "mix",
                                   "moving",  "pusher",  "plate", "planar", "rest"};
  return names[static_cast<int>(kind)];
}

bool as_people_make_them(PackKind kind) {
  return kind >= PackKind::moving;
}

// The camera looks along y; every third marker is one of a laser that sees x alone.
bool measures_axis(PackKind kind, std::size_t marker, int axis) {
  if (kind != PackKind::planar) return true;
  return marker % 3 == 1 ? axis == 0 : axis != 1;
}

bool measures_force_axis(PackKind kind, int axis) {
  return kind != PackKind::planar || axis == 0;
}

Setting make_setting(PlantKind kind, Random& random) {
  Setting s = kind == PlantKind::stem           ? single_stem(random)
              : kind == PlantKind::stiff_stem   ? stiff_stem(random)
              : kind == PlantKind::two_branches ? two_branches(random)
                                                : side_branch(random);
  s.kind = kind;
  s.tip = {s.hold.curve, 1.0, {}};
  mark(s, "stem", {0.2, 0.4, 0.6, 0.8, 1.0});
  for (std::size_t c = 1; c < s.plant.curves.size(); ++c)
    mark(s, s.plant.curves[c].name, {0.1, 0.4, 0.7, 1.0});
  return s;
}

std::vector<TrialPlan> make_pack(PackKind kind, const Setting& s, const Vec3& start,
                                 double softness, double pause, Random& random) {
  const bool side = s.kind == PlantKind::side_branch;
  // Two directions across the stem, of which the branch is pulled along neither.
  const double turn = random.uniform(-0.3, 0.3), small = 0.035 * s.reach, large = 0.09 * s.reach;
  const Vec3 across(-std::sin(turn), std::cos(turn), 0);
  const Vec3 other = side ? Vec3(0, 0.2, -1).normalized() : Vec3(std::cos(turn), std::sin(turn), 0);
  const double force = large / softness;
  std::vector<TrialPlan> pack;
  if (kind == PackKind::release)
    pack = {release(s, start, "release_1", large * other),
            release(s, start, "release_2", small * other),
            release(s, start, "release_3", large * across),
            release(s, start, "release_4", small * across)};
  if (kind == PackKind::weights)
    pack = {weights(s.tip, "weights_1", force * other), weights(s.tip, "weights_2", force * across),
            weights({s.tip.curve, 0.6, {}}, "weights_3", 1.5 * force * other)};
  if (kind == PackKind::push)
    pack = {push(s, start, "push_1", large * other, 1.5),
            push(s, start, "push_2", large * across, 0.5),
            push(s, start, "push_3", -large * other, 1.0)};
  if (kind == PackKind::sweep)
    pack = {sweep("sweep_1", Vec3(0.003, 0, 0), 1.0, 9.0),
            sweep("sweep_2", Vec3(0, 0.003, 0), 1.0, 9.0),
            sweep("sweep_3", Vec3(0.006, 0.006, 0), 0.5, 5.0)};
  if (kind == PackKind::mix)
    pack = {release(s, start, "release_1", large * other),
            release(s, start, "release_2", small * across),
            weights(s.tip, "weights_1", force * other),
            push(s, start, "push_1", large * across, 1.2)};
  if (kind == PackKind::moving)
    pack = {swing(s, start, "swing_1", large * other, 1.3, 0.5 * force * other),
            swing(s, start, "swing_2", 0.7 * large * across, 1.2, 0.5 * force * across),
            swing(s, start, "swing_3", -large * (other + across).normalized(), 1.4,
                  0.3 * force * other)};
  if (kind == PackKind::pusher)
    pack = {probe(s, start, "push_1", large * other, 0.3 * large, 1.5),
            probe(s, start, "push_2", large * across, 0.0, 0.6),
            probe(s, start, "push_3", -large * other, 0.2 * large, 1.0)};
  if (kind == PackKind::plate)
    pack = {on_plate(release(s, start, "release_1", large * other)),
            on_plate(push(s, start, "push_1", large * across, 0.6)),
            on_plate(push(s, start, "push_2", -large * other, 1.2))};
  if (kind == PackKind::planar)
    pack = {release(s, start, "release_1", large * other),
            weights(s.tip, "weights_1", force * other),
            push(s, start, "push_1", -large * other, 1.2)};
  if (kind == PackKind::rest)
    pack = {deflections(s, start, "rest_1", 1.3 * large * other, Vec3::Zero()),
            deflections(s, start, "rest_2", 1.3 * large * across, Vec3::Zero()),
            deflections(s, start, "rest_3", -1.3 * large * other, 0.5 * force * across)};
  for (std::size_t i = 0; i < pack.size(); ++i) pack[i].clock = pause * static_cast<double>(i);
  return pack;
}

// A cantilever swings like 0.2427 of its mass at its tip (k = 3EI/L^3, w = 1.8751^2 sqrt(EI/mL^4)).
std::vector<TrialPlan> first_mode_pack(const Setting& s, double softness) {
  double mass = 0.0;
  for (const reference::Segment& segment :
       reference::build_tree(s.plant, {}, {}, s.plant.distance).segments)
    mass += segment.mass;
  const double f = std::sqrt(1.0 / (softness * 0.2427 * mass)) / (2 * M_PI);
  return {sweep("sweep_1", Vec3(0.004, 0, 0), 0.8 * f, 1.2 * f),
          sweep("sweep_2", Vec3(0, 0.004, 0), 1.2 * f, 0.8 * f),
          sweep("sweep_3", Vec3(0.002, 0.002, 0), 0.9 * f, 1.1 * f)};
}

double tip_softness(const Setting& s) {
  const reference::Subject subject{s.plant, {}, {}};
  const reference::Mesh mesh{s.plant.distance, 0.004};
  TrialPlan trial;
  const Vec3 before = settled_point(subject, trial, s.tip, mesh);
  const double force = 1e-3;
  trial.loads = {{s.tip, Vec3(0, force, 0)}};
  return (settled_point(subject, trial, s.tip, mesh) - before).norm() / force;
}

}  // namespace pedicel::hidden
