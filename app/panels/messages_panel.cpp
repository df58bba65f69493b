#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <map>

#include "app/panels/panel.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

/// What the program has to say, and a line for commands.
class MessagesPanel : public Panel {
 public:
  std::string_view name() const override { return "Messages"; }
  Dock dock() const override { return Dock::bottom; }

  void draw(Ui& ui) override {
    idle(ui);
    ui.unread = false;
    const float line = ImGui::GetFrameHeightWithSpacing();
    if (ImGui::BeginChild("messages", ImVec2(0, -line))) {
      const auto& messages = ui.session.messages().all();
      if (messages.empty() && answer_.empty()) note("Nothing to say.");
      for (std::size_t i = 0; i < messages.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        message(ui, messages[i]);
        ImGui::PopID();
      }
      if (!answer_.empty()) ImGui::TextWrapped("%s", answer_.c_str());
      if (scrolled_ != shown_) ImGui::SetScrollHereY(1.0f), scrolled_ = shown_;
    }
    ImGui::EndChild();
    command_line(ui);
  }

  /// A file that cannot be read is shown at once, with what to do; other news bring the tab up.
  void idle(Ui& ui) override {
    const auto& messages = ui.session.messages().all();
    const std::size_t said = ui.session.messages().said();
    const std::size_t news = std::min(said - shown_, messages.size());
    for (std::size_t i = messages.size() - news; i < messages.size(); ++i) {
      bring_up(ui, messages[i]);
      when_[messages[i].text] = clock_text();
      if (messages[i].can_retry) ui.problem = messages[i].text, ui.dialog = Dialog::problem;
    }
    shown_ = said;
    const bool mended = std::none_of(messages.begin(), messages.end(),
                                     [](const Message& one) { return one.can_retry; });
    if (mended && ui.dialog == Dialog::problem) ui.dialog = Dialog::none;
  }

 private:
  /// The drawer opens for errors only: it moves the scene away under the hand. What was said before
  /// is no news.
  static void bring_up(Ui& ui, const Message& one) {
    if (one.severity == Severity::notice || (one.severity == Severity::warning && one.times > 1))
      return;
    if (one.severity == Severity::error || ui.preferences.show_bottom)
      ui.show_panel = "Messages";
    else
      ui.say(one.text), ui.unread = true;
  }

  /// "14:03:05", local.
  static std::string clock_text() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    std::array<char, 16> text{};
    std::strftime(text.data(), text.size(), "%H:%M:%S", &local);
    return text.data();
  }

  void message(Ui& ui, const Message& one) {
    const bool notice = one.severity == Severity::notice;
    if (const auto when = when_.find(one.text); when != when_.end() && !ui.filmed) {
      ImGui::TextColored(palette().dim, "%s", when->second.c_str());
      ImGui::SameLine();
    }
    const bool fault = one.severity == Severity::error;
    if (!notice) ImGui::PushStyleColor(ImGuiCol_Text, fault ? palette().error : palette().warning);
    const std::string again = one.times > 1 ? "  (" + std::to_string(one.times) + " times)" : "";
    ImGui::TextWrapped("%s%s", one.text.c_str(), again.c_str());
    if (!notice) ImGui::PopStyleColor();
    if (one.can_retry && ImGui::SmallButton("Read it again")) ui.ask(Action::reload);
    tip(keys_of(Action::reload));
  }

  void command_line(Ui& ui) {
    const float button = ImGui::CalcTextSize("Clear").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SetNextItemWidth(rest_width(button + ImGui::GetStyle().ItemSpacing.x));
    if (ImGui::InputTextWithHint("##command", "a command, as in scripts: help, play, pull ...",
                                 &ui.command_line, ImGuiInputTextFlags_EnterReturnsTrue)) {
      const Result result = ui.session.run_text(ui.command_line);
      answer_ = result.text;
      if (result.ok) ui.command_line.clear();
      ImGui::SetKeyboardFocusHere(-1);
    }
    ImGui::SameLine();
    if (ImGui::Button("Clear")) ui.session.messages().clear(), answer_.clear();
  }

  std::size_t shown_ = 0, scrolled_ = 0;
  std::string answer_;
  std::map<std::string, std::string> when_;  // a text was said last
};

}  // namespace

std::unique_ptr<Panel> make_messages_panel() {
  return std::make_unique<MessagesPanel>();
}

}  // namespace pedicel::app
