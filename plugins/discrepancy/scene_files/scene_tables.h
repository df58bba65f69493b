#pragma once

#include "engine/io/csv.h"
#include "plugins/discrepancy/scene/scene_experiment.h"

/// The tables of a scene experiment's trials. Faults go to the diagnostics with line and column;
/// what comes back then is empty. They may be written as io::TableText takes it.
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

/// time,fx,fy,fz,tx,ty,tz: some of them or all.
Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics);

/// time,event,what[,by]; `places` receives where each row stands.
std::vector<SceneEvent> read_scene_events(const std::filesystem::path& file,
                                          std::vector<SourcePosition>& places,
                                          Diagnostics& diagnostics);

std::string table_text(const std::vector<std::string>& names, const Samples& samples);
/// All tables of a trial that have rows, and its events, into its folder. Throws io::WriteError.
void write_scene_tables(const std::filesystem::path& folder, const SceneExperiment& experiment,
                        const SceneTrial& trial);

std::string scene_events_text(const std::vector<SceneEvent>& events);

/// Names of the columns after `time`, in the order of Samples.
std::vector<std::string> marker_columns(const std::vector<SceneMarker>& markers);
std::vector<std::string> pixel_columns(const std::vector<SceneMarker>& markers);
std::vector<std::string> wrench_columns();

}  // namespace pedicel::discrepancy
