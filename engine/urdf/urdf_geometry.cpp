#include "engine/urdf/urdf_geometry.h"

#include <urdf_model/pose.h>

#include "engine/geometry/mesh_file.h"

namespace pedicel::robot {

namespace {

Vec3 vector_or(const UrdfXml& xml, const TiXmlElement& element, const char* attribute,
               const Vec3& otherwise) {
  const auto values = xml.numbers(element, attribute, 3, element.ValueStr());
  return values ? Vec3((*values)[0], (*values)[1], (*values)[2]) : otherwise;
}

double number_of(const UrdfXml& xml, const TiXmlElement& element, const char* attribute) {
  return xml.number(element, attribute, element.ValueStr()).value_or(0.0);
}

Geometry read_primitive(const UrdfXml& xml, const TiXmlElement& shape) {
  Geometry geometry;
  const std::string& kind = shape.ValueStr();
  if (kind == "box") {
    geometry.kind = Geometry::Kind::box;
    geometry.size = vector_or(xml, shape, "size", Vec3::Zero());
    return geometry;
  }
  geometry.radius = number_of(xml, shape, "radius");
  geometry.kind = Geometry::Kind::sphere;
  if (kind == "sphere") return geometry;
  geometry.length = number_of(xml, shape, "length");
  geometry.kind = kind == "capsule" ? Geometry::Kind::capsule : Geometry::Kind::cylinder;
  return geometry;
}

bool has_extent(const Geometry& geometry) {
  switch (geometry.kind) {
    case Geometry::Kind::box:
      return geometry.size.minCoeff() > 0.0;
    case Geometry::Kind::cylinder:
      return geometry.radius > 0.0 && geometry.length > 0.0;
    case Geometry::Kind::sphere:
    case Geometry::Kind::capsule:
      return geometry.radius > 0.0;
    case Geometry::Kind::mesh:
      break;
  }
  return true;
}

std::string list_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> names;
  for (const auto& path : paths) names.push_back(path.string());
  return first_names(names);
}

}  // namespace

Pose read_origin(const UrdfXml& xml, const TiXmlElement& parent) {
  const TiXmlElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const Vec3 xyz = vector_or(xml, *origin, "xyz", Vec3::Zero());
  if (const auto q = xml.numbers(*origin, "quat_xyzw", 4, "origin"))
    return {xyz, Quat((*q)[3], (*q)[0], (*q)[1], (*q)[2]).normalized()};
  const Vec3 rpy = vector_or(xml, *origin, "rpy", Vec3::Zero());
  urdf::Rotation r;  // its order of roll, pitch and yaw, to the last bit
  r.setFromRPY(rpy.x(), rpy.y(), rpy.z());
  return {xyz, Quat(r.w, r.x, r.y, r.z).normalized()};
}

std::optional<Geometry> UrdfShapes::read(const TiXmlElement& owner, const std::string& link) {
  const TiXmlElement& shape = *owner.FirstChildElement("geometry")->FirstChildElement();
  const bool collision = owner.ValueStr() == "collision";
  if (shape.ValueStr() == "mesh") return read_mesh(shape, link, collision);
  const Geometry geometry = read_primitive(xml_, shape);
  if (has_extent(geometry)) return geometry;
  remarks_.add(xml_.position(shape), "link '" + link + "'",
               owner.ValueStr() + " of size 0, left out");
  return {};
}

const UrdfShapes::Loaded& UrdfShapes::load(const std::filesystem::path& file, const Vec3& scale) {
  std::string key = file.string();
  for (int k = 0; k < 3; ++k) key += " " + std::to_string(scale[k]);
  const auto [at, added] = loaded_.try_emplace(key);
  if (!added) return at->second;
  try {
    at->second.mesh = std::make_shared<geometry::TriangleMesh>(geometry::load_mesh(file, scale));
  } catch (const InvalidFile& fault) {
    at->second.fault = fault.all().front().what;
  }
  return at->second;
}

std::optional<Geometry> UrdfShapes::read_mesh(const TiXmlElement& mesh, const std::string& link,
                                              bool collision) {
  const std::string name = mesh.Attribute("filename");
  const TiXmlBase& at = attribute_or_element(mesh, "filename");
  const auto [known, added] = found_.try_emplace(name);
  if (added) known->second = packages_.find(name, xml_.file());
  const PackagePaths::Found& found = known->second;
  MissingMesh missing{xml_.position(at), link, name, found.package, "", "", "", collision};
  if (!found.file) {
    missing.reason = "not found";
    missing.looked_in = list_of(found.looked_at);
    missing.advice = found.advice;
  } else if (geometry::is_lfs_pointer(*found.file)) {
    missing.reason = geometry::lfs_advice;
  }
  if (!missing.reason.empty()) {
    missing_.push_back(std::move(missing));
    return {};
  }
  if (found.other_case)
    remarks_.add(xml_.position(at), "link '" + link + "'",
                 "mesh file \"" + name + "\": " + found.file->filename().string() +
                     " is there and taken; their names differ in upper and lower case");
  const Loaded& loaded = load(*found.file, vector_or(xml_, mesh, "scale", Vec3::Ones()));
  if (loaded.mesh != nullptr) {
    Geometry geometry;
    geometry.kind = Geometry::Kind::mesh;
    geometry.mesh_file = *found.file;
    geometry.mesh = loaded.mesh;
    return geometry;
  }
  const std::string fault = "mesh \"" + name + "\": " + loaded.fault;
  if (collision)
    xml_.error(at, "link '" + link + "': collision: " + fault);
  else
    remarks_.add(xml_.position(at), "link '" + link + "'", fault + "; not drawn");
  return {};
}

}  // namespace pedicel::robot
