#include "app/gltf/gltf_surfaces.h"

#include <numbers>

#include "app/draw/drawing.h"
#include "app/draw/plant_drawing.h"
#include "engine/geometry/primitives_mesh.h"
#include "engine/render/mesh_normals.h"

namespace pedicel::app {

namespace {

constexpr int sides = 16, stem_sides = 8;

bool alike(const render::Shading& a, const render::Shading& b) {
  return a.colour.r == b.colour.r && a.colour.g == b.colour.g && a.colour.b == b.colour.b &&
         a.roughness == b.roughness;
}

class Gathered {
 public:
  void add(const geometry::TriangleMesh& mesh, const Pose& pose, const render::Shading& material) {
    if (mesh.triangles.empty()) return;
    GltfSurface& surface = of(material, false);
    const render::MeshData data = render::with_normals(mesh);
    const auto first = static_cast<std::uint32_t>(surface.positions.size() / 3);
    for (std::size_t v = 0; v + 5 < data.vertices.size(); v += 6) {
      const float* at = data.vertices.data() + v;
      put(surface.positions, pose * Vec3(at[0], at[1], at[2]));
      put(surface.normals, (pose.rotation * Vec3(at[3], at[4], at[5])).normalized());
    }
    for (const std::uint32_t index : data.indices) surface.indices.push_back(first + index);
  }
  void add(const render::BladeFace& face) {
    GltfSurface& surface = of(face.material, true);
    const Vec3 across = (face.b - face.a).cross(face.c - face.a);
    if (!(across.norm() > 0.0)) return;
    for (const Vec3& corner : {face.a, face.b, face.c}) {
      surface.indices.push_back(static_cast<std::uint32_t>(surface.positions.size() / 3));
      put(surface.positions, corner);
      put(surface.normals, across.normalized());
    }
  }
  std::vector<GltfSurface> take() {
    std::erase_if(all_, [](const GltfSurface& one) { return one.indices.empty(); });
    return std::move(all_);
  }
  GltfSurface& of(const render::Shading& material, bool both_sides) {
    for (GltfSurface& one : all_)
      if (alike(one.material, material) && one.both_sides == both_sides) return one;
    all_.push_back({{}, {}, {}, {}, material, both_sides});
    return all_.back();
  }
  static void put(std::vector<float>& values, const Vec3& v) {
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(v[i]));
  }

 private:
  std::vector<GltfSurface> all_;
};

/// The frame of what stands along z between two points.
Pose along(const Vec3& p0, const Vec3& p1) {
  return {0.5 * (p0 + p1), Quat::FromTwoVectors(Vec3::UnitZ(), p1 - p0)};
}

/// A circle about a joint's third axis, `back` (m) behind the joint.
void add_ring(GltfSurface& surface, double radius, double back, int joint) {
  for (int s = 0; s < stem_sides; ++s) {
    const double angle = 2.0 * std::numbers::pi * s / stem_sides;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    Gathered::put(surface.positions, radius * out - Vec3(0, 0, back));
    Gathered::put(surface.normals, out);
    surface.joints.push_back(static_cast<std::uint16_t>(joint));
  }
}

/// The triangles between two rings, of which `first` is the first vertex.
void join_rings(GltfSurface& surface, std::uint32_t first) {
  for (std::uint32_t s = 0; s < stem_sides; ++s) {
    const std::uint32_t next = (s + 1) % stem_sides;
    for (const std::uint32_t corner :
         {s, next, stem_sides + s, next, stem_sides + next, stem_sides + s})
      surface.indices.push_back(first + corner);
  }
}

void add_stem(GltfSurface& surface, const cosserat::Element& element, int joint) {
  const auto first = static_cast<std::uint32_t>(surface.positions.size() / 3);
  add_ring(surface, element.radius_near, element.length, joint);
  add_ring(surface, element.radius_far, 0.0, joint);
  join_rings(surface, first);
}

}  // namespace

std::vector<GltfSurface> surfaces_of(const render::DrawList& shape) {
  Gathered all;
  for (const render::Sphere& sphere : shape.spheres)
    if (sphere.radius > 0.0)
      all.add(geometry::make_sphere(sphere.radius, sides), {sphere.centre, Quat::Identity()},
              sphere.material);
  for (const render::Box& box : shape.boxes)
    all.add(geometry::make_box(2.0 * box.half_extents), box.pose, box.material);
  for (const render::MeshInstance& one : shape.meshes)
    if (one.mesh) all.add(*one.mesh, one.pose, one.material);
  for (const render::Capsule& one : shape.capsules) {
    const double radius = std::max(one.r0, one.r1), length = (one.p1 - one.p0).norm();
    if (radius > 0.0 && length > 0.0)
      all.add(geometry::make_capsule(radius, length, sides), along(one.p0, one.p1), one.material);
  }
  for (const render::TubeSegment& one : shape.tubes) {
    const double radius = 0.5 * (one.r0 + one.r1), length = (one.p1 - one.p0).norm();
    if (radius > 0.0 && length > 0.0)
      all.add(geometry::make_cylinder(radius, length, sides), along(one.p0, one.p1),
              {one.colour0, one.roughness, one.specular});
  }
  for (const render::BladeFace& face : shape.blades) all.add(face);
  return all.take();
}

std::vector<GltfSurface> surfaces_of(const cosserat::RodModel& model,
                                     const simulation::PlantInfo& plant) {
  const PlantLook look = PlantLook::of(plant.look);
  GltfSurface stems{{}, {}, {}, {}, look.stem, false}, leaves{{}, {}, {}, {}, look.blade, true};
  for (int e = 0; e < model.size(); ++e)
    add_stem(stems, model.elements[static_cast<std::size_t>(e)], e);
  for (const simulation::Blade& blade : plant.blades) {
    Vec3 drawn[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto e = static_cast<std::size_t>(blade[k].element);
      const cosserat::Element& element = model.elements[e];
      drawn[k] = element.drawn_position - element.drawn_rotation * Vec3(0, 0, blade[k].back);
    }
    const Vec3 across = (drawn[1] - drawn[0]).cross(drawn[2] - drawn[0]);
    if (!(across.norm() > 0.0)) continue;
    for (const simulation::BladeCorner& corner : blade) {
      const cosserat::Element& element = model.elements[static_cast<std::size_t>(corner.element)];
      leaves.indices.push_back(static_cast<std::uint32_t>(leaves.positions.size() / 3));
      Gathered::put(leaves.positions, Vec3(0, 0, -corner.back));
      Gathered::put(leaves.normals, (element.drawn_rotation.conjugate() * across).normalized());
      leaves.joints.push_back(static_cast<std::uint16_t>(corner.element));
    }
  }
  std::vector<GltfSurface> all;
  if (!stems.indices.empty()) all.push_back(std::move(stems));
  if (!leaves.indices.empty()) all.push_back(std::move(leaves));
  return all;
}

GltfSurface string_surface(int places) {
  GltfSurface surface{{}, {}, {}, {}, {twine, 0.9F, 0.1F}, false};
  for (int i = 0; i < places; ++i) {
    add_ring(surface, string_radius, 0.0, i);
    if (i > 0) join_rings(surface, static_cast<std::uint32_t>((i - 1) * stem_sides));
  }
  return surface;
}

}  // namespace pedicel::app
