#include "pedicel/discrepancy/scene/giving_source.h"

#include <algorithm>

namespace pedicel::discrepancy {

namespace {
constexpr double smallest_motion = 1.0e-12;  // m
}

GivingSource::GivingSource(const coupling::ColliderSet& colliders,
                           const coupling::CouplingSettings& settings, double margin, int body,
                           const GivingArm& arm)
    : colliders_(colliders), inner_(colliders, settings), margin_(margin), body_(body), arm_(arm) {}

void GivingSource::find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
                        std::vector<cosserat::ContactPoint>& found) {
  const std::size_t first = found.size();
  inner_.find(model, state, dt, found);
  for (std::size_t i = first; i < found.size(); ++i) {
    found[i].margin = margin_;
    if (arm_.compliance > 0.0 && colliders_.collider(found[i].collider).body == body_)
      give_way(model, state, found[i]);
  }
}

void GivingSource::give_way(const cosserat::RodModel& model, const cosserat::RodState& state,
                            cosserat::ContactPoint& point) const {
  const auto link = static_cast<std::size_t>(colliders_.collider(point.collider).link);
  const Vec3 n = point.normal_W;
  const Vec3 place =
      cosserat::point_on(model, state, model.shapes[point.shape].element, point.back) -
      point.radius * n;
  const auto moved = [&](const Pose& by) -> Vec3 { return place - by.inverse() * place; };
  const Vec3 now = moved(arm_.given[link]), change = now - moved(arm_.given_before[link]);
  arm_.arm->model().jacobian(arm_.links, static_cast<int>(link), arm_.links[link].inverse() * place,
                             jacobian_);
  const Eigen::Matrix3Xd j = jacobian_.topRows<3>();
  const Mat3 give = arm_.compliance * j * j.transpose();  // m/N
  const double along = n.dot(give * n);
  point.give = along;
  point.gap += n.dot(now);
  // The solver takes one compliance for all directions: what has been given way across the normal
  // is told in its terms.
  Vec3 across = change - n * n.dot(change);
  const double size = across.norm();
  if (size < smallest_motion) return;
  const Vec3 t = across / size;
  const double own = t.dot(give * t);
  if (own > 0.0) across *= std::clamp(along / own, 0.1, 10.0);
  point.surface_motion_W -= across;
}

}  // namespace pedicel::discrepancy
