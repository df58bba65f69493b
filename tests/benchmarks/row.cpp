// A row of tomatoes with leaves whose plants may touch each other and themselves, shaken: what
// tools/row_speed measures beside MuJoCo.
//
// Usage: pedicel_row PLANTS THREADS SECONDS [CAPSULES]
// Steps it for about so many seconds of wall time and prints one JSON object. CAPSULES: writes the
// elements of one plant into that file instead, one a line, as row_mujoco.cpp reads them.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/cosserat/solver/standing.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/places.h"

namespace pedicel {

namespace {

constexpr double step_length = 1.0 / 240.0;  // s
constexpr double apart = 0.3;                // m, as in assets/scenes/tomato_row.scene.yaml

/// The ground shakes across the row, once a second: the same in both programs.
Vec3 weight_at(double time) {
  return {0.0, 3.0 * std::sin(2.0 * std::numbers::pi * time), -9.81};
}

cosserat::RodModel tomato(double x) {
  Diagnostics diagnostics;
  const auto file = plant::read_plant_file(
      pedicel::test::source_folder() / "plants/row_tomato.plant.yaml", diagnostics);
  if (!file) throw InvalidFile(diagnostics);
  plant::BuildOptions options;
  options.pose.position = Vec3(x, 0, 0);
  options.leaf_folders = {pedicel::test::source_folder() / "assets/leaves"};
  auto built = plant::build_plant(*file, options, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  return std::move(built->model);
}

/// parent, near end, far end (m), turn x y z w, radius (m), mass (kg), its place from the near end
/// (m), inertia (kg m2), stiffness of the joint (N m/rad), then radius and place of a fruit on it.
void write_capsules(const cosserat::RodModel& model, const char* path) {
  std::ofstream out(path);
  out.precision(17);
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[e];
    const Vec3 near = model.drawn_start(e);
    const auto& q = element.drawn_rotation.coeffs();
    double fruit = 0.0, at = 0.0;
    for (const cosserat::Fruit& one : model.fruits)
      if (one.element == e) fruit = one.radius, at = element.length - one.back;
    out << element.parent << ' ' << near.transpose() << ' ' << element.length << ' '
        << q.transpose() << ' ' << element.radius_far << ' ' << element.mass << ' '
        << element.length - element.com_back << ' ' << element.inertia.transpose() << ' '
        << element.bend_stiffness.transpose() << ' ' << fruit << ' ' << at << '\n';
  }
}

void measure(int plants, int threads, double seconds) {
  cosserat::RodSystem system(cosserat::RodSettings{}, threads);
  for (int p = 0; p < plants; ++p) system.add_plant(tomato(p * apart));
  system.let_plants_touch({});
  int elements = 0, most = 0;
  long steps = 0, contacts = 0;
  for (int p = 0; p < plants; ++p) elements += system.model(p).size();
  using Clock = std::chrono::steady_clock;
  double passed = 0.0;
  // Its lists are made by the first steps.
  constexpr int warm = 24;
  Clock::time_point start = Clock::now();
  for (long i = 0; i < warm || passed < seconds; ++i) {
    if (i == warm) start = Clock::now();
    system.step(step_length, weight_at(i * step_length));
    if (i < warm) continue;
    ++steps;
    passed = std::chrono::duration<double>(Clock::now() - start).count();
    int sides = 0;
    for (int p = 0; p < plants; ++p) sides += system.report(p).contacts;
    contacts += sides / 2;
    most = std::max(most, sides / 2);
  }
  std::printf(
      "{\"elements\": %d, \"contacts\": %.1f, \"most_contacts\": %d, \"steps\": %ld, "
      "\"seconds\": %.4f}\n",
      elements, static_cast<double>(contacts) / static_cast<double>(steps), most, steps, passed);
}

}  // namespace

}  // namespace pedicel

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "row: expected PLANTS THREADS SECONDS [CAPSULES]\n");
    return 2;
  }
  try {
    if (argc == 5)
      pedicel::write_capsules(pedicel::tomato(0.0), argv[4]);
    else
      pedicel::measure(std::atoi(argv[1]), std::atoi(argv[2]), std::atof(argv[3]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "row: %s\n", error.what());
    return 1;
  }
}
