#include "tests/discrepancy/reference_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/geometry/curve.h"
#include "tests/discrepancy/reference_rotation.h"
#include "tests/discrepancy/reference_section.h"

namespace pedicel::reference {

namespace {

using geometry::Curve;
using plant::Effect;
using plant::PlantFile;

/// A curve in the direction of growth, with the arcs (from its own base) where nodes must be.
struct Shoot {
  int curve = 0;
  bool reversed = false;
  int parent_shoot = -1;
  double parent_growth = 0.0;  // m from the parent's base
  std::vector<double> keys;    // m from its base, increasing once sorted
  std::vector<int> ends_at;    // the segment that ends at each of its nodes
  std::vector<double> nodes;   // m from its base
};

class Builder {
 public:
  Builder(const PlantFile& plant, const std::vector<Effect>& effects,
          const std::vector<plant::PlantMass>& masses, double spacing)
      : plant_(plant), effects_(plant.effects), masses_(masses), spacing_(spacing) {
    effects_.insert(effects_.end(), effects.begin(), effects.end());
    if (!plant.fruits.empty() || !plant.leaves.empty() || !plant.supports.empty())
      throw std::invalid_argument("the reference knows neither fruits nor leaves nor supports");
  }

  Tree build() {
    make_curves();
    connect();
    for (Shoot& shoot : shoots_) mesh(shoot);
    fill({}, {});
    if (plant_.shape == plant::Shape::drawn) stand_as_drawn();
    fill(effects_, masses_);
    for (const Effect& e : effects_) read_law(e);
    return std::move(tree_);
  }

 private:
  void make_curves() {
    for (const plant::PlantCurve& c : plant_.curves) {
      std::vector<double> radius = c.radius.empty() ? std::vector<double>{0.0} : c.radius;
      if (radius.size() == 1) radius.assign(c.points.size(), radius.front());
      curves_.push_back(c.interpolation == plant::Interpolation::linear
                            ? Curve::linear(c.points, radius)
                            : Curve::smooth(c.points, radius));
      tree_.curve_lengths.push_back(curves_.back().length());
    }
  }

  double arc(const Shoot& shoot, double growth) const {
    return shoot.reversed ? curves_[shoot.curve].length() - growth : growth;
  }

  // Breadth first: the curve end nearest to the root, then whatever ends near a curve that stands.
  void connect() {
    std::vector<bool> placed(curves_.size(), false);
    double best = std::numeric_limits<double>::infinity();
    Shoot first;
    for (std::size_t c = 0; c < curves_.size(); ++c)
      for (const bool reversed : {false, true}) {
        const Vec3 end = curves_[c].point(reversed ? curves_[c].length() : 0.0);
        if ((end - plant_.root).norm() >= best) continue;
        best = (end - plant_.root).norm();
        first.curve = static_cast<int>(c);
        first.reversed = reversed;
        tree_.root = end;
      }
    shoots_.push_back(first);
    placed[first.curve] = true;
    for (std::size_t s = 0; s < shoots_.size(); ++s)
      for (std::size_t c = 0; c < curves_.size(); ++c)
        if (!placed[c] && join(static_cast<int>(s), static_cast<int>(c))) placed[c] = true;
    if (std::count(placed.begin(), placed.end(), false))
      throw std::invalid_argument("a curve reaches no other");
    for (std::size_t s = 1; s < shoots_.size(); ++s)
      shoots_[shoots_[s].parent_shoot].keys.push_back(shoots_[s].parent_growth);
  }

  bool join(int s, int c) {
    const Shoot parent = shoots_[s];
    for (const bool reversed : {false, true}) {
      const Vec3 end = curves_[c].point(reversed ? curves_[c].length() : 0.0);
      const double growth = nearest(parent, end);
      if ((curves_[parent.curve].point(arc(parent, growth)) - end).norm() >= plant_.connect)
        continue;
      Shoot shoot;
      shoot.curve = c;
      shoot.reversed = reversed;
      shoot.parent_shoot = s;
      shoot.parent_growth = growth;
      shoots_.push_back(shoot);
      return true;
    }
    return false;
  }

