#pragma once

#include <imgui.h>

#include <string>

#include "app/ui/bindings.h"
#include "engine/core/frames.h"

namespace pedicel::app {

struct Ui;

enum class Icon {
  play,
  pause,
  step,
  step_back,
  reset,
  reload,
  open,
  save,
  undo,
  redo,
  pencil,
  camera,
  help,
  cross,
  warning
};

/// A square button with a drawn sign; the tip says the sentence and the keys.
bool icon_button(const char* id, Icon icon, const std::string& tip, bool enabled = true,
                 bool active = false);
/// The same for an action of the binding table, which it asks for when pressed.
bool action_button(Ui& ui, Action action, Icon icon, bool enabled = true, bool active = false);
void draw_icon(ImDrawList& list, Icon icon, const ImVec2& centre, float size, ImU32 colour);

/// A tip for the last item, wrapped, once the pointer rests on it; beside the dock that it is of.
void tip(const std::string& text);
/// A heading inside a panel.
void heading(const Ui& ui, const char* text);
/// "name        value" with the value to the right; what does not fit ends in "...".
void row(const char* name, const std::string& value);
/// Dim, wrapped text.
void note(const std::string& text);
/// A button as wide as its column.
bool wide_button(const char* label);
/// Text broken into lines for the room there is, at blanks only: ImGui breaks numbers at their
/// point, too.
std::string at_blanks(const std::string& text);
/// Text cut to a width (px) with "..."; the whole text as a tip.
void elided(const std::string& text, float width, const ImVec4* colour = nullptr);
std::string elide(const std::string& text, float width);
/// Goes on in the row where a check box with that label still fits into it, else in the next one.
void stay_in_row(const char* label);
/// The width that is left, but for `right` px.
float rest_width(float right = 0.0f);

/// 0.00123 as "1.23e-03", 12.3 as "12.3": `digits` that count.
std::string number_text(double value, int digits = 4);
/// With its unit, in the prefix that reads best for m, N, Pa, s ("12.3 mm", "4.2 MPa").
std::string quantity_text(double value, const std::string& unit, int digits = 3);

/// For the tips of bars that are dragged.
inline constexpr char how_to_drag[] = "Drag; with Shift finer. Ctrl+click: type a value.";

/// A name to the left and, dim, a value to the right; what does not fit of the name ends in "...".
void caption(const Ui& ui, const std::string& name, const std::string& value, const ImVec4& colour,
             const std::string& what = "");
/// A slider under its caption: on the slider itself the grab would cover the value. `format` is
/// printf's, for the value. True when it was moved, or a value typed, within its ends.
bool slider(const Ui& ui, const std::string& name, double& value, double low, double high,
            const char* format, ImGuiSliderFlags flags = 0, const std::string& what = "");

/// An input of a number that is committed by Enter or by leaving it. True once, when it was.
bool number_field(const char* id, double& value, const char* format = "%.6g");
/// The same with a label before it and its unit behind it, in two columns.
bool labelled_number(const Ui& ui, const char* label, const char* unit, double& value);
/// Three numbers in a row under their name. True once one was typed.
bool three_numbers(const Ui& ui, const char* label, Vec3& value, const char* format = "%.6g");
/// An input of a text, as number_field().
bool text_field(const char* id, std::string& text, const char* hint = "");

}  // namespace pedicel::app
