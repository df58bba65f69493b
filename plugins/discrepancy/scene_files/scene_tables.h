#pragma once

#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/scene/scene_experiment.h"

/// The tables of a scene experiment's trials, beside those of any experiment. Faults go to the
/// diagnostics with line and column; what comes back then is empty.
namespace pedicel::discrepancy {

/// time,<joint>,...: some joints of the robot or all, in any order; `columns` receives the degree
/// of freedom of each.
Samples read_joint_table(const std::filesystem::path& file, const robot::RobotDescription& robot,
                         io::Quantity quantity, std::vector<int>& columns,
                         Diagnostics& diagnostics);

/// time,<marker>.x,<marker>.y,<marker>.z,...: some axes of some markers or all; what is absent was
/// not measured.
Samples read_scene_markers(const std::filesystem::path& file,
                           const std::vector<SceneMarker>& markers, Diagnostics& diagnostics);

/// time,<marker>.u,<marker>.v,...: the same of image points.
Samples read_pixels(const std::filesystem::path& file, const std::vector<SceneMarker>& markers,
                    Diagnostics& diagnostics);

/// All tables of a trial that have rows, and its events, into its folder. Throws io::WriteError.
void write_scene_tables(const std::filesystem::path& folder, const SceneExperiment& experiment,
                        const SceneTrial& trial);

std::vector<std::string> pixel_columns(const std::vector<SceneMarker>& markers);

}  // namespace pedicel::discrepancy
