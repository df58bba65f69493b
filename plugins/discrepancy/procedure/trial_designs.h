#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// A trial that could be done next: what to do in words, and how long it takes.
struct TrialDesign {
  Trial trial;           ///< with sample times; its samples are zeros
  std::string action;    ///< "Pull stem at 0.8 along x by 40 mm and let go"
  double minutes = 0.0;  ///< of work, waiting included as far as it keeps a person
  bool turned = false;   ///< with the plant turned by 180 degrees about the vertical
};

/// Where and how far designs push.
struct DesignScales {
  plant::CurvePlace grip;           ///< the point that is held or pushed
  Vec3 rest = Vec3::Zero();         ///< m, W: where it rests
  Vec3 turned_rest = Vec3::Zero();  ///< m, W: the same with the plant turned
  double reach = 0.0;               ///< m, of the pushes done so far
  double stiffness = 0.0;           ///< N/m, of the holder; 0: rigid
  double load = 0.0;                ///< N, at the top, that bends by about the reach
  bool force = false;               ///< the force of the holder can be measured
  double sample_time = 0.02;        ///< s
  double last_clock = 0.0;          ///< s, of the trials done so far
};

/// Grip, reach, load and samples as in the trials done so far; where nothing was held, at 0.8 of
/// the longest curve and by a tenth of its length. The rest positions are left open.
DesignScales design_scales(const Experiment& experiment);

/// Releases of two sizes in two directions, pushes at two rates with a hold of a minute, weights up
/// and down at two places, a shaken base, the plant turned, a repetition after an hour.
std::vector<TrialDesign> trial_designs(const Experiment& experiment, const DesignScales& scales);

/// The experiment's plant turned by 180 degrees about the vertical through its root.
plant::PlantFile turned_plant(const plant::PlantFile& plant);

}  // namespace pedicel::discrepancy
