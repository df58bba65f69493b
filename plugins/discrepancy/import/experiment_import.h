#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/import/force_record.h"
#include "plugins/discrepancy/import/recording.h"
#include "plugins/discrepancy/import/world_tracks.h"

namespace pedicel::discrepancy {

/// A point of the recordings, and where it sits on the plant.
struct PlacedPoint {
  std::string point;  ///< its name in the recordings
  std::string name;   ///< its name in the experiment
  plant::CurvePlace place;
};

/// What leads a point of the plant: a point of the recordings, or the machine of the force table.
struct ImportedHold {
  std::string point;  ///< empty: the force table's extension, along its direction
  plant::CurvePlace place;
  std::optional<double> stiffness;  ///< N/m; absent: rigid
};

/// One recording, and what belongs to it alone.
struct ImportedTrial {
  std::string name;
  Recording recording;
  std::optional<ForceRecord> force;
  std::optional<double> begin;        ///< s on the recording's clock; absent: its first sample
  std::optional<double> force_begin;  ///< s on the force table's clock
  std::optional<double> release;      ///< s of the trial
};

/// All that an experiment is made of.
struct ImportRequest {
  std::string title;
  std::filesystem::path plant_path;
  plant::PlantFile plant;
  Statements statements;
  std::optional<Vec3> extension_direction;  ///< W, unit
  std::vector<PlacedPoint> places;
  std::vector<ImportedHold> holds;
  std::vector<ImportedTrial> trials;
};

/// Brings recordings and forces together. What nobody states, and what contradicts itself, is put
/// on notes.missing; what comes back then is of no use.
Experiment import_experiment(const ImportRequest& request, ImportNotes& notes);

}  // namespace pedicel::discrepancy
