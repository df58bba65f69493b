#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plots/svg_plot.h"
#include "engine/plots/svg_polar.h"

namespace pedicel::app {

struct ReportTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// What was expected of a run, and what it did: "detached_count is 1", "1".
struct ReportExpectation {
  std::string what, measured;
  bool met = false;
};

struct ReportImage {
  std::filesystem::path file;  ///< a PNG; its bytes go into the page
  std::string caption;
};

/// A run made ready to be read; plain data. What is empty is left out of the page.
struct RunSummary {
  std::string title, purpose;
  std::string see;    ///< what to look at
  std::string error;  ///< why the run ended early
  std::vector<ReportExpectation> expectations;
  std::string video;                   ///< relative to the page
  std::filesystem::path moving_scene;  ///< a GLB, played in the page; empty: none
  std::vector<ReportImage> pictures;
  ReportTable events;
  ReportTable gentleness;  ///< how each organ was handled
  std::vector<plots::LinePlot> plots;
  ReportTable sweep;
  std::optional<plots::LinePlot> sweep_plot;
  std::optional<plots::PolarPlot> sweep_polar;  ///< a sweep over directions
  std::vector<ReportImage> sweep_pictures;
  ReportTable solvers, solver_speeds;  ///< both solvers over a sweep, and at equal error
  std::string solver_note;
  std::vector<std::pair<std::string, std::string>> numbers;   ///< speed, hash, steps
  std::vector<std::pair<std::string, std::string>> settings;  ///< with their units
  std::vector<std::pair<std::string, std::string>> files;     ///< name, what it holds
  std::string machine;                                        ///< version, machine, renderer
};

/// Writes the page, one HTML file that needs nothing but the video beside it. A picture that cannot
/// be read is named in its place. Throws io::WriteError.
void write_run_report(const RunSummary& summary, const std::filesystem::path& path);

}  // namespace pedicel::app