  double nearest(const Shoot& shoot, const Vec3& point) const {
    const Curve& curve = curves_[shoot.curve];
    double best = 0.0, step = curve.length() / 512;
    const auto distance = [&](double growth) {
      return (curve.point(arc(shoot, std::clamp(growth, 0.0, curve.length()))) - point).norm();
    };
    for (int i = 0; i <= 512; ++i)
      if (distance(i * step) < distance(best)) best = i * step;
    for (; step > 1e-9; step *= 0.5)
      for (const double to : {best - step, best + step})
        if (distance(to) < distance(best)) best = to;
    return std::clamp(best, 0.0, curve.length());
  }

  // The segment that a shoot starts at the end of; its parent is meshed before it.
  int foot(const Shoot& shoot) const {
    if (shoot.parent_shoot < 0) return -1;
    const Shoot& parent = shoots_[shoot.parent_shoot];
    std::size_t best = 0;
    for (std::size_t i = 0; i < parent.nodes.size(); ++i)
      if (std::abs(parent.nodes[i] - shoot.parent_growth) <
          std::abs(parent.nodes[best] - shoot.parent_growth))
        best = i;
    return parent.ends_at[best];
  }

  void mesh(Shoot& shoot) {
    const double length = curves_[shoot.curve].length();
    std::vector<double> keys = shoot.keys;
    keys.insert(keys.end(), {0.0, length});
    std::sort(keys.begin(), keys.end());
    shoot.nodes = {0.0};
    for (std::size_t i = 1; i < keys.size(); ++i) {
      if (keys[i] - keys[i - 1] < 1e-4 * length) continue;
      const double from = shoot.nodes.back();
      const int parts =
          std::max(1, static_cast<int>(std::ceil((keys[i] - from) / spacing_ - 1e-9)));
      for (int k = 1; k <= parts; ++k) shoot.nodes.push_back(from + (keys[i] - from) * k / parts);
    }
    shoot.ends_at = {foot(shoot)};
    Vec3 start = shoot.parent_shoot < 0 ? tree_.root : far_end(shoot.ends_at.front());
    for (std::size_t i = 1; i < shoot.nodes.size(); ++i) {
      const Vec3 end = curves_[shoot.curve].point(arc(shoot, shoot.nodes[i]));
      add_segment(shoot, static_cast<int>(i), start, end);
      start = end;
    }
  }

  Vec3 far_end(int segment) const { return segment < 0 ? tree_.root : ends_[segment]; }

  void add_segment(Shoot& shoot, int node, const Vec3& start, const Vec3& end) {
    Segment s;
    s.parent = shoot.ends_at.back();
    s.length = (end - start).norm();
    s.curve = shoot.curve;
    s.arc_near = arc(shoot, shoot.nodes[node - 1]);
    s.arc_far = arc(shoot, shoot.nodes[node]);
    s.drawn = frame_along((end - start) / s.length, plant_.curves[s.curve].section.normal,
                          s.parent < 0 ? Quat::Identity() : tree_.segments[s.parent].drawn);
    const Quat from = s.parent < 0 ? Quat::Identity() : tree_.segments[s.parent].drawn;
    s.joint.rest = (from.conjugate() * s.drawn).normalized();
    shoot.ends_at.push_back(tree_.size());
    tree_.segments.push_back(s);
    ends_.push_back(end);
  }

  double material(int curve, std::optional<double> plant::MaterialValues::*value) const {
    const auto& own = plant_.curves[curve].material.*value;
    return own ? *own : (plant_.material.*value).value();
  }

  static bool concerns(const Effect& effect, const std::string& curve) {
    return !effect.place || effect.place->curve == curve;
  }

  // 1/E over the plain one between two arcs of a curve, with gradients and weak stretches.
  double softening(int curve, double from, double to, const std::vector<Effect>& effects) const {
    const std::string& name = plant_.curves[curve].name;
    const double low = std::min(from, to), high = std::max(from, to), all = curves_[curve].length();
    double soft = 1.0;
    for (const Effect& e : effects) {
      if (e.name == "youngs_modulus") soft /= e.number("factor");
      if (e.name == "stiffness_gradient" && concerns(e, name))
        soft /= 1.0 + e.number("gradient") * (0.5 * (low + high) / all - 0.5);
      if (e.name == "weak_segment" && concerns(e, name)) {
        const double centre = e.place->at * all, half = 0.5 * e.number("length");
        const double shared =
            std::max(0.0, std::min(high, centre + half) - std::max(low, centre - half));
        soft *= 1.0 + shared / (high - low) * (1.0 / e.number("factor") - 1.0);
      }
    }
    return soft;
  }

