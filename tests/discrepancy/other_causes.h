#pragma once

#include <string>
#include <vector>

#include "tests/discrepancy/hidden_effect.h"

namespace pedicel::hidden {

/// A cause that might be named in place of the hidden one, by what it does while it is small.
struct OtherCause {
  std::string name;
  /// Each way is a set of small effects that the cause may mix (directions, components of a
  /// vector). Of places, lengths and times it has one: those are ways of their own.
  std::vector<std::vector<plant::Effect>> ways;
};

/// Every effect of the page Effects that is neither `truth` nor has it as a special case (a
/// wind of no speed is drag), for the plant and the trials of a case. Modulus, density and damping
/// are not among them, which a refit may change anyway; nor are outliers, detachment, and a marker
/// that sits elsewhere, which moves one marker for good and is like nothing else.
std::vector<OtherCause> other_causes(const std::string& truth, const Setting& setting,
                                     const Scale& scale);

/// What two honest solvers of the same plant may differ by where branches leave: the joint of each
/// branch softer by the l/4EI that it has where it is given the branch's whole segment, on a mesh
/// of half the plant's spacing. Empty for a single stem.
std::vector<plant::Effect> soft_junctions(const plant::PlantFile& plant);

}  // namespace pedicel::hidden
