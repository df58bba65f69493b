#include "engine/urdf/urdf_reader.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/urdf/substitute_inertia.h"
#include "engine/urdf/urdf_geometry.h"
#include "engine/urdf/urdf_materials.h"
#include "engine/urdf/urdf_plausible.h"
#include "engine/urdf/urdf_text.h"
#include "engine/urdf/urdf_xml.h"
#include "engine/urdf/urdfdom_text.h"

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

/// The checked XML beside urdfdom's model of it, and what is remarked on the way.
struct Source {
  TiXmlDocument document;
  urdf::ModelInterfaceSharedPtr model;
  UrdfRemarks remarks;
};

bool check(const UrdfXml& xml, const TiXmlElement* robot, Diagnostics& diagnostics,
           UrdfRemarks& remarks) {
  const int before = diagnostics.error_count();
  if (robot == nullptr || robot->ValueStr() != "robot") {
    const std::string found = robot != nullptr ? "<" + robot->ValueStr() + ">" : "nothing";
    diagnostics.error({xml.file(), 1, 1},
                      found + " as the first element, expected <robot name=\"...\">");
    return false;
  }
  if (check_xacro(xml, *robot, remarks)) return false;
  check_links(xml, *robot);
  check_joints(xml, *robot, remarks);
  check_tree(xml, *robot);
  return diagnostics.error_count() == before;
}

/// The robot's name; one without has that of its file.
std::string name_of(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks) {
  if (const char* name = robot.Attribute("name"); name != nullptr && *name != '\0') return name;
  const std::string stem = std::filesystem::path(xml.file()).stem().string();
  remarks.add(xml.position(robot), "robot", "no name, the file's is taken: '" + stem + "'");
  return stem;
}

bool parse(const std::string& bytes, const UrdfXml& xml, Diagnostics& diagnostics, Source& source) {
  const std::optional<std::string> text = urdf_xml_text(bytes, xml.file(), diagnostics);
  if (!text) return false;
  source.document.SetTabSize(1);  // a tab counts as one column, as in every other reader
  source.document.Parse(text->c_str());
  if (source.document.Error()) {
    diagnostics.error(
        {xml.file(), std::max(1, source.document.ErrorRow()),
         std::max(1, source.document.ErrorCol())},
        std::string("not XML: ") + source.document.ErrorDesc() + ", expected a URDF file");
    return false;
  }
  const TiXmlElement* robot = source.document.RootElement();
  if (!check(xml, robot, diagnostics, source.remarks)) return false;
  const UrdfdomMessages messages;
  source.model = urdf::parseURDF(urdfdom_text(*robot, name_of(xml, *robot, source.remarks)));
  if (source.model != nullptr && messages.errors().empty()) return true;
  diagnostics.error({xml.file(), 1, 1}, "urdfdom refuses it: " + messages.errors());
  return false;
}

Inertial read_inertial(const UrdfXml& xml, const TiXmlElement& element,
                       const urdf::Inertial& source) {
  const Pose pose = read_origin(xml, element);
  const Mat3 rotation = pose.rotation.toRotationMatrix();
  Mat3 inertia;
  inertia << source.ixx, source.ixy, source.ixz, source.ixy, source.iyy, source.iyz, source.ixz,
      source.iyz, source.izz;
  return {source.mass, pose.position, rotation * inertia * rotation.transpose()};
}

