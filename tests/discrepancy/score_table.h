#pragma once

#include <string>
#include <vector>

#include "tests/discrepancy/scoring.h"

namespace pedicel::hidden {

/// A share with its 95 % interval by Wilson's score (Wilson, J. Am. Stat. Assoc. 22, 1927).
struct Share {
  int count = 0, of = 0;
  double value = 0.0, low = 0.0, high = 1.0;  ///< NaN, 0 and 1 where there is nothing to count
};
Share share(int count, int of);

/// A quantile (0 to 1) of values with the distribution-free 95 % interval of its order statistics:
/// the number of values below it is binomial. Ends that so few values do not bound are infinite.
struct Quantile {
  int of = 0;
  double value = 0.0, low = 0.0, high = 0.0;  ///< NaN and infinite where there is no value
};
Quantile quantile(std::vector<double> values, double level);

/// One figure of the table.
struct TableRow {
  std::string figure;
  double value = 0.0, low = 0.0, high = 0.0;
  int count = 0;      ///< cases (or parameters) that it rests on
  bool share = true;  ///< shown in percent
  std::string good, extraordinary;
};

/// All figures by which a diagnosis is judged. Records as people make them have rows of their own,
/// and are in no other.
std::vector<TableRow> score_table(const std::vector<Score>& scores);

/// What was hidden against what was said.
struct Confusion {
  std::vector<std::string> hidden, said;  ///< labels of the rows and the columns
  std::vector<std::vector<int>> count;    ///< [hidden][said]
};
Confusion confusion(const std::vector<Score>& scores);

/// The table with its bounds, in Markdown and as CSV.
std::string markdown(const std::vector<TableRow>& rows);
std::string csv(const std::vector<TableRow>& rows);
/// The cells that hold something, a line a row of the matrix, in Markdown; and the whole as CSV.
std::string markdown(const Confusion& confusion);
std::string csv(const Confusion& confusion);

/// The cells of a row of the table as text: figure, value with bounds, cases, good, extraordinary.
std::vector<std::string> cells(const TableRow& row);

}  // namespace pedicel::hidden
