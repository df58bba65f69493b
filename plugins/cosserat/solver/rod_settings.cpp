#include "engine/core/check.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/position_based_solver.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

std::vector<Parameter> parameters_of(RodSettings& s) {
  return {
      {"newton_iterations", "1", &s.newton_iterations, 1, 1000,
       "Most Newton iterations a step of the direct solver. One is stable; two to four converge."},
      {"tolerance", "1", &s.tolerance, 0.0, 1.0e-2,
       "Newton stops when it expects to be nearer than this to the solution (m and rad)."},
      {"iterations", "1", &s.iterations, 1, 10000,
       "Gauss-Seidel sweeps a sub-step of the position-based solver."},
      {"substeps", "1", &s.substeps, 1, 10000, "Sub-steps a step of the position-based solver."},
  };
}

std::string remedy(StepError error) {
  switch (error) {
    case none:
      return "";
    case not_converged:
      return "the rods did not converge: raise rods.newton_iterations or lower dt";
    case not_finite:
      return "a position is not a finite number: lower dt, or check stiffness and mass of the "
             "organ";
    case line_search_failed:
      return "no step lowers the potential: lower dt";
  }
  return "";
}

std::unique_ptr<RodSolver> make_solver(const RodSettings& settings, const RodModel& model) {
  if (settings.solver == SolverKind::position_based && is_extended(model))
    throw UsageError("RodSettings.solver = position_based with plant \"" + model.name +
                     "\", which has effects (joint laws, air or drift) that only the direct solver "
                     "runs: must be direct");
  if (settings.solver == SolverKind::position_based)
    return std::make_unique<PositionBasedSolver>(settings, model);
  return std::make_unique<DirectSolver>(settings, model);
}

}  // namespace pedicel::cosserat
