#include "plugins/discrepancy/simulate/guides.h"

#include <algorithm>

namespace pedicel::discrepancy {

namespace {

// N. More than any plant gives in its elastic range; with it a rigid guide stores 0.05 J.
constexpr double pressed = 1.0e3;

}  // namespace

Vec3 force_of(const Guide& guide, const cosserat::RodModel& model,
              const cosserat::RodState& state) {
  if (!state.alive[guide.element]) return Vec3::Zero();  // it led a fruit that came off
  const Vec3 place = cosserat::point_on(model, state, guide.element, guide.back);
  const double short_of = guide.axis.dot(guide.target - place);
  return guide.stiffness * (guide.one_sided ? std::max(0.0, short_of) : short_of) * guide.axis;
}

void Guides::cover(double, double to) {
  share_ = to;
}

void Guides::find(const cosserat::RodModel&, const cosserat::RodState& state, double,
                  std::vector<cosserat::ContactPoint>& found) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Guide& guide = all[i];
    if (!state.alive[guide.element]) continue;
    const Vec3 place = state.position[guide.element] -
                       guide.back * (state.orientation[guide.element] * Vec3::UnitZ());
    const Vec3 target = guide.before + share_ * (guide.target - guide.before);
    cosserat::ContactPoint point;
    point.shape = guide.element;  // each segment has the shape of its number
    point.collider = static_cast<int>(2 * i);
    point.back = guide.back;
    point.normal_W = guide.axis;
    point.gap = guide.axis.dot(place - target);
    point.stiffness = guide.one_sided ? guide.stiffness : 0.5 * guide.stiffness;
    point.margin = guide.one_sided ? 0.0 : pressed / guide.stiffness;
    found.push_back(point);
    if (guide.one_sided) continue;
    point.collider += 1;
    point.normal_W = -guide.axis;
    point.gap = -point.gap;
    found.push_back(point);
  }
}

}  // namespace pedicel::discrepancy
