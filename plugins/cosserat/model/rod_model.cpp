#include "plugins/cosserat/model/rod_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/check.h"
#include "plugins/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

constexpr double pi = 3.14159265358979323846;

// The frame of a segment along `axis`: its first axis from the hint, or carried over from `parent`.
Quat segment_frame(const Quat& parent, const Vec3& axis, const Vec3& normal_W) {
  const Vec3 along = normal_W - normal_W.dot(axis) * axis;
  if (along.norm() > 1.0e-6 * (1.0 + normal_W.norm())) {
    Mat3 frame;
    frame.col(0) = along.normalized();
    frame.col(2) = axis;
    frame.col(1) = axis.cross(frame.col(0));
    return Quat(frame).normalized();
  }
  return (least_rotation(parent * Vec3::UnitZ(), axis) * parent).normalized();
}

Vec3 bending(const Section& section) {
  return {section.bend1, section.bend2, section.twist};
}

// Half of each of the two segments bends: springs in series, axis by axis.
Vec3 joint_stiffness(const Element& child, const Element* parent) {
  Vec3 compliance = 0.5 * child.length * bending(child.section).cwiseInverse();
  if (parent) compliance += 0.5 * parent->length * bending(parent->section).cwiseInverse();
  return compliance.cwiseInverse();
}

// Adds a body on the axis to a running (mass, first moment, inertia about the child node).
struct Lump {
  double mass = 0.0, moment = 0.0;  // kg, kg m (mass * back)
  Vec3 about_node = Vec3::Zero();   // kg m2

  void add(double m, double back, const Vec3& own) {
    mass += m;
    moment += m * back;
    about_node += own + m * back * back * Vec3(1, 1, 0);
  }
};

void add_shapes(RodModel& model) {
  model.shapes.clear();
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    model.shapes.push_back({e, element.length, 0.0, element.radius_near, element.radius_far, -1});
  }
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
    const Fruit& fruit = model.fruits[f];
    model.shapes.push_back({fruit.element, fruit.back, fruit.back, fruit.radius, fruit.radius, f});
  }
}

bool same_welds(const RodModel& a, const RodModel& b) {
  const auto same = [](const Weld& x, const Weld& y) { return x.a == y.a && x.b == y.b; };
  return std::equal(a.welds.begin(), a.welds.end(), b.welds.begin(), b.welds.end(), same);
}

}  // namespace

Vec3 RodModel::drawn_start(int element) const {
  const int parent = elements[element].parent;
  return parent < 0 ? root.position : elements[parent].drawn_position;
}

int add_element(RodModel& model, int parent, const Vec3& end_W, const Section& section,
                const Vec3& normal_W) {
  PEDICEL_ASSERT(parent < model.size());
  Element element;
  element.parent = parent;
  element.section = section;
  const Vec3 start = parent < 0 ? model.root.position : model.elements[parent].drawn_position;
  element.length = (end_W - start).norm();
  if (!(element.length > 0.0)) throw UsageError("a segment's length = 0 m: must be > 0");
  element.drawn_position = end_W;
  const Quat& before = parent < 0 ? model.root.rotation : model.elements[parent].drawn_rotation;
  element.drawn_rotation = segment_frame(before, (end_W - start) / element.length, normal_W);
  model.elements.push_back(element);
  return model.size() - 1;
}

double fruit_mass(const Fruit& fruit) {
  return fruit.density * 4.0 / 3.0 * pi * std::pow(fruit.radius, 3);
}

void lump_inertia(RodModel& model, int index, const std::vector<bool>& fruit_gone) {
  Element& element = model.elements[index];
  const Section& s = element.section;
  const double mass = s.mass * element.length,
               slender = mass * element.length * element.length / 12;
  Lump lump;
  lump.add(mass, 0.5 * element.length,
           element.length * Vec3(s.inertia1, s.inertia2, s.inertia3) + Vec3(slender, slender, 0));
  for (const PointMass& point : model.masses) {
    if (point.element != index) continue;
    lump.add(point.mass, point.back, 0.4 * point.mass * point.radius * point.radius * Vec3::Ones());
  }
  for (std::size_t f = 0; f < model.fruits.size(); ++f) {
    const Fruit& fruit = model.fruits[f];
    if (fruit.element != index || (!fruit_gone.empty() && fruit_gone[f])) continue;
    const double m = fruit_mass(fruit);
    lump.add(m, fruit.back, 0.4 * m * fruit.radius * fruit.radius * Vec3::Ones());
  }
  element.mass = lump.mass;
  element.com_back = lump.moment / lump.mass;
  element.inertia =
      lump.about_node - lump.mass * element.com_back * element.com_back * Vec3(1, 1, 0);
}

void finish(RodModel& model) {
  for (int e = 0; e < model.size(); ++e) {
    Element& element = model.elements[e];
    const Element* parent = element.parent < 0 ? nullptr : &model.elements[element.parent];
    const Quat& before = parent ? parent->drawn_rotation : model.root.rotation;
    element.stretch_stiffness = {element.section.shear1, element.section.shear2,
                                 element.section.axial};
    element.bend_stiffness = joint_stiffness(element, parent);
    element.rest_strain.setZero();
    element.rest_rotation = (before.conjugate() * element.drawn_rotation).normalized();
    lump_inertia(model, e);
  }
  for (Weld& weld : model.welds)
    weld.rest_rotation =
        (model.elements[weld.a].drawn_rotation.conjugate() * model.elements[weld.b].drawn_rotation)
            .normalized();
  for (Support& support : model.supports)
    support.rotation = model.elements[support.element].drawn_rotation;
  add_shapes(model);
}

std::vector<int> first_of_welded(const RodModel& model) {
  std::vector<int> first(model.elements.size());
  std::iota(first.begin(), first.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Weld& weld : model.welds) {
      const int lowest = std::min(first[weld.a], first[weld.b]);
      changed |= first[weld.a] != lowest || first[weld.b] != lowest;
      first[weld.a] = first[weld.b] = lowest;
    }
  }
  return first;
}

bool differs_in_constants_only(const RodModel& a, const RodModel& b) {
  if (!a.laws.empty() || !b.laws.empty() || !same_welds(a, b)) return false;
  const std::vector<int> first = first_of_welded(a);
  const auto same_element = [&](const Element& x, const Element& y) {
    const auto e = &x - a.elements.data();
    const bool opened = first[e] != e;  // drawn where its first is; moved from there by its force
    return x.parent == y.parent && x.organ == y.organ && x.length == y.length &&
           (opened || x.drawn_position == y.drawn_position) &&
           x.drawn_rotation.coeffs() == y.drawn_rotation.coeffs() &&
           x.radius_near == y.radius_near && x.radius_far == y.radius_far;
  };
  const auto same_fruit = [](const Fruit& x, const Fruit& y) {
    return x.name == y.name && x.element == y.element && x.back == y.back && x.radius == y.radius;
  };
  return a.organs == b.organs && a.shapes.size() == b.shapes.size() &&
         std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                    same_element) &&
         std::equal(a.fruits.begin(), a.fruits.end(), b.fruits.begin(), b.fruits.end(), same_fruit);
}

}  // namespace pedicel::cosserat
