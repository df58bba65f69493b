#pragma once

namespace pedicel::cosserat {

/// How parts of plants touch each other.
struct SelfContactSettings {
  double stiffness = 1.0e5;        ///< N/m, at most, stem against stem, > 0
  double fruit_stiffness = 1.0e4;  ///< N/m, at most, where one is a fruit, > 0
  double friction = 0.5;           ///< 1, Coulomb, >= 0
  double margin = 2.0e-4;          ///< m, two surfaces begin to push at this gap, > 0
};

}  // namespace pedicel::cosserat
