#include "app/dataset/contact_sheet.h"

#include <algorithm>

#include "engine/render/text.h"

namespace pedicel::app {

namespace {

constexpr int gap = 6;         // px, between cells
constexpr int text_rows = 16;  // px, below a cell

/// Its own for each label, and the same everywhere.
render::Colour colour_of(std::uint16_t label) {
  std::uint32_t mixed = label * 2654435761u;
  mixed ^= mixed >> 15;
  const auto part = [&](int shift) {
    return 0.35f + 0.65f * static_cast<float>((mixed >> shift) & 255u) / 255.0f;
  };
  return {part(0), part(8), part(16)};
}

/// The pixel of a larger picture that a pixel of the cell shows.
int scaled(int at, int from, int to) {
  return std::min(to - 1, at * to / from);
}

void put_cell(render::Image& sheet, const SheetCell& cell, int left, int top, int width,
              int height) {
  const render::Image& from = cell.image;
  const auto label_at = [&](int x, int y) {
    const int u = scaled(std::clamp(x, 0, width - 1), width, from.width);
    const int v = scaled(std::clamp(y, 0, height - 1), height, from.height);
    return cell.instances
        .values[static_cast<std::size_t>(v) * static_cast<std::size_t>(from.width) +
                static_cast<std::size_t>(u)];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* pixel =
          from.at(scaled(x, width, from.width), scaled(y, height, from.height));
      std::copy(pixel, pixel + 3, sheet.at(left + x, top + y));
      const std::uint16_t label = label_at(x, y);
      if (label != label_at(x + 1, y) || label != label_at(x, y + 1))
        render::blend(sheet, left + x, top + y,
                      colour_of(std::max({label, label_at(x + 1, y), label_at(x, y + 1)})), 0.9);
    }
  render::TextStyle style;
  style.cap_height = 8.0;
  render::draw_text(sheet, left + 2, top + height + 4, cell.text, style);
}

}  // namespace

render::Image contact_sheet(const std::vector<SheetCell>& cells, int columns, int cell_width) {
  if (cells.empty()) return render::Image(cell_width, text_rows);
  const int count = static_cast<int>(cells.size());
  const int across = std::min(columns, count), down = (count + across - 1) / across;
  const render::Image& first = cells.front().image;
  const int cell_height = std::max(1, cell_width * first.height / first.width);
  render::Image sheet(across * (cell_width + gap) + gap,
                      down * (cell_height + text_rows + gap) + gap);
  std::fill(sheet.rgb.begin(), sheet.rgb.end(), std::uint8_t{28});
  for (int i = 0; i < count; ++i)
    put_cell(sheet, cells[static_cast<std::size_t>(i)], gap + (i % across) * (cell_width + gap),
             gap + (i / across) * (cell_height + text_rows + gap), cell_width, cell_height);
  return sheet;
}

}  // namespace pedicel::app
