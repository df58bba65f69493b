#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "app/editors/diagnosis_part.h"
#include "app/panels/panel.h"
#include "app/panels/scene_data.h"
#include "app/session/measured/experiment_reading.h"
#include "app/session/measured/measured_instant.h"
#include "app/session/measured/measured_scene.h"
#include "app/session/session_measured.h"
#include "app/ui/plot.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"
#include "app/view/measured_marks.h"

namespace pedicel::app {

namespace {

using discrepancy::Model;

void begin_ink(const render::Colour& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, ink(colour));
}

/// What both kinds of experiment have; without trials: none is open.
struct OpenExperiment {
  std::string title;
  std::vector<std::string> trials;
  double end = 0.0;       // s, of the trial that is shown
  int simulated = 0;      // trials of models that are still to come
  bool stands = true;     // the document has what was measured
  bool of_scene = false;  // a robot at plants
};

OpenExperiment open_experiment(const Ui& ui) {
  OpenExperiment open;
  const SessionMeasured& measured = ui.session.measured();
  const auto trial = static_cast<std::size_t>(std::max(0, ui.view.measured.trial));
  if (const discrepancy::Experiment* scene = measured.scene().experiment()) {
    open.title = scene->title;
    for (const auto& one : scene->trials) open.trials.push_back(one.name);
    if (trial < scene->trials.size()) open.end = scene->trials[trial].duration();
    open.simulated = measured.scene().still_simulated();
    open.stands = measured.has_scene();
    open.of_scene = true;
  } else if (const discrepancy::Experiment* plant = measured.data().experiment()) {
    open.title = plant->title;
    for (const auto& one : plant->trials) open.trials.push_back(one.name);
    if (trial < plant->trials.size() && !plant->trials[trial].markers.time.empty())
      open.end = plant->trials[trial].markers.time.back();
    open.simulated = measured.data().still_simulated();
    open.stands = measured.plant() >= 0;
  }
  return open;
}

/// Measured data of the plant: through time, against the models, and what a diagnosis makes of it.
class DataPanel : public Panel {
 public:
  std::string_view name() const override { return "Data"; }
  Dock dock() const override { return Dock::right; }

  void draw(Ui& ui) override {
    follow(ui);
    open_row(ui);
    if (reading(ui)) return;
    OpenExperiment open = open_experiment(ui);
    if (open.trials.empty()) {
      note(
          "Measured data over the plant, or over a robot at plants: open an experiment, the folder "
          "with experiment.yaml.");
      return;
    }
    title(ui, open);
    open = open_experiment(ui);
    if (open.trials.empty()) return;  // closed
    diagnosis_.draw(ui);
    trial_and_time(ui, open);
    if (open.of_scene) {
      scene_.draw(ui);
    } else {
      const discrepancy::Experiment& experiment = *ui.session.measured().data().experiment();
      models(ui);
      markers(ui, experiment);
      plot(ui, experiment);
      shown(ui);
    }
    diagnosis_.draw_result(ui);
  }

  void idle(Ui& ui) override { follow(ui); }

 private:
  /// Another experiment: its first trial from the beginning. Time goes on while it plays.
  void follow(Ui& ui) {
    MeasuredView& view = ui.view.measured;
    const MeasuredData& data = ui.session.measured().data();
    const MeasuredScene& scene = ui.session.measured().scene();
    if (view.number != data.number() || view.scene != scene.number()) {
      const MeasuredView fresh;
      view.number = data.number(), view.scene = scene.number();
      view.trial = view.marker = view.model = view.instrument = view.column = fresh.model;
      view.camera = fresh.camera;
      view.time = 0.0, view.playing = false;
      const std::filesystem::path folder = ui.session.measured().folder();
      if (!folder.empty()) ui.ask(Action::frame_all);
      if (!folder.empty()) path_ = opened_ = folder.string();
      plot_ = {};
    }
    if (found_ != ui.session.measured().diagnoses()) {
      found_ = ui.session.measured().diagnoses();
      extends_ = true;
    }
    // The extended model of a scene is simulated after its diagnosis.
    if (extends_ && (data.has(discrepancy::extended) || scene.has(discrepancy::extended))) {
      view.model = discrepancy::extended;
      extends_ = false;
    }
    const double passed = std::clamp(ui.now - last_, 0.0, 0.1);
    last_ = ui.now;
    if (!view.playing) return;
    view.time += passed;
    const double end = open_experiment(ui).end;
    if (view.time > end) view.time = end > 0.0 ? std::fmod(view.time, end) : 0.0;
  }

