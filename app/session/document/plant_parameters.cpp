#include "pedicel/app/session/document/plant_parameters.h"

#include <cmath>

#include "pedicel/app/run/plant_overrides.h"

namespace pedicel::app {

namespace {

using plant::PlantFile;

struct Description {
  const char *key, *unit, *sentence;
  double minimum, maximum;
  bool logarithmic, restarts;
};

constexpr Description descriptions[] = {
    {"material.youngs_modulus", "Pa",
     "Stiffness of the stems (those with their own keep their ratio to it); a green stem 1e7 to "
     "1e9, wood 1e10.",
     1.0e5, 1.0e11, true, false},
    {"material.poisson_ratio", "1", "Decides the shear and twist stiffness; 0.3 to 0.4 for tissue.",
     -0.9, 0.5, false, false},
    {"material.density", "kg/m3",
     "Mass of the stems (those with their own keep their ratio to it); fresh tissue 700 to 1000.",
     50.0, 3000.0, false, false},
    {"material.damping_time", "s",
     "Kelvin-Voigt: damping ratio = pi * frequency * this; 0.01 calms a stem within seconds. Stems "
     "with their own keep their ratio to it.",
     0.0, 1.0, false, false},
    {"detach.stretch", "1", "Strain of its stalk at which a fruit comes off.", 1.0e-3, 2.0, true,
     false},
    {"detach.bend", "rad", "Bending of its stalk's joint at which a fruit comes off.", 1.0e-3, 3.2,
     true, false},
    {"detach.force", "N", "Force in its stalk at which a fruit comes off.", 1.0e-3, 1.0e3, true,
     false},
    {"detach.moment", "N m", "Bending moment in its stalk at which a fruit comes off.", 1.0e-5,
     1.0e2, true, false},
    {"detach.torsion", "N m", "Torsion in its stalk at which a fruit comes off.", 1.0e-5, 1.0e2,
     true, false},
    {"sampling.distance", "m", "How far apart nodes lie: finer is more exact and slower.", 1.0e-3,
     0.5, true, true},
};

std::optional<double> value_of(const PlantFile& plant, const std::string& key) {
  if (key == "material.youngs_modulus") return plant.material.youngs_modulus;
  if (key == "material.poisson_ratio") return plant.material.poisson_ratio;
  if (key == "material.density") return plant.material.density;
  if (key == "material.damping_time") return plant.material.damping_time;
  if (key == "sampling.distance") return plant.distance;
  if (plant.fruits.empty()) return std::nullopt;
  const plant::DetachLimits& limits = plant.fruits.front().detach;
  if (key == "detach.stretch") return limits.stretch;
  if (key == "detach.bend") return limits.bend;
  if (key == "detach.force") return limits.force;
  if (key == "detach.moment") return limits.moment;
  return limits.torsion;
}

PlantFile with(PlantFile plant, const std::vector<world::Setting>& settings) {
  Diagnostics ignored;  // they were checked when they were set
  apply_plant_overrides(plant, settings, ignored);
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
  for (const Description& d : descriptions) {
    const std::optional<double> value = value_of(current, d.key);
    if (!value) continue;
    SessionParameter one;
    one.key = "plants." + name + "." + d.key;
    one.group = name;
    one.unit = d.unit;
    one.sentence = d.sentence;
    one.value = *value;
    one.initial = value_of(initial, d.key).value_or(*value);
    one.minimum = d.minimum;
    one.maximum = d.maximum;
    one.logarithmic = d.logarithmic;
    one.restarts = d.restarts;
    all.push_back(std::move(one));
  }
}

}  // namespace pedicel::app
