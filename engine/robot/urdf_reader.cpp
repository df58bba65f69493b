#include "robot/urdf_reader.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "io/atomic_file.h"
#include "robot/substitute_inertia.h"
#include "robot/urdf_geometry.h"
#include "robot/urdf_xml.h"

namespace pedicel::robot {

namespace {

/// Keeps what urdfdom would print on stderr.
class UrdfdomMessages : public console_bridge::OutputHandler {
 public:
  UrdfdomMessages() { console_bridge::useOutputHandler(this); }
  ~UrdfdomMessages() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      errors_ += (errors_.empty() ? "" : "; ") + text;
  }
  const std::string& errors() const { return errors_; }

 private:
  std::string errors_;
};

/// The checked XML beside urdfdom's model of it.
struct Source {
  TiXmlDocument document;
  urdf::ModelInterfaceSharedPtr model;
};

bool check(const UrdfXml& xml, const TiXmlElement* robot, const PackagePaths& packages,
           Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  if (robot == nullptr || robot->ValueStr() != "robot") {
    const std::string found = robot != nullptr ? "<" + robot->ValueStr() + ">" : "nothing";
    diagnostics.error({xml.file(), 1, 1},
                      found + " as the first element, expected <robot name=\"...\">");
    return false;
  }
  if (check_xacro(xml, *robot)) return false;
  xml.text(*robot, "name", "robot");
  check_links(xml, *robot, packages);
  check_joints(xml, *robot);
  check_tree(xml, *robot);
  return diagnostics.error_count() == before;
}

bool parse(const std::string& text, const UrdfXml& xml, const PackagePaths& packages,
           Diagnostics& diagnostics, Source& source) {
  source.document.SetTabSize(1);  // a tab counts as one column, as in every other reader
  source.document.Parse(text.c_str());
  if (source.document.Error()) {
    diagnostics.error(
        {xml.file(), std::max(1, source.document.ErrorRow()),
         std::max(1, source.document.ErrorCol())},
        std::string("not XML: ") + source.document.ErrorDesc() + ", expected a URDF file");
    return false;
  }
  if (!check(xml, source.document.RootElement(), packages, diagnostics)) return false;
  const UrdfdomMessages messages;
  source.model = urdf::parseURDF(text);
  if (source.model != nullptr && messages.errors().empty()) return true;
  diagnostics.error({xml.file(), 1, 1}, "urdfdom refuses it: " + messages.errors());
  return false;
}

Link read_link(const urdf::Link& source, UrdfMeshes& meshes) {
  Link link;
  link.name = source.name;
  if (source.inertial != nullptr) {
    const urdf::Inertial& in = *source.inertial;
    const Pose pose = to_pose(in.origin);
    const Mat3 rotation = pose.rotation.toRotationMatrix();
    Mat3 inertia;
    inertia << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    link.inertial = {in.mass, pose.position, rotation * inertia * rotation.transpose()};
  }
  for (const auto& visual : source.visual_array)
    link.visuals.push_back(read_visual(*visual, meshes));
  for (const auto& collision : source.collision_array)
    link.collisions.push_back({to_pose(collision->origin), meshes.read(*collision->geometry)});
  return link;
}

JointType joint_type(int type) {
  switch (type) {
    case urdf::Joint::REVOLUTE:
      return JointType::revolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::continuous;
    case urdf::Joint::PRISMATIC:
      return JointType::prismatic;
    default:
      return JointType::fixed;
  }
}

Joint read_joint(const urdf::Joint& source, const RobotDescription& robot) {
  Joint joint;
  joint.name = source.name;
  joint.type = joint_type(source.type);
  joint.parent = robot.link(source.parent_link_name);
  joint.child = robot.link(source.child_link_name);
  joint.X_PJ = to_pose(source.parent_to_joint_origin_transform);
  if (!joint.moves()) return joint;
  joint.axis = Vec3(source.axis.x, source.axis.y, source.axis.z).normalized();
  if (source.limits != nullptr) {
    if (joint.type != JointType::continuous) {
      joint.lower = source.limits->lower;
      joint.upper = source.limits->upper;
    }
    if (source.limits->effort > 0.0) joint.effort = source.limits->effort;
    if (source.limits->velocity > 0.0) joint.velocity = source.limits->velocity;
  }
  if (source.dynamics != nullptr) {
    joint.damping = source.dynamics->damping;
    joint.friction = source.dynamics->friction;
  }
  return joint;
}

/// Follows a chain of mimics to the joint that moves by itself: q = m1 (m2 q2 + o2) + o1.
Mimic resolve_mimic(const urdf::ModelInterface& model, const urdf::JointMimic& mimic,
                    const RobotDescription& robot) {
  Mimic result{robot.joint(mimic.joint_name), mimic.multiplier, mimic.offset};
  const urdf::JointConstSharedPtr source = model.getJoint(mimic.joint_name);
  if (source->mimic == nullptr) return result;
  const Mimic next = resolve_mimic(model, *source->mimic, robot);
  return {next.source, result.multiplier * next.multiplier,
          result.multiplier * next.offset + result.offset};
}

RobotDescription describe(const UrdfXml& xml, const TiXmlElement& root,
                          const urdf::ModelInterface& model, UrdfMeshes& meshes) {
  RobotDescription robot;
  robot.name = model.getName();
  for (const TiXmlElement* element : children(root, "link")) {
    meshes.set_position(xml.position(*element));
    robot.links.push_back(read_link(*model.getLink(element->Attribute("name")), meshes));
  }
  for (const TiXmlElement* element : children(root, "joint"))
    robot.joints.push_back(read_joint(*model.getJoint(element->Attribute("name")), robot));
  for (Joint& joint : robot.joints)
    if (const auto& mimic = model.getJoint(joint.name)->mimic; mimic != nullptr && joint.moves())
      joint.mimic = resolve_mimic(model, *mimic, robot);
  robot.root = robot.link(model.getRoot()->name);
  return robot;
}

void substitute_inertias(const UrdfXml& xml, const TiXmlElement& root, RobotDescription& robot) {
  const std::vector<const TiXmlElement*> elements = children(root, "link");
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    bool fixed = true;
    for (const Joint& joint : robot.joints)
      if (joint.child == static_cast<int>(i)) fixed = !joint.moves();
    if (const auto sentence = substitute_inertia(robot.links[i], fixed))
      xml.warning(*elements[i], *sentence);
  }
}

}  // namespace

