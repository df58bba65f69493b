#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/data/sample_table.h"

/// The tables of an experiment folder. Faults go to the diagnostics with line and column; what
/// comes back then is empty. The ways of writing a table are those of io::TableText; names of
/// columns take any capitals and a unit ("m1.x (mm)", a row of units), and what comes back is in SI
/// units.
namespace pedicel::discrepancy {

/// time,x,y,z[,qx,qy,qz,qw]
DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics,
                     Rows rows = Rows::time);

/// time,<marker>.x,<marker>.y,<marker>.z,...: every marker once, in any order; empty cells where it
/// was not seen. Of each marker one axis or two may be missing: they were not measured.
Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics, Rows rows = Rows::time);

/// time,fx,fy,fz, or one or two of the axes; empty cells where it was not measured.
Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics,
                   Rows rows = Rows::time);

/// time,fx,fy,fz,tx,ty,tz, or some of them: force and moment at the root.
Samples read_wrench(const std::filesystem::path& file, Diagnostics& diagnostics,
                    Rows rows = Rows::time);

/// time,event,what (and by, which is not used), without a look at the plant; where each `what`
/// stands.
std::vector<MeasuredEvent> read_event_rows(const std::filesystem::path& file,
                                           std::vector<SourcePosition>& what_is_at,
                                           Diagnostics& diagnostics);

/// The same; what detached is a fruit of the plant.
std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics);

/// What was measured nowhere of a point has no column; `rows` says whether there is a time.
std::string path_text(const DrivenPath& path, Rows rows = Rows::time);
std::string markers_text(const Samples& samples, std::span<const Marker> markers,
                         Rows rows = Rows::time);
std::string force_text(const Samples& samples, Rows rows = Rows::time);
std::string wrench_text(const Samples& samples, Rows rows = Rows::time);
std::string events_text(const std::vector<MeasuredEvent>& events);

}  // namespace pedicel::discrepancy
