#include "engine/urdf/urdf_materials.h"

#include <charconv>
#include <sstream>
#include <vector>

namespace pedicel::robot {

namespace {

const Eigen::Vector4d grey(0.7, 0.7, 0.7, 1.0);

/// Four numbers in 0..1, or three of an opaque colour.
std::optional<Eigen::Vector4d> parse_colour(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> parts;
  for (std::string word; stream >> word;) {
    double part = -1.0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), part);
    if (fault != std::errc{} || stop != word.data() + word.size() || !(part >= 0.0 && part <= 1.0))
      return {};
    parts.push_back(part);
  }
  if (parts.size() == 3) parts.push_back(1.0);
  if (parts.size() != 4) return {};
  return Eigen::Vector4d(parts[0], parts[1], parts[2], parts[3]);
}

}  // namespace

UrdfMaterials::UrdfMaterials(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks)
    : xml_(xml), remarks_(remarks) {
  for (const TiXmlElement* material : children(robot, "material")) define(*material, "robot");
  for (const TiXmlElement* link : children(robot, "link"))
    for (const TiXmlElement* visual : children(*link, "visual"))
      if (const TiXmlElement* material = visual->FirstChildElement("material")) {
        const char* name = link->Attribute("name");
        define(*material, std::string("link '") + (name != nullptr ? name : "") + "'");
      }
}

void UrdfMaterials::define(const TiXmlElement& material, const std::string& who) {
  if (material.FirstChildElement() == nullptr) return;
  const Colour colour = read(material, who);
  if (const char* name = material.Attribute("name")) defined_.emplace(name, colour);
}

UrdfMaterials::Colour UrdfMaterials::read(const TiXmlElement& material,
                                          const std::string& who) const {
  const TiXmlElement* color = material.FirstChildElement("color");
  if (color == nullptr) return {};
  const char* rgba = color->Attribute("rgba");
  const Colour colour = parse_colour(rgba != nullptr ? rgba : "");
  if (!colour)
    remarks_.add(xml_.position(attribute_or_element(*color, "rgba")), who,
                 std::string("rgba \"") + (rgba != nullptr ? rgba : "") +
                     "\", expected four numbers in 0..1; drawn grey");
  return colour;
}

Eigen::Vector4d UrdfMaterials::colour(const TiXmlElement& visual, const std::string& link) const {
  const TiXmlElement* material = visual.FirstChildElement("material");
  if (material == nullptr) return grey;
  const char* name = material->Attribute("name");
  if (name != nullptr && *name != '\0')
    if (const auto known = defined_.find(name); known != defined_.end())
      return known->second.value_or(grey);
  if (const TiXmlElement* color = material->FirstChildElement("color"))
    return parse_colour(color->Attribute("rgba") != nullptr ? color->Attribute("rgba") : "")
        .value_or(grey);
  if (name != nullptr && material->FirstChildElement() == nullptr)
    remarks_.add(xml_.position(*material), "link '" + link + "'",
                 std::string("material '") + name + "' is defined nowhere, drawn grey");
  return grey;
}

}  // namespace pedicel::robot
