#include "engine/world/bodies.h"

namespace pedicel::world {

namespace {

BodyPart box(const Vec3& centre, const Vec3& size) {
  BodyPart part;
  part.pose.position = centre;
  part.half_extents = 0.5 * size;
  return part;
}

/// Half the extents of a part along the axes of its own frame.
Vec3 half_size(const BodyPart& part) {
  switch (part.kind) {
    case BodyPart::Kind::box:
      return part.half_extents;
    case BodyPart::Kind::sphere:
      return Vec3::Constant(part.radius);
    case BodyPart::Kind::cylinder:
      return {part.radius, part.radius, 0.5 * part.length};
    case BodyPart::Kind::capsule:
      return {part.radius, part.radius, 0.5 * part.length + part.radius};
  }
  return Vec3::Zero();
}

}  // namespace

const std::vector<std::string>& body_looks() {
  static const std::vector<std::string> looks = {"steel", "wood",   "light",
                                                 "dark",  "accent", "hidden"};
  return looks;
}

std::vector<BodyPart> tray_parts(const Vec3& size, double wall) {
  const double inner = size.z() - wall, middle = wall + 0.5 * inner;
  const double x = 0.5 * (size.x() - wall), y = 0.5 * (size.y() - wall);
  const double between = size.y() - 2.0 * wall;
  return {
      box({0, 0, 0.5 * wall}, {size.x(), size.y(), wall}),
      box({0, -y, middle}, {size.x(), wall, inner}), box({0, y, middle}, {size.x(), wall, inner}),
      box({-x, 0, middle}, {wall, between, inner}), box({x, 0, middle}, {wall, between, inner})};
}

BodyDescription fruit_body(const std::string& name, double radius, double mass, double stub_length,
                           double stub_radius) {
  BodyDescription body;
  body.name = name;
  body.mass = mass;
  body.friction = 0.7;
  BodyPart sphere;
  sphere.kind = BodyPart::Kind::sphere;
  sphere.radius = radius;
  body.parts.push_back(sphere);
  if (stub_length > radius) {
    BodyPart stub;
    stub.kind = BodyPart::Kind::capsule;
    stub.radius = stub_radius;
    stub.length = stub_length - radius;
    stub.pose.position = Vec3(0, 0, -radius - 0.5 * stub.length);
    body.parts.push_back(stub);
  }
  return body;
}

std::pair<Vec3, Vec3> bounds_of(const BodyDescription& body) {
  Eigen::AlignedBox3d bounds;
  for (const BodyPart& part : body.parts) {
    const Vec3 half = part.pose.rotation.toRotationMatrix().cwiseAbs() * half_size(part);
    bounds.extend(part.pose.position - half);
    bounds.extend(part.pose.position + half);
  }
  return {bounds.min(), bounds.max()};
}

}  // namespace pedicel::world
