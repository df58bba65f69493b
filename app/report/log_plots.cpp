#include "app/report/log_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

namespace pedicel::app {

namespace {

constexpr std::size_t most_curves = 5;
constexpr const char* limit_colour = "#57606a";
constexpr const char* tool_colour = "#1f2328";
// A link's normal force and friction share one.
constexpr std::array<const char*, most_curves> link_colours = {"#1b6ca8", "#d1495b", "#2e8b57",
                                                               "#8a5fbf", "#c77d0a"};

std::vector<double> values_of(const io::CsvTable& log, int column) {
  std::vector<double> values;
  for (const auto& row : log.rows) values.push_back(row[static_cast<std::size_t>(column)]);
  return values;
}

double largest(const io::CsvTable& log, int column) {
  double most = 0.0;
  for (const double value : values_of(log, column))
    if (std::isfinite(value)) most = std::max(most, value);
  return most;
}

/// What stands before `suffix` in a column's name; empty where it does not end so.
std::string stem_of(const std::string& column, std::string_view suffix) {
  return column.ends_with(suffix) ? column.substr(0, column.size() - suffix.size()) : "";
}

/// The names N for which there are columns N + suffix, those with the largest values first, without
/// those that are never above zero, at most most_curves. Names of organs and fruits have a '/'.
std::vector<std::string> ranked(const io::CsvTable& log, std::string_view suffix,
                                bool with_organs = true) {
  std::vector<std::pair<double, std::string>> found;
  for (std::size_t c = 0; c < log.columns.size(); ++c) {
    const std::string name = stem_of(log.columns[c], suffix);
    if (!with_organs && name.find('/') != std::string::npos) continue;
    const double most = name.empty() ? 0.0 : largest(log, static_cast<int>(c));
    if (most > 0.0) found.emplace_back(most, name);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  if (found.size() > most_curves) found.resize(most_curves);
  std::vector<std::string> names;
  for (const auto& [most, name] : found) names.push_back(name);
  return names;
}

class Plots {
 public:
  Plots(const io::CsvTable& log, const std::vector<plots::PlotEvent>& events)
      : log_(log), events_(events), time_(values_of(log, 0)) {}

  /// Begins a plot. One that gets no curve is dropped by finish().
  void begin(const std::string& title, const std::string& y_label) {
    plots_.push_back({title, {"time (s)"}, {y_label}, {}, events_});
  }
  void curve(const std::string& column, const std::string& label, const std::string& colour = "",
             bool dashed = false) {
    const int c = log_.column(column);
    if (c < 0) return;
    plots_.back().series.push_back({label, time_, values_of(log_, c), true, false, dashed, colour});
  }
  /// A horizontal line, where the plot has curves.
  void limit(double value, const std::string& label) {
    if (plots_.back().series.empty() || !std::isfinite(value)) return;
    plots_.back().series.push_back(
        {label, {time_.front(), time_.back()}, {value, value}, true, false, true, limit_colour});
  }
  std::vector<plots::LinePlot> finish() {
    std::erase_if(plots_, [](const plots::LinePlot& plot) { return plot.series.empty(); });
    return std::move(plots_);
  }

 private:
  const io::CsvTable& log_;
  const std::vector<plots::PlotEvent>& events_;
  std::vector<double> time_;
  std::vector<plots::LinePlot> plots_;
};

void add_strain(Plots& plots, const std::vector<std::string>& fruits,
                const std::vector<StalkLimits>& limits, const std::string& title,
                const std::string& y_label, const std::string& suffix, const std::string& limit,
                double StalkLimits::*value) {
  plots.begin(title, y_label);
  std::set<double> drawn;
  for (const std::string& fruit : fruits) plots.curve(fruit + suffix, fruit);
  for (const StalkLimits& stalk : limits)
    if (std::find(fruits.begin(), fruits.end(), stalk.fruit) != fruits.end() &&
        drawn.insert(stalk.*value).second)
      plots.limit(stalk.*value, limit + " = " + io::format_number(stalk.*value, 4));
}

void add_contact(Plots& plots, const io::CsvTable& log) {
  plots.begin("Contact force on the plant", "force (N)");
  // Organs feel the same forces from the other side, so links and bodies say it all.
  const std::vector<std::string> columns = ranked(log, "_normal_N", false);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string name = columns[i].substr(std::string_view("contact_").size());
    plots.curve(columns[i] + "_normal_N", name + ", normal", link_colours[i]);
    plots.curve(columns[i] + "_tangential_N", name + ", friction", link_colours[i], true);
  }
}

}  // namespace

std::vector<plots::LinePlot> log_plots(const io::CsvTable& log,
                                       const std::vector<StalkLimits>& limits,
                                       const std::vector<plots::PlotEvent>& events) {
  if (log.rows.empty()) return {};
  Plots plots(log, events);
  const std::vector<std::string> fruits = ranked(log, "_margin_used_1");
  plots.begin("How near the fruits came to coming off",
              "largest strain or load over its limit (1)");
  for (const std::string& fruit : fruits) plots.curve(fruit + "_margin_used_1", fruit);
  plots.limit(1.0, "comes off");
  add_strain(plots, fruits, limits, "Stretch and shear of the stalks", "|C_s| (1)", "_stretch_1",
             "C_s^max", &StalkLimits::stretch);
  add_strain(plots, fruits, limits, "Bending of the stalks", "|C_b| (rad)", "_bend_rad", "C_b^max",
             &StalkLimits::bend);
  add_contact(plots, log);
  plots.begin("Heights", "z (m)");
  for (const std::string& fruit : fruits) plots.curve(fruit + "_z_m", fruit);
  plots.curve("tool_z_m", "tool", tool_colour, true);
  if (fruits.empty()) {
    plots.begin("Largest strain of any segment", "|C_s| (1)");
    plots.curve("stretch_max_1", "");
    plots.begin("Kinetic energy of the plants", "energy (J)");
    plots.curve("energy_kinetic_J", "");
  }
  return plots.finish();
}

plots::LinePlot sweep_plot(const std::string& label, const std::vector<double>& values,
                           const std::string& measured_label, const std::vector<double>& measured) {
  plots::LinePlot plot;
  plot.title = measured_label + " over " + label;
  plot.x.label = label;
  plot.y.label = measured_label;
  plot.series.push_back({"", values, measured, true, true});
  return plot;
}

}  // namespace pedicel::app