std::optional<RobotDescription> parse_urdf(const std::string& text,
                                           const std::filesystem::path& path,
                                           const PackagePaths& packages, Diagnostics& diagnostics) {
  const UrdfXml xml(path.string(), diagnostics);
  const int before = diagnostics.error_count();
  Source source;
  if (!parse(text, xml, packages, diagnostics, source)) return {};
  const TiXmlElement& root = *source.document.RootElement();
  UrdfMeshes meshes(path, packages, diagnostics);
  RobotDescription robot = describe(xml, root, *source.model, meshes);
  if (diagnostics.error_count() > before) return {};  // a mesh that cannot be loaded
  robot.file = path.string();
  substitute_inertias(xml, root, robot);
  return robot;
}

std::optional<RobotDescription> read_urdf(const std::filesystem::path& path,
                                          const PackagePaths& packages, Diagnostics& diagnostics) {
  std::string text;
  try {
    text = io::read_file(path);
  } catch (const InvalidFile&) {
    diagnostics.error({path.string()}, "cannot be read, expected a URDF file");
    return {};
  }
  return parse_urdf(text, path, packages, diagnostics);
}

RobotDescription load_urdf(const std::filesystem::path& path, const PackagePaths& packages) {
  Diagnostics diagnostics;
  std::optional<RobotDescription> robot = read_urdf(path, packages, diagnostics);
  if (!robot) throw InvalidFile(diagnostics);
  return std::move(*robot);
}

}  // namespace pedicel::robot
