#include "plugins/discrepancy/pick/pick_report.h"

#include "engine/io/html_report.h"
#include "engine/plots/svg_plot.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Two levels and the time to settle between them fit in.
constexpr double around = 0.4;  // s shown before and after the fall

/// The force's size and its part along the pull, in a stretch of the record.
plots::LinePlot plot_of(const PickForce& course, const Pick& pick, const std::string& title,
                        std::optional<std::pair<double, double>> stretch) {
  plots::LinePlot plot;
  plot.title = title;
  plot.x.label = "time (s)";
  plot.y.label = "force (N)";
  plots::PlotSeries size{"size", {}, {}}, along{"along the pull", {}, {}};
  // Single samples show only near by. There they tell how few of them a break has.
  along.markers = stretch.has_value();
  for (int i = 0; i < course.size(); ++i) {
    if (stretch && (course.time(i) < stretch->first || course.time(i) > stretch->second)) continue;
    size.x.push_back(course.time(i));
    // Beside the part along the pull, the size shows where a hand turned: there it stays and the
    // part falls.
    size.y.push_back(course.force(i).norm());
    along.x.push_back(course.time(i));
    if (pick.fall) along.y.push_back(course.force(i).dot(pick.fall->pull));
  }
  plot.series.push_back(size);
  if (pick.fall) plot.series.push_back(along);
  // Marked in the plot, so that a person can see whether it is where the load goes.
  if (const auto time = pick.time())
    plot.events.push_back({*time, pick.end == Pick::End::came_off ? "came off" : "slips"});
  return plot;
}

}  // namespace

void write_pick_report(const std::filesystem::path& file, const std::vector<JudgedPick>& all,
                       const PickSettings& settings) {
  io::HtmlReport report("Picks", text("%.0f records", static_cast<double>(all.size())));
  // A table of all records first: in a season's picks one looks for the odd ones, and only then at
  // their plots.
  std::vector<std::vector<std::string>> rows;
  for (const JudgedPick& judged : all) {
    const Pick& pick = judged.pick;
    rows.push_back({judged.record.file, pick.outcome(),
                    pick.probability ? text("%.3f", *pick.probability) : "",
                    pick.time() ? text("%.3f", *pick.time()) : "", text("%.4g", pick.peak_force),
                    pick.fall && pick.fall->half ? text("%.3g", 1e3 * *pick.fall->half) : ""});
  }
  report.table({"record", "outcome", "probability that it came off", "time, s", "peak force, N",
                "half of the load lost in, ms"},
               rows);
  for (const JudgedPick& judged : all) {
    const Pick& pick = judged.pick;
    report.heading(judged.record.file);
    // Marked as good where the fruit came off, which is what a picker is for.
    report.note(pick.sentence(), pick.end == Pick::End::came_off);
    // Made again as it was judged, without zero and spikes: a plot of the raw record would not show
    // what the answer is about.
    const PickForce course(judged.record, settings.rest);
    // What is unclear for want of samples has its sentence, and nothing that could be drawn.
    if (course.size() < 2) continue;
    std::vector<std::string> plots = {plots::to_svg(plot_of(course, pick, "the record", {}))};
    if (pick.fall)
      plots.push_back(
          plots::to_svg(plot_of(course, pick, "its largest fall",
                                std::pair(pick.fall->time - around, pick.fall->time + around))));
    report.plots(plots);
  }
  report.write(file);
}

}  // namespace pedicel::discrepancy
