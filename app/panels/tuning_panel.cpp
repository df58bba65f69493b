#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "app/panels/panel.h"
#include "app/panels/theme.h"
#include "app/panels/ui.h"
#include "app/panels/widgets.h"
#include "io/yaml.h"

namespace pedicel::app {

namespace {

bool contains(std::string text, std::string part) {
  const auto low = [](std::string& s) {
    std::ranges::transform(s, s.begin(), [](unsigned char c) { return std::tolower(c); });
  };
  low(text), low(part);
  return text.find(part) != std::string::npos;
}

/// "plants.tomato.material.density" in group "tomato": "material.density".
std::string short_name(const SessionParameter& p) {
  for (const std::string& before : {"plants." + p.group + ".", p.group + "."})
    if (p.key.starts_with(before)) return p.key.substr(before.size());
  return p.key;
}

std::string tip_of(const SessionParameter& p) {
  const std::string unit = p.unit == "1" ? "" : " " + p.unit;
  return p.sentence + "\n\n" + p.key + ": " + number_text(p.minimum, 4) + " to " +
         number_text(p.maximum, 4) + unit + "; the files say " + number_text(p.initial, 5) + unit +
         (p.restarts ? ". A change starts the run anew." : "");
}

/// Every described number, changed while it runs.
class TuningPanel : public Panel {
 public:
  std::string_view name() const override { return "Tune"; }
  Dock dock() const override { return Dock::right; }

  void draw(Ui& ui) override {
    const std::vector<SessionParameter> parameters = ui.session.parameters();
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##search", "search: density, damping, ...", search_, sizeof search_);
    changed_row(ui, parameters);
    if (!ImGui::BeginChild("parameters")) {
      ImGui::EndChild();
      return;
    }
    std::string group;
    bool open = false, any = false;
    for (const SessionParameter& p : parameters) {
      if (*search_ && !contains(p.key + " " + p.sentence, search_)) continue;
      any = true;
      if (p.group != group) {
        group = p.group;
        const bool plant = ui.session.document().plant_index(group) >= 0;
        ImGui::SetNextItemOpen(true, *search_ ? ImGuiCond_Always : ImGuiCond_Once);
        open = ImGui::CollapsingHeader(group.c_str());
        if (plant) tip("The plant " + group);
      }
      if (open) parameter(ui, p);
    }
    if (!any) note(*search_ ? "Nothing of that name." : "Open a scene to tune it.");
    ImGui::EndChild();
  }

 private:
  static void changed_row(Ui& ui, const std::vector<SessionParameter>& parameters) {
    const auto changed =
        std::ranges::count_if(parameters, [](const SessionParameter& p) { return p.changed; });
    ImGui::BeginDisabled(changed == 0);
    if (ImGui::Button("Keep")) ui.report(ui.session.keep_parameters());
    tip("Writes changed plant parameters into the plants, so that saving keeps them");
    ImGui::SameLine();
    if (ImGui::Button("Discard")) ui.report(ui.session.discard_parameters());
    tip("Sets everything back to what the files say");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextColored(changed ? palette().warning : palette().dim, "%d changed",
                       static_cast<int>(changed));
  }

  void parameter(Ui& ui, const SessionParameter& p) {
    ImGui::PushID(p.key.c_str());
    const std::string unit = p.unit == "1" ? "" : p.unit;
    const float reset = p.changed ? ImGui::CalcTextSize("reset").x + 12.0f * ui.scale : 0.0f;
    const float unit_width = ImGui::CalcTextSize(unit.c_str()).x;
    const std::string label =
        elide(short_name(p), rest_width(reset + unit_width + 10.0f * ui.scale));
    ImGui::TextColored(p.changed ? palette().warning : palette().text, "%s", label.c_str());
    tip(tip_of(p));
    ImGui::SameLine(0, 6.0f * ui.scale);
    ImGui::TextColored(palette().dim, "%s", unit.c_str());
    if (p.changed) {
      ImGui::SameLine(ImGui::GetContentRegionMax().x - reset + 4.0f * ui.scale);
      if (ImGui::SmallButton("reset")) ui.report(ui.session.reset_parameter(p.key));
      tip("Back to " + number_text(p.initial, 5));
    }
    control(ui, p);
    ImGui::PopID();
  }

  void control(Ui& ui, const SessionParameter& p) {
    if (p.flag) {
      bool on = p.value != 0.0;
      if (ImGui::Checkbox(on ? "on" : "off", &on)) set(ui, p, on ? 1.0 : 0.0);
      return;
    }
    double value = dragged_ == p.key ? dragged_value_ : p.value;
    int whole = static_cast<int>(value);
    const int low = static_cast<int>(p.minimum), high = static_cast<int>(p.maximum);
    ImGui::SetNextItemWidth(-1);
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp |
        (p.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    const bool moved = p.whole ? ImGui::SliderScalar("##value", ImGuiDataType_S32, &whole, &low,
                                                     &high, "%d", flags)
                               : ImGui::SliderScalar("##value", ImGuiDataType_Double, &value,
                                                     &p.minimum, &p.maximum, "%.5g", flags);
    if (p.whole) value = whole;
    const bool started = ImGui::IsItemActivated(), ended = ImGui::IsItemDeactivated();
    tip(tip_of(p) + "\nCtrl+click: type a value.");
    if (started) {
      ui.session.begin_gesture();
      dragged_ = p.key, dragged_value_ = p.value;
    }
    if (moved && value != p.value) dragged_value_ = value, set(ui, p, value);
    if (ended && dragged_ == p.key) {
      ui.session.end_gesture();
      dragged_.clear();
    }
  }

  static void set(Ui& ui, const SessionParameter& p, double value) {
    ui.run(Command("set", {{"key", p.key}, {"value", io::format_number(value)}}));
  }

  char search_[64] = "";
  std::string dragged_;  // key of the slider in hand
  double dragged_value_ = 0.0;
};

}  // namespace

std::unique_ptr<Panel> make_tuning_panel() {
  return std::make_unique<TuningPanel>();
}

}  // namespace pedicel::app
