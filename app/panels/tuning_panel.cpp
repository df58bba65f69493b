#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "app/panels/panel.h"
#include "app/session/session_tuning.h"
#include "app/ui/drag_bar.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"
#include "engine/io/yaml.h"

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
    std::vector<SessionParameter> parameters = ui.session.tuning().parameters();
    const auto plant = [&ui](const SessionParameter& p) {
      return ui.session.document().plant_index(p.group) >= 0;
    };
    std::ranges::stable_partition(parameters, plant);  // what people come for first
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
        open = header(group, plant(p));
      }
      if (open) parameter(ui, p);
    }
    if (!any) note(*search_ ? "Nothing of that name." : "Open a scene to tune it.");
    ImGui::EndChild();
  }

 private:
  /// A search opens what it finds, and leaves the groups as they were by hand.
  bool header(const std::string& group, bool begins_open) {
    bool& open = open_.emplace(group, begins_open).first->second;
    ImGui::SetNextItemOpen(open || *search_, ImGuiCond_Always);
    const bool shown = ImGui::CollapsingHeader(group.c_str());
    if (!*search_) open = shown;
    return shown;
  }

  static void changed_row(Ui& ui, const std::vector<SessionParameter>& parameters) {
    const auto changed =
        std::ranges::count_if(parameters, [](const SessionParameter& p) { return p.changed; });
    ImGui::BeginDisabled(changed == 0);
    if (ImGui::Button("Keep")) ui.report(ui.session.tuning().keep());
    tip("Writes changed plant parameters into the plants, so that saving keeps them");
    ImGui::SameLine();
    if (ImGui::Button("Discard")) ui.report(ui.session.tuning().discard());
    tip("Sets everything back to what the files say");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::TextColored(changed ? palette().warning : palette().dim, "%d changed",
                       static_cast<int>(changed));
  }

  /// Name and value above, the slider below; a changed one can be set back.
  void parameter(Ui& ui, const SessionParameter& p) {
    ImGui::PushID(p.key.c_str());
    const double value = dragged_ == p.key ? dragged_value_ : p.value;
    const std::string unit = p.unit == "1" || p.unit.empty() ? "" : " " + p.unit;
    const std::string text = p.flag ? (value != 0.0 ? "on" : "off") : number_text(value, 5) + unit;
    caption(ui, short_name(p), text, p.changed ? palette().warning : palette().text, tip_of(p));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(6.0f * ui.scale, 0.0f));
    control(ui, p);
    reset_button(ui, p);
    ImGui::PopStyleVar();
    ImGui::PopID();
  }

  /// Its room is always kept, so that a bar does not change its length in the hand.
  static void reset_button(Ui& ui, const SessionParameter& p) {
    if (!p.changed) return;
    ImGui::SameLine();
    if (ImGui::Button("reset")) ui.report(ui.session.tuning().reset(p.key));
    tip("Back to " + number_text(p.initial, 5));
  }

  void control(Ui& ui, const SessionParameter& p) {
    if (p.flag) {
      bool on = p.value != 0.0;
      if (ImGui::Checkbox("##on", &on)) set(ui, p, on ? 1.0 : 0.0);
      return;
    }
    double value = dragged_ == p.key ? dragged_value_ : p.value;
    ImGui::SetNextItemWidth(rest_width(ImGui::CalcTextSize("reset").x + 20.0f * ui.scale));
    const bool moved =
        drag_bar(ui, "##value", value, {p.minimum, p.maximum, p.logarithmic, p.whole});
    const bool started = ImGui::IsItemActivated(), held = ImGui::IsItemActive();
    tip(tip_of(p) + "\n" + how_to_drag);
    if (started) {
      ui.session.begin_gesture();
      dragged_ = p.key, dragged_value_ = p.value;
    }
    if (moved) dragged_value_ = value, set(ui, p, value);
    if (!held && dragged_ == p.key) {
      ui.session.end_gesture();
      dragged_.clear();
    }
  }

  static void set(Ui& ui, const SessionParameter& p, double value) {
    ui.run(Command("set", {{"key", p.key}, {"value", io::format_number(value)}}));
  }

  char search_[64] = "";
  std::map<std::string, bool> open_;  // groups, by hand
  std::string dragged_;               // key of the slider in hand
  double dragged_value_ = 0.0;
};

}  // namespace

std::unique_ptr<Panel> make_tuning_panel() {
  return std::make_unique<TuningPanel>();
}

}  // namespace pedicel::app
