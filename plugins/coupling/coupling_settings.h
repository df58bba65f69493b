#pragma once

#include <string>
#include <vector>

#include "engine/core/parameter.h"
#include "plugins/cosserat/contact/self_contact_settings.h"

namespace pedicel::coupling {

/// How plants touch robots, rigid bodies, the ground and themselves. Names, units, bounds and
/// sentences: parameters_of().
struct CouplingSettings {
  double contact_stiffness = 1.0e5;  ///< N/m, of a stem
  double fruit_stiffness = 1.0e4;    ///< N/m, of a fruit's flesh
  double margin = 2.0e-4;            ///< m, contact begins to push at this gap
  double friction = 0.5;             ///< 1, where the collider states none of its own
  int samples_per_feature = 2;       ///< 1, along a capsule, per smallest extent of the collider
  int most_samples = 16;             ///< 1, along one capsule
  bool two_way = false;              ///< the reaction acts on the links
  bool self_contact = true;          ///< plants touch themselves
  bool plant_contact = false;        ///< plants touch each other, and themselves
  bool blade_contact = false;        ///< leaf blades touch robots, bodies and the ground
};
std::vector<Parameter> parameters_of(CouplingSettings& settings);

/// The first value that is out of its bounds, as "CouplingSettings.margin = -1 m: must be ...";
/// empty where all are in.
std::string check(const CouplingSettings& settings);

/// What a plant's contact with itself and with other plants takes over.
cosserat::SelfContactSettings self_contact_settings(const CouplingSettings& settings);

}  // namespace pedicel::coupling
