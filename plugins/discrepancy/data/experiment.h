#pragma once

#include <Eigen/Dense>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

/// A point of the plant whose position was measured.
struct Marker {
  std::string name;
  plant::CurvePlace place;
};

/// A known motion: linear between its rows, the first and last row kept before and after.
struct DrivenPath {
  std::vector<double> time;    ///< s, increasing
  std::vector<Vec3> position;  ///< m, W
  /// By how much what moves has turned since it was drawn (W; identity: as drawn); empty where the
  /// file gives no orientation.
  std::vector<Quat> rotation;
  std::filesystem::path file{};  ///< from the trial's folder; empty where it was made by a program

  Vec3 position_at(double t) const;
  Quat rotation_at(double t) const;  ///< shortest way between rows; identity where there is none
};

/// A point that is held to a path until `release` (free from then on). The reader gives a hold
/// without `release` the end of its path where the trial goes on longer.
struct Hold {
  plant::CurvePlace place;
  DrivenPath path;
  double release = std::numeric_limits<double>::infinity();  ///< s
  std::optional<double> stiffness{};                         ///< N/m; absent: rigid
  /// Unit vectors (W), across each other, along which alone it leads: the point slides along the
  /// others without friction. Empty: it leads along all.
  std::vector<Vec3> axes{};
  bool one_sided = false;  ///< of a single axis: it only pushes, along the axis
  bool direction = false;  ///< of the path's orientation it leads the segment's direction alone

  bool slides() const { return !axes.empty(); }
};

/// A force that acts for from <= t < to.
struct TimedLoad {
  plant::CurvePlace place;
  Vec3 force = Vec3::Zero();  ///< N, W
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// Samples over time: one row a sample, NaN where nothing was measured; a whole column of NaN is an
/// axis that was not measured.
struct Samples {
  std::vector<double> time;  ///< s, increasing
  Eigen::MatrixXd value;     ///< samples x columns
  int size() const { return static_cast<int>(time.size()); }
};

/// Something that happened: `what` is an organ or fruit, `by` the link that did it, in a scene.
struct MeasuredEvent {
  double time = 0.0;  ///< s
  std::string event;  ///< grasped | released | detached | slipped
  std::string what = {}, by = {};

  bool is_detachment() const { return event == "detached"; }
};

/// One run of the experiment: what was done, and what was measured.
struct Trial {
  enum class Use { unset, fit, check };
  std::string name;
  std::filesystem::path folder;  ///< from the experiment's, as in the file
  Use use = Use::unset;
  double clock = 0.0;                ///< s since the first trial
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s2
  std::vector<plant::PlantMass> masses;
  std::vector<Hold> holds;
  std::vector<TimedLoad> loads;
  std::optional<DrivenPath> base;
  /// s: it begins in motion, and its first samples, up to this time, say how the plant stands and
  /// moves at time 0. Absent: at rest.
  std::optional<double> window;
  /// Without time: row i of every table belongs together, with the plant in equilibrium. A sample's
  /// time is then the number of its row.
  bool is_static = false;
  std::vector<plant::Effect> effects;  ///< at the sensor or the grip, known in this trial

  Samples markers;  ///< m, W; 3 columns a marker, in the experiment's order
  Samples force;    ///< N, W; 3 columns: the first hold's pull on the plant; empty: not measured
  std::vector<MeasuredEvent> events;
  /// N and N m, W; 6 columns: force and moment of what carries the plant on it, at the root as it
  /// is then; empty: not measured.
  Samples wrench;
  std::filesystem::path wrench_file;  ///< from the trial's folder

  double duration() const;  ///< s, of the last sample of anything
};

/// Known noise of the sensors; what is absent is estimated from the data.
struct StatedNoise {
  std::optional<double> position_std;  ///< m
  std::optional<double> force_std;     ///< N
  std::optional<double> moment_std{};  ///< N m
  /// m, of the rows of paths themselves: what led the plant went elsewhere than they say.
  std::optional<double> path_std{};
};

/// An experiment folder, whole: the page Experiment folder of the manual.
struct Experiment {
  std::filesystem::path folder;
  std::string title;
  plant::PlantFile plant;            ///< the nominal plant
  std::filesystem::path plant_path;  ///< of its file, for the leaf templates beside it
  std::vector<Marker> markers;
  StatedNoise noise;
  std::vector<plant::Effect> effects;  ///< at the sensor or the grip, known in every trial
  std::vector<Trial> trials;
};

/// Whether it was recorded when fruits came off, in any trial: then those that no trial names
/// stayed on.
bool records_detachments(const Experiment& experiment);

/// Reads an experiment folder (or its experiment.yaml). Every fault goes to `diagnostics` with
/// file, line and column; nothing comes back where there is one.
std::optional<Experiment> read_experiment(const std::filesystem::path& path,
                                          Diagnostics& diagnostics);

/// Writes it as a folder that read_experiment() reads back, the plant file and all tables included,
/// each trial in a folder of its name. Throws io::WriteError.
void write_experiment(const std::filesystem::path& folder, const Experiment& experiment);

}  // namespace pedicel::discrepancy
