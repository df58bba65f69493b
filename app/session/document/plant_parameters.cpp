#include "app/session/document/plant_parameters.h"

#include "plugins/plant/plant_numbers.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::app {

namespace {

using plant::PlantFile;

PlantFile with(PlantFile plant, const std::vector<world::Setting>& settings) {
  Diagnostics ignored;  // they were checked when they were set
  simulation::apply_plant_overrides(plant, settings, ignored);
  return plant;
}

}  // namespace

bool is_plant_key(const std::string& key) {
  for (const char* head : {"plants.", "material.", "detach.", "sampling."})
    if (key.rfind(head, 0) == 0) return true;
  return false;
}

void add_plant_parameters(std::vector<SessionParameter>& all, const std::string& name,
                          const PlantFile& plant, const std::vector<world::Setting>& now,
                          const std::vector<world::Setting>& files) {
  const PlantFile current = with(plant, now), initial = with(plant, files);
  for (const plant::PlantNumber& number : plant::plant_numbers()) {
    const std::optional<double> value = plant::value_of(current, number);
    if (!value || number.high == number.low) continue;
    SessionParameter one;
    one.key = "plants." + name + "." + std::string(number.key);
    one.group = name;
    one.unit = number.unit;
    one.sentence = number.sentence;
    one.value = *value;
    one.initial = plant::value_of(initial, number).value_or(*value);
    one.minimum = number.low;
    one.maximum = number.high;
    one.logarithmic = number.logarithmic;
    one.restarts = number.restarts;
    all.push_back(std::move(one));
  }
}

}  // namespace pedicel::app