  // Compliance (rad/(N m)) of the half of a segment that is near to or far from its joint.
  Vec3 half_compliance(const Segment& s, bool near, const std::vector<Effect>& effects) const {
    const SectionValues v = values(s);
    const double middle = 0.5 * (s.arc_near + s.arc_far);
    const double soft = near ? softening(s.curve, s.arc_near, middle, effects)
                             : softening(s.curve, middle, s.arc_far, effects);
    return 0.5 * s.length * soft * Vec3(1.0 / v.bend1, 1.0 / v.bend2, 1.0 / v.twist);
  }

  SectionValues values(const Segment& s) const {
    const plant::PlantCurve& c = plant_.curves[s.curve];
    return section_values(c.section, curves_[s.curve].radius(0.5 * (s.arc_near + s.arc_far)),
                          material(s.curve, &plant::MaterialValues::youngs_modulus),
                          material(s.curve, &plant::MaterialValues::poisson_ratio),
                          material(s.curve, &plant::MaterialValues::density));
  }

  void fill(const std::vector<Effect>& effects, const std::vector<plant::PlantMass>& masses) {
    for (Segment& s : tree_.segments) {
      set_stiffness(s, effects);
      set_mass(s, effects);
    }
    for (const plant::PlantMass& m : plant_.masses) hang(m.place, m.mass);
    for (const plant::PlantMass& m : masses) hang(m.place, m.mass);
    for (const Effect& e : effects)
      if (e.name == "extra_mass") hang(*e.place, e.number("mass"));
  }

  void set_stiffness(Segment& s, const std::vector<Effect>& effects) {
    Vec3 compliance = half_compliance(s, true, effects);
    s.joint.length = 0.5 * s.length;
    if (s.parent >= 0) {
      compliance += half_compliance(tree_.segments[s.parent], false, effects);
      s.joint.length += 0.5 * tree_.segments[s.parent].length;
    }
    const std::string& name = plant_.curves[s.curve].name;
    Mat3 k = compliance.cwiseInverse().asDiagonal();
    double hinge = 0.0;
    s.joint.damping_time = material(s.curve, &plant::MaterialValues::damping_time);
    const bool first = s.parent < 0 || tree_.segments[s.parent].curve != s.curve;
    for (const Effect& e : effects) {
      if (e.name == "anisotropy" && concerns(e, name)) k = turn_stiffness(s, k, e);
      if (e.name == "asymmetry" && concerns(e, name))
        s.joint.side =
            s.drawn.conjugate() * Eigen::Map<const Vec3>(e.numbers.at("axis").data()).normalized();
      if (e.name == "damping_time") s.joint.damping_time *= e.number("factor");
      if (e.name == "base_compliance" && s.parent < 0) hinge += 1.0 / e.number("stiffness");
      if (e.name == "attachment_compliance" && first && e.place->curve == name)
        hinge += 1.0 / e.number("stiffness");
    }
    if (hinge > 0.0) {
      Mat3 soft = k.inverse();
      soft.topLeftCorner<2, 2>() += hinge * Eigen::Matrix2d::Identity();
      k = soft.inverse();
    }
    s.joint.stiffness = k;
    s.stretch = s.length * softening(s.curve, s.arc_near, s.arc_far, effects) / values(s).stretch;
  }

  // Bending towards `direction` turns about the axis square to it and to the stem.
  static Mat3 turn_stiffness(const Segment& s, const Mat3& k, const Effect& e) {
    const std::vector<double>& d = e.numbers.at("direction");
    const Vec3 body = s.drawn.conjugate() * Vec3(d[0], d[1], d[2]).normalized();
    const Vec3 axis = Vec3::UnitZ().cross(body);
    if (axis.norm() < 1e-3) return k;
    const Vec3 a = axis.normalized();
    return k + (e.number("ratio") - 1.0) * a.dot(k * a) * a * a.transpose();
  }

