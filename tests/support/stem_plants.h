#pragma once

#include <string>

/// Plant files of one stem, to which a test adds what it is about.

/// Upright and straight, 0.4 m, elements of 20 mm; drawn at rest.
inline const std::string straight_stem_text =
    "format: pedicel-plant\nversion: 1\nname: p\nshape: rest\n"
    "material: {youngs_modulus: 1e8, poisson_ratio: 0.3, density: 700, damping_time: 0.01}\n"
    "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0]\ncurves:\n"
    "  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, 0.4]], radius: 0.004}\n";

/// Bent a little, 0.2 m, as it hangs.
inline const std::string bent_stem_text = R"(format: pedicel-plant
version: 1
name: stem
material: {youngs_modulus: 1.0e8, poisson_ratio: 0.3, density: 800, damping_time: 0.01}
sampling: {connect: 0.01, distance: 0.02}
root: [0, 0, 0]
curves:
  - {name: stem, points: [[0, 0, 0], [0, 0, 0.1], [0.01, 0, 0.2]], radius: 0.004}
)";
