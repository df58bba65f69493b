#pragma once

#include <memory>
#include <span>

#include "plugins/cosserat/solver/row_search.h"

namespace pedicel::cosserat {

/// The incremental potential of some plants over one step, without loads, supports, welds and
/// contact, in rows of eight elements (lanes.h): its value, its gradient with a positive definite
/// Hessian (Gauss-Newton plus the tension's geometric stiffness), and the solution of Newton's
/// system. The order of calls is DirectSolver's. Calls with a pool share the packs out to its
/// threads: branches before what carries them in eliminate(), after it elsewhere.
struct RodRows {
  RodRows(std::span<const RodModel* const> plants, int threads, bool keep_blocks = false,
          std::shared_ptr<RowScratch> scratch = nullptr)
      : store(plants, threads, keep_blocks, std::move(scratch)), extensions(store, plants.size()) {
    for (std::size_t p = 0; p < plants.size(); ++p)
      states.read_model(static_cast<int>(p), *plants[p]);
  }

  RowStore store;
  RowExtensions extensions;
  RowStates states{store, extensions};
  RowElimination elimination{store};
  RowSearch search{store, states, elimination};
};

}  // namespace pedicel::cosserat
