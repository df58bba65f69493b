#include <cstdio>

#include "engine/world/scene_reader.h"
#include "plugins/simulation/simulation.h"

int main() {
  pedicel::Diagnostics faults;
  const auto scene = pedicel::world::read_scene(SCENE, faults);
  if (!scene) return std::fputs(faults.text().c_str(), stderr), 3;
  pedicel::simulation::Simulation simulation(*scene, {});
  while (simulation.world().time() < 0.1) simulation.step();
  std::printf("%ld steps, %zu plant\n", simulation.world().steps(), simulation.plants().size());
  return simulation.world().steps() == 48 && simulation.plants().size() == 1 ? 0 : 1;
}
