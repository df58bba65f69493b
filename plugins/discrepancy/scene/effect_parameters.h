#pragma once

#include <string>

#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

// Parameters that several scene effects have.

/// Which plant, camera or sensor it concerns; all where nothing is said.
inline effects::EffectParameter which(const std::string& kind, const std::string& said) {
  return {
      .name = kind, .sentence = "which " + said, .size = 0, .required = false, .otherwise = "all"};
}

inline effects::EffectParameter factor_of(const std::string& name, const std::string& sentence) {
  return {.name = name,
          .unit = "1",
          .bounds = io::positive,
          .sentence = sentence,
          .vanishes = effects::Vanishes::at_one,
          .first = {1.0}};
}

/// Three numbers that do nothing at 0; those that may be left out are 0 then.
inline effects::EffectParameter vector_of(const std::string& name, const std::string& unit,
                                          const std::string& sentence, bool required = true) {
  return {.name = name,
          .unit = unit,
          .bounds = io::any_number,
          .sentence = sentence,
          .size = 3,
          .required = required,
          .otherwise = required ? "" : "0",
          .vanishes = effects::Vanishes::at_zero,
          .first = {0.0, 0.0, 0.0}};
}

}  // namespace pedicel::discrepancy
