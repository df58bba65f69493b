// The kernels that a step is made of, and what a plant costs before its first step, one by one. The
// whole at real settings: `pedicel bench`; against other programs: tools/bench.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "engine/core/random.h"
#include "engine/geometry/grid_distance.h"
#include "engine/geometry/primitives_mesh.h"
#include "engine/geometry/shapes.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/cosserat/solver/standing.h"
#include "plugins/plant/plant_builder.h"
#include "plugins/plant/reference_plants.h"
#include "tests/support/places.h"

namespace pedicel {

namespace {

const Vec3 earth(0, 0, -9.81);
constexpr double dt = 1.0 / 240.0;  // s

/// Shows the time of one element (one query, one plant) beside the time of an iteration.
void per_item(benchmark::State& state, double items, const char* name) {
  state.counters[name] = benchmark::Counter(
      items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// A row of forest plants (59 elements each) under gravity; one Newton iteration a step, so that
/// the work does not lessen while the plants settle.
void direct_step(benchmark::State& state) {
  cosserat::RodSettings settings;
  settings.newton_iterations = 1;
  cosserat::RodSystem system(settings);
  for (int p = 0; p < state.range(0) / 59; ++p) system.add_plant(plant::forest_plant(p));
  for (int i = 0; i < 10; ++i) system.step(dt, earth);
  for (auto _ : state) system.step(dt, earth);
  per_item(state, static_cast<double>(state.range(0)), "per_element");
}
BENCHMARK(direct_step)->Arg(59)->Arg(590)->Arg(5900)->Unit(benchmark::kMicrosecond);

/// A system whose blocks are those of springs between neighbours: diagonally dominant.
void fill(cosserat::BlockSystem& system, const cosserat::RodModel& model) {
  system.clear();
  for (int e = 0; e < model.size(); ++e) {
    system.diagonal(e) += 2.0 * cosserat::Mat6::Identity();
    system.right_side(e).setOnes();
    if (model.elements[e].parent < 0) continue;
    system.diagonal(model.elements[e].parent) += cosserat::Mat6::Identity();
    system.coupling(e) = -cosserat::Mat6::Identity();
  }
}

void fill_blocks(benchmark::State& state) {
  const cosserat::RodModel model = plant::hanging_tree();
  cosserat::BlockSystem system(model);
  for (auto _ : state) fill(system, model);
  per_item(state, model.size(), "per_element");
}
BENCHMARK(fill_blocks)->Unit(benchmark::kMicrosecond);

/// Elimination and substitution overwrite the blocks: the time of fill_blocks is to be taken off.
void fill_and_solve_blocks(benchmark::State& state) {
  const cosserat::RodModel model = plant::hanging_tree();
  cosserat::BlockSystem system(model);
  for (auto _ : state) {
    fill(system, model);
    if (!system.solve()) throw std::logic_error("the system must be positive definite");
  }
  per_item(state, model.size(), "per_element");
}
BENCHMARK(fill_and_solve_blocks)->Unit(benchmark::kMicrosecond);

/// Contacts of the hanging tree with itself, in its drawn shape: nothing moves, so this is the
/// narrow phase of the pairs that are kept.
void self_contact_find(benchmark::State& state) {
  const cosserat::RodModel model = plant::hanging_tree();
  const cosserat::RodState drawn = cosserat::drawn_state(model);
  cosserat::SelfContact contact(model, {});
  contact.begin_step(model, drawn, dt);
  std::vector<cosserat::ContactPoint> found;
  for (auto _ : state) {
    found.clear();
    contact.find(model, drawn, dt, found);
    benchmark::DoNotOptimize(found.data());
  }
  per_item(state, model.size(), "per_element");
}
BENCHMARK(self_contact_find)->Unit(benchmark::kMicrosecond);

/// The same from scratch: exclusions, broad and narrow phase.
void self_contact_build(benchmark::State& state) {
  const cosserat::RodModel model = plant::hanging_tree();
  const cosserat::RodState drawn = cosserat::drawn_state(model);
  std::vector<cosserat::ContactPoint> found;
  for (auto _ : state) {
    found.clear();
    cosserat::SelfContact contact(model, {});
    contact.begin_step(model, drawn, dt);
    contact.find(model, drawn, dt, found);
    benchmark::DoNotOptimize(found.data());
  }
  per_item(state, model.size(), "per_element");
}
BENCHMARK(self_contact_build)->Unit(benchmark::kMicrosecond);

/// Distances and gradients at points around a capsule of 5 cm and 20 cm, most of them near it.
void query(benchmark::State& state, const geometry::SignedDistance& solid) {
  Random random(1);
  std::vector<Vec3> points(1024);
  for (Vec3& p : points)
    p = {random.uniform(-0.06, 0.06), random.uniform(-0.06, 0.06), random.uniform(-0.16, 0.16)};
  Vec3 gradient;
  for (auto _ : state)
    for (const Vec3& p : points) benchmark::DoNotOptimize(solid.distance(p, &gradient));
  per_item(state, static_cast<double>(points.size()), "per_query");
}

void shape_query(benchmark::State& state) {
  query(state, geometry::CapsuleDistance(0.05, 0.2));
}
BENCHMARK(shape_query)->Unit(benchmark::kMicrosecond);

void mesh_query(benchmark::State& state) {
  query(state, geometry::MeshDistance(geometry::make_capsule(0.05, 0.2, 48)));
}
BENCHMARK(mesh_query)->Unit(benchmark::kMicrosecond);

void grid_query(benchmark::State& state) {
  const geometry::MeshDistance mesh(geometry::make_capsule(0.05, 0.2, 48));
  query(state, geometry::GridDistance(mesh, {}));
}
BENCHMARK(grid_query)->Unit(benchmark::kMicrosecond);

/// From the drawn curves of a shipped plant to its rods.
void plant_build(benchmark::State& state) {
  Diagnostics diagnostics;
  const auto file = plant::read_plant_file(
      pedicel::test::source_folder() / "plants/cherry_tomato.plant.yaml", diagnostics);
  if (!file) throw InvalidFile(diagnostics);
  plant::BuildOptions options;
  options.leaf_folders = {pedicel::test::source_folder() / "assets/leaves"};
  int elements = 0;
  for (auto _ : state) {
    const auto built = plant::build_plant(*file, options, diagnostics);
    if (!built) throw InvalidFile(diagnostics);
    elements = built->model.size();
  }
  per_item(state, elements, "per_element");
}
BENCHMARK(plant_build)->Unit(benchmark::kMicrosecond);

void stand_as_drawn(benchmark::State& state) {
  cosserat::RodModel model = plant::forest_plant(0);
  for (auto _ : state) benchmark::DoNotOptimize(cosserat::stand_as_drawn(model, earth));
  per_item(state, model.size(), "per_element");
}
BENCHMARK(stand_as_drawn)->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace pedicel

BENCHMARK_MAIN();
