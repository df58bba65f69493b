#include "plugins/cosserat/lanes/instruction_set.h"

#include <algorithm>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "plugins/cosserat/lanes/lane_kernels.h"

namespace pedicel::cosserat {

std::string checked_instruction_set(const std::string& asked) {
  const std::vector<std::string> here = available_instruction_sets();
  if (asked.empty()) return here.front();
  if (std::ranges::find(here, asked) != here.end()) return asked;
  throw UsageError("instruction set " + asked + ": this processor does not have it, expected " +
                   (here.size() > 1 ? "one of: " : "") + joined(here));
}

void choose_instruction_set(const std::string& asked) {
  use_instruction_set(asked.empty() ? asked : checked_instruction_set(asked));
}

}  // namespace pedicel::cosserat
