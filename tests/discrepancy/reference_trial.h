#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"
#include "tests/discrepancy/reference_solver.h"

namespace pedicel::reference {

/// A known motion: linear between its rows, the first and last row kept before and after.
struct Rows {
  std::vector<double> time;    ///< s
  std::vector<Vec3> position;  ///< m, W
  std::vector<Quat> rotation;  ///< to W, or empty

  Pose at(double t) const;
};

struct HoldPlan {
  plant::CurvePlace place;
  Rows path;
  double release = std::numeric_limits<double>::infinity();  ///< s
  std::optional<double> stiffness;                           ///< N/m; absent: rigid
  /// Unit vectors (W), across each other, along which alone it leads; the point slides along the
  /// others. Empty: it leads along all.
  std::vector<Vec3> axes{};
  bool one_sided = false;  ///< of a single axis: it only pushes, along the axis
};

struct LoadPlan {
  plant::CurvePlace place;
  Vec3 force = Vec3::Zero();  ///< N, W
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// One run: what is done, and when it is looked at. Rows, releases and loads change at multiples of
/// `interval`.
struct TrialPlan {
  std::string name;
  double duration = 5.0;   ///< s
  double interval = 0.02;  ///< s between samples
  double clock = 0.0;      ///< s
  Vec3 gravity = Vec3(0, 0, -9.81);
  std::vector<plant::PlantMass> masses;
  std::vector<HoldPlan> holds;
  std::vector<LoadPlan> loads;
  std::optional<Rows> base;
  bool measures_force = false;   ///< of the first hold
  bool measures_wrench = false;  ///< of the clamp on the plant
  /// s: the record begins here, in mid swing. What came before is done by then, and is not in it.
  double begins = 0.0;
  /// Every sample is a state at rest, with the paths as they are at its time.
  bool is_static = false;
};

struct MarkerPlan {
  std::string name;
  plant::CurvePlace place;
};

/// What no effect stands for.
struct OutsideEffect {
  enum class Kind {
    string,  ///< pulls like a spring of `size` (N/m) beyond `slack` (m) from `point`, never pushes
    stake,   ///< a face through `point` with outward `direction` pushes with `size` (N/m)
    push,    ///< size (N) sin(2 pi frequency t) along `direction`
    attraction,  ///< towards `point`: size (N) d^2/(d^2 + r^2), d = 0.05 m, at a distance r
  };
  Kind kind = Kind::string;
  plant::CurvePlace place;
  Vec3 point = Vec3::Zero(), direction = Vec3::UnitX();
  double size = 0.0, slack = 0.0, frequency = 1.0;
};
const char* name_of(OutsideEffect::Kind kind);

struct Mesh {
  double spacing = 0.01;  ///< m, longest segment
  double dt = 0.002;      ///< s, longest step
};

/// A plant with everything that is hidden in it, at the grip and in the sensors.
struct Subject {
  plant::PlantFile plant;
  std::vector<plant::Effect> effects;
  std::vector<OutsideEffect> outside;
};

/// Samples without noise; outliers are not part of it.
struct Record {
  std::vector<double> time;        ///< s, from where the record begins
  Eigen::MatrixXd markers;         ///< samples x 3 markers, m, W
  Eigen::MatrixXd force;           ///< samples x 3, N, W; empty where it is not measured
  Eigen::MatrixXd wrench;          ///< samples x 6, N and N m, W; likewise
  double most_curvature = 0.0;     ///< 1/m, of any joint from the unloaded shape at any sample
  double settled_curvature = 0.0;  ///< 1/m, at time 0
  bool settled = true;
};

Record run_trial(const Subject& subject, const TrialPlan& trial,
                 const std::vector<MarkerPlan>& markers, const Mesh& mesh);

/// Where a point of the plant stands before the trial does anything.
Vec3 settled_point(const Subject& subject, const TrialPlan& trial, const plant::CurvePlace& place,
                   const Mesh& mesh);

/// A rigid hold is a spring of this stiffness, N/m.
inline constexpr double rigid_stiffness = 1e6;

}  // namespace pedicel::reference
