#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Something that measured data say and that cannot be, whatever the plant is made of: its tables,
/// the drawing and what was done contradict each other.
struct Contradiction {
  std::string trial;           ///< its name
  std::filesystem::path file;  ///< from the experiment's folder
  int kind = 0;                ///< the same number: of the same kind
  /// What is said, what was expected, and the likely cause; it goes on after the file's name.
  std::string what;

  std::string sentence() const { return file.string() + " " + what; }
};

/// All that is found, at most one a trial: what follows from a wrong clock or unit is not told
/// beside it. Takes milliseconds.
std::vector<Contradiction> contradictions(const Experiment& experiment);

/// Each as an error of its file.
void add_to(Diagnostics& diagnostics, const Experiment& experiment,
            const std::vector<Contradiction>& found);

/// In one sentence: the first of each kind, and which other files say the same.
std::string sentence(const std::vector<Contradiction>& found);

}  // namespace pedicel::discrepancy
