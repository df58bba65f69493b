#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/number_text.h"

/// How a table is written, told from its text.
namespace pedicel::io {

/// What parts the cells of a header and of the rows behind it; `fault` where that cannot be told.
struct SeparatorFound {
  char separator = ',';
  std::string fault;
  int line = 0;  ///< of the fault
};

/// A record and the line where it begins.
struct TableLine {
  std::string_view text;
  int line = 0;
};

/// Its first cell is in quotes and no other one is: how R writes the name of a row.
bool has_row_name(std::string_view record);

SeparatorFound find_separator(const TableLine& header, const std::vector<TableLine>& rows);

/// The decimal mark of all numbers of `rows` (the text behind the header); `fault` where they
/// contradict each other or may be read in two ways.
struct DecimalFound {
  char decimal = '.';
  std::string fault;
  int line = 0, column = 1;
};
DecimalFound find_decimal(std::string_view rows, int first_line, char separator);

}  // namespace pedicel::io
