#include "app/report/meta.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/report/version.h"
#include "engine/io/atomic_file.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

namespace {

using Json = nlohmann::ordered_json;

Json section(const std::vector<Parameter>& parameters) {
  Json json;
  for (const Parameter& parameter : parameters)
    json[parameter.name] = {{"value", parameter.get()}, {"unit", parameter.unit}};
  return json;
}

}  // namespace

void write_meta(const std::filesystem::path& path, const simulation::Simulation& simulation,
                const SceneResult& result) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(result.state_hash));
  const world::Scene& scene = simulation.scene();
  cosserat::RodSettings rods = simulation.assets()->rods;
  coupling::CouplingSettings coupling = simulation.assets()->coupling;
  Json json = {{"program", "pedicel"},
               {"version", version()},
               {"git_hash", git_hash()},
               {"machine", machine()},
               {"scene", scene.name},
               {"scene_file", scene.file.filename().string()},
               {"seed", scene.seed},
               {"threads", scene.threads},
               {"dt_s", scene.dt},
               {"steps", result.steps},
               {"simulated_s", result.simulated},
               {"exit_code", result.exit_code},
               {"error", result.error},
               {"state_hash", hash},
               {"gravity_m_s2", {scene.gravity.x(), scene.gravity.y(), scene.gravity.z()}}};
  json["solver"] = rods.solver == cosserat::SolverKind::direct ? "direct" : "position_based";
  json["integrator"] = rods.integrator == cosserat::Integrator::bdf2 ? "bdf2" : "backward_euler";
  json["rods"] = section(cosserat::parameters_of(rods));
  json["coupling"] = section(coupling::parameters_of(coupling));
  json["plants"] = Json::array();
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const simulation::PlantInfo& info = simulation.plants()[p];
    json["plants"].push_back({{"name", model.name},
                              {"elements", model.size()},
                              {"sampled_nodes", info.sampled_nodes},
                              {"fruits", model.fruits.size()},
                              {"welds", model.welds.size()}});
    if (info.residual)
      json["plants"].back()["settles_from_drawing_mm"] = {
          {"largest", 1.0e3 * info.residual->largest}, {"rms", 1.0e3 * info.residual->rms}};
  }
  io::write_file_atomically(path, json.dump(2) + "\n");
}

}  // namespace pedicel::app
