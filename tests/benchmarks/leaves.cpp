// What leaves and neighbours cost: leafy plants beside trees of as many elements, and rows of
// plants that may touch each other.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/places.h"

namespace pedicel {

namespace {

constexpr double step_length = 1.0 / 240.0;  // s
const Vec3 weight(0, 0, -9.81);
const Vec3 apart(0.3, 0, 0);  // m, as in assets/scenes/tomato_row.scene.yaml

plant::PlantFile tomato_file() {
  Diagnostics diagnostics;
  auto file = plant::read_plant_file(
      pedicel::test::source_folder() / "plants/row_tomato.plant.yaml", diagnostics);
  if (!file) throw InvalidFile(diagnostics);
  return *file;
}

cosserat::RodModel tomato(const plant::PlantFile& file, const Vec3& place) {
  Diagnostics diagnostics;
  plant::BuildOptions options;
  options.pose.position = place;
  options.leaf_folders = {pedicel::test::source_folder() / "assets/leaves"};
  auto built = plant::build_plant(file, options, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  return std::move(built->model);
}

/// The same elements without what closes the leaves' loops.
cosserat::RodModel opened(cosserat::RodModel model) {
  model.welds.clear();
  cosserat::finish(model);
  cosserat::stand_as_drawn(model, weight);
  return model;
}

/// All plants sway: their velocity grows with the height.
void push(cosserat::RodSystem& system) {
  for (int p = 0; p < system.size(); ++p) {
    cosserat::RodState& state = system.edit_state(p);
    for (int e = 0; e < state.size(); ++e)
      state.velocity[e] = Vec3(0, 0.4 * state.position[e].z(), 0);
  }
}

void run(benchmark::State& state, cosserat::RodSystem& system) {
  push(system);
  int elements = 0;
  long iterations = 0, steps = 0;
  for (int p = 0; p < system.size(); ++p) elements += system.model(p).size();
  for (int i = 0; i < 20; ++i) system.step(step_length, weight);
  for (auto _ : state) {
    system.step(step_length, weight);
    iterations += system.report(0).iterations;
    if (++steps % 240 != 0) continue;
    state.PauseTiming();  // what has come to rest takes fewer iterations
    push(system);
    state.ResumeTiming();
  }
  using benchmark::Counter;
  state.counters["elements"] = elements;
  state.counters["per_element"] =
      Counter(elements, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["real_time_factor"] = Counter(step_length, Counter::kIsIterationInvariantRate);
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(steps);
}

/// `plants` alone, each stepped by itself.
void leafy_plants(benchmark::State& state) {
  const plant::PlantFile file = tomato_file();
  cosserat::RodSystem system{cosserat::RodSettings{}};
  for (int p = 0; p < state.range(0); ++p) system.add_plant(tomato(file, p * apart));
  run(state, system);
}
BENCHMARK(leafy_plants)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);

void trees_of_the_same_elements(benchmark::State& state) {
  const plant::PlantFile file = tomato_file();
  cosserat::RodSystem system{cosserat::RodSettings{}};
  for (int p = 0; p < state.range(0); ++p) system.add_plant(opened(tomato(file, p * apart)));
  run(state, system);
}
BENCHMARK(trees_of_the_same_elements)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);

/// A row whose plants may touch each other: plants, threads.
void row_of_tomatoes(benchmark::State& state) {
  const plant::PlantFile file = tomato_file();
  cosserat::RodSystem system(cosserat::RodSettings{}, static_cast<int>(state.range(1)));
  for (int p = 0; p < state.range(0); ++p) system.add_plant(tomato(file, p * apart));
  system.let_plants_touch({});
  run(state, system);
}
BENCHMARK(row_of_tomatoes)
    ->ArgsProduct({{10, 30, 100, 300}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace pedicel
