#include <map>

#include "engine/robot/description.h"
#include "engine/urdf/urdf_xml.h"

namespace pedicel::robot {

namespace {

const std::set<std::string> joint_types = {"fixed", "revolute", "continuous", "prismatic"};

void check_axis(const UrdfXml& xml, const TiXmlElement& joint, const std::string& what) {
  const TiXmlElement* axis = joint.FirstChildElement("axis");
  if (axis == nullptr) return;  // the standard's default is 1 0 0
  if (!xml.text(*axis, "xyz", what + ": axis")) return;
  const auto xyz = xml.numbers(*axis, "xyz", 3, what + ": axis");
  if (xyz && Vec3((*xyz)[0], (*xyz)[1], (*xyz)[2]).norm() < 1e-6)
    xml.error(attribute_or_element(*axis, "xyz"),
              what + ": axis of length 0, expected a direction such as 0 0 1");
}

/// An effort or a velocity: 0, -1 and none at all are no limit.
void check_largest(const UrdfXml& xml, const TiXmlElement& limit, const char* name,
                   const std::string& what, UrdfRemarks& remarks) {
  const TiXmlBase& at = attribute_or_element(limit, name);
  const auto remark = [&](const std::string& found) {
    remarks.add(xml.position(at), what, found + ", taken as unlimited");
  };
  if (limit.Attribute(name) == nullptr) return remark(std::string("no ") + name);
  if (is_endless(limit, name) && *limit.Attribute(name) != '-') return;
  const auto value = xml.number(limit, name, what + ": limit");
  if (!value || *value > 0.0) return;
  if (*value == 0.0)
    remark(std::string(name) + " 0 would stop the joint");
  else if (*value == -1.0)
    remark(std::string(name) + " -1");
  else
    xml.error(at, what + ": limit: " + name + " \"" + limit.Attribute(name) +
                      "\", expected 0 or more, or -1 for no limit");
}

/// A lower or an upper limit; -inf and inf are none.
std::optional<double> read_end(const UrdfXml& xml, const TiXmlElement& limit, const char* name,
                               const std::string& what) {
  const bool lower = std::string(name) == "lower";
  if (is_endless(limit, name) && (*limit.Attribute(name) == '-') == lower)
    return lower ? -Joint::unlimited : Joint::unlimited;
  return xml.number(limit, name, what + ": limit", false);
}

void check_limit(const UrdfXml& xml, const TiXmlElement& joint, const std::string& type,
                 const std::string& what, UrdfRemarks& remarks) {
  const bool needed = type == "revolute" || type == "prismatic";
  const TiXmlElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) {
    if (needed)
      xml.error(joint, what + ": " + type +
                           " joint without <limit>, expected lower, upper, effort and velocity");
    return;
  }
  const auto lower = read_end(xml, *limit, "lower", what);
  const auto upper = read_end(xml, *limit, "upper", what);
  if (needed && lower.value_or(0.0) > upper.value_or(0.0))
    remarks.add(xml.position(*limit), what, "limit with lower above upper, taken as unlimited");
  for (const char* name : {"effort", "velocity"}) check_largest(xml, *limit, name, what, remarks);
}

void check_dynamics(const UrdfXml& xml, const TiXmlElement& joint, const std::string& what) {
  const TiXmlElement* dynamics = joint.FirstChildElement("dynamics");
  if (dynamics == nullptr) return;
  xml.not_negative(*dynamics, "damping", what + ": dynamics", false, false);
  xml.not_negative(*dynamics, "friction", what + ": dynamics", false, false);
  if (dynamics->Attribute("damping") == nullptr && dynamics->Attribute("friction") == nullptr)
    xml.error(*dynamics, what + ": empty <dynamics>, expected damping or friction");
}

using JointMap = std::map<std::string, const TiXmlElement*>;

void check_mimic(const UrdfXml& xml, const TiXmlElement& joint, const JointMap& joints,
                 const std::string& name, const std::string& what) {
  const TiXmlElement* mimic = joint.FirstChildElement("mimic");
  if (mimic == nullptr) return;
  xml.number(*mimic, "multiplier", what + ": mimic", false);
  xml.number(*mimic, "offset", what + ": mimic", false);
  const std::optional<std::string> source = xml.text(*mimic, "joint", what + ": mimic");
  if (!source) return;
  std::set<std::string> seen = {name};
  for (std::string at = *source;;) {
    const auto found = joints.find(at);
    if (found == joints.end()) {
      xml.error(attribute_or_element(*mimic, "joint"),
                what + ": mimic of the unknown joint '" + at + "', expected a joint of this file");
      return;
    }
    const char* type = found->second->Attribute("type");
    if (type != nullptr && std::string(type) == "fixed") {
      xml.error(attribute_or_element(*mimic, "joint"),
                what + ": mimic of the fixed joint '" + at + "', expected a joint that moves");
      return;
    }
    if (!seen.insert(at).second) {
      xml.error(attribute_or_element(*mimic, "joint"),
                what + ": mimic joints in a circle, expected one that moves by itself");
      return;
    }
    const TiXmlElement* next = found->second->FirstChildElement("mimic");
    const char* next_name = next != nullptr ? next->Attribute("joint") : nullptr;
    if (next_name == nullptr) return;
    at = next_name;
  }
}

void check_joint(const UrdfXml& xml, const TiXmlElement& joint, const JointMap& joints,
                 const std::string& name, UrdfRemarks& remarks) {
  const std::string what = "joint '" + name + "'";
  xml.check_origin(joint, what);
  const std::optional<std::string> type = xml.text(joint, "type", what);
  if (type == "fixed") return;  // nothing else of it means anything
  check_axis(xml, joint, what);
  check_dynamics(xml, joint, what);
  check_mimic(xml, joint, joints, name, what);
  if (!type) return;
  if (joint_types.contains(*type)) return check_limit(xml, joint, *type, what, remarks);
  const bool in_the_standard = *type == "floating" || *type == "planar";
  xml.error(attribute_or_element(joint, "type"),
            what +
                (in_the_standard ? ": joint type '" + *type + "' is not supported"
                                 : ": unknown joint type '" + *type + "'") +
                ", expected fixed, revolute, continuous or prismatic");
}

}  // namespace

void check_joints(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks) {
  JointMap joints;
  for (const TiXmlElement* joint : children(robot, "joint")) {
    const std::optional<std::string> name = xml.text(*joint, "name", "joint");
    if (name && !joints.emplace(*name, joint).second)
      xml.error(attribute_or_element(*joint, "name"),
                "duplicate joint '" + *name + "', expected each name once");
  }
  for (const TiXmlElement* joint : children(robot, "joint"))
    if (const char* name = joint->Attribute("name"))
      check_joint(xml, *joint, joints, name, remarks);
}

}  // namespace pedicel::robot
