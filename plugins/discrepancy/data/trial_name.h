#pragma once

#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::discrepancy {

/// trial "push": a trial within a sentence. Its name may be a word of the sentence itself.
inline std::string named_trial(const std::string& name) {
  return "trial " + in_quotes(name);
}

}  // namespace pedicel::discrepancy
