#include "engine/io/csv.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::filesystem::path file = folder.write("table.csv", fuzz::text_of(data, size));
  Diagnostics diagnostics;
  try {
    io::CsvRules rules;
    rules.empty_cells = true;
    const io::CsvTable table = io::read_csv(file, rules, diagnostics);
    for (const std::vector<double>& row : table.rows)
      fuzz::require(row.size() == table.columns.size(), "a cell a column in every row");
    fuzz::require(table.rows.size() == table.lines.size(), "a line number a row");
  } catch (const InvalidFile&) {
  }
  return 0;
}
