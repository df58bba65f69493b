#include "engine/render/frame_geometry.h"

#include <cmath>
#include <initializer_list>

#include "engine/render/colour_space.h"
#include "engine/render/mesh_normals.h"

namespace pedicel::render {

namespace {

void put(std::vector<float>& to, const Vec3& v) {
  for (int i = 0; i < 3; ++i) to.push_back(static_cast<float>(v[i]));
}
void put(std::vector<float>& to, const Vec3& v, double w) {
  put(to, v);
  to.push_back(static_cast<float>(w));
}
void put(std::vector<float>& to, const Colour& colour) {
  const Colour linear = to_linear(colour);
  to.insert(to.end(), {linear.r, linear.g, linear.b});
}
void put(std::vector<float>& to, const Shading& material, Label label) {
  put(to, material.colour);
  to.insert(to.end(), {material.roughness, material.specular, static_cast<float>(label)});
}
void put_segment(std::vector<float>& to, const TubeSegment& t) {
  put(to, t.p0, t.r0);
  put(to, t.p1, t.r1);
  for (const Vec3* v : {&t.tangent0, &t.tangent1, &t.side0, &t.side1}) put(to, *v);
  put(to, t.colour0);
  put(to, t.colour1);
  to.insert(to.end(), {t.roughness, t.specular, static_cast<float>(t.label)});
}
void put_pose(std::vector<float>& to, const Pose& pose, const Vec3& stretch) {
  const Mat3 matrix = pose.rotation.toRotationMatrix() * stretch.asDiagonal();
  for (int row = 0; row < 3; ++row) put(to, matrix.row(row).transpose(), pose.position[row]);
}

}  // namespace

MeshCache::Entry& MeshCache::entry(const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  Entry& found = entries_[mesh.get()];
  // The address may have belonged to another mesh before.
  if (found.owner.lock() != mesh) {
    found.owner = mesh;
    found.box = mesh_bounds(*mesh);
    found.drawn = std::make_unique<InstancedMesh>(gl_, with_normals(*mesh), mesh_layout());
    found.drawn->set_closed(is_closed(*mesh));
  }
  return found;
}

const InstancedMesh& MeshCache::get(const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  return *entry(mesh).drawn;
}

const Eigen::AlignedBox3d& MeshCache::bounds(
    const std::shared_ptr<const geometry::TriangleMesh>& mesh) {
  return entry(mesh).box;
}

void MeshCache::drop_unused() {
  std::erase_if(entries_, [](const auto& item) { return item.second.owner.expired(); });
}

Detail::Detail(const Camera& camera, int width, int height, double share)
    : to_camera_(camera.view().topRows<3>()),
      focal_(camera.focal_length(height)),
      near_(camera.near_plane),
      share_(share),
      slope_(0.5 * width / focal_, 0.5 * height / focal_) {}

int Detail::level(const Vec3& centre, double radius) const {
  return level(centre, radius, radius);
}

int Detail::level(const Vec3& centre, double reach, double radius) const {
  if (everything_) return UnitMeshes::level_for(focal_ * radius);
  const Vec3 p = to_camera_ * centre.homogeneous();
  const double depth = -p.z();
  if (depth < near_ - reach) return -1;
  for (int axis = 0; axis < 2; ++axis) {
    // Distance beyond the side plane of the view.
    const double out = (std::abs(p[axis]) - slope_[axis] * depth) / std::hypot(1.0, slope_[axis]);
    if (out > reach) return -1;
  }
  return UnitMeshes::level_for(share_ * focal_ * radius / std::max(depth - reach, near_));
}

FrameGeometry::FrameGeometry(const GlFunctions& gl, const UnitMeshes& shapes, MeshCache& cache)
    : gl_(gl), shapes_(shapes), cache_(cache) {
  gl_.GenBuffers(1, &buffer_);
}

FrameGeometry::~FrameGeometry() {
  gl_.DeleteBuffers(1, &buffer_);
}

std::vector<float>& FrameGeometry::batch(Kind kind, const InstancedMesh& mesh) {
  auto& batches = batches_[static_cast<int>(kind)];
  for (Batch& known : batches)
    if (known.mesh == &mesh) return known.floats;
  batches.push_back({&mesh, {}, 0});
  return batches.back().floats;
}

void FrameGeometry::prepare(const DrawList& list, const Detail& detail) {
  for (auto& batches : batches_) batches.clear();
  add_tubes(list, detail);
  add_capsules(list, detail);
  for (const Sphere& s : list.spheres) add_sphere(s.centre, s.radius, s.material, s.label, detail);
  add_solids(list, detail);
  add_thin(list);
  upload();
}

void FrameGeometry::add_tubes(const DrawList& list, const Detail& detail) {
  constexpr double straight = 0.9998;  // cosine of a bend that nobody sees
  for (const TubeSegment& t : list.tubes) {
    const double thick = std::max(t.r0, t.r1);
    const double reach = 0.75 * (t.p1 - t.p0).norm() + thick;
    const int level = detail.level(0.5 * (t.p0 + t.p1), reach, thick);
    if (level < 0) continue;
    const bool curved = t.tangent0.dot(t.tangent1) < straight;
    put_segment(
        batch(Kind::tube, t.rounded ? shapes_.capsule(level, curved) : shapes_.tube(level, curved)),
        t);
  }
}

void FrameGeometry::add_capsules(const DrawList& list, const Detail& detail) {
  for (const Capsule& c : list.capsules) {
    const Vec3 axis = c.p1 - c.p0;
    const double length = axis.norm(), thick = std::max(c.r0, c.r1);
    if (length <= std::abs(c.r1 - c.r0) + 1e-9) {  // one sphere holds the other
      add_sphere(c.r0 >= c.r1 ? c.p0 : c.p1, thick, c.material, c.label, detail);
      continue;
    }
    const int level = detail.level(0.5 * (c.p0 + c.p1), 0.5 * length + thick, thick);
    if (level < 0) continue;
    const Vec3 along = axis / length;
    const Vec3 side = along.unitOrthogonal();
    put_segment(batch(Kind::tube, shapes_.capsule(level, false)),
                {c.p0, c.p1, along, along, side, side, c.r0, c.r1, c.material.colour,
                 c.material.colour, c.material.roughness, c.material.specular, true, c.label});
  }
}

void FrameGeometry::add_sphere(const Vec3& centre, double radius, const Shading& material,
                               Label label, const Detail& detail) {
  const int level = detail.level(centre, radius);
  if (level < 0) return;
  std::vector<float>& floats = batch(Kind::sphere, shapes_.sphere(level));
  put(floats, centre, radius);
  put(floats, material, label);
}

void FrameGeometry::add_solids(const DrawList& list, const Detail& detail) {
  for (const Box& b : list.boxes) {
    if (detail.level(b.pose.position, b.half_extents.norm()) < 0) continue;
    std::vector<float>& floats = batch(Kind::mesh, shapes_.cube());
    put_pose(floats, b.pose, b.half_extents);
    put(floats, b.material, b.label);
  }
  for (const MeshInstance& m : list.meshes) {
    if (!m.mesh || m.mesh->triangles.empty()) continue;
    const Eigen::AlignedBox3d& box = cache_.bounds(m.mesh);
    if (detail.level(m.pose * box.center(), 0.5 * box.diagonal().norm()) < 0) continue;
    std::vector<float>& floats = batch(Kind::mesh, cache_.get(m.mesh));
    put_pose(floats, m.pose, Vec3::Ones());
    put(floats, m.material, m.label);
  }
}

void FrameGeometry::add_thin(const DrawList& list) {
  for (const BladeFace& t : list.blades) {
    std::vector<float>& floats = batch(Kind::blade, shapes_.blade());
    for (const Vec3* corner : {&t.a, &t.b, &t.c}) put(floats, *corner);
    put(floats, t.material, t.label);
  }
  for (const Line& l : list.lines) {
    std::vector<float>& floats = batch(Kind::line, shapes_.line());
    put(floats, l.a);
    put(floats, l.b);
    put(floats, l.colour);
    floats.push_back(l.width);
  }
}

void FrameGeometry::upload() {
  staging_.clear();
  for (auto& batches : batches_)
    for (Batch& b : batches) {
      b.first = staging_.size();
      staging_.insert(staging_.end(), b.floats.begin(), b.floats.end());
    }
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(staging_.size() * sizeof(float)),
                 staging_.data(), GL_STREAM_DRAW);
}

void FrameGeometry::draw(Kind kind, bool cull) const {
  for (const Batch& b : batches_[static_cast<int>(kind)]) {
    const bool half = cull && b.mesh->is_closed();
    if (half) gl_.Enable(GL_CULL_FACE), gl_.CullFace(GL_BACK);
    b.mesh->draw(buffer_, b.first, b.count());
    if (half) gl_.Disable(GL_CULL_FACE);
  }
}

long FrameGeometry::triangles() const {
  long total = 0;
  for (const auto& batches : batches_)
    for (const Batch& b : batches) total += static_cast<long>(b.count()) * b.mesh->triangles();
  return total;
}

}  // namespace pedicel::render
