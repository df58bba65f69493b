#include <algorithm>

#include "engine/io/csv.h"
#include "engine/io/thing_bounds.h"
#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

namespace {

const char* const inertia_names[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};

/// A number from 0 on, and not above what anything weighs or measures.
void check_extent(const UrdfXml& xml, const TiXmlElement& element, const char* attribute,
                  const std::string& what, double most) {
  const auto value = xml.not_negative(element, attribute, what, true, false);
  if (value && *value > most)
    xml.error(attribute_or_element(element, attribute),
              what + ": " + attribute + " \"" + element.Attribute(attribute) +
                  "\", expected at most " + io::format_number(most));
}

void check_inertial(const UrdfXml& xml, const TiXmlElement& link, const std::string& what) {
  const TiXmlElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  xml.check_origin(*inertial, what + ": inertial");
  if (const TiXmlElement* mass = inertial->FirstChildElement("mass"))
    check_extent(xml, *mass, "value", what + ": mass", io::mass_bounds.maximum);
  else
    xml.error(*inertial, what + ": inertial without <mass>, expected <mass value=\"...\"/>");
  const TiXmlElement* inertia = inertial->FirstChildElement("inertia");
  if (inertia == nullptr) {
    xml.error(*inertial,
              what + ": inertial without <inertia>, expected ixx, ixy, ixz, iyy, iyz, izz");
    return;
  }
  for (const char* name : inertia_names) xml.number(*inertia, name, what + ": inertia");
}

void check_mesh(const UrdfXml& xml, const TiXmlElement& mesh, const std::string& what) {
  if (const auto scale = xml.numbers(mesh, "scale", 3, what + ": mesh"))
    for (double s : *scale)
      if (s == 0.0) {
        xml.error(attribute_or_element(mesh, "scale"), what + ": scale 0, expected no zero");
        break;
      }
  xml.text(mesh, "filename", what + ": mesh");
}

void check_geometry(const UrdfXml& xml, const TiXmlElement& owner, const std::string& what) {
  const TiXmlElement* geometry = owner.FirstChildElement("geometry");
  const TiXmlElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
  if (shape == nullptr) {
    xml.error(owner,
              what + ": no geometry, expected <geometry> with box, cylinder, sphere or mesh");
    return;
  }
  const std::string& kind = shape->ValueStr();
  if (kind == "mesh") {
    check_mesh(xml, *shape, what);
  } else if (kind == "sphere") {
    check_extent(xml, *shape, "radius", what + ": sphere", io::extent_bounds.maximum);
  } else if (kind == "cylinder" || kind == "capsule") {
    check_extent(xml, *shape, "radius", what + ": " + kind, io::extent_bounds.maximum);
    check_extent(xml, *shape, "length", what + ": " + kind, io::extent_bounds.maximum);
  } else if (kind == "box") {
    if (!xml.text(*shape, "size", what + ": box")) return;
    if (const auto size = xml.numbers(*shape, "size", 3, what + ": box")) {
      const std::string said = what + ": box size \"" + shape->Attribute("size") + "\", expected ";
      const auto [low, high] = std::minmax_element(size->begin(), size->end());
      if (*low < 0.0) xml.error(attribute_or_element(*shape, "size"), said + "0 or more");
      if (*high > io::extent_bounds.maximum)
        xml.error(attribute_or_element(*shape, "size"),
                  said + "at most " + io::format_number(io::extent_bounds.maximum) + " m");
    }
  } else {
    xml.error(*shape, what + ": unknown geometry <" + kind +
                          ">, expected box, cylinder, sphere, capsule or mesh");
  }
}

void check_link(const UrdfXml& xml, const TiXmlElement& link, const std::string& what) {
  check_inertial(xml, link, what);
  for (const char* kind : {"visual", "collision"})
    for (const TiXmlElement* owner : children(link, kind)) {
      xml.check_origin(*owner, what + ": " + kind);
      check_geometry(xml, *owner, what + ": " + kind);
    }
}

}  // namespace

void check_links(const UrdfXml& xml, const TiXmlElement& robot) {
  std::set<std::string> names;
  for (const TiXmlElement* link : children(robot, "link")) {
    const std::optional<std::string> name = xml.text(*link, "name", "link");
    if (!name) continue;
    if (!names.insert(*name).second)
      xml.error(attribute_or_element(*link, "name"),
                "duplicate link '" + *name + "', expected each name once");
    check_link(xml, *link, "link '" + *name + "'");
  }
  if (names.empty()) xml.error(robot, "no link, expected at least one <link name=\"...\"/>");
}

}  // namespace pedicel::robot
