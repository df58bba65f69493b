#include "app/editors/tie_editor.h"

#include <imgui.h>

#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

const TieSnapshot* running_tie(const Ui& ui) {
  for (const TieSnapshot& tie : ui.snapshot->ties)
    if (tie.number == ui.selection.tie) return &tie;
  return nullptr;
}

void set_tie(Ui& ui, const char* key, double value) {
  ui.run(Command("set tie", {{"tie", ui.selection.tie + 1}, {"key", key}, {"value", value}}));
}

void draw_tie_ends(Ui& ui, const world::SceneTie& tie) {
  row("Holds", tie.organ);
  double at = tie.at;
  if (labelled_number(ui, "Place on stem", "", at)) set_tie(ui, "at", at);
  tip("0 is the stem's foot, 1 its tip");
  if (!tie.to_organ.empty()) {
    row("Ends on", tie.to_organ);
    double to_at = tie.to_at.value_or(0.0);
    if (tie.to_at && labelled_number(ui, "Place there", "", to_at)) set_tie(ui, "to_at", to_at);
    return;
  }
  Vec3 end = 1e3 * tie.to;
  const char* label = tie.is_offset ? "Ends off it x, y, z, mm" : "Ends at x, y, z, mm";
  if (three_numbers(ui, label, end))
    ui.run(Command("move tie", {{"tie", ui.selection.tie + 1},
                                {tie.is_offset ? "offset" : "to", Vec3(end / 1e3)}}));
}

/// A string that is as long as drawn has no length of its own: the running one says it.
void draw_tie_length(Ui& ui, const world::SceneTie& tie) {
  const TieSnapshot* now = running_tie(ui);
  double length = 1e3 * tie.length.value_or(now ? now->course.length : 0.0);
  if (labelled_number(ui, "Length", "mm", length)) set_tie(ui, "length", length / 1e3);
  tip("It pulls where it is longer, and bears no pressure");
  if (tie.length) {
    if (wide_button("As long as drawn"))
      ui.run(Command("tauten tie", {{"tie", ui.selection.tie + 1}}));
    tip("Neither slack nor taut where the plant stands as drawn");
  } else {
    note("As long as drawn.");
  }
  double stiffness = tie.stiffness;
  if (labelled_number(ui, "Stiffness", "N/m", stiffness)) set_tie(ui, "stiffness", stiffness);
  if (!now) return row("Now", "holds nothing");
  const double slack = now->course.length - (now->course.to_W - now->course.from_W).norm();
  row("Slack", slack > 0.0 ? quantity_text(slack, "m") : "none");
  row("Pulls with", quantity_text(now->course.tension, "N"));
}

}  // namespace

void choose_tie(Ui& ui, int tie) {
  ui.selection = {};
  ui.selection.kind = Selection::Kind::tie;
  ui.selection.tie = tie;
}

const world::SceneTie* chosen_tie(const Ui& ui) {
  const auto& ties = ui.session.document().scene->ties;
  const bool known = ui.selection.kind == Selection::Kind::tie && ui.selection.tie >= 0 &&
                     ui.selection.tie < static_cast<int>(ties.size());
  return known ? &ties[static_cast<std::size_t>(ui.selection.tie)] : nullptr;
}

void draw_tie(Ui& ui) {
  const world::SceneTie* found = chosen_tie(ui);
  if (!found) return note("This string is no longer there.");
  const world::SceneTie tie = *found;  // commands replace the document
  draw_tie_ends(ui, tie);
  draw_tie_length(ui, tie);
  if (wide_button("Delete")) ui.ask(Action::remove);
  tip("(" + keys_of(Action::remove) + ")");
}

}  // namespace pedicel::app
