#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "app/panels/panel.h"
#include "app/session/measured/measured_instant.h"
#include "app/session/session_measured.h"
#include "app/ui/free_file_name.h"
#include "app/ui/plot.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"
#include "app/view/measured_marks.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"

namespace pedicel::app {

namespace {

/// Quantities of the run over time, to be picked from a list, and the loads of the organ that was
/// clicked.
class PlotsPanel : public Panel {
 public:
  std::string_view name() const override { return "Plots"; }
  Dock dock() const override { return Dock::bottom; }

  void draw(Ui& ui) override {
    const std::vector<std::string> names = ui.session.control().log().names();
    if (stage_ != ui.snapshot->stage) {
      stage_ = ui.snapshot->stage;
      std::erase_if(picked_, [&](const std::string& one) {
        return !one.starts_with(organ_prefix) && !one.starts_with(trial_prefix) &&
               std::ranges::count(names, one) == 0;
      });
      if (picked_.empty()) pick_something(names);
    }
    follow_experiment(ui);
    const float list_width =
        std::min(15.0f * ImGui::GetFontSize(), 0.36f * ImGui::GetContentRegionAvail().x);
    if (ImGui::BeginChild("list", ImVec2(list_width, 0))) choose(ui, names);
    ImGui::EndChild();
    ImGui::SameLine();
    const std::vector<PlotLine> lines = make_lines(ui);
    draw_plots(ui, lines);
  }

 private:
  static constexpr const char* organ_prefix = "clicked organ: ";
  static constexpr const char* trial_prefix = "trial: ";
  static constexpr std::array<const char*, 4> forces = {"force_x_N", "force_y_N", "force_z_N",
                                                        "force_N"};

  /// "N" of "force_x_N", "force_x_N of the nominal model": what may share an axis.
  static std::string unit_of(const std::string& name) {
    for (const char* unit : {"_N", "_Nm", "_1", "_m", "_rad", "_J", "_s", "_deg", "_mm"}) {
      const std::size_t at = name.rfind(unit);
      if (at != std::string::npos && at + std::string(unit).size() == name.size()) return unit + 1;
    }
    return "";
  }

  /// One beside the other, one a unit: newtons and strains have no axis in common.
  void draw_plots(const Ui& ui, const std::vector<PlotLine>& lines) {
    std::map<std::string, std::vector<PlotLine>> by_unit;
    for (const PlotLine& line : lines) by_unit[unit_of(line.name)].push_back(line);
    if (by_unit.empty()) by_unit[""] = {};
    ImVec2 size = ImGui::GetContentRegionAvail();
    const float gap = 6.0f * ui.scale, count = static_cast<float>(by_unit.size());
    size.x = std::max(10.0f, (size.x - gap * (count - 1.0f)) / count);
    bool first = true;
    for (const auto& [unit, group] : by_unit) {
      if (!first) ImGui::SameLine(0, gap);
      first = false;
      draw_plot(("plot" + unit).c_str(), group, views_[unit], size, "s");
      name_lines(group, views_[unit]);
    }
  }

  /// The measured force is shown at once, where there is one.
  void follow_experiment(const Ui& ui) {
    if (experiment_ == ui.session.measured().data().number()) return;
    experiment_ = ui.session.measured().data().number();
    std::erase_if(picked_, [](const std::string& one) { return one.starts_with(trial_prefix); });
    if (has_force(ui)) picked_ = {std::string(trial_prefix) + "force_N"};
    views_.clear();
  }

  static bool has_force(const Ui& ui) {
    const discrepancy::Experiment* experiment = ui.session.measured().data().experiment();
    const auto trial = static_cast<std::size_t>(ui.view.measured.trial);
    return experiment && trial < experiment->trials.size() &&
           !experiment->trials[trial].force.time.empty();
  }

  void pick_something(const std::vector<std::string>& names) {
    for (const char* wanted : {"margin", "strain", "force"})
      for (const std::string& one : names)
        if (picked_.empty() && one.find(wanted) != std::string::npos) picked_.push_back(one);
    if (picked_.empty() && !names.empty()) picked_.push_back(names.front());
  }

  void choose(Ui& ui, const std::vector<std::string>& names) {
    const float button = ImGui::CalcTextSize("CSV").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(rest_width(button + ImGui::GetStyle().ItemSpacing.x));
    ImGui::InputTextWithHint("##search", "search", search_, sizeof search_);
    ImGui::SameLine();
    if (ImGui::Button("CSV")) export_csv(ui);
    tip("Writes the lines that are shown to a table beside the scene: NAME_plot_001.csv, ...");
    if (ImGui::BeginChild("names", ImVec2(0, 0), true)) {
      if (has_force(ui))
        for (const char* part : forces) toggle(std::string(trial_prefix) + part);
      for (const char* part : {"strain_1", "force_N", "moment_Nm"})
        toggle(std::string(organ_prefix) + part);
      for (const std::string& one : names) toggle(one);
    }
    ImGui::EndChild();
  }

