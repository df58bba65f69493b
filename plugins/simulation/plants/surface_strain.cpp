#include "plugins/simulation/plants/surface_strain.h"

#include <algorithm>

namespace pedicel::simulation {

double surface_strain(const cosserat::RodModel& model, const cosserat::RodState& state,
                      int element) {
  const cosserat::Strain strain = cosserat::strain_of(model, state, element);
  const cosserat::Element& e = model.elements[element];
  const double radius = std::max(e.radius_near, e.radius_far);
  return strain.stretch.norm() + radius * strain.bend.norm() / e.length;
}

}  // namespace pedicel::simulation
