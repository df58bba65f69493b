#pragma once

#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/skeleton/skeleton.h"

/// A plant as Helios' plug-in plantarchitecture writes it (writePlantStructureXML): shoots made of
/// phytomers, which say lengths, radii and angles. Angles are in degrees, as in the file; lengths
/// are in its unit.
namespace pedicel::plant {

struct HeliosPetiole {
  double length = 0.0, radius = 0.0, pitch = 0.0;
  double curvature = 0.0;  ///< deg per length
  double taper = 0.0;      ///< what is lost of the radius towards the tip, 0 to 1
  double scale = 1.0;      ///< of the radius, by the leaf's growth
  int segments = 1;
  SourcePosition where;
};

struct HeliosInternode {
  double length = 0.0, radius = 0.0, pitch = 0.0, phyllotaxis = 0.0;
  int segments = 1;
  std::vector<double> bend, turn;  ///< deg a segment, where the file has them
  std::vector<Vec3> vertices;      ///< older files say places; empty: none
  std::vector<double> radii;       ///< of these
  std::vector<HeliosPetiole> petioles;
  SourcePosition where;
};

struct HeliosShoot {
  int id = 0;
  int parent = -1;  ///< id of a shoot that stands before it, -1: from the ground
  int parent_node = 0, parent_petiole = 0;
  double pitch = 0.0, yaw = 0.0, roll = 0.0;  ///< of its base
  std::vector<HeliosInternode> internodes;
  SourcePosition where;
};

struct HeliosPlant {
  Vec3 base = Vec3::Zero();
  std::vector<HeliosShoot> shoots;
  SourcePosition where;
};

/// The places of a plant's shoots and petioles, turned as Helios turns them when it reads its own
/// files. `unit` (m) of its lengths. Shoots that hang from what is not there go to the diagnostics,
/// and then the result is empty.
std::vector<SkeletonNode> helios_nodes(const HeliosPlant& plant, double unit,
                                       Diagnostics& diagnostics);

}  // namespace pedicel::plant
