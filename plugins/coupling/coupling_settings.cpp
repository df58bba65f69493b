#include "plugins/coupling/coupling_settings.h"

namespace pedicel::coupling {

std::vector<Parameter> parameters_of(CouplingSettings& s) {
  // Files, the tuning panel, the manual and the checks all come from this list. Stiffness and
  // margin belong together: what presses harder than stiffness times margin overlaps, and what is
  // stiffer than needed costs iterations of a step. Lower bounds above zero keep divisions by a
  // margin or a stiffness finite.
  return {
      {"contact_stiffness", "N/m", &s.contact_stiffness, 1.0, 1.0e9,
       "Stiffness of a stem's contact. A force F sinks in by F over it; choose it so that the "
       "largest force sinks in by less than half of the margin."},
      {"fruit_stiffness", "N/m", &s.fruit_stiffness, 1.0, 1.0e9,
       "Stiffness of a fruit's contact: the soft flesh. Ripe tomatoes are near 1e3 to 1e4."},
      {"margin", "m", &s.margin, 1.0e-7, 0.01,
       "Contact begins to push at this gap, so that resting things do not overlap. Choose about "
       "force over stiffness."},
      {"friction", "1", &s.friction, 0.0, 10.0,
       "Coulomb coefficient of plant against a collider that states none, and of plant against "
       "plant. Stem or fruit on rubber 0.6 to 1, on steel 0.2 to 0.5."},
      {"samples_per_feature", "1", &s.samples_per_feature, 1, 64,
       "Samples along a capsule per smallest extent of the collider. Raise it for colliders with "
       "small hollows or ribs."},
      {"most_samples", "1", &s.most_samples, 2, 256, "Most samples along one capsule."},
      {"two_way", "1", &s.two_way, 0, 1,
       "Whether the reaction acts on the robot's links. Needed for wood and stiff stems."},
      {"self_contact", "1", &s.self_contact, 0, 1, "Whether a plant touches itself."},
      {"plant_contact", "1", &s.plant_contact, 0, 1,
       "Whether plants touch each other, fruits that came off, and themselves. They are then "
       "solved "
       "as one, by the direct solver."},
      {"blade_contact", "1", &s.blade_contact, 0, 1,
       "Whether leaf blades touch robots, bodies and the ground between their veins, too; with "
       "plant_contact also other plants."},
  };
}

std::string check(const CouplingSettings& settings) {
  // The list points into the settings to read and to write. Checked is a copy, so that a check can
  // take constant ones.
  CouplingSettings copy = settings;
  const auto refusal = check_parameters(parameters_of(copy));
  // With the name of the struct, so that a caller in code finds the field as well as one with a
  // file.
  return refusal ? "CouplingSettings." + *refusal : std::string();
}

cosserat::SelfContactSettings self_contact_settings(const CouplingSettings& settings) {
  // The same numbers as against robots: a plant's surface does not know what touches it.
  return {settings.contact_stiffness, settings.fruit_stiffness, settings.friction, settings.margin};
}

}  // namespace pedicel::coupling
