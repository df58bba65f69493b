#include "engine/geometry/cache_folder.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "engine/geometry/grid_cache.h"
#include "engine/geometry/primitives_mesh.h"
#include "tests/unit/geometry/support.h"

namespace pedicel::geometry {
namespace {

namespace fs = std::filesystem;

/// A file of so many bytes (none on the disk) that was used so many minutes ago.
fs::path file(const TemporaryFolder& folder, const std::string& name, std::uintmax_t bytes,
              int minutes) {
  const fs::path path = folder.write(name, "");
  fs::resize_file(path, bytes);
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(minutes));
  return path;
}

TEST(CacheFolder, RemovesWhatWasUsedLongestAgo) {
  const TemporaryFolder folder;
  const fs::path old = file(folder, "a.sdf", 400, 30), older = file(folder, "b.sdf", 400, 40),
                 young = file(folder, "c.sdf", 400, 10), other = file(folder, "d.txt", 9000, 90);
  EXPECT_EQ(trim_cache(folder.path(), 900), 800u);
  EXPECT_FALSE(fs::exists(older));
  EXPECT_TRUE(fs::exists(old) && fs::exists(young));
  EXPECT_TRUE(fs::exists(other));  // not the cache's
  mark_used(old);
  EXPECT_EQ(trim_cache(folder.path(), 500), 400u);
  EXPECT_TRUE(fs::exists(old));
  EXPECT_FALSE(fs::exists(young));
}

TEST(CacheFolder, KeepsTheFileThatWasJustMade) {
  const TemporaryFolder folder;
  const fs::path made = file(folder, "a.sdf", 4000, 50), other = file(folder, "b.sdf", 400, 1);
  trim_cache(folder.path(), 900, made);
  EXPECT_TRUE(fs::exists(made));
  EXPECT_FALSE(fs::exists(other));
}

TEST(CacheFolder, TakesAwayWhatStoppedProgramsLeft) {
  const TemporaryFolder folder;
  const fs::path left = file(folder, "a.sdf.part12_0", 10, 90);
  const fs::path written_now = file(folder, "a.sdf.part13_0", 10, 1);
  trim_cache(folder.path(), 900);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(written_now));
  EXPECT_EQ(trim_cache(folder.path() / "nowhere", 900), 0u);
}

TEST(CacheFolder, ANewGridBringsTheFolderBelowItsBound) {
  const TemporaryFolder folder;
  const fs::path big = file(folder, "0123456789abcdef.sdf", cache_bound, 10);
  const TriangleMesh mesh = make_cylinder(0.03, 0.08, 12);
  const GridSettings settings{0.004, 0.01};
  cached_grid(mesh, settings, folder.path());
  EXPECT_FALSE(fs::exists(big));
  EXPECT_TRUE(fs::exists(grid_cache_file(mesh, settings, folder.path())));
}

TEST(CacheFolder, AGridThatIsReadCountsAsUsed) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = make_cylinder(0.03, 0.08, 12);
  const GridSettings settings{0.004, 0.01};
  cached_grid(mesh, settings, folder.path());
  const fs::path path = grid_cache_file(mesh, settings, folder.path());
  const auto then = fs::file_time_type::clock::now() - std::chrono::hours(5);
  fs::last_write_time(path, then);
  GridReport report;
  cached_grid(mesh, settings, folder.path(), nullptr, &report);
  EXPECT_TRUE(report.from_cache);
  EXPECT_GT(fs::last_write_time(path), then + std::chrono::hours(4));
}

// Programs that build, read and make room in one folder: every grid comes out whole.
TEST(CacheFolder, SeveralMayUseOneFolderAtOnce) {
  const TemporaryFolder folder;
  const GridSettings settings{0.004, 0.01};
  std::vector<std::vector<float>> wanted;
  std::vector<TriangleMesh> meshes;
  for (int i = 0; i < 4; ++i) {
    meshes.push_back(make_cylinder(0.02 + 0.002 * i, 0.05, 12));
    wanted.push_back(GridDistance(MeshDistance(meshes.back()), settings).samples());
  }
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 40; ++i) {
        const std::size_t m = static_cast<std::size_t>((i + t) % 4);
        GridReport report;
        const GridDistance grid = cached_grid(meshes[m], settings, folder.path(), nullptr, &report);
        if (grid.samples() != wanted[m] || !report.problem.empty()) ++wrong;
        if (i % 3 == t % 3) trim_cache(folder.path(), 30'000);
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(CacheFolder, TheEnvironmentNamesIt) {
  ::setenv("PEDICEL_CACHE", "/fast/grids", 1);
  EXPECT_EQ(default_cache_folder(), "/fast/grids");
  ::setenv("PEDICEL_CACHE", "off", 1);
  EXPECT_EQ(default_cache_folder(), "");
  ::unsetenv("PEDICEL_CACHE");
  EXPECT_NE(default_cache_folder(), "/fast/grids");
}

}  // namespace
}  // namespace pedicel::geometry
