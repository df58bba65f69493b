#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "engine/urdf/urdf_remarks.h"
#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

/// The colours of a URDF. A material is defined where it has a colour or a texture, at the robot or
/// in any visual; the robot's own win, then the first in the file. What is no colour is remarked
/// and drawn grey: no number of a run depends on it.
class UrdfMaterials {
 public:
  UrdfMaterials(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks);

  /// Of a <visual> of a link: red, green, blue, alpha in 0..1.
  Eigen::Vector4d colour(const TiXmlElement& visual, const std::string& link) const;

 private:
  using Colour = std::optional<Eigen::Vector4d>;
  void define(const TiXmlElement& material, const std::string& who);
  Colour read(const TiXmlElement& material, const std::string& who) const;

  const UrdfXml& xml_;
  UrdfRemarks& remarks_;
  std::map<std::string, Colour> defined_;
};

}  // namespace pedicel::robot
