#include "peer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "engine/core/ring_down.h"
#include "engine/core/timer.h"

namespace peers {

namespace {

constexpr double gravity = 9.81;  // m/s2
constexpr double drag = 2.0;      // 1/s
// About critical for the first mode of the cantilever and of the forest's plants: they settle
// within a second, where they settle under any drag.
constexpr double settling_drag = 14.0;  // 1/s

struct Task {
  std::string work;
  double dt = 0.0;  // s
  int threads = 1;
  double seconds = 0.0;  // of wall time
  MakeWorld make_world;
};

using Worlds = std::vector<std::unique_ptr<World>>;

// Plant p is plant p / threads of world p % threads.
Worlds make_worlds(const Task& task, const std::vector<Plant>& plants) {
  const std::size_t threads = std::min<std::size_t>(task.threads, plants.size());
  std::vector<std::vector<Plant>> parts(threads);
  for (std::size_t p = 0; p < plants.size(); ++p) parts[p % threads].push_back(plants[p]);
  Worlds worlds;
  for (const std::vector<Plant>& part : parts) worlds.push_back(task.make_world(part, task.dt));
  return worlds;
}

void step(const Worlds& worlds, int steps) {
  std::vector<std::thread> threads;
  for (const auto& world : worlds)
    threads.emplace_back([&world, steps] {
      for (int i = 0; i < steps; ++i) world->step();
    });
  for (std::thread& thread : threads) thread.join();
}

// Mean over the ends of how far they are below where they were drawn (m, negative).
double mean_droop(const Worlds& worlds, const std::vector<Plant>& plants) {
  double sum = 0.0;
  int ends = 0;
  for (std::size_t p = 0; p < plants.size(); ++p)
    for (std::size_t e = 0; e < plants[p].size(); ++e) {
      if (!plants[p][e].is_end) continue;
      const Vector3d end = worlds[p % worlds.size()]->end(p / worlds.size(), e);
      sum += end.z() - plants[p][e].end().z();
      ++ends;
    }
  return sum / ends;
}

double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::atof(line.c_str() + 6) / 1024.0;
  return 0.0;
}

int steps_of(double seconds, double dt) {
  return static_cast<int>(std::lround(seconds / dt));
}

void print(const std::string& figures, bool finite) {
  std::printf("{%s%s, \"peak_megabytes\": %.1f}\n", finite ? "" : "\"unstable\": true",
              finite ? figures.c_str() : "", peak_megabytes());
}

std::string figure(const char* name, double value) {
  char text[100];
  std::snprintf(text, sizeof text, "\"%s\": %.9g", name, value);
  return text;
}

void measure_speed(const Task& task, const std::vector<Plant>& plants) {
  const Worlds worlds = make_worlds(task, plants);
  for (const auto& world : worlds) world->set_environment(gravity, drag);
  step(worlds, 1);
  const int trial_steps = 2;
  pedicel::Timer timer;
  step(worlds, trial_steps);
  const double seconds_a_step = timer.seconds() / trial_steps;
  const int steps = static_cast<int>(
      std::clamp(task.seconds / seconds_a_step, 2.0, std::max(2.0, 2.0 / task.dt)));
  timer.restart();
  step(worlds, steps);
  const double wall = timer.seconds();
  print(figure("real_time_factor", steps * task.dt / wall) + ", " +
            figure("simulated", steps * task.dt),
        std::isfinite(mean_droop(worlds, plants)));
}

void measure_droop(const Task& task) {
  const std::vector<Plant> plants = forest();
  const Worlds worlds = make_worlds(task, plants);
  for (const auto& world : worlds) world->set_environment(gravity, settling_drag);
  step(worlds, steps_of(1.5, task.dt));
  const double droop = mean_droop(worlds, plants);
  print(figure("droop", droop), std::isfinite(droop));
}

void measure_tip(const Task& task, int elements) {
  const auto world = task.make_world(cantilever(elements), task.dt);
  world->set_environment(gravity, settling_drag);
  for (int i = 0; i < steps_of(4.0, task.dt); ++i) world->step();
  const double drop = -world->end(0, elements - 1).z();
  print(figure("tip_drop", drop), std::isfinite(drop));
}

// Let go, without gravity or drag, from the shape that a two-hundredth of gravity gives.
void measure_ring(const Task& task) {
  const int elements = 20;
  const auto world = task.make_world(cantilever(elements), task.dt);
  world->set_environment(gravity / 200.0, settling_drag);
  for (int i = 0; i < steps_of(2.0, task.dt); ++i) world->step();
  world->set_environment(0.0, 0.0);
  std::vector<double> tip;
  for (int i = 0; i < steps_of(10.0, task.dt); ++i) {
    world->step();
    tip.push_back(world->end(0, elements - 1).z());
  }
  const auto ring = pedicel::ring_down(tip, task.dt);
  print(ring ? figure("frequency", ring->frequency) + ", " + figure("damping", ring->damping_ratio)
             : std::string("\"oscillates\": false"),
        std::isfinite(tip.back()));
}

}  // namespace

int run(int argc, char** argv, const MakeWorld& make_world) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: %s WORK DT THREADS SECONDS (see peer.h)\n", argv[0]);
    return 2;
  }
  const Task task{argv[1], std::atof(argv[2]), std::atoi(argv[3]), std::atof(argv[4]), make_world};
  if (task.work == "forest")
    measure_speed(task, forest());
  else if (task.work == "tree")
    measure_speed(task, tree());
  else if (task.work == "tip20")
    measure_tip(task, 20);
  else if (task.work == "tip40")
    measure_tip(task, 40);
  else if (task.work == "ring20")
    measure_ring(task);
  else if (task.work == "droop")
    measure_droop(task);
  else
    return 2;
  return 0;
}

}  // namespace peers
