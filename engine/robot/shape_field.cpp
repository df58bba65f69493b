#include "engine/robot/shape_field.h"

namespace pedicel::robot {

std::shared_ptr<const geometry::SignedDistance> shape_field(const Geometry& shape) {
  switch (shape.kind) {
    case Geometry::Kind::box:
      return std::make_shared<geometry::BoxDistance>(shape.size);
    case Geometry::Kind::sphere:
      return std::make_shared<geometry::SphereDistance>(shape.radius);
    case Geometry::Kind::cylinder:
      return std::make_shared<geometry::CylinderDistance>(shape.radius, shape.length);
    case Geometry::Kind::capsule:
      return std::make_shared<geometry::CapsuleDistance>(shape.radius, shape.length);
    case Geometry::Kind::mesh:
      break;
  }
  return nullptr;
}

}  // namespace pedicel::robot
