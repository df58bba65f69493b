#include "engine/geometry/mesh.h"

#include <gmock/gmock.h>

#include <cstring>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/geometry/aabb.h"
#include "engine/geometry/mass_properties.h"
#include "engine/geometry/mesh_topology.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

// A tetrahedron with corners at the origin and at 1, 2, 3 m on the axes: volume 1 * 2 * 3 / 6 = 1.
const Vec3 kCorners[] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
const int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string ascii_stl() {
  std::string text = "solid t\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : face)
      text += "vertex " + std::to_string(kCorners[i].x()) + " " + std::to_string(kCorners[i].y()) +
              " " + std::to_string(kCorners[i].z()) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string binary_stl() {
  std::string bytes(80, '\0');
  const std::uint32_t count = 4;
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& face : kFaces) {
    float numbers[12] = {};
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        numbers[3 + 3 * k + axis] = static_cast<float>(kCorners[face[k]][axis]);
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
  }
  return bytes;
}

const char* const kObj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// `up` is Y_UP or Z_UP; coordinates in units of `unit` metres.
std::string dae(const std::string& up, const std::string& unit, const std::string& matrix) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="u" meter=")" +
         unit + "\"/><up_axis>" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><matrix>)" +
         matrix + R"(</matrix>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

const char* const kIdentity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

std::string gltf_buffer() {
  std::string bytes;
  for (const Vec3& corner : kCorners)
    for (int axis = 0; axis < 3; ++axis) {
      const float number = static_cast<float>(corner[axis]);
      bytes.append(reinterpret_cast<const char*>(&number), 4);
    }
  for (const auto& face : kFaces)
    for (const int i : face) {
      const std::uint16_t index = static_cast<std::uint16_t>(i);
      bytes.append(reinterpret_cast<const char*>(&index), 2);
    }
  return bytes;
}

std::string gltf_json(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",
"min":[0,0,0],"max":[1,2,3]},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},
{"buffer":0,"byteOffset":48,"byteLength":24}],"buffers":[{)" +
         uri + R"("byteLength":72}]})";
}

std::string glb() {
  std::string json = gltf_json("");
  while (json.size() % 4) json += ' ';
  const std::string buffer = gltf_buffer();
  std::string bytes;
  const auto word = [&bytes](std::uint32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), 4);
  };
  word(0x46546C67);
  word(2);
  word(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  word(static_cast<std::uint32_t>(json.size()));
  word(0x4E4F534A);
  bytes += json;
  word(static_cast<std::uint32_t>(buffer.size()));
  word(0x004E4942);
  return bytes + buffer;
}

void expect_tetrahedron(const TriangleMesh& mesh, const Vec3& scale = Vec3::Ones()) {
  ASSERT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(topology(mesh).manifold());
  const Aabb box = bounds(mesh);
  const Vec3 far = scale.cwiseProduct(Vec3(1, 2, 3));
  EXPECT_LT((box.min() - far.cwiseMin(0.0)).norm(), 1e-6);
  EXPECT_LT((box.max() - far.cwiseMax(0.0)).norm(), 1e-6);
  double volume = 0.0;  // signed: positive where triangles look outward
  for (const auto& t : mesh.triangles)
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  EXPECT_NEAR(volume, std::abs(scale.prod()), 1e-6);
}

std::string refusal(const std::filesystem::path& path) {
  try {
    load_mesh(path);
  } catch (const InvalidFile& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(LoadMesh, ReadsEveryFormat) {
  const TemporaryFolder folder;
  folder.write("t.bin", gltf_buffer());
  expect_tetrahedron(load_mesh(folder.write("a.stl", ascii_stl())));
  expect_tetrahedron(load_mesh(folder.write("b.STL", binary_stl())));
  expect_tetrahedron(load_mesh(folder.write("c.obj", kObj)));
  expect_tetrahedron(load_mesh(folder.write("d.dae", dae("Y_UP", "1", kIdentity))));
  expect_tetrahedron(load_mesh(folder.write("e.gltf", gltf_json(R"("uri":"t.bin",)"))));
  expect_tetrahedron(load_mesh(folder.write("f.glb", glb())));
}

TEST(LoadMesh, ColladaKeepsItsAxesAndAppliesItsUnitAndTransforms) {
  const TemporaryFolder folder;
  expect_tetrahedron(load_mesh(folder.write("up.dae", dae("Z_UP", "1", kIdentity))));
  expect_tetrahedron(load_mesh(folder.write("mm.dae", dae("Z_UP", "0.001", kIdentity))),
                     Vec3::Constant(0.001));
  const TriangleMesh shifted =
      load_mesh(folder.write("at.dae", dae("Z_UP", "0.01", "1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1")));
  EXPECT_LT((bounds(shifted).min() - Vec3(0.05, 0.06, 0.07)).norm(), 1e-7);
}

TEST(LoadMesh, ScaleActsPerAxisAndMirroringKeepsTrianglesOutward) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.obj", kObj);
  expect_tetrahedron(load_mesh(path, {0.5, 2, 3}), {0.5, 2, 3});
  expect_tetrahedron(load_mesh(path, {1, -1, 1}), {1, -1, 1});
  expect_tetrahedron(
      load_mesh(folder.write("m.dae", dae("Z_UP", "1", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"))),
      {-1, 1, 1});
  EXPECT_THROW(load_mesh(path, {1, 0, 1}), UsageError);
}

TEST(LoadMesh, DropsDegenerateTrianglesAndTheirVertices) {
  const TemporaryFolder folder;
  expect_tetrahedron(load_mesh(
      folder.write("t.obj", std::string(kObj) + "v 9 9 9\nf 5 5 1\nv 0.5 0 0\nf 1 6 2\n")));
}

TEST(LoadMesh, RefusesWithPathAndExpectation) {
  const TemporaryFolder folder;
  const std::string missing = refusal(folder.path() / "none.stl");
  EXPECT_THAT(missing, StartsWith((folder.path() / "none.stl").string() + ": error: "));
  EXPECT_THAT(missing, EndsWith("no such file, expected a mesh"));
  EXPECT_THAT(refusal(folder.write("t.step", "x")),
              HasSubstr("unknown mesh format '.step', expected .stl, .obj, .dae, .gltf or .glb"));
  EXPECT_THAT(refusal(folder.write("t.dae", "not xml")), HasSubstr("not a readable mesh: "));
  EXPECT_THAT(refusal(folder.write("short.stl", binary_stl().substr(0, 200))),
              HasSubstr("cut off: 200 of 284 bytes (4 triangles)"));
  EXPECT_THAT(refusal(folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
              HasSubstr("no triangles, expected at least one with an area"));
  EXPECT_THAT(refusal(folder.write("wild.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")),
              HasSubstr("vertex index out of range"));
  EXPECT_THAT(refusal(folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")),
              HasSubstr("a vertex is not finite, expected numbers in metres"));
}

}  // namespace
}  // namespace pedicel::geometry
