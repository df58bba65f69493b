#pragma once

#include <tinyxml.h>

#include <string>

namespace pedicel::robot {

/// A checked URDF as urdfdom 3.0 takes it: named `name`, without what it might refuse and this
/// reader takes from the XML or does not need: version, shapes, materials, all but origin, parent
/// and child of fixed joints, safety controllers, transmissions, sensors and extensions.
std::string urdfdom_text(const TiXmlElement& robot, const std::string& name);

}  // namespace pedicel::robot
