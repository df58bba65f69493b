#include "app/panels/scene_data.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/session/session_measured.h"
#include "app/ui/theme.h"
#include "app/ui/widgets.h"
#include "app/view/measured_marks.h"

namespace pedicel::app {

namespace {

using discrepancy::Model;

/// The models that have something to show of a trial.
std::vector<int> known_models(const MeasuredScene& scene, int trial) {
  std::vector<int> known;
  for (int m = 0; m < discrepancy::model_count; ++m)
    if (scene.path(static_cast<Model>(m), trial)) known.push_back(m);
  return known;
}

std::string measured_text(double value) {
  return std::isfinite(value) ? number_text(value, 3) : "-";
}

}  // namespace

void SceneData::draw(Ui& ui) {
  MeasuredView& view = ui.view.measured;
  const MeasuredScene& scene = ui.session.measured().scene();
  models(ui);
  const std::vector<SceneInstrument> list = instruments_of(*scene.experiment(), view.trial);
  if (list.empty()) return note("Nothing was measured in this trial.");
  view.instrument = std::clamp(view.instrument, 0, static_cast<int>(list.size()) - 1);
  instruments(ui, list);
  plot(ui, list[static_cast<std::size_t>(view.instrument)]);
  shown(ui);
}

void SceneData::models(Ui& ui) const {
  MeasuredView& view = ui.view.measured;
  const MeasuredScene& scene = ui.session.measured().scene();
  heading(ui, "Model");
  for (int m = 0; m < discrepancy::model_count; ++m) {
    if (m > 0 && !scene.has(static_cast<Model>(m))) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, ink(model_colour(m)));
    ImGui::RadioButton(model_name(static_cast<Model>(m)), &view.model, m);
    ImGui::PopStyleColor();
    const ScenePath* path = scene.path(static_cast<Model>(m), view.trial);
    if (!path || path->healthy) continue;
    ImGui::SameLine();
    ImGui::TextUnformatted("failed");
  }
  if (!scene.has(discrepancy::extended))
    note("Refitted and extended models come with a diagnosis.");
}

void SceneData::instruments(Ui& ui, const std::vector<SceneInstrument>& list) {
  MeasuredView& view = ui.view.measured;
  const MeasuredScene& scene = ui.session.measured().scene();
  const std::vector<int> columns = known_models(scene, view.trial);
  heading(ui, "Error of the instruments, RMS");
  if (!ImGui::BeginTable("instruments", 1 + static_cast<int>(columns.size()),
                         ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchSame))
    return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.0f);
  for (std::size_t m = 0; m < columns.size(); ++m) ImGui::TableSetupColumn("");
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::TableNextColumn();
  for (const int m : columns) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ink(model_colour(m)));
    elided(model_name(static_cast<Model>(m)), rest_width());
    ImGui::PopStyleColor();
  }
  for (int i = 0; i < static_cast<int>(list.size()); ++i) {
    const SceneInstrument& one = list[static_cast<std::size_t>(i)];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(i);
    if (ImGui::Selectable(elide(one.name + ", " + one.unit, rest_width()).c_str(),
                          view.instrument == i, ImGuiSelectableFlags_SpanAllColumns)) {
      view.instrument = i, view.column = 0;
      plot_.follows = true;
    }
    ImGui::PopID();
    for (const int m : columns) {
      ImGui::TableNextColumn();
      const std::vector<double>& rms = scene.path(static_cast<Model>(m), view.trial)->rms;
      elided(
          i < static_cast<int>(rms.size()) ? measured_text(rms[static_cast<std::size_t>(i)]) : "-",
          rest_width());
    }
  }
  ImGui::EndTable();
}

void SceneData::plot(Ui& ui, const SceneInstrument& instrument) {
  MeasuredView& view = ui.view.measured;
  heading(ui, (instrument.name + ", " + instrument.unit).c_str());
  view.column = std::clamp(view.column, 0, static_cast<int>(instrument.columns.size()) - 1);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##column",
                        instrument.columns[static_cast<std::size_t>(view.column)].c_str())) {
    for (int c = 0; c < static_cast<int>(instrument.columns.size()); ++c) {
      ImGui::PushID(c);
      if (ImGui::Selectable(instrument.columns[static_cast<std::size_t>(c)].c_str(),
                            c == view.column)) {
        view.column = c;
        plot_.follows = true;
      }
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  const MeasuredSeries series =
      scene_series_of(ui.session.measured().scene(), view.trial, instrument, view.column);
  std::vector<PlotLine> lines{{"measured", ink(measured_colour), series.time, series.measured}};
  for (int m = 0; m < discrepancy::model_count; ++m) {
    const auto& values = series.models[static_cast<std::size_t>(m)];
    if (!values.empty())
      lines.push_back(
          {model_name(static_cast<Model>(m)), ink(model_colour(m)), series.time, values});
  }
  draw_plot("column", lines, plot_, ImVec2(rest_width(), 150.0f * ui.scale), "s");
}

void SceneData::shown(Ui& ui) {
  MeasuredView& view = ui.view.measured;
  const discrepancy::Experiment& experiment = *ui.session.measured().scene().experiment();
  heading(ui, "Shown");
  ImGui::Checkbox("Markers", &view.markers);
  ImGui::Checkbox("Robot and plants of the trial", &view.shape);
  tip("The robot as its joints were measured, plants as the model has them");
  ImGui::Checkbox("Errors as arrows", &view.errors);
  ImGui::BeginDisabled(!view.errors);
  slider(ui, "Lengthened", view.error_scale, 1.0, 100.0, "%.0f times",
         ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  if (experiment.cameras.empty()) return;
  note("Through a camera: rings where it saw the markers, crosses where the model has them.");
  ImGui::RadioButton("by hand", &view.camera, -1);
  for (int c = 0; c < static_cast<int>(experiment.cameras.size()); ++c)
    ImGui::RadioButton(("camera " + experiment.cameras[static_cast<std::size_t>(c)].name).c_str(),
                       &view.camera, c);
}

}  // namespace pedicel::app
