#include "app/editors/copy_part.h"

#include <imgui.h>

#include <cmath>
#include <numbers>

#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

constexpr double degree = std::numbers::pi / 180.0;  // rad

void mirror(Ui& ui, const std::string& plant, const std::string& stem) {
  Vec3& normal = ui.draw.mirror_normal;
  const bool by_itself = normal.isZero();
  if (ImGui::Button("Mirror")) {
    if (by_itself)
      ui.run(Command("mirror stem", {{"plant", plant}, {"stem", stem}}));
    else
      ui.run(Command("mirror stem", {{"plant", plant}, {"stem", stem}, {"normal", normal}}));
  }
  tip("Copies the stem with everything on it to the other side of its parent, or of the plane "
      "through its foot with this normal");
  ImGui::SameLine();
  ImGui::TextColored(palette().dim, "%s", by_itself ? "across its parent" : "by the normal");
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(palette().dim, "Normal x, y, z");
  constexpr int fields = 3;
  const float space = 4.0f * ui.scale;
  ImGui::SameLine();
  const float width = (rest_width() - (fields - 1) * space) / fields;
  for (int axis = 0; axis < fields; ++axis) {
    if (axis) ImGui::SameLine(0, space);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(axis);
    number_field("##normal", normal[axis], "%.4g");
    ImGui::PopID();
    tip("x, y, z of the mirror's normal; 0, 0, 0: across the parent");
  }
}

void repeat(Ui& ui, const std::string& plant, const std::string& stem) {
  DrawMode& d = ui.draw;
  double count = d.copies, spacing = 1e3 * d.copy_spacing, angle = d.copy_angle / degree;
  if (labelled_number(ui, "Copies", "", count)) d.copies = static_cast<int>(std::lround(count));
  if (labelled_number(ui, "Spacing", "mm", spacing)) d.copy_spacing = spacing / 1e3;
  tip("Along the parent, from one to the next; below 0: towards its first point");
  if (labelled_number(ui, "Angle", "deg", angle)) d.copy_angle = degree * angle;
  tip("About the parent, from one to the next");
  if (wide_button("Repeat"))
    ui.run(Command("repeat stem", {{"plant", plant},
                                   {"stem", stem},
                                   {"count", d.copies},
                                   {"spacing", d.copy_spacing},
                                   {"angle", d.copy_angle}}));
  tip("Copies it so many times along its parent");
}

}  // namespace

void draw_copies(Ui& ui, const std::string& plant, const std::string& stem) {
  heading(ui, "Copies");
  mirror(ui, plant, stem);
  repeat(ui, plant, stem);
}

}  // namespace pedicel::app
