#include "engine/geometry/grid_cache.h"

#include <gmock/gmock.h>

#include <sstream>

#include "engine/geometry/primitives_mesh.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

using testing::HasSubstr;

const GridSettings kSettings{0.004, 0.01};

TriangleMesh mesh() {
  return make_cylinder(0.03, 0.08, 12);
}

std::string contents(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

TEST(GridCache, GivesTheSameBitsAsBuilding) {
  const TemporaryFolder folder;
  GridReport first, second;
  const GridDistance built = cached_grid(mesh(), kSettings, folder.path() / "a/b", nullptr, &first);
  const GridDistance read = cached_grid(mesh(), kSettings, folder.path() / "a/b", nullptr, &second);
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(first.problem + second.problem, "");
  EXPECT_EQ(built.samples(), read.samples());
  EXPECT_EQ(built.bounds().min(), read.bounds().min());
  Random random(41);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(random, 0.1);
    Vec3 a, b;
    EXPECT_EQ(built.distance(p, &a), read.distance(p, &b));
    EXPECT_EQ(a, b);
  }
  int files = 0;
  for ([[maybe_unused]] const auto& entry :
       std::filesystem::directory_iterator(folder.path() / "a/b"))
    ++files;
  EXPECT_EQ(files, 1);  // nothing half written is left
}

TEST(GridCache, NamesFilesByContent) {
  const auto name = [](const TriangleMesh& m, const GridSettings& settings) {
    return grid_cache_file(m, settings, "cache");
  };
  TriangleMesh scaled = mesh(), turned = mesh();
  for (Vec3& vertex : scaled.vertices) vertex *= 1.0 + 1e-15;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(name(mesh(), kSettings), name(mesh(), kSettings));
  EXPECT_NE(name(mesh(), kSettings), name(scaled, kSettings));
  EXPECT_NE(name(mesh(), kSettings), name(turned, kSettings));
  EXPECT_NE(name(mesh(), kSettings), name(mesh(), {0.004, 0.011}));
  EXPECT_NE(name(mesh(), kSettings), name(mesh(), {0.003, 0.01}));
}

TEST(GridCache, RebuildsDamagedFiles) {
  const TemporaryFolder folder;
  const auto path = grid_cache_file(mesh(), kSettings, folder.path());
  const GridDistance good = cached_grid(mesh(), kSettings, folder.path());
  const std::string whole = contents(path);
  ASSERT_GT(whole.size(), 1000u);
  std::vector<std::string> damaged = {"",
                                      "x",
                                      whole.substr(0, 60),
                                      whole.substr(0, 500),
                                      whole.substr(0, whole.size() - 4),
                                      whole + "more"};
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{12}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 0x10);
  }
  for (const std::string& bytes : damaged) {
    std::ofstream(path, std::ios::binary) << bytes;
    GridReport report;
    const GridDistance grid = cached_grid(mesh(), kSettings, folder.path(), nullptr, &report);
    EXPECT_FALSE(report.from_cache);
    EXPECT_THAT(report.problem, HasSubstr("damaged cache file, built anew"));
    EXPECT_EQ(grid.samples(), good.samples());
    EXPECT_EQ(contents(path), whole);
  }
}

TEST(GridCache, DoesNotTakeAnotherMeshesFile) {
  const TemporaryFolder folder;
  const GridSettings other{0.005, 0.01};
  cached_grid(mesh(), other, folder.path());
  std::filesystem::copy_file(grid_cache_file(mesh(), other, folder.path()),
                             grid_cache_file(mesh(), kSettings, folder.path()));
  GridReport report;
  cached_grid(mesh(), kSettings, folder.path(), nullptr, &report);
  EXPECT_FALSE(report.from_cache);
}

TEST(GridCache, WorksWithoutAFolder) {
  const TemporaryFolder folder;
  GridReport report;
  cached_grid(mesh(), kSettings, {}, nullptr, &report);
  EXPECT_FALSE(report.from_cache);
  EXPECT_EQ(report.problem, "");
  const auto file = folder.write("a_file", "");
  cached_grid(mesh(), kSettings, file, nullptr, &report);
  EXPECT_THAT(report.problem, HasSubstr("cannot be written"));
}

TEST(GridCache, DefaultFolderFollowsTheEnvironment) {
  ::unsetenv("PEDICEL_CACHE");
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(default_cache_folder(), "/somewhere/pedicel");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  ::setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(default_cache_folder(), "/home/someone/.cache/pedicel");
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(default_cache_folder(), "");
}

}  // namespace
}  // namespace pedicel::geometry