  void open_row(Ui& ui) {
    const float button = ImGui::CalcTextSize("Open").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(rest_width(button + ImGui::GetStyle().ItemSpacing.x));
    bool asked = text_field("##path", path_, "experiment folder");
    ImGui::SameLine();
    asked |= ImGui::Button("Open");
    if (asked && !path_.empty() && (path_ != opened_ || ui.session.measured().folder().empty())) {
      const Result result = ui.session.run(Command("open experiment", {{"folder", path_}}));
      opened_ = result.ok ? path_ : "";
    }
    const std::string& fault = ui.session.measured().reading_fault();
    if (fault.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, palette().error);
    ImGui::TextWrapped("%s", fault.c_str());
    ImGui::PopStyleColor();
  }

  /// How far the one is that is being read; false: none is.
  static bool reading(Ui& ui) {
    const ExperimentReading* reading = ui.session.measured().reading();
    if (!reading) return false;
    note("reading " + reading->path().filename().string());
    const int all = reading->trials(), done = std::min(reading->trials_read() + 1, all);
    const std::string text =
        all ? "trial " + std::to_string(done) + " of " + std::to_string(all) : std::string("plant");
    ImGui::ProgressBar(
        all ? static_cast<float>(reading->trials_read()) / static_cast<float>(all) : 0.0f,
        ImVec2(-1, 0), text.c_str());
    if (wide_button("Cancel")) ui.run(Command("cancel reading", {}));
    return true;
  }

  void title(Ui& ui, const OpenExperiment& open) {
    heading(ui, "Trial");
    if (!open.title.empty()) note(open.title);
    if (open.simulated > 0) note("simulating: " + std::to_string(open.simulated) + " trials to go");
    if (!open.stands)
      note(open.of_scene ? "The document's plants are not as they were measured (any more)."
                         : "The document's plant is not as it was measured (any more).");
    if (wide_button("Close experiment")) ui.run(Command("close experiment", {}));
    tip("Leaves the measured data; what stands in the scene stays");
  }

  void trial_and_time(Ui& ui, const OpenExperiment& open) {
    MeasuredView& view = ui.view.measured;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##trial", open.trials[static_cast<std::size_t>(view.trial)].c_str())) {
      for (int t = 0; t < static_cast<int>(open.trials.size()); ++t) {
        ImGui::PushID(t);
        if (ImGui::Selectable(open.trials[static_cast<std::size_t>(t)].c_str(), t == view.trial)) {
          view.trial = t;
          view.time = std::min(view.time, open_experiment(ui).end);
          plot_.follows = true;
          scene_.follow();
        }
        ImGui::PopID();
      }
      ImGui::EndCombo();
    }
    if (icon_button("play data", view.playing ? Icon::pause : Icon::play,
                    view.playing ? "Stop here" : "Play the trial as it was measured"))
      view.playing = !view.playing;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    float time = static_cast<float>(view.time);
    if (ImGui::SliderFloat("##time", &time, 0.0f, static_cast<float>(open.end), "%.3f s"))
      view.time = time, view.playing = false;
  }

  void models(Ui& ui) {
    MeasuredView& view = ui.view.measured;
    const MeasuredData& data = ui.session.measured().data();
    heading(ui, "Model");
    for (int m = 0; m < discrepancy::model_count; ++m) {
      if (m > 0 && !data.has(static_cast<Model>(m))) continue;
      begin_ink(model_colour(m));
      ImGui::RadioButton(model_name(static_cast<Model>(m)), &view.model, m);
      ImGui::PopStyleColor();
      const TrialPath* path = data.path(static_cast<Model>(m), view.trial);
      if (!path) continue;
      ImGui::SameLine();
      const std::string rms =
          path->healthy ? number_text(1e3 * path->rms, 3) + " mm rms" : std::string("failed");
      ImGui::SetCursorPosX(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(rms.c_str()).x);
      ImGui::TextUnformatted(rms.c_str());
    }
    if (!data.has(discrepancy::extended))
      note("Refitted and extended models come with a diagnosis.");
    else
      ImGui::Checkbox("Side by side", &view.side_by_side);
  }

