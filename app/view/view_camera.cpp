#include "app/view/view_camera.h"

#include <algorithm>
#include <cmath>

namespace pedicel::app {

namespace {

constexpr double steepest = 1.55;                   // rad: straight down would lose the horizon
constexpr double nearest = 0.01, farthest = 500.0;  // m

}  // namespace

void ViewCamera::set(const render::Camera& camera) {
  const Vec3 offset = camera.eye - camera.target;
  target_ = camera.target;
  distance_ = std::clamp(offset.norm(), nearest, farthest);
  azimuth_ = std::atan2(offset.y(), offset.x());
  elevation_ =
      std::clamp(std::asin(std::clamp(offset.z() / offset.norm(), -1.0, 1.0)), -steepest, steepest);
  field_of_view_ = camera.field_of_view;
}

Vec3 ViewCamera::back() const {
  return {std::cos(elevation_) * std::cos(azimuth_), std::cos(elevation_) * std::sin(azimuth_),
          std::sin(elevation_)};
}

render::Camera ViewCamera::camera() const {
  render::Camera camera;
  camera.target = target_;
  camera.eye = target_ + distance_ * back();
  camera.field_of_view = field_of_view_;
  camera.near_plane = 0.02 * distance_;
  camera.far_plane = std::max(60.0 * distance_, 50.0);
  return camera;
}

void ViewCamera::orbit(double dx, double dy, int height) {
  const double turn = M_PI / std::max(height, 1);
  azimuth_ = std::remainder(azimuth_ - turn * dx, 2.0 * M_PI);
  elevation_ = std::clamp(elevation_ + turn * dy, -steepest, steepest);
}

void ViewCamera::pan(double dx, double dy, int height) {
  const double metres = 2.0 * distance_ * std::tan(0.5 * field_of_view_) / std::max(height, 1);
  const render::Mat4 view = camera().view();
  const Vec3 right = view.block<1, 3>(0, 0).transpose(), up = view.block<1, 3>(1, 0).transpose();
  target_ += metres * (dy * up - dx * right);
}

void ViewCamera::dolly(double steps, const Vec3& towards_W) {
  const double before = distance_;
  distance_ = std::clamp(before * std::pow(0.87, steps), nearest, farthest);
  target_ += (1.0 - distance_ / before) * (towards_W - target_);
}

void ViewCamera::stay_above(double height) {
  const double missing = height - camera().eye.z();
  if (missing <= 0.0) return;
  const double sine = (height - target_.z()) / distance_;
  if (sine <= std::sin(steepest))
    elevation_ = std::max(elevation_, std::asin(std::max(sine, -1.0)));
  else
    target_.z() += missing;
}

void ViewCamera::look_at(const Vec3& target_W) {
  render::Camera moved = camera();
  if ((moved.eye - target_W).norm() < nearest) return;
  moved.target = target_W;
  set(moved);
}

void ViewCamera::frame(const Eigen::AlignedBox3d& box, double aspect) {
  render::Camera framed = render::frame(box, aspect, azimuth_, elevation_);
  // render::frame() has a field of view of its own.
  const double ratio = std::tan(0.5 * framed.field_of_view) / std::tan(0.5 * field_of_view_);
  framed.eye = framed.target + ratio * (framed.eye - framed.target);
  framed.field_of_view = field_of_view_;
  set(framed);
}

}  // namespace pedicel::app
