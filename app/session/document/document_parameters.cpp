#include "app/session/document/document_parameters.h"

#include <algorithm>

#include "app/session/document/plant_parameters.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/simulation/plants/rod_options.h"

namespace pedicel::app {

namespace {

/// The settings that the scene and the document make of the solver and the contacts.
struct Settings {
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
};

Settings settings_of(const world::Scene& scene) {
  Settings settings;
  Diagnostics diagnostics;
  simulation::apply_rod_settings(scene.rods, settings.rods, diagnostics);
  simulation::apply_coupling_settings(scene.coupling, settings.coupling, diagnostics);
  return settings;
}

SessionParameter described(const std::string& group, const Parameter& now,
                           const Parameter& initial) {
  SessionParameter one;
  one.key = group + "." + now.name;
  one.group = group;
  one.unit = now.unit;
  one.sentence = now.sentence;
  one.value = now.get();
  one.initial = initial.get();
  one.minimum = now.minimum;
  one.maximum = now.maximum;
  one.flag = std::holds_alternative<bool*>(now.value);
  one.whole = std::holds_alternative<int*>(now.value);
  one.logarithmic = !one.flag && one.maximum > 1.0e3 * std::max(one.minimum, 1.0e-12);
  one.restarts = now.name == "margin" || now.name == "two_way" || now.name == "self_contact" ||
                 now.name == "plant_contact" || now.name == "blade_contact";
  return one;
}

void add(std::vector<SessionParameter>& all, const std::string& group,
         const std::vector<Parameter>& now, const std::vector<Parameter>& initial) {
  for (std::size_t i = 0; i < now.size(); ++i) all.push_back(described(group, now[i], initial[i]));
}

}  // namespace

std::vector<SessionParameter> document_parameters(const Document& document, const Document& plain) {
  std::vector<SessionParameter> all;
  const world::Scene scene = scene_of(document), files = scene_of(plain);
  Settings now = settings_of(scene), initial = settings_of(files);
  add(all, "rods", cosserat::parameters_of(now.rods), cosserat::parameters_of(initial.rods));
  add(all, "coupling", coupling::parameters_of(now.coupling),
      coupling::parameters_of(initial.coupling));
  for (std::size_t p = 0; p < document.plants.size(); ++p)
    if (document.plants[p].file)
      add_plant_parameters(all, document.plants[p].entry.name, *document.plants[p].file,
                           scene.plants[p].set, files.plants[p].set);
  return all;
}

}  // namespace pedicel::app
