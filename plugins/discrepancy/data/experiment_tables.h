#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/table_spec.h"
#include "plugins/discrepancy/data/experiment.h"

/// The tables of an experiment folder. Faults go to the diagnostics with line and column; what
/// comes back then is empty. The ways of writing a table are those of io::TableText, the names of
/// columns those of io::TableSpec, and what comes back is in SI units.
namespace pedicel::discrepancy {

/// What the rows of a table are: samples at times, or states of rest one after the other, whose
/// "time" is the number of the row, from 0 on.
enum class Rows { time, rest };

/// Values row after row, as a matrix.
Eigen::MatrixXd matrix_of_rows(const std::vector<double>& values, std::size_t columns);

/// A table of samples. A column that is not there is NaN throughout, but where `present` receives
/// those that are.
Samples read_samples(const std::filesystem::path& file, const io::TableSpec& spec,
                     Diagnostics& diagnostics, std::vector<int>* present = nullptr);

/// time,x,y,z[,qx,qy,qz,qw]
DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics,
                     Rows rows = Rows::time);

/// time,<marker>.x,<marker>.y,<marker>.z,...: every marker once, in any order; empty cells where it
/// was not seen. Of each marker one axis or two may be missing: they were not measured.
Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics, Rows rows = Rows::time);

/// time,<marker>.x,<marker>.y,<marker>.z,...: some axes of some markers or all; what is absent was
/// not measured.
Samples read_some_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                          Diagnostics& diagnostics);

/// time,<marker>.u,<marker>.v,...: the same of image points.
Samples read_pixels(const std::filesystem::path& file, std::span<const Marker> markers,
                    Diagnostics& diagnostics);

/// time,<joint>,...: some joints of the robot or all, in any order; `columns` receives the degree
/// of freedom of each.
Samples read_joint_table(const std::filesystem::path& file, const robot::RobotDescription& robot,
                         io::Quantity quantity, std::vector<int>& columns,
                         Diagnostics& diagnostics);

/// time,fx,fy,fz, or one or two of the axes; empty cells where it was not measured.
Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics,
                   Rows rows = Rows::time);

/// time,fx,fy,fz,tx,ty,tz, or some of them: force and moment at the root.
Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics,
                    Rows rows = Rows::time);

std::vector<std::string> wrench_columns();
io::TableSpec wrench_spec();

/// Columns of a table of events behind its time.
enum EventColumn { event_column, what_column, by_column };

/// time,event,what[,by]. `check` may look at each, and say what is wrong with its cells.
std::vector<MeasuredEvent> read_events(
    const std::filesystem::path& file, Diagnostics& diagnostics,
    const std::function<void(const MeasuredEvent&, io::SpecTable&)>& check = {});

/// "m1.x", "m1.y", "m1.z", ...
std::vector<std::string> marker_columns(std::span<const Marker> markers,
                                        const std::vector<const char*>& axes = {".x", ".y", ".z"});
/// "m1.u", "m1.v", ...
std::vector<std::string> pixel_columns(std::span<const Marker> markers);

/// `rows` says whether there is a time.
std::string table_text(const std::vector<std::string>& names, const Samples& samples,
                       Rows rows = Rows::time);
/// The same; an axis of a point that was measured nowhere has no column.
std::string points_text(const std::vector<std::string>& names, const Samples& samples,
                        Rows rows = Rows::time);
std::string path_text(const DrivenPath& path, Rows rows = Rows::time);
/// With `by` where it is known of one.
std::string events_text(const std::vector<MeasuredEvent>& events);

}  // namespace pedicel::discrepancy