  void toggle(const std::string& one) {
    if (*search_ && one.find(search_) == std::string::npos) return;
    const auto at = std::ranges::find(picked_, one);
    const bool on = at != picked_.end(), measured = one.starts_with(trial_prefix);
    const ImU32 own =
        measured ? ink(measured_colour) : line_colour(static_cast<int>(at - picked_.begin()));
    ImGui::PushStyleColor(ImGuiCol_Text, on ? own : ImGui::GetColorU32(ImGuiCol_Text));
    const std::string shown = elide(one, rest_width());
    ImGui::PushID(one.c_str());
    if (ImGui::Selectable(shown.c_str(), on)) {
      if (on)
        picked_.erase(at);
      else
        picked_.push_back(one);
      views_.clear();
    }
    ImGui::PopID();
    ImGui::PopStyleColor();
    if (shown != one) tip(one);
  }

  std::vector<PlotLine> make_lines(const Ui& ui) const {
    std::vector<PlotLine> lines;
    const RunLog& log = ui.session.control().log();
    for (std::size_t p = 0; p < picked_.size(); ++p) {
      const std::string& one = picked_[p];
      if (one.starts_with(trial_prefix)) {
        add_force(ui, one, lines);
        continue;
      }
      PlotLine line{one, line_colour(static_cast<int>(p)), {}, {}};
      if (one.starts_with(organ_prefix)) {
        const char kind = one[std::string(organ_prefix).size()];
        for (const OrganLoad& load : log.loads()) {
          line.x.push_back(load.time);
          line.y.push_back(kind == 's' ? load.strain : kind == 'f' ? load.force : load.moment);
        }
      } else {
        RunLog::Series series = log.series(one);
        line.x = std::move(series.time), line.y = std::move(series.value);
      }
      lines.push_back(std::move(line));
    }
    return lines;
  }

  /// The measured force of the trial that the Data panel shows, over the trial's time, and what
  /// each model says of it.
  static void add_force(const Ui& ui, const std::string& name, std::vector<PlotLine>& lines) {
    const std::string part = name.substr(std::string(trial_prefix).size());
    const auto axis = std::ranges::find(forces, part) - forces.begin();
    const auto series = force_series_of(ui.session.measured().data(), ui.view.measured.trial,
                                        static_cast<int>(axis));
    if (!series) return;
    lines.push_back({"measured " + part, ink(measured_colour), series->time, series->measured});
    for (int m = 0; m < discrepancy::model_count; ++m) {
      const auto& values = series->models[static_cast<std::size_t>(m)];
      if (values.empty()) continue;
      lines.push_back({std::string(model_name(static_cast<discrepancy::Model>(m))) + " " + part,
                       ink(model_colour(m)), series->time, values});
    }
  }

  /// One row a time of the first line; the others have a value there where they were sampled, too.
  void export_csv(Ui& ui) const {
    const std::vector<PlotLine> lines = make_lines(ui);
    if (lines.empty()) return ui.say("no line is shown: choose one first");
    std::string text = "time_s";
    for (const PlotLine& line : lines) text += "," + io::csv_cell(line.name);
    text += "\n";
    for (std::size_t i = 0; i < lines.front().x.size(); ++i) {
      const double time = lines.front().x[i];
      text += io::format_number(time);
      for (const PlotLine& line : lines) {
        const auto at = std::ranges::lower_bound(line.x, time);
        const bool there = at != line.x.end() && *at == time;
        text +=
            "," + (there ? io::format_number(line.y[static_cast<std::size_t>(at - line.x.begin())])
                         : std::string("nan"));
      }
      text += "\n";
    }
    try {
      const std::filesystem::path file =
          free_file_name(ui.output_stem().string() + "_plot", ".csv");
      io::write_file_atomically(file, text);
      ui.say("written: " + std::filesystem::absolute(file).string());
    } catch (const std::exception& error) {
      ui.say(error.what());
    }
  }

  std::vector<std::string> picked_;
  std::map<std::string, PlotView> views_;  // a unit each
  char search_[64] = "";
  std::uint64_t stage_ = ~0ull;
  int experiment_ = -1;
};

}  // namespace

std::unique_ptr<Panel> make_plots_panel() {
  return std::make_unique<PlotsPanel>();
}

}  // namespace pedicel::app
