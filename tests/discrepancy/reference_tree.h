#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

/// A simulator of plants that shares nothing with the rods of the program but the plant file: joint
/// angles instead of positions, no stretch and no shear, articulated-body elimination instead of a
/// block system, a third-order implicit Runge-Kutta method instead of BDF2. What it and the program
/// agree on is then no common mistake.
namespace pedicel::reference {

/// A spring in series with a dashpot that adds instant K (phi - phi0) - share K q to a joint's
/// moment, with q' = (phi - phi0 - q) / time and q = 0 at first. Hung: it has relaxed under the
/// plant's own weight, from the unloaded shape (phi0 = 0), before anything else was done.
struct MemoryTerm {
  double instant = 0.0, share = 0.0;
  double time = 1.0;  ///< s
  bool hung = false;
};

/// How every joint answers its rotation phi (rad), beyond M = K (phi + damping_time phi').
struct JointLaw {
  double nonlinearity = 0.0, k0 = 1.0;    ///< 1, 1/m: bending times 1 + b (k/k0)^2
  double asymmetry = 0.0, side_k0 = 1.0;  ///< 1, 1/m: bending about Joint::side
  double slider_ratio = 0.0;              ///< share of K that slips
  double slider_curvature = std::numeric_limits<double>::infinity();  ///< 1/m
  double slider_moment = std::numeric_limits<double>::infinity();     ///< N m
  double yield_curvature = std::numeric_limits<double>::infinity();   ///< 1/m, from the rest shape
  double drift_rate = 0.0;                                            ///< 1/s, of E over the clock
  double hysteresis_ratio = 0.0;     ///< share of K that is Bouc-Wen's
  double hysteresis_moment = 1.0;    ///< N m, of the whole K
  double hysteresis_exponent = 1.0;  ///< 1 is Dahl's
  std::vector<MemoryTerm> memory;
};

struct Joint {
  Quat rest = Quat::Identity();   ///< child to parent, unloaded
  Mat3 stiffness = Mat3::Zero();  ///< N m/rad, in the child's frame
  double damping_time = 0.0;      ///< s
  double length = 0.0;            ///< m of rod that it stands for
  Vec3 side = Vec3::Zero();       ///< axis of JointLaw::asymmetry, in the child's frame
};

/// A rigid piece of stem; its joint is its near end, its third axis points to the far end.
struct Segment {
  int parent = -1;  ///< whose far end it starts at; -1: the clamp
  double length = 0.0;
  double mass = 0.0;            ///< kg
  double centre = 0.0;          ///< m from the joint
  Vec3 inertia = Vec3::Zero();  ///< kg m2, about the joint, along its own axes
  double stretch = 0.0;         ///< m/N, its length over EA: known, but rigid in motion
  Joint joint;
  Quat drawn;  ///< to W, as drawn
  int curve = 0;
  double arc_near = 0.0, arc_far = 0.0;  ///< m along the curve as drawn
};

/// Air that moves past a plant: 1/2 rho area |u| u a metre, u the relative velocity's normal part.
struct Air {
  Vec3 velocity = Vec3::Zero();             ///< m/s
  double area = 0.0;                        ///< m2/m, the drag coefficient included
  double frequency = 0.0, amplitude = 0.0;  ///< Hz, 1: velocity times 1 + amplitude sin(2 pi f t)
  int curve = -1;                           ///< -1: all
  /// Of a plate, with this normal (W, as drawn): `area` along it, `across` square to it, of the
  /// whole velocity.
  Vec3 normal = Vec3::Zero();
  double across = 0.0;  ///< m2/m
};

struct Tree {
  std::vector<Segment> segments;  ///< parents before children
  Vec3 root = Vec3::Zero();       ///< m, W: where the clamp is
  JointLaw law;
  double mass_damping = 0.0;  ///< 1/s
  std::vector<Air> air;
  std::vector<double> curve_lengths;  ///< m
  int size() const { return static_cast<int>(segments.size()); }
};

/// A point of a tree.
struct Place {
  int segment = 0;
  double along = 0.0;  ///< m from the segment's joint
};

/// Curves to segments at most `spacing` (m) long, with `effects` on top of the plant's own; masses
/// of a trial are hung on like the plant's. Effects at the grip and the sensor are passed over.
/// Throws std::invalid_argument for what it does not know: fruits, leaves, supports.
Tree build_tree(const plant::PlantFile& plant, const std::vector<plant::Effect>& effects,
                const std::vector<plant::PlantMass>& trial_masses, double spacing);

/// Where a fraction `at` of a curve's drawn length lies.
Place locate(const plant::PlantFile& plant, const Tree& tree, const std::string& curve, double at);

}  // namespace pedicel::reference
