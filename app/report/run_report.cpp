#include "app/report/run_report.h"

#include <algorithm>

#include "app/report/moving_scene.h"
#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/io/html_report.h"

namespace pedicel::app {

namespace {

using io::HtmlReport;

void add_result(HtmlReport& page, const RunSummary& summary) {
  if (!summary.error.empty()) page.note("The run ended early: " + summary.error, false);
  if (summary.expectations.empty()) return;
  const auto all = static_cast<long>(summary.expectations.size());
  const long met = std::count_if(summary.expectations.begin(), summary.expectations.end(),
                                 [](const ReportExpectation& e) { return e.met; });
  const std::string count = std::to_string(met) + " of " + std::to_string(all);
  page.note(count + " expectations met.", met == all);
  std::vector<std::vector<std::string>> rows;
  for (const ReportExpectation& e : summary.expectations)
    rows.push_back({e.met ? "✓ met" : "✗ not met", e.what, e.measured});
  page.table({"", "Expected", "Measured"}, rows);
}

/// Two side by side; what is left over at the end takes the whole width.
void add_pictures(HtmlReport& page, const std::vector<ReportImage>& images) {
  std::vector<io::ReportPicture> row;
  const auto flush = [&] {
    if (!row.empty()) page.pictures(row);
    row.clear();
  };
  for (const ReportImage& image : images) {
    try {
      const std::string bytes = io::read_file(image.file);
      row.push_back({{bytes.begin(), bytes.end()}, image.caption});
    } catch (const InvalidFile& error) {
      page.paragraph(image.caption + ": " + error.what());
    }
    if (row.size() == 2) flush();
  }
  flush();
}

void add_table(HtmlReport& page, const std::string& heading, const ReportTable& table) {
  if (table.rows.empty()) return;
  page.heading(heading);
  page.table(table.header, table.rows);
}

void add_pairs(HtmlReport& page, const std::string& heading,
               const std::vector<std::pair<std::string, std::string>>& pairs) {
  if (pairs.empty()) return;
  page.heading(heading);
  page.key_values(pairs);
}

void add_sweep(HtmlReport& page, const RunSummary& summary) {
  add_table(page, "Sweep", summary.sweep);
  if (summary.sweep_plot) page.plot(to_svg(*summary.sweep_plot));
  if (summary.sweep_polar) page.plot(to_svg(*summary.sweep_polar));
  add_pictures(page, summary.sweep_pictures);
}

void add_solvers(HtmlReport& page, const RunSummary& summary) {
  add_table(page, "The direct and the position-based solver", summary.solvers);
  add_table(page, "Their speed at equal error", summary.solver_speeds);
  if (!summary.solver_note.empty()) page.paragraph(summary.solver_note);
}

}  // namespace

void write_run_report(const RunSummary& summary, const std::filesystem::path& path) {
  HtmlReport page(summary.title, summary.purpose);
  add_result(page, summary);
  if (!summary.see.empty()) page.paragraph("What to see: " + summary.see);
  if (!summary.video.empty()) page.video(summary.video, "The whole run.");
  if (!summary.moving_scene.empty()) add_moving_scene(page, summary.moving_scene);
  add_pictures(page, summary.pictures);
  add_table(page, "What came off", summary.events);
  add_table(page, "How gently it was done", summary.gentleness);
  add_sweep(page, summary);
  add_solvers(page, summary);
  if (!summary.plots.empty()) page.heading("Over time");
  for (const plots::LinePlot& plot : summary.plots) page.plot(to_svg(plot));
  add_pairs(page, "Numbers", summary.numbers);
  add_pairs(page, "Settings", summary.settings);
  add_pairs(page, "Files", summary.files);
  if (!summary.machine.empty()) page.paragraph(summary.machine);
  page.write(path);
}

}  // namespace pedicel::app
