#include "plugins/discrepancy/scene/giving_source.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/contact/self_contact.h"

namespace pedicel::discrepancy {

namespace {
/// Of the largest compliance across the normal.
constexpr double least_share = 1.0;
}  // namespace

GivingSource::GivingSource(const coupling::ColliderSet& colliders,
                           const coupling::CouplingSettings& settings, double margin, int body,
                           const GivingArm& arm)
    : colliders_(colliders),
      inner_(colliders, settings),
      margin_(margin),
      body_(body),
      arm_(arm),
      pushed_(static_cast<std::size_t>(colliders.size()), Vec3::Zero()),
      pushed_before_(pushed_) {
  inner_.share_later();
}

void GivingSource::find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
                        std::vector<cosserat::ContactPoint>& found) {
  const std::size_t first = found.size();
  inner_.find(model, state, dt, found);
  for (std::size_t i = first; i < found.size(); ++i) {
    found[i].margin = margin_;
    if (arm_.gives && colliders_.collider(found[i].collider).body == body_)
      give_way(model, state, found[i]);
  }
  inner_.share_stiffness(model, std::span(found).subspan(first));
}

void GivingSource::remember(std::span<const cosserat::ContactForce> forces) {
  std::swap(pushed_, pushed_before_);
  std::ranges::fill(pushed_, Vec3::Zero());
  for (const cosserat::ContactForce& force : forces) {
    const int collider = force.point.collider;
    if (cosserat::is_self_contact(collider) || collider >= static_cast<int>(pushed_.size()))
      continue;
    pushed_[static_cast<std::size_t>(collider)] -=
        force.normal * force.point.normal_W + force.tangential_W;
  }
}

void GivingSource::give_way(const cosserat::RodModel& model, const cosserat::RodState& state,
                            cosserat::ContactPoint& point) const {
  const auto collider = static_cast<std::size_t>(point.collider);
  const int link = colliders_.collider(point.collider).link;
  const Vec3 n = point.normal_W;
  const Vec3 place =
      cosserat::point_on(model, state, model.shapes[point.shape].element, point.back) -
      point.radius * n;
  const Pose& pose = arm_.links[static_cast<std::size_t>(link)];
  arm_.arm->model().jacobian(arm_.links, link, pose.inverse() * place, jacobian_);
  const Eigen::Matrix3Xd j = jacobian_.topRows<3>();
  const Mat3 give = j * arm_.compliance * j.transpose();  // m/N
  // Across the normal it gives way by less than twice what the solver reckons with, or the
  // correction by the step before runs away.
  const Mat3 flat = Mat3::Identity() - n * n.transpose();
  const double along = n.dot(give * n);
  const double across = (flat * give * flat).trace();
  point.give = std::max(along, least_share * across);
  if (collider >= pushed_.size()) return;
  const Vec3& pushed = pushed_[collider];
  const Vec3& before = pushed_before_[collider];
  point.gap += point.give * n.dot(pushed);
  point.surface_motion_W -= share_ * point.give * (flat * (pushed - before));
}

}  // namespace pedicel::discrepancy
