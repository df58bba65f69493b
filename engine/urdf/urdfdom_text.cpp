#include "engine/urdf/urdfdom_text.h"

#include <set>

#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

namespace {

using Names = std::set<std::string>;

/// Takes out every child element that is not in the list.
void keep_only(TiXmlElement& parent, const Names& names) {
  for (TiXmlElement* child = parent.FirstChildElement(); child != nullptr;) {
    TiXmlElement* next = child->NextSiblingElement();
    if (!names.contains(child->ValueStr())) parent.RemoveChild(child);
    child = next;
  }
}

void prepare_joint(TiXmlElement& joint) {
  const char* type = joint.Attribute("type");
  const bool fixed = type != nullptr && std::string(type) == "fixed";
  keep_only(joint, fixed
                       ? Names{"origin", "parent", "child"}
                       : Names{"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"});
  TiXmlElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) return;
  for (const char* name : {"effort", "velocity"})
    if (limit->Attribute(name) == nullptr) limit->SetAttribute(name, "0");
  for (const char* name : {"effort", "velocity", "lower", "upper"})
    if (is_endless(*limit, name)) limit->SetAttribute(name, "0");
}

}  // namespace

std::string urdfdom_text(const TiXmlElement& robot, const std::string& name) {
  TiXmlElement copy(robot);
  copy.SetAttribute("name", name);
  copy.RemoveAttribute("version");
  keep_only(copy, {"link", "joint"});
  for (TiXmlElement* child = copy.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (child->ValueStr() == "link") keep_only(*child, {"inertial"});
    if (child->ValueStr() == "joint") prepare_joint(*child);
  }
  TiXmlPrinter printer;
  copy.Accept(&printer);
  return printer.Str();
}

}  // namespace pedicel::robot
