#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "pedicel/core/diagnostics.h"
#include "pedicel/discrepancy/data/experiment.h"

/// The tables of an experiment folder. Faults go to the diagnostics with line and column; what
/// comes back then is empty. The ways of writing a table are those of io::TableText; names of
/// columns take any capitals and a unit ("m1.x (mm)", a row of units), and what comes back is in SI
/// units.
namespace pedicel::discrepancy {

/// time,x,y,z[,qx,qy,qz,qw]
DrivenPath read_path(const std::filesystem::path& file, Diagnostics& diagnostics);

/// time,<marker>.x,<marker>.y,<marker>.z,...: every marker once, in any order; empty cells where it
/// was not seen.
Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics);

/// time,fx,fy,fz; empty cells where it was not measured.
Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics);

/// time,event,what (and by, which is not used), without a look at the plant; where each `what`
/// stands.
std::vector<MeasuredEvent> read_event_rows(const std::filesystem::path& file,
                                           std::vector<SourcePosition>& what_is_at,
                                           Diagnostics& diagnostics);

/// The same; what detached is a fruit of the plant.
std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics);

std::string path_text(const DrivenPath& path);
std::string markers_text(const Samples& samples, std::span<const Marker> markers);
std::string force_text(const Samples& samples);
std::string events_text(const std::vector<MeasuredEvent>& events);

}  // namespace pedicel::discrepancy
