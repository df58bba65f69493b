#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/diagnostics.h"
#include "discrepancy/experiment.h"

/// The tables of an experiment folder. Faults go to the diagnostics with line and column; what
/// comes back then is empty.
namespace pedicel::discrepancy {

/// time,x,y,z[,qx,qy,qz,qw]
Path read_path(const std::filesystem::path& file, Diagnostics& diagnostics);

/// time,<marker>.x,<marker>.y,<marker>.z,...: every marker once, in any order; empty cells where it
/// was not seen.
Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics);

/// time,fx,fy,fz; empty cells where it was not measured.
Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics);

/// time,event,what
std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics);

std::string path_text(const Path& path);
std::string markers_text(const Samples& samples, std::span<const Marker> markers);
std::string force_text(const Samples& samples);
std::string events_text(const std::vector<MeasuredEvent>& events);

}  // namespace pedicel::discrepancy
