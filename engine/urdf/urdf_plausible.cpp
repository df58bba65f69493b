#include "engine/urdf/urdf_plausible.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "engine/io/csv.h"

namespace pedicel::robot {

namespace {

// Bounds far outside of any robot, so that a robot that is merely odd passes.
constexpr double heaviest_link = 1e4;   // kg
constexpr double longest = 50.0;        // m, of a link or between two joints
constexpr double smallest_mesh = 1e-4;  // m
constexpr double most_gyration = 10.0;  // 1, radius of gyration over the link's own size
constexpr double most_turns = 3.5;      // of a limit, in turns

using Box = Eigen::AlignedBox3d;

Vec3 half_size(const Geometry& shape) {
  switch (shape.kind) {
    case Geometry::Kind::box:
      return 0.5 * shape.size;
    case Geometry::Kind::sphere:
      return Vec3::Constant(shape.radius);
    case Geometry::Kind::cylinder:
      return {shape.radius, shape.radius, 0.5 * shape.length};
    case Geometry::Kind::capsule:
      return {shape.radius, shape.radius, 0.5 * shape.length + shape.radius};
    case Geometry::Kind::mesh:
      break;
  }
  return Vec3::Zero();
}

Box box_of(const Geometry& shape) {
  if (shape.kind != Geometry::Kind::mesh) return {-half_size(shape), half_size(shape)};
  Box box;
  for (const Vec3& vertex : shape.mesh->vertices) box.extend(vertex);
  return box;
}

std::string metres(double length) {
  return io::format_number(length, 4) + " m";
}

/// The remarks on one link.
class LinkRemarks {
 public:
  LinkRemarks(const UrdfXml& xml, const TiXmlElement& element, const Link& link,
              UrdfRemarks& remarks)
      : xml_(xml), element_(element), link_(link), remarks_(remarks) {}

  void act(double reach) {
    for (const Visual& visual : link_.visuals) shape(visual.geometry, visual.X_LV, reach);
    for (const Collision& collision : link_.collisions)
      shape(collision.geometry, collision.X_LC, reach);
    if (link_.inertial.mass > 0.0) inertia();
  }

 private:
  void add(const std::string& what) {
    remarks_.add(xml_.position(element_), "link '" + link_.name + "'", what);
  }

  void shape(const Geometry& geometry, const Pose& X_L, double reach) {
    const Box own = box_of(geometry);
    for (int corner = 0; corner < 8; ++corner)
      size_.extend(X_L * own.corner(static_cast<Box::CornerType>(corner)));
    const double length = own.sizes().maxCoeff();
    const bool is_mesh = geometry.kind == Geometry::Kind::mesh;
    const std::string what =
        is_mesh ? "mesh " + geometry.mesh_file.filename().string() : std::string("a shape");
    if (is_mesh && length > 3.0 && reach > 0.0 && length > 20.0 * reach)
      add(what + " is " + metres(length) + " long where all joints span " + metres(reach) +
          ": is it in mm (scale=\"0.001 0.001 0.001\")?");
    else if (length > longest)
      add(what + " is " + metres(length) + " long: no robot's is" +
          (is_mesh ? "; is it in mm (scale=\"0.001 0.001 0.001\")?" : ", expected metres"));
    else if (is_mesh && length < smallest_mesh)
      add(what + " is " + metres(length) + " long: scaled twice?");
    else if (X_L.position.norm() > longest)
      add("a shape lies " + metres(X_L.position.norm()) + " from its link, expected metres");
  }

  void inertia() {
    const Inertial& own = link_.inertial;
    if (own.mass > heaviest_link)
      add("mass " + io::format_number(own.mass, 4) + " kg: no robot's link weighs that; grams?");
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(own.inertia, Eigen::EigenvaluesOnly);
    const Vec3 moments = solver.eigenvalues();  // increasing
    if (moments[0] > 0.0 && moments[0] + moments[1] < 0.999 * moments[2])
      add("inertia that no body can have: its largest principal moment is above the sum of the "
          "other two");
    if (own.com_L.norm() > longest)
      add("centre of mass " + metres(own.com_L.norm()) + " from its link, expected metres");
    if (size_.isEmpty() || moments[2] <= 0.0) return;
    const double gyration = std::sqrt(moments[2] / own.mass), length = size_.sizes().norm();
    if (gyration > most_gyration * length)
      add("inertia of a body more than " + io::format_number(most_gyration, 2) +
          " times as large as the link's shapes: kg m2 expected");
  }

  const UrdfXml& xml_;
  const TiXmlElement& element_;
  const Link& link_;
  UrdfRemarks& remarks_;
  Box size_;  // of the shapes, in link axes
};

void remark_joint(const UrdfXml& xml, const TiXmlElement& element, const Joint& joint,
                  UrdfRemarks& remarks) {
  const std::string who = "joint '" + joint.name + "'";
  const auto add = [&](const std::string& what) { remarks.add(xml.position(element), who, what); };
  const double distance = joint.X_PJ.position.norm();
  if (distance > longest) add("lies " + metres(distance) + " from its parent, expected metres");
  if (const TiXmlElement* origin = element.FirstChildElement("origin"))
    if (const auto rpy = xml.numbers(*origin, "rpy", 3, who))
      for (const double angle : *rpy)
        if (std::abs(angle) > 2.01 * std::numbers::pi) {
          add("origin: rpy of more than a turn, expected rad; degrees?");
          break;
        }
  if (!joint.moves()) return;
  if (joint.lower == joint.upper && !joint.mimic)
    add("lower and upper limit are the same: it cannot move");
  const double limit = std::max(std::abs(joint.lower), std::abs(joint.upper));
  if (joint.type == JointType::revolute && limit > most_turns * 2.0 * std::numbers::pi &&
      limit <= 1000.0)
    add("limits of many turns, expected rad; degrees?");
  if (joint.type == JointType::prismatic && limit > longest && limit <= 1e4)
    add("slides " + metres(limit) + ", expected metres; millimetres?");
}

}  // namespace

void remark_implausible(const UrdfXml& xml, const TiXmlElement& root, const RobotDescription& robot,
                        UrdfRemarks& remarks) {
  double reach = 0.0;
  for (const Joint& joint : robot.joints) reach += joint.X_PJ.position.norm();
  const std::vector<const TiXmlElement*> links = children(root, "link");
  for (std::size_t i = 0; i < robot.links.size(); ++i)
    LinkRemarks(xml, *links[i], robot.links[i], remarks).act(reach);
  const std::vector<const TiXmlElement*> joints = children(root, "joint");
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    remark_joint(xml, *joints[j], robot.joints[j], remarks);
}

}  // namespace pedicel::robot