  void markers(Ui& ui, const discrepancy::Experiment& experiment) {
    MeasuredView& view = ui.view.measured;
    const MeasuredData& data = ui.session.measured().data();
    const auto now = instant_of(data, view.trial, static_cast<Model>(view.model), view.time);
    heading(ui, "Error of markers, mm");
    if (!now) return note("No markers were measured in this trial.");
    const int rows = std::min<int>(static_cast<int>(experiment.markers.size()), 8) + 1;
    std::vector<int> columns;
    for (int m = 0; m < discrepancy::model_count; ++m)
      if (data.path(static_cast<Model>(m), view.trial)) columns.push_back(m);
    if (!ImGui::BeginTable(
            "markers", 2 + static_cast<int>(columns.size()),
            ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchSame,
            ImVec2(0, (static_cast<float>(rows) + 0.4f) *
                          (ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y))))
      return;
    // The models' columns get what the names and the numbers leave.
    float names = ImGui::CalcTextSize("m10").x;
    for (const discrepancy::Marker& marker : experiment.markers)
      names = std::max(names, ImGui::CalcTextSize(marker.name.c_str()).x);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed,
                            std::min(names, 5.0f * ImGui::GetFontSize()));
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, ImGui::CalcTextSize("0.000").x);
    for (std::size_t m = 0; m < columns.size(); ++m) ImGui::TableSetupColumn("");
    ImGui::TableSetupScrollFreeze(0, 1);
    header(columns);
    for (int i = 0; i < static_cast<int>(now->markers.size()); ++i)
      marker_row(ui, experiment, *now, columns, i);
    ImGui::EndTable();
  }

  static void header(const std::vector<int>& columns) {
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    ImGui::TableNextColumn();
    ImGui::TableNextColumn();
    elided("now", rest_width());
    for (const int m : columns) {
      ImGui::TableNextColumn();
      begin_ink(model_colour(m));
      elided(model_name(static_cast<Model>(m)), rest_width());
      ImGui::PopStyleColor();
    }
  }

  void marker_row(Ui& ui, const discrepancy::Experiment& experiment, const MeasuredInstant& now,
                  const std::vector<int>& columns, int marker) {
    MeasuredView& view = ui.view.measured;
    const auto i = static_cast<std::size_t>(marker);
    const auto cell = [](double metres) {
      elided(std::isfinite(metres) ? number_text(1e3 * metres, 3) : "-", rest_width());
    };
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(marker);
    if (ImGui::Selectable(elide(experiment.markers[i].name, rest_width()).c_str(),
                          view.marker == marker, ImGuiSelectableFlags_SpanAllColumns)) {
      view.marker = marker;
      plot_.follows = true;
    }
    ImGui::PopID();
    ImGui::TableNextColumn();
    cell(now.markers[i].error().norm());
    for (const int m : columns) {
      ImGui::TableNextColumn();
      cell(ui.session.measured().data().path(static_cast<Model>(m), view.trial)->marker_rms[i]);
    }
  }

  void plot(Ui& ui, const discrepancy::Experiment& experiment) {
    const MeasuredView& view = ui.view.measured;
    if (experiment.markers.empty()) return;
    constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
    heading(ui, ("Marker " + experiment.markers[static_cast<std::size_t>(view.marker)].name + ", m")
                    .c_str());
    for (int a = 0; a < 3; ++a) {
      if (a > 0) ImGui::SameLine();
      if (ImGui::RadioButton(axes[static_cast<std::size_t>(a)], &axis_, a)) plot_.follows = true;
    }
    const MeasuredSeries series =
        series_of(ui.session.measured().data(), view.trial, view.marker, axis_);
    std::vector<PlotLine> lines{{"measured", ink(measured_colour), series.time, series.measured}};
    for (int m = 0; m < discrepancy::model_count; ++m) {
      const auto& values = series.models[static_cast<std::size_t>(m)];
      if (values.empty()) continue;
      lines.push_back(
          {model_name(static_cast<Model>(m)), ink(model_colour(m)), series.time, values});
    }
    draw_plot("coordinate", lines, plot_, ImVec2(rest_width(), 150.0f * ui.scale), "s");
  }

  static void shown(Ui& ui) {
    MeasuredView& view = ui.view.measured;
    heading(ui, "Shown");
    ImGui::Checkbox("Markers", &view.markers);
    ImGui::Checkbox("The plant as the model has it", &view.shape);
    bool residual = ui.view.colours == ColourMap::residual;
    if (ImGui::Checkbox("Residual as colours", &residual))
      ui.view.colours = residual ? ColourMap::residual : ColourMap::none;
    ImGui::Checkbox("Errors as arrows", &view.errors);
    ImGui::BeginDisabled(!view.errors);
    slider(ui, "Lengthened", view.error_scale, 1.0, 100.0, "%.0f times",
           ImGuiSliderFlags_Logarithmic);
    ImGui::EndDisabled();
  }

  std::string path_, opened_;
  PlotView plot_;
  int axis_ = 0;
  double last_ = 0.0;
  int found_ = 0;         // SessionMeasured::diagnoses() that was noticed
  bool extends_ = false;  // its extended model is to be brought to the front
  SceneData scene_;
  DiagnosisPart diagnosis_;
};

}  // namespace

std::unique_ptr<Panel> make_data_panel() {
  return std::make_unique<DataPanel>();
}

}  // namespace pedicel::app
