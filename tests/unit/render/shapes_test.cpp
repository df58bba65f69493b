#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/core/random.h"
#include "engine/render/gl_functions.h"
#include "engine/render/mesh_normals.h"
#include "engine/render/shadow_map.h"
#include "engine/render/unit_meshes.h"

namespace pedicel::render {
namespace {

TEST(UnitSphere, PointsHaveRadiusOneAndFacesLookOutwards) {
  for (int times = 0; times < 4; ++times) {
    const MeshData sphere = unit_sphere(times);
    EXPECT_EQ(sphere.indices.size(), 3u * 8u * (1u << (2 * times)));
    const auto point = [&](std::uint32_t i) {
      return Eigen::Map<const Eigen::Vector3f>(&sphere.vertices[3 * i]);
    };
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
      const Eigen::Vector3f a = point(sphere.indices[i]), b = point(sphere.indices[i + 1]),
                            c = point(sphere.indices[i + 2]);
      EXPECT_NEAR(a.norm(), 1.0f, 1e-6);
      EXPECT_GT((b - a).cross(c - a).dot(a), 0.0f);
    }
  }
}

TEST(UnitTube, CountsFollowTheLevel) {
  const MeshData open = unit_tube(6, 2, 0), closed = unit_tube(6, 1, 2);
  EXPECT_EQ(open.vertices.size(), 4u * 6u * 3u);
  EXPECT_EQ(open.indices.size(), 3u * 2u * 6u * 2u);
  EXPECT_EQ(closed.vertices.size(), 4u * 6u * 6u);
}

geometry::TriangleMesh cube() {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MeshNormals, CubeKeepsItsEdges) {
  const MeshData data = with_normals(cube());
  EXPECT_EQ(data.vertices.size() / 6, 24u);  // every corner once for each of its three faces
  for (std::size_t i = 0; i < data.vertices.size(); i += 6) {
    const Eigen::Map<const Eigen::Vector3f> normal(&data.vertices[i + 3]);
    EXPECT_NEAR(normal.lpNorm<Eigen::Infinity>(), 1.0f, 1e-6) << "along an axis";
  }
}

TEST(MeshNormals, WideCreaseMakesTheCubeRound) {
  EXPECT_EQ(with_normals(cube(), 3.0).vertices.size() / 6, 8u);
}

TEST(MeshNormals, DegenerateTriangleHasAFiniteNormal) {
  geometry::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  for (const float value : with_normals(mesh).vertices) EXPECT_TRUE(std::isfinite(value));
}

TEST(FitSun, HoldsEveryCasterAndKeepsToTheTexelGrid) {
  Random random(11);
  const Vec3 to_sun(0.4, -0.5, 0.8);
  for (int i = 0; i < 100; ++i) {
    const Vec3 centre(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0, 2));
    const Vec3 half(random.uniform(0.05, 2), random.uniform(0.05, 2), random.uniform(0.05, 2));
    const Eigen::AlignedBox3d box(centre - half, centre + half);
    const SunView sun = fit_sun(box, to_sun, 1024);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector4d p =
          sun.matrix *
          box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).homogeneous();
      EXPECT_LE(p.head<3>().cwiseAbs().maxCoeff(), 1.0 + 1e-9);
    }
    // The world's origin stays on a whole texel, whatever the box.
    const Eigen::Vector2d origin = sun.matrix.col(3).head<2>() * 512.0;
    EXPECT_NEAR((origin - origin.array().round().matrix()).norm(), 0.0, 1e-6);
  }
}

TEST(FitSun, TowardsTheSunIsNearer) {
  const SunView sun = fit_sun({Vec3(-1, -1, -1), Vec3(1, 1, 1)}, Vec3(0, 0, 1), 512);
  EXPECT_LT((sun.matrix * Eigen::Vector4d(0, 0, 1, 1)).z(),
            (sun.matrix * Eigen::Vector4d(0, 0, -1, 1)).z());
}

TEST(GlFunctions, NamesWhatIsMissing) {
  EXPECT_THAT([] { GlFunctions::load([](const char*) -> void* { return nullptr; }); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                  "OpenGL function glActiveTexture is missing, expected an OpenGL 3.3 core")));
}

TEST(ShadowMap, OfASmallPictureIsSmall) {
  EXPECT_EQ(shadow_side(2048, 1280, 720), 2048);
  EXPECT_EQ(shadow_side(2048, 640, 400), 2048);
  EXPECT_EQ(shadow_side(2048, 320, 240), 1024);
  EXPECT_EQ(shadow_side(2048, 120, 160), 512);
  EXPECT_EQ(shadow_side(2048, 16, 16), 256);
  EXPECT_EQ(shadow_side(512, 320, 240), 512);
}

}  // namespace
}  // namespace pedicel::render
