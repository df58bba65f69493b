#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// A set of labelled pictures of a scene that varies.
struct DataSetOptions {
  world::Scene scene;  ///< with what varies (`vary`)
  simulation::SimulationOptions simulation;
  std::filesystem::path out;
  long count = 100;                             ///< pictures
  long first = 0;                               ///< the first of them that this run makes
  int seed = 0;                                 ///< picture i is drawn from seed + i
  std::optional<std::array<int, 2>> size = {};  ///< px, in place of the cameras' own
  std::string camera;                           ///< empty: the scene's cameras in turn
  std::array<double, 2> at{0.0, 0.0};           ///< s, simulated time: drawn between the two
  bool quiet = false;
};

struct DataSetResult {
  long pictures = 0;     ///< that there are now
  long made = 0;         ///< of them, by this run
  long annotations = 0;  ///< of all of them
  long left_out = 0;     ///< what was drawn cannot stand, or its simulation became unstable
  double seconds = 0.0;
};

/// Makes the pictures that are not there yet, and writes the annotations of all. Each picture has a
/// simulation of its own, so it does not depend on the others: a run that was stopped goes on, and
/// a larger count adds to what is there, to the same bits. Throws InvalidFile, UsageError (where
/// pictures cannot be taken, too), io::WriteError where the folder holds something else. Ends
/// early, with everything closed, where stop_requested.
DataSetResult make_data_set(const DataSetOptions& options);

/// Counts the pictures that are there, and writes what is put together from all: annotations and
/// contact sheet. make_data_set() ends with it.
DataSetResult end_data_set(const DataSetOptions& options);

/// Files of the set in `from` (of the same identity) go into that of `options`, by links where both
/// are on one disk. What is there stays. Throws io::WriteError.
void take_pictures(const std::filesystem::path& from, const DataSetOptions& options);

}  // namespace pedicel::app