  void set_mass(Segment& s, const std::vector<Effect>& effects) {
    const SectionValues v = values(s);
    double factor = 1.0;
    for (const Effect& e : effects) {
      if (e.name == "density") factor *= e.number("factor");
      if (e.name == "mass_distribution" && concerns(e, plant_.curves[s.curve].name))
        factor *= 1.0 + e.number("gradient") *
                            (0.5 * (s.arc_near + s.arc_far) / curves_[s.curve].length() - 0.5);
    }
    s.mass = factor * v.mass * s.length;
    s.centre = 0.5 * s.length;
    const double bar = s.mass * s.length * s.length / 3.0;
    s.inertia = Vec3(bar, bar, 0.0) +
                factor * s.length * Vec3(v.inertia1, v.inertia2, v.inertia1 + v.inertia2);
  }

  void hang(const plant::CurvePlace& at, double mass) {
    const Place place = locate(plant_, tree_, at.curve, at.at);
    Segment& s = tree_.segments[place.segment];
    s.centre = (s.mass * s.centre + mass * place.along) / (s.mass + mass);
    s.mass += mass;
    s.inertia += mass * place.along * place.along * Vec3(1, 1, 0);
  }

  // A tree is statically determinate: the weight beyond a joint gives its moment, and the rest
  // rotation is the one from which that moment turns the joint to where it is drawn.
  void stand_as_drawn() {
    const int n = tree_.size();
    std::vector<Vec3> weight(n, Vec3::Zero()), moment(n, Vec3::Zero());  // W; about the joint
    for (int i = n - 1; i >= 0; --i) {
      Segment& s = tree_.segments[i];
      const Vec3 own(0, 0, -9.81 * s.mass), start = far_end(s.parent);
      weight[i] += own;
      moment[i] += (s.drawn * Vec3(0, 0, s.centre)).cross(own);
      const Vec3 load = s.drawn.conjugate() * moment[i];
      Vec3 phi = s.joint.stiffness.ldlt().solve(load);
      for (int k = 0; k < 50; ++k)
        phi = s.joint.stiffness.ldlt().solve(inverse_tangent(phi).transpose().inverse() * load);
      s.joint.rest = (s.joint.rest * rotation_exp(phi).conjugate()).normalized();
      if (s.parent < 0) continue;
      weight[s.parent] += weight[i];
      moment[s.parent] +=
          moment[i] + (start - far_end(tree_.segments[s.parent].parent)).cross(weight[i]);
    }
  }

  // Adds curvature + gradient (s - L/2) to the unloaded shape, about the normal and tangent x
  // normal.
  void curve_rest(const Effect& e) {
    const int curve = plant_.curve_index(e.place->curve);
    const auto number = [&](const char* key, int i) { return e.numbers.at(key)[i]; };
    const Vec3 normal(number("normal", 0), number("normal", 1), number("normal", 2));
    for (Segment& s : tree_.segments) {
      if (s.curve != curve) continue;
      double from = s.arc_near;
      const double to = 0.5 * (s.arc_near + s.arc_far), way = s.arc_far > s.arc_near ? 1.0 : -1.0;
      if (s.parent >= 0 && tree_.segments[s.parent].curve == curve)
        from = 0.5 * (tree_.segments[s.parent].arc_near + tree_.segments[s.parent].arc_far);
      const Vec3 tangent = way * (s.drawn * Vec3::UnitZ());
      const Vec3 e1 = (normal - normal.dot(tangent) * tangent).normalized();
      const double middle = 0.5 * (from + to) - 0.5 * curves_[curve].length();
      const Vec3 turn =
          (to - from) *
          ((number("curvature", 0) + number("gradient", 0) * middle) * e1 +
           (number("curvature", 1) + number("gradient", 1) * middle) * tangent.cross(e1));
      s.joint.rest = (s.joint.rest * rotation_exp(s.drawn.conjugate() * turn)).normalized();
    }
  }

