#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/render/image.h"

namespace pedicel::app {

/// A small picture of a data set.
struct SheetCell {
  render::Image image;
  render::GrayImage instances;
  std::string text;  ///< written below it
};

/// All of them in rows, each with the outlines of what is labelled, at most `columns` in a row.
render::Image contact_sheet(const std::vector<SheetCell>& cells, int columns, int cell_width);

}  // namespace pedicel::app
