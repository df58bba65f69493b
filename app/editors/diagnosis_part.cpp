#include "app/editors/diagnosis_part.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/session/measured/diagnosis_job.h"
#include "app/session/measured/measured_data.h"
#include "app/session/measured/measured_scene.h"
#include "app/session/session_measured.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

void paragraph(const std::string& text, const ImVec4* colour = nullptr) {
  if (text.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, colour ? *colour : palette().text);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(at_blanks(text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

std::string seconds_text(double seconds) {
  if (seconds < 100.0) return number_text(std::max(1.0, std::round(seconds)), 2) + " s";
  return number_text(std::round(seconds / 60.0), 3) + " min";
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
  return text + ".";
}

}  // namespace

void DiagnosisPart::draw(Ui& ui) {
  heading(ui, "Diagnosis");
  if (ui.session.measured().is_diagnosing())
    draw_progress(ui);
  else if (wide_button("Find out what is wrong"))
    ui.run(Command("diagnose", {}));
  if (of_ == ui.session.measured().diagnoses()) return;
  of_ = ui.session.measured().diagnoses();
  card_ = ui.session.measured().card();
}

void DiagnosisPart::draw_result(Ui& ui) {
  if (!card_.headline.empty()) draw_card(ui);
}

void DiagnosisPart::draw_progress(Ui& ui) {
  const DiagnosisProgress now = ui.session.measured().progress();
  const std::string share = std::to_string(static_cast<int>(100.0 * now.share)) + " %";
  ImGui::ProgressBar(static_cast<float>(now.share), ImVec2(-1, 0), share.c_str());
  paragraph(now.doing.empty() ? "beginning" : now.doing);
  std::string time = seconds_text(now.seconds) + " so far";
  if (now.left) time += ", about " + seconds_text(*now.left) + " left";
  note(time);
  const bool ends =
      ui.session.measured().data().is_cancelling() || ui.session.measured().scene().is_cancelling();
  ImGui::BeginDisabled(ends);
  if (wide_button(ends ? "Cancelling ..." : "Cancel")) ui.run(Command("cancel diagnosis", {}));
  ImGui::EndDisabled();
  if (!now.found.empty()) note(now.found.back());
}

void DiagnosisPart::draw_card(Ui& ui) {
  const ImVec4& colour = card_.good ? palette().good : palette().warning;
  ImGui::PushFont(ui.bold);
  paragraph(card_.headline, &colour);
  ImGui::PopFont();
  note(card_.certainty);
  if (!card_.remainder.empty()) paragraph(card_.remainder);
  draw_causes(ui);
  if (!card_.gain.empty()) {
    heading(ui, card_.outcome == "unknown" ? "What is left" : "What it gains");
    paragraph(card_.gain);
  }
  draw_competing_models(ui);
  if (!card_.detectable_limits.empty() || !card_.unseen.empty()) {
    if (!ImGui::CollapsingHeader("What could still hide")) return draw_next(ui);
    if (!card_.detectable_limits.empty()) paragraph(listed(card_.detectable_limits));
    if (!card_.unseen.empty()) note("These data cannot see at any size: " + listed(card_.unseen));
  }
  draw_next(ui);
}

void DiagnosisPart::draw_next(Ui& ui) {
  heading(ui, "What to do next");
  paragraph(card_.next);
  draw_buttons(ui);
}

void DiagnosisPart::draw_causes(Ui& ui) {
  if (card_.causes.empty()) return;
  heading(ui, card_.outcome == "ambiguous" ? "What it could be" : "What it is");
  for (const DiagnosisCard::Cause& cause : card_.causes) {
    paragraph(cause.name, &palette().accent);
    paragraph("Where: " + cause.place);
    paragraph(cause.numbers);
    if (!cause.because.empty()) note(cause.because);
  }
}

void DiagnosisPart::draw_competing_models(Ui& ui) {
  if (card_.competing_models.empty()) return;
  heading(ui, "What else it could have been");
  for (const DiagnosisCard::CompetingModel& model : card_.competing_models) {
    // The reason says how far it is behind where that is what decides.
    const bool said = model.why.find(" nats ") != std::string::npos;
    if (said)
      paragraph(model.name);
    else
      row(model.name.c_str(), number_text(model.behind, 3) + " nats");
    note(model.why);
  }
}

void DiagnosisPart::draw_buttons(Ui& ui) {
  ImGui::Spacing();
  using Acceptance = SessionMeasured::Acceptance;
  const bool of_scene = ui.session.measured().scene().experiment() != nullptr;
  const Acceptance acceptance = ui.session.measured().acceptance();
  if (acceptance == Acceptance::accepted) {
    paragraph(of_scene ? "The scene has the effects that were found."
                       : "The plant has the effects that were found.",
              &palette().good);
    ImGui::BeginDisabled(!ui.session.history().can_undo());
    if (wide_button("Undo")) ui.ask(Action::undo);
    ImGui::EndDisabled();
  } else {
    ImGui::BeginDisabled(acceptance == Acceptance::impossible);
    if (wide_button(of_scene ? "Accept the extended scene" : "Accept the extended plant"))
      ui.run(Command("accept diagnosis", {}));
    ImGui::EndDisabled();
  }
  if (wide_button("Write report")) {
    const std::string folder = "diagnosis_" + ui.session.measured().folder().filename().string();
    if (ui.run(Command("write report", {{"folder", folder}}))) ui.say("written to " + folder);
  }
}

}  // namespace pedicel::app