  void read_law(const Effect& e) {
    JointLaw& law = tree_.law;
    const auto optional = [&](const char* key, double otherwise) {
      return e.numbers.contains(key) ? e.number(key) : otherwise;
    };
    if (e.name == "mass_damping") tree_.mass_damping += e.number("rate");
    if (e.name == "material_nonlinearity") {
      law.nonlinearity = e.number("coefficient");
      law.k0 = e.number("k0");
    }
    if (e.name == "asymmetry") {
      law.asymmetry = e.number("coefficient");
      law.side_k0 = e.number("k0");
    }
    if (e.name == "internal_friction") {
      law.slider_ratio = e.number("ratio");
      law.slider_curvature = optional("curvature", law.slider_curvature);
      law.slider_moment = optional("moment", law.slider_moment);
    }
    if (e.name == "relaxation" || e.name == "creep") {
      const auto start = e.words.find("start");
      const bool hung = start != e.words.end() && start->second == "hung";
      law.memory.push_back({0.0, e.number("fraction"), e.number("time"), hung});
    }
    if (e.name == "hysteresis") {
      law.hysteresis_ratio = e.number("ratio");
      law.hysteresis_moment = e.number("moment");
      law.hysteresis_exponent = e.number("exponent");
    }
    if (e.name == "rest_shape") curve_rest(e);
    if (e.name == "structural_damping") add_ladder(e.number("loss_factor"));
    if (e.name == "yield") law.yield_curvature = e.number("curvature");
    if (e.name == "stiffness_drift") law.drift_rate += e.number("rate");
    if (e.name == "leaf_drag" || e.name == "wind" || e.name == "gust") {
      Air air;
      air.area = e.number("drag_area");
      air.frequency = optional("frequency", 0.0);
      air.amplitude = optional("amplitude", 0.0);
      if (e.place) air.curve = plant_.curve_index(e.place->curve);
      if (e.numbers.contains("velocity"))
        air.velocity = Eigen::Map<const Vec3>(e.numbers.at("velocity").data());
      tree_.air.push_back(air);
    }
    if (e.name == "plate_drag") {
      Air air;
      air.area = e.number("normal");
      air.across = e.number("tangential");
      air.normal = Eigen::Map<const Vec3>(e.numbers.at("direction").data()).normalized();
      if (e.place) air.curve = plant_.curve_index(e.place->curve);
      tree_.air.push_back(air);
    }
  }

  // Equal springs on dashpots whose times stand a factor sqrt(10) apart, 0.3 ms to 32 s: the sum
  // over them of w t / (1 + w^2 t^2) is close to pi / (2 ln sqrt(10)) inside the band, at every
  // rate. E (1 + i loss factor) keeps its real part where plants swing, here at 3 Hz.
  void add_ladder(double loss_factor) {
    const double spacing = 0.5 * std::log(10.0), share = loss_factor * 2.0 * spacing / M_PI;
    for (int i = -1; i <= 9; ++i) {
      const double time = 1e-3 * std::exp(spacing * i), wt = 2.0 * M_PI * 3.0 * time;
      tree_.law.memory.push_back({share / (1.0 + wt * wt), share, time});
    }
  }

  const PlantFile& plant_;
  std::vector<Effect> effects_;  // the plant's own first
  const std::vector<plant::PlantMass>& masses_;
  double spacing_;
  Tree tree_;
  std::vector<Curve> curves_;
  std::vector<Shoot> shoots_;
  std::vector<Vec3> ends_;  // far end of each segment, W, as drawn
};

}  // namespace

Tree build_tree(const PlantFile& plant, const std::vector<Effect>& effects,
                const std::vector<plant::PlantMass>& trial_masses, double spacing) {
  return Builder(plant, effects, trial_masses, spacing).build();
}

Place locate(const PlantFile& plant, const Tree& tree, const std::string& curve, double at) {
  const int index = plant.curve_index(curve);
  if (index < 0) throw std::invalid_argument("no curve " + curve);
  const double arc = std::clamp(at, 0.0, 1.0) * tree.curve_lengths[index];
  for (int i = 0; i < tree.size(); ++i) {
    const Segment& s = tree.segments[i];
    if (s.curve != index) continue;
    const double share = (arc - s.arc_near) / (s.arc_far - s.arc_near);
    if (share > -1e-9 && share < 1.0 + 1e-9) return {i, share * s.length};
  }
  throw std::invalid_argument("no such place on " + curve);
}

}  // namespace pedicel::reference
