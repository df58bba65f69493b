#include <map>

#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

namespace {

/// The link that a joint names, where it exists; everything else is reported.
std::optional<std::string> linked(const UrdfXml& xml, const TiXmlElement& joint, const char* end,
                                  const std::map<std::string, const TiXmlElement*>& links) {
  const char* name = joint.Attribute("name");
  const std::string what = std::string("joint '") + (name != nullptr ? name : "") + "'";
  const TiXmlElement* element = joint.FirstChildElement(end);
  if (element == nullptr) {
    xml.error(joint, what + ": no <" + end + ">, expected <" + end + " link=\"...\"/>");
    return {};
  }
  const std::optional<std::string> link = xml.text(*element, "link", what + ": " + end);
  if (!link || links.contains(*link)) return link;
  xml.error(
      attribute_or_element(*element, "link"),
      what + ": " + end + " link '" + *link + "' does not exist, expected a link of this file");
  return {};
}

struct Tree {
  std::map<std::string, const TiXmlElement*> links;
  std::map<std::string, std::string> parent_of;         // child link to parent link
  std::map<std::string, const TiXmlElement*> joint_of;  // child link to its joint
};

Tree collect(const UrdfXml& xml, const TiXmlElement& robot) {
  Tree tree;
  for (const TiXmlElement* link : children(robot, "link"))
    if (const char* name = link->Attribute("name")) tree.links.emplace(name, link);
  for (const TiXmlElement* joint : children(robot, "joint")) {
    const auto parent = linked(xml, *joint, "parent", tree.links);
    const auto child = linked(xml, *joint, "child", tree.links);
    if (!parent || !child) continue;
    if (!tree.parent_of.emplace(*child, *parent).second)
      xml.error(*joint, "link '" + *child + "' is the child of two joints, expected one parent");
    tree.joint_of.emplace(*child, joint);
  }
  return tree;
}

/// Whether walking up from a link comes back to it.
bool in_cycle(const Tree& tree, const std::string& link) {
  auto up = tree.parent_of.find(link);
  for (std::size_t steps = 0; up != tree.parent_of.end() && steps <= tree.links.size(); ++steps) {
    if (up->second == link) return true;
    up = tree.parent_of.find(up->second);
  }
  return false;
}

}  // namespace

void check_tree(const UrdfXml& xml, const TiXmlElement& robot) {
  const Tree tree = collect(xml, robot);
  std::string root;
  bool cycle_reported = false;
  for (const TiXmlElement* link : children(robot, "link")) {
    const char* name = link->Attribute("name");
    if (name == nullptr || tree.links.at(name) != link) continue;
    if (!tree.parent_of.contains(name)) {
      if (!root.empty())
        xml.error(*link, "two roots: links '" + root + "' and '" + name +
                             "' have no parent joint, expected one root");
      else
        root = name;
    } else if (!cycle_reported && in_cycle(tree, name)) {
      cycle_reported = true;
      xml.error(
          *tree.joint_of.at(name),
          std::string("link '") + name + "' is its own ancestor, expected a tree without a cycle");
    }
  }
}

}  // namespace pedicel::robot
