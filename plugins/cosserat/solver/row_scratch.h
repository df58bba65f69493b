#pragma once

#include <memory>
#include <memory_resource>
#include <vector>

#include "engine/core/huge_pages.h"
#include "plugins/cosserat/lanes/lanes.h"

namespace pedicel::cosserat {

/// What a step needs and leaves nothing in: RodRows that are never stepped at once may share it,
/// and then stay in a core's cache.
class RowScratch {
 public:
  /// `on_huge_pages`: it and what lasts of those RodRows stand on HugePages.
  explicit RowScratch(bool on_huge_pages = false)
      : pages_(on_huge_pages ? std::make_unique<HugePages>() : nullptr),
        memory(pages_ ? pages_.get() : std::pmr::get_default_resource()) {}

 private:
  std::unique_ptr<HugePages> pages_;

 public:
  template <class Row>
  using Rows = std::pmr::vector<Row>;
  std::pmr::memory_resource* const memory;
  Rows<PoseRow> start{memory}, iterate{memory};
  Rows<RateRow> rate{memory};
  Rows<StrainRow> strain{memory};
  Rows<ViscousRow> viscous{memory};
  Rows<TermRow> term{memory};
  Rows<FactorRow> factor{memory};
  Rows<BlocksRow> blocks{memory};
  Rows<LoopFactorRow> loop_factor{memory};
};

}  // namespace pedicel::cosserat
