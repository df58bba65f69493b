#include "app/playback/drawn_markers.h"

#include <algorithm>
#include <cmath>

#include "app/draw/drawing.h"

namespace pedicel::app {

namespace {

constexpr double farthest = 1.0e6;  // m, from the origin

Vec3 place_of(const ros::Point& p) {
  return {p.x, p.y, p.z};
}

Pose pose_of_marker(const ros::PoseMessage& message) {
  const ros::Quaternion& q = message.orientation;
  Quat rotation(q.w, q.x, q.y, q.z);
  const double size = rotation.norm();
  return {place_of(message.position), size > 0.0 ? rotation.normalized() : Quat::Identity()};
}

ros::Point mean_of(const ros::Point& a, const ros::Point& b, double share) {
  const Vec3 mean = (1.0 - share) * place_of(a) + share * place_of(b);
  return {mean.x(), mean.y(), mean.z()};
}

bool is_like(const ros::Marker& a, const ros::Marker& b) {
  return a.ns == b.ns && a.id == b.id && a.type == b.type && a.action == b.action &&
         a.points.size() == b.points.size();
}

render::Shading shading_of(const ros::Marker& marker) {
  return {{marker.color.r, marker.color.g, marker.color.b}};
}

/// Lines in chains: points that two lines share are drawn once.
void add_lines(render::DrawList& list, const ros::Marker& marker, const Pose& pose, bool strip) {
  const double radius = 0.5 * marker.scale.x;
  const render::Colour colour{marker.color.r, marker.color.g, marker.color.b};
  std::vector<render::TubePoint> chain;
  const auto finish = [&] {
    if (chain.size() > 1) list.add_tube(chain);
    chain.clear();
  };
  for (std::size_t i = 0; i < marker.points.size(); ++i) {
    const Vec3 p = pose * place_of(marker.points[i]);
    const bool begins = !strip && i % 2 == 0;
    if (begins && !chain.empty()) {
      if ((chain.back().position - p).norm() < 1.0e-6) continue;
      finish();
    }
    chain.push_back({p, radius, colour});
  }
  finish();
}

void add_triangles(render::DrawList& list, const ros::Marker& marker, const Pose& pose) {
  for (std::size_t i = 0; i + 2 < marker.points.size(); i += 3)
    list.blades.push_back({pose * place_of(marker.points[i]), pose * place_of(marker.points[i + 1]),
                           pose * place_of(marker.points[i + 2]), shading_of(marker)});
}

/// False for what is no number, too.
bool is_in_sight(const Vec3& p) {
  return (p.array().abs() <= farthest).all();
}

/// Whether there is anything to draw: others' logs may hold sizes of 0, and places that are none.
bool can_be_drawn(const ros::Marker& marker) {
  const ros::Vector3& s = marker.scale;
  const ros::Quaternion& q = marker.pose.orientation;
  const bool triangles = marker.type == ros::Marker::triangle_list;
  const bool thick = marker.type == ros::Marker::cube || marker.type == ros::Marker::cylinder;
  if (!triangles && !(s.x > 0.0)) return false;
  if (thick && !(s.y > 0.0 && s.z > 0.0)) return false;
  return is_in_sight({s.x, s.y, s.z}) && is_in_sight(place_of(marker.pose.position)) &&
         is_in_sight({q.x, q.y, q.z}) && std::abs(q.w) <= farthest &&
         std::ranges::all_of(marker.points,
                             [](const ros::Point& p) { return is_in_sight(place_of(p)); });
}

void add_marker(render::DrawList& list, const ros::Marker& marker) {
  if (!can_be_drawn(marker)) return;
  const Pose pose = pose_of_marker(marker.pose);
  const render::Shading shading = shading_of(marker);
  const Vec3 scale(marker.scale.x, marker.scale.y, marker.scale.z);
  switch (marker.type) {
    case ros::Marker::cube:
      list.boxes.push_back({pose, 0.5 * scale, shading});
      break;
    case ros::Marker::sphere:
      list.spheres.push_back({pose.position, 0.5 * scale.x(), shading});
      break;
    case ros::Marker::cylinder:
      add_cylinder(list, pose, 0.5 * scale.x(), scale.z(), shading);
      break;
    case ros::Marker::line_strip:
    case ros::Marker::line_list:
      add_lines(list, marker, pose, marker.type == ros::Marker::line_strip);
      break;
    case ros::Marker::sphere_list:
      for (const ros::Point& p : marker.points)
        list.spheres.push_back({pose * place_of(p), 0.5 * scale.x(), shading});
      break;
    case ros::Marker::triangle_list:
      add_triangles(list, marker, pose);
      break;
    default:
      break;
  }
}

}  // namespace

ros::MarkerArray between(const ros::MarkerArray& before, const ros::MarkerArray& after,
                         double share) {
  ros::MarkerArray all = before;
  const std::size_t size = std::min(before.markers.size(), after.markers.size());
  for (std::size_t m = 0; m < size; ++m) {
    ros::Marker& one = all.markers[m];
    const ros::Marker& next = after.markers[m];
    if (!is_like(one, next)) continue;
    const Pose a = pose_of_marker(one.pose), b = pose_of_marker(next.pose);
    const Quat turn = a.rotation.slerp(share, b.rotation);
    one.pose = {mean_of(one.pose.position, next.pose.position, share),
                {turn.x(), turn.y(), turn.z(), turn.w()}};
    for (std::size_t p = 0; p < one.points.size(); ++p)
      one.points[p] = mean_of(one.points[p], next.points[p], share);
  }
  return all;
}

void add_markers(render::DrawList& list, const ros::MarkerArray& markers) {
  for (const ros::Marker& marker : markers.markers)
    if (marker.action == ros::Marker::add) add_marker(list, marker);
}

}  // namespace pedicel::app
