#include "plugins/cosserat/solver/exact_hessian.h"
#include "plugins/cosserat/solver/standing.h"

namespace pedicel::cosserat {

bool is_stable(const RodModel& model, const RodState& state, const Vec3& gravity,
               std::span<const Load> loads) {
  BlockSystem system(model);
  add_exact_hessian(model, state, gravity, loads, system);
  return system.negative_eigenvalues() == 0;
}

}  // namespace pedicel::cosserat
