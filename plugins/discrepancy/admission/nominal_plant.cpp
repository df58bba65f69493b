#include "plugins/discrepancy/admission/nominal_plant.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/solver/equilibrium.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

namespace {

constexpr double usual_force = 1.0e-3;  // N
// Of the reach, of a place that it moves: there a plant is a spring.
constexpr double largest_way = 0.01, smallest_way = 1.0e-4;

}  // namespace

std::optional<NominalPlant> NominalPlant::of(const Experiment& experiment, const Vec3& gravity) {
  try {
    return NominalPlant(experiment, gravity);
    // The plant's own reader tells its faults. Checks that need no plant go on.
  } catch (const InvalidFile&) {
    return std::nullopt;
  }
}

NominalPlant::NominalPlant(const Experiment& experiment, const Vec3& gravity)
    : file_(experiment.plant()),
      // On the file's own mesh, without short segments at junctions: what these change is far less
      // than what is asked here.
      built_(PlantMaker(experiment, experiment.plant().distance, 0.0).nominal()),
      drawn_(cosserat::drawn_state(built_.model)),
      settled_(drawn_),
      gravity_(gravity) {
  const cosserat::RodModel& model = built_.model;
  // A plant too soft to stand is compared as drawn: what falls over is found by others.
  if (!find_equilibrium(model, settled_, gravity_, {})) settled_ = drawn_;
  root_ = model.root.position;
  for (const cosserat::Element& element : model.elements) {
    // Along the plant and not through the air: nothing that bends changes it.
    far_.push_back(element.length + (element.parent < 0 ? 0.0 : far_[element.parent]));
    reach_ = std::max(reach_, far_.back());
    mass_ += element.mass;
  }
  // Last, since a spot needs the settled plant and the ways along it.
  for (const Marker& marker : experiment.markers) markers_.push_back(spot(marker.place));
}

Spot NominalPlant::spot(const plant::CurvePlace& place) const {
  Spot spot;
  spot.point = built_.locate(file_.curve_index(place.curve), place.at);
  const auto [element, back] = spot.point;
  spot.drawn = cosserat::point_on(built_.model, drawn_, element, back);
  spot.settled = cosserat::point_on(built_.model, settled_, element, back);
  spot.from_root = far_[element] - back;
  return spot;
}

const Mat3& NominalPlant::compliance(const Spot& spot) const {
  const auto [known, is_new] =
      compliances_.try_emplace({spot.point.element, spot.point.back}, Mat3::Zero());
  // Each is six equilibria, and holds are asked for by several checks.
  if (is_new) known->second = find_compliance(spot);
  return known->second;
}

Mat3 NominalPlant::find_compliance(const Spot& spot) const {
  const int element = spot.point.element;
  const double back = spot.point.back;
  // By equilibria, not by the stiffness matrix: a place within an element, and a plant that sags,
  // are in it.
  const auto moved = [&](const Vec3& force) {
    cosserat::RodState state = settled_;
    const cosserat::Load load{element, back, force};
    const bool found = find_equilibrium(built_.model, state, gravity_, {&load, 1});
    const Vec3 there = cosserat::point_on(built_.model, state, element, back);
    return found ? Vec3(there - spot.settled) : Vec3(Vec3::Constant(std::nan("")));
  };
  // From both sides: a place that goes aside comes down a little, too, and along a rod that is
  // hardly bent that would be more than all else.
  const auto estimate = [&](double force) {
    Mat3 compliance;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 one = force * Vec3::Unit(axis);
      compliance.col(axis) = (moved(one) - moved(-one)) / (2.0 * force);
    }
    // A plant at rest has an energy, so its compliance is symmetric. What is not is error.
    return Mat3(0.5 * (compliance + compliance.transpose()));
  };
  const Mat3 compliance = estimate(usual_force);
  // The first force is a guess. By what it moves the second one is chosen, so that differences are
  // neither rounding nor a large deflection.
  const double way = usual_force * compliance.diagonal().maxCoeff() / reach_;
  if (!(way > largest_way || way < smallest_way)) return compliance;
  // A stiff tree hardly moves under a millinewton, a thin stem folds under it.
  return estimate(usual_force * largest_way / way);
}

double NominalPlant::along(const Spot& a, const Spot& b) const {
  int one = a.point.element, other = b.point.element;
  if (one == other) return std::abs(a.from_root - b.from_root);
  // A parent stands before its children: the later of two is on no way to the other.
  while (one != other && std::min(one, other) >= 0) {
    int& later = one > other ? one : other;
    later = built_.model.elements[later].parent;
  }
  // They meet at the root alone.
  if (std::min(one, other) < 0) return a.from_root + b.from_root;
  // The way to the fork is shared; where one of the two is on the way to the other, up to that one.
  const double shared = std::min({far_[one], a.from_root, b.from_root});
  return a.from_root + b.from_root - 2.0 * shared;
}

}  // namespace pedicel::discrepancy