Link read_link(const UrdfXml& xml, const TiXmlElement& element, const urdf::Link& source,
               UrdfShapes& shapes, const UrdfMaterials& materials) {
  Link link;
  link.name = source.name;
  if (source.inertial != nullptr)
    link.inertial = read_inertial(xml, *element.FirstChildElement("inertial"), *source.inertial);
  for (const TiXmlElement* visual : children(element, "visual"))
    if (auto geometry = shapes.read(*visual, link.name))
      link.visuals.push_back(
          {read_origin(xml, *visual), std::move(*geometry), materials.colour(*visual, link.name)});
  for (const TiXmlElement* collision : children(element, "collision"))
    if (auto geometry = shapes.read(*collision, link.name))
      link.collisions.push_back({read_origin(xml, *collision), std::move(*geometry)});
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

Joint read_joint(const UrdfXml& xml, const TiXmlElement& element, const urdf::Joint& source,
                 const RobotDescription& robot) {
  Joint joint;
  joint.name = source.name;
  joint.type = joint_type(source.type);
  joint.parent = robot.link(source.parent_link_name);
  joint.child = robot.link(source.child_link_name);
  joint.X_PJ = read_origin(xml, element);
  if (!joint.moves()) return joint;
  joint.axis = Vec3(source.axis.x, source.axis.y, source.axis.z).normalized();
  if (source.limits != nullptr) {
    const TiXmlElement& limit = *element.FirstChildElement("limit");
    const double lower = is_endless(limit, "lower") ? -Joint::unlimited : source.limits->lower;
    const double upper = is_endless(limit, "upper") ? Joint::unlimited : source.limits->upper;
    if (joint.type != JointType::continuous && lower <= upper) {  // crossed ones are remarked
      joint.lower = lower;
      joint.upper = upper;
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

RobotDescription describe(const UrdfXml& xml, const Source& source, UrdfShapes& shapes,
                          const UrdfMaterials& materials) {
  const urdf::ModelInterface& model = *source.model;
  const TiXmlElement& root = *source.document.RootElement();
  RobotDescription robot;
  robot.name = model.getName();
  for (const TiXmlElement* element : children(root, "link"))
    robot.links.push_back(
        read_link(xml, *element, *model.getLink(element->Attribute("name")), shapes, materials));
  for (const TiXmlElement* element : children(root, "joint"))
    robot.joints.push_back(
        read_joint(xml, *element, *model.getJoint(element->Attribute("name")), robot));
  for (Joint& joint : robot.joints)
    if (const auto& mimic = model.getJoint(joint.name)->mimic; mimic != nullptr && joint.moves())
      joint.mimic = resolve_mimic(model, *mimic, robot);
  robot.root = robot.link(model.getRoot()->name);
  return robot;
}

/// Links whose masses or inertias are substituted in one and the same way.
struct Substituted {
  const TiXmlElement* first = nullptr;
  InertiaSubstitute lightest;
  double heaviest = 0.0;  // kg
  std::vector<std::string> links;
};

void add_to(std::vector<Substituted>& kinds, const InertiaSubstitute& one,
            const TiXmlElement& element, const std::string& link) {
  auto kind = std::ranges::find_if(kinds, [&](const Substituted& known) {
    return known.lightest.why == one.why && known.lightest.how == one.how;
  });
  if (kind == kinds.end()) kind = kinds.insert(kinds.end(), {&element, one, one.mass, {}});
  kind->lightest.mass = std::min(kind->lightest.mass, one.mass);
  kind->heaviest = std::max(kind->heaviest, one.mass);
  kind->links.push_back("link '" + link + "'");
}

void substitute_inertias(const UrdfXml& xml, const TiXmlElement& root, RobotDescription& robot) {
  const std::vector<const TiXmlElement*> elements = children(root, "link");
  std::vector<Substituted> kinds;
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    bool fixed = true;
    for (const Joint& joint : robot.joints)
      if (joint.child == static_cast<int>(i)) fixed = !joint.moves();
    if (const auto one = substitute_inertia(robot.links[i], fixed))
      add_to(kinds, *one, *elements[i], robot.links[i].name);
  }
  for (const Substituted& kind : kinds) {
    const std::string times =
        kind.links.size() > 1 ? " (" + std::to_string(kind.links.size()) + " links)" : "";
    xml.warning(*kind.first,
                first_names(kind.links) + ": " + kind.lightest.sentence(kind.heaviest) + times);
  }
}

}  // namespace

std::optional<RobotDescription> parse_urdf(const std::string& text,
                                           const std::filesystem::path& path,
                                           const PackagePaths& packages, Diagnostics& diagnostics) {
  const UrdfXml xml(path.string(), diagnostics);
  const int before = diagnostics.error_count();
  Source source;
  if (!parse(text, xml, diagnostics, source)) {
    source.remarks.report(diagnostics);
    return {};
  }
  const TiXmlElement& root = *source.document.RootElement();
  const UrdfMaterials materials(xml, root, source.remarks);
  UrdfShapes shapes(xml, packages, source.remarks);
  RobotDescription robot = describe(xml, source, shapes, materials);
  remark_implausible(xml, root, robot, source.remarks);
  source.remarks.report(diagnostics);
  report_missing(shapes.missing(), diagnostics);
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
