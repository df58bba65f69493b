#pragma once

#include "plugins/cosserat/model/rod_model.h"

/// The plants on which Pedicel and its peers are measured: E 2e7 Pa, nu 0.3, 450 kg/m3, elements of
/// 2 cm, no Kelvin-Voigt damping, unloaded as drawn. Element k of n of a rod whose radius goes from
/// r0 to r1 has r0 + (r1 - r0) k / (n - 1).
namespace pedicel::plant {

/// Plant `index` of the forest, of 59 elements: it stands at (0.5 (index mod 7), 0.5 floor(index /
/// 7), 0) m; a stem of 19 elements along (0.02, 0, 1), r 5 to 4 mm; branches b = 0..4 of 8
/// elements, r 3 to 2 mm, from the end of stem element 4 + 3 b, 1.0 rad from the vertical at
/// azimuth 2.399963 b + index. Mass damping 2 1/s. Settled droop, mean over all ends of 38 plants:
/// -4.62 mm.
cosserat::RodModel forest_plant(int index);
inline constexpr int forest_size = 38;  ///< plants: 2,242 elements

/// One connected plant of 2,242 elements that hangs from its root: a trunk of 42 elements downward,
/// r 5 mm; 22 branches of 40, r 4 to 3 mm, 1.0 rad from straight down; on each 6 twigs of 10, r 2
/// mm, 1.3 rad from straight down. Mass damping 2 1/s. Settled droop: -0.2645 m.
cosserat::RodModel hanging_tree();

/// A horizontal rod of 0.4 m, r 3 mm, along x. Heavy elastica: tip at (0.316833, -0.227248) m;
/// first frequency without gravity 1.10599 Hz.
cosserat::RodModel cantilever(int elements);

}  // namespace pedicel::plant
