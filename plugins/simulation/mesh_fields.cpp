#include "plugins/simulation/mesh_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/core/diagnostics.h"
#include "engine/core/thread_pool.h"
#include "engine/core/verbosity.h"
#include "engine/geometry/grid_cache.h"
#include "engine/geometry/near_exact_distance.h"
#include "engine/io/csv.h"

namespace pedicel::simulation {

namespace {

using geometry::GridDistance;

Vec3 size_of(const geometry::TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& vertex : mesh.vertices) box.extend(vertex);
  return box.sizes();
}

double samples_of(const MeshField& field) {
  return GridDistance::sample_count(field.size, field.grid);
}

/// The largest give way first, so that the robot's small parts keep their grids.
void choose(std::vector<MeshField>& fields) {
  std::vector<MeshField*> by_size;
  for (MeshField& field : fields) by_size.push_back(&field);
  std::stable_sort(by_size.begin(), by_size.end(), [](const MeshField* a, const MeshField* b) {
    return samples_of(*a) < samples_of(*b);
  });
  double all = 0.0;
  for (MeshField* field : by_size) {
    const double samples = samples_of(*field);
    // One mesh has a bound, and so has the robot as a whole.
    field->exact_near = samples > most_fine_samples || all + samples > most_robot_samples;
    if (!field->exact_near) all += samples;
  }
  for (MeshField& field : fields)
    if (field.exact_near) field.grid = geometry::coarse_settings(field.size, most_coarse_samples);
}

std::string millimetres(double length) {
  return io::format_number(std::round(1e3 * length), 4) + " mm";
}

std::shared_ptr<const geometry::SignedDistance> build(const MeshField& field,
                                                      const std::filesystem::path& folder,
                                                      ThreadPool& pool,
                                                      geometry::GridReport& report) {
  GridDistance grid = geometry::cached_grid(*field.mesh, field.grid, folder, &pool, &report);
  // A grid answers in one look-up; the exact distance walks a tree of triangles.
  if (!field.exact_near) return std::make_shared<GridDistance>(std::move(grid));
  return std::make_shared<geometry::NearExactDistance>(geometry::MeshDistance(*field.mesh),
                                                       std::move(grid), field.grid, near_band);
}

/// Grids of so many samples take seconds to build, and whoever waits should know what for.
constexpr double long_wait = 0x1p22;

void say_what_takes_long(const std::vector<MeshField>& fields,
                         const std::filesystem::path& folder) {
  double samples = 0.0;
  int meshes = 0;
  std::error_code ignored;
  for (const MeshField& field : fields) {
    if (!folder.empty() && std::filesystem::exists(
                               geometry::grid_cache_file(*field.mesh, field.grid, folder), ignored))
      continue;
    samples += samples_of(field);
    ++meshes;
  }
  if (samples > long_wait)
    say(Verbosity::lines, "building the distance grids of %d collision meshes, %.0f million points",
        meshes, 1e-6 * samples);
}

}  // namespace

std::vector<MeshField> plan_mesh_fields(const robot::RobotDescription& robot) {
  std::vector<MeshField> fields;
  for (const robot::Link& link : robot.links)
    for (const robot::Collision& collision : link.collisions) {
      const robot::Geometry& shape = collision.geometry;
      // Two links with one mesh share one grid.
      const auto same = [&](const MeshField& f) { return f.mesh == shape.mesh.get(); };
      if (shape.kind != robot::Geometry::Kind::mesh ||
          std::any_of(fields.begin(), fields.end(), same))
        continue;
      MeshField field;
      field.mesh = shape.mesh.get();
      field.link = link.name;
      field.file = shape.mesh_file.filename().string();
      field.size = size_of(*shape.mesh);
      fields.push_back(std::move(field));
    }
  choose(fields);
  return fields;
}

std::vector<std::string> large_mesh_warnings(const robot::RobotDescription& robot) {
  std::vector<std::string> warnings;
  for (const MeshField& field : plan_mesh_fields(robot)) {
    if (!field.exact_near) continue;
    const auto metres = [&](int axis) { return io::format_number(field.size[axis], 3); };
    warnings.push_back("link '" + field.link + "': collision mesh " + field.file + " (" +
                       metres(0) + " x " + metres(1) + " x " + metres(2) +
                       " m) would take too large a grid: distances to it are exact within " +
                       millimetres(near_band) +
                       ", which is slow, and farther away too small by up to " +
                       millimetres(2.0 * field.grid.far_error()));
  }
  return warnings;
}

MeshDistances exact_mesh_fields(const robot::RobotDescription& robot) {
  MeshDistances distances;
  for (const MeshField& field : plan_mesh_fields(robot))
    // Without plants nobody asks for distances in a step, so no grid is worth its time.
    distances[field.mesh] = std::make_shared<geometry::MeshDistance>(*field.mesh);
  return distances;
}

MeshDistances build_mesh_fields(const robot::RobotDescription& robot,
                                std::vector<std::string>& notes) {
  const std::filesystem::path folder = geometry::default_cache_folder();
  MeshDistances distances;
  int built = 0;
  const std::vector<MeshField> fields = plan_mesh_fields(robot);
  say_what_takes_long(fields, folder);
  // Any number of threads gives the same samples.
  ThreadPool pool(static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u)));
  for (const MeshField& field : fields) {
    geometry::GridReport report;
    distances[field.mesh] = build(field, folder, pool, report);
    if (!report.problem.empty()) notes.push_back(report.problem);
    built += !report.from_cache;
  }
  for (const std::string& warning : large_mesh_warnings(robot))
    notes.push_back(robot.file + ": warning: " + warning);
  if (built > 0 && !folder.empty())
    notes.push_back("distance grids built: " + std::to_string(built) + ", kept in " +
                    folder.string() + ", at most " + std::to_string(geometry::cache_bound >> 20) +
                    " MB (see --help)");
  return distances;
}

}  // namespace pedicel::simulation
