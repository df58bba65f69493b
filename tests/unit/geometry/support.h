#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "engine/core/random.h"
#include "engine/geometry/mesh.h"

namespace pedicel::geometry {

inline Vec3 random_point(Random& random, double half) {
  const double x = random.uniform(-half, half), y = random.uniform(-half, half);
  return {x, y, random.uniform(-half, half)};
}

inline Vec3 random_unit(Random& random) {
  const double x = random.normal(), y = random.normal();
  return Vec3(x, y, random.normal()).normalized();
}

inline Pose random_pose(Random& random) {
  const double w = random.normal(), x = random.normal(), y = random.normal();
  return {random_point(random, 1.0), Quat(w, x, y, random.normal()).normalized()};
}

inline TriangleMesh moved(TriangleMesh mesh, const Pose& pose) {
  for (Vec3& vertex : mesh.vertices) vertex = pose * vertex;
  return mesh;
}

/// Two meshes as one, without joining anything.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

/// A torus about z, vertices on the true surface.
inline TriangleMesh torus(double major, double minor, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
      const double rho = major + minor * std::cos(v);
      mesh.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), minor * std::sin(v));
      const int a = i * across + j, b = (i + 1) % around * across + j;
      const int c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// A folder of its own that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pedicel_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace pedicel::geometry
