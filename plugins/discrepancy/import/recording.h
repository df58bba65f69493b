#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::discrepancy {

/// What a file says of itself, and where.
template <class Value>
struct Stated {
  std::optional<Value> value;
  SourcePosition where{};
};

/// Named points over time as a laboratory's program recorded them, in the file's own unit and
/// axes. What the file does not state is absent, and has to be told by the person who imports it.
struct Recording {
  std::filesystem::path file;
  std::string program;             ///< "OptiTrack Motive CSV"
  std::vector<std::string> names;  ///< of the points, each once
  Eigen::MatrixXd value;           ///< samples x 3 names (x, y, z); NaN where not seen
  std::vector<double> time;        ///< s, increasing; empty: the file counts frames alone
  std::vector<double> frame;       ///< numbers of the frames, increasing; empty where not counted
  Stated<double> rate;             ///< Hz, of the frames
  Stated<double> unit;             ///< m, length of the file's unit
  Stated<char> up;                 ///< 'x', 'y' or 'z'
  /// The points lie in a picture: x to the right and y up from its upper left corner, both in
  /// pixels, z absent (0).
  bool in_pixels = false;
  bool flat = false;                 ///< the file has two axes; z is 0
  std::vector<std::string> remarks;  ///< what was left out or put right, a sentence each

  int samples() const { return static_cast<int>(value.rows()); }
  /// Index of a point; -1 where there is none of that name.
  int index_of(const std::string& name) const;
};

/// How the columns of a recording are read where its program leaves that open.
struct RecordingOptions {
  /// A tracked point less likely than this was not seen (DeepLabCut).
  double least_likelihood = 0.6;
};

}  // namespace pedicel::discrepancy
