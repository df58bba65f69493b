#pragma once

#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

/// What a drawing becomes: the tree and the nodes that `distance` keeps. m, P.
struct PlantPreview {
  struct Node {
    Vec3 position = Vec3::Zero();
    int parent = -1;      ///< among the nodes; -1: the root
    int curve = -1;       ///< that it lies on
    bool is_key = false;  ///< a junction, an end, or something starts here
  };
  std::vector<Node> nodes;         ///< those that are kept; parents first
  int sampled = 0;                 ///< before the others were left out
  std::vector<int> loose;          ///< curves that reach nothing
  std::vector<std::string> names;  ///< of the curves
  std::string problem;             ///< why there are no nodes; empty where there are some
};

/// Never throws: an unfinished drawing says what it lacks.
PlantPreview preview(const PlantFile& plant);

}  // namespace pedicel::plant
