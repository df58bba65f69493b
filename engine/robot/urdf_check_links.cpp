#include "robot/urdf_xml.h"

namespace pedicel::robot {

namespace {

const char* const inertia_names[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};

void check_inertial(const UrdfXml& xml, const TiXmlElement& link, const std::string& what) {
  const TiXmlElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  xml.check_origin(*inertial, what + ": inertial");
  if (const TiXmlElement* mass = inertial->FirstChildElement("mass"))
    xml.not_negative(*mass, "value", what + ": mass", true, false);
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

void check_mesh(const UrdfXml& xml, const TiXmlElement& mesh, const std::string& what,
                const PackagePaths& paths) {
  if (const auto scale = xml.numbers(mesh, "scale", 3, what + ": mesh"))
    for (double s : *scale)
      if (s == 0.0) {
        xml.error(attribute_or_element(mesh, "scale"), what + ": scale 0, expected no zero");
        break;
      }
  const std::optional<std::string> uri = xml.text(mesh, "filename", what + ": mesh");
  if (!uri) return;
  const PackagePaths::Found found = paths.find(*uri, xml.file());
  if (found.file) return;
  std::string hint;
  if (uri->rfind("package://", 0) == 0) {
    const std::string package = uri->substr(10, uri->find('/', 10) - 10);
    hint = "; say where the package is with --package " + package + "=PATH";
  }
  std::string places;
  for (const auto& path : found.looked_at) places += (places.empty() ? "" : ", ") + path.string();
  xml.error(attribute_or_element(mesh, "filename"),
            what + ": mesh file \"" + *uri + "\" not found, looked for " + places + hint);
}

void check_geometry(const UrdfXml& xml, const TiXmlElement& owner, const std::string& what,
                    const PackagePaths& paths) {
  const TiXmlElement* geometry = owner.FirstChildElement("geometry");
  const TiXmlElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
  if (shape == nullptr) {
    xml.error(owner,
              what + ": no geometry, expected <geometry> with box, cylinder, sphere or mesh");
    return;
  }
  const std::string& kind = shape->ValueStr();
  if (kind == "mesh") {
    check_mesh(xml, *shape, what, paths);
  } else if (kind == "sphere") {
    xml.not_negative(*shape, "radius", what + ": sphere", true, true);
  } else if (kind == "cylinder") {
    xml.not_negative(*shape, "radius", what + ": cylinder", true, true);
    xml.not_negative(*shape, "length", what + ": cylinder", true, true);
  } else if (kind == "box") {
    if (!xml.text(*shape, "size", what + ": box")) return;
    if (const auto size = xml.numbers(*shape, "size", 3, what + ": box"))
      if ((*size)[0] <= 0.0 || (*size)[1] <= 0.0 || (*size)[2] <= 0.0)
        xml.error(attribute_or_element(*shape, "size"),
                  what + ": box size \"" + shape->Attribute("size") + "\", expected more than 0");
  } else {
    xml.error(*shape, what + ": unknown geometry <" + kind +
                          ">, expected box, cylinder, sphere or mesh" +
                          (kind == "capsule" ? " (a capsule is a cylinder and two spheres)" : ""));
  }
}

void check_color(const UrdfXml& xml, const TiXmlElement& material, const std::string& what) {
  const TiXmlElement* color = material.FirstChildElement("color");
  if (color == nullptr || !xml.text(*color, "rgba", what + ": color")) return;
  const auto rgba = xml.numbers(*color, "rgba", 4, what + ": color");
  if (!rgba) return;
  for (double part : *rgba)
    if (part < 0.0 || part > 1.0) {
      xml.error(
          attribute_or_element(*color, "rgba"),
          what + ": rgba \"" + color->Attribute("rgba") + "\", expected four numbers in 0..1");
      return;
    }
}

void check_link(const UrdfXml& xml, const TiXmlElement& link, const std::string& what,
                const std::set<std::string>& materials, const PackagePaths& paths) {
  check_inertial(xml, link, what);
  for (const TiXmlElement* visual : children(link, "visual")) {
    xml.check_origin(*visual, what + ": visual");
    check_geometry(xml, *visual, what + ": visual", paths);
    const TiXmlElement* material = visual->FirstChildElement("material");
    if (material == nullptr) continue;
    check_color(xml, *material, what + ": material");
    const char* name = material->Attribute("name");
    if (name != nullptr && material->FirstChildElement() == nullptr && !materials.contains(name))
      xml.warning(*material, what + ": material '" + name + "' is defined nowhere, drawn grey");
  }
  for (const TiXmlElement* collision : children(link, "collision")) {
    xml.check_origin(*collision, what + ": collision");
    check_geometry(xml, *collision, what + ": collision", paths);
  }
}

/// Names of materials that carry a colour anywhere in the file.
std::set<std::string> material_names(const UrdfXml& xml, const TiXmlElement& robot) {
  std::set<std::string> names;
  const auto take = [&](const TiXmlElement& material) {
    if (const char* name = material.Attribute("name"))
      if (material.FirstChildElement() != nullptr) names.insert(name);
  };
  for (const TiXmlElement* material : children(robot, "material")) {
    take(*material);
    check_color(xml, *material, "material");
  }
  for (const TiXmlElement* link : children(robot, "link"))
    for (const TiXmlElement* visual : children(*link, "visual"))
      if (const TiXmlElement* material = visual->FirstChildElement("material")) take(*material);
  return names;
}

}  // namespace

void check_links(const UrdfXml& xml, const TiXmlElement& robot, const PackagePaths& paths) {
  const std::set<std::string> materials = material_names(xml, robot);
  std::set<std::string> names;
  for (const TiXmlElement* link : children(robot, "link")) {
    const std::optional<std::string> name = xml.text(*link, "name", "link");
    if (!name) continue;
    if (!names.insert(*name).second)
      xml.error(attribute_or_element(*link, "name"),
                "duplicate link '" + *name + "', expected each name once");
    check_link(xml, *link, "link '" + *name + "'", materials, paths);
  }
  if (names.empty()) xml.error(robot, "no link, expected at least one <link name=\"...\"/>");
}

}  // namespace pedicel::robot
