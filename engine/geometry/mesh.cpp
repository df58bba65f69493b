#include "engine/geometry/mesh.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <map>
#include <string>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/files_read.h"
#include "engine/core/stop.h"
#include "engine/geometry/mesh_file.h"

namespace pedicel::geometry {

namespace {

using Transform = Eigen::Affine3d;

/// The library opens what a mesh file names, too: buffers of glTF, materials of OBJ.
class NotedFiles : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    note_file_read(file);
    return DefaultIOSystem::Open(file, mode);
  }
};

Transform from_assimp(const aiMatrix4x4& m) {
  Transform transform;
  transform.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
      m.d1, m.d2, m.d3, m.d4;
  return transform;
}

void append_mesh(const aiMesh& source, const Transform& transform, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D& v = source.mVertices[i];
    mesh.vertices.push_back(transform * Vec3(v.x, v.y, v.z));
  }
  const bool mirrored = transform.linear().determinant() < 0.0;
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    std::array<int, 3> triangle;
    for (int k = 0; k < 3; ++k) triangle[k] = first + static_cast<int>(face.mIndices[k]);
    if (mirrored) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
}

void append_node(const aiScene& scene, const aiNode& node, const Transform& parent,
                 TriangleMesh& mesh) {
  throw_if_stopped();
  const Transform transform = parent * from_assimp(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    append_mesh(*scene.mMeshes[node.mMeshes[i]], transform, mesh);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    append_node(scene, *node.mChildren[i], transform, mesh);
}

/// Gives vertices with the same coordinates one index, that of the first of them, and leaves out
/// vertices without a triangle.
void merge_equal_vertices(TriangleMesh& mesh) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::map<Vec3, int, decltype(less)> index(less);
  std::vector<Vec3> kept;
  for (auto& triangle : mesh.triangles) {
    throw_if_stopped();
    for (int& vertex : triangle) {
      const Vec3& point = mesh.vertices[vertex];
      const auto [place, added] = index.try_emplace(point, static_cast<int>(kept.size()));
      if (added) kept.push_back(point);
      vertex = place->second;
    }
  }
  mesh.vertices = std::move(kept);
}

void drop_degenerate_triangles(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    const Vec3 ab = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec3 ac = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    // Collinear within the rounding of the coordinates, whatever the size of the triangle.
    return ab.cross(ac).norm() <= 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm());
  });
}

void check_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {".stl", ".obj", ".dae", ".gltf", ".glb"})
    if (extension == known) return;
  throw InvalidFile({path.string()}, "unknown mesh format '" + extension +
                                         "', expected .stl, .obj, .dae, .gltf or .glb");
}

void check_finite(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (const Vec3& vertex : mesh.vertices)
    if (!vertex.allFinite())
      throw InvalidFile({path.string()}, "a vertex is not finite, expected numbers in metres");
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path, const Vec3& scale) {
  if (!scale.allFinite() || (scale.array() == 0.0).any())
    throw UsageError("load_mesh: each axis of scale must be finite and not 0");
  check_extension(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InvalidFile({path.string()}, "no such file, expected a mesh");
  if (const auto fault = mesh_file_fault(path)) throw InvalidFile({path.string()}, *fault);

  Assimp::Importer importer;
  importer.SetIOHandler(new NotedFiles);  // which it owns
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InvalidFile({path.string()},
                      std::string("not a readable mesh: ") + importer.GetErrorString());

  TriangleMesh mesh;
  append_node(*scene, *scene->mRootNode, Transform(Eigen::Scaling(scale)), mesh);
  check_finite(path, mesh);  // before merging: NaN has no place in an order
  drop_degenerate_triangles(mesh);
  merge_equal_vertices(mesh);
  if (mesh.triangles.empty())
    throw InvalidFile({path.string()}, "no triangles, expected at least one with an area");
  return mesh;
}

}  // namespace pedicel::geometry
