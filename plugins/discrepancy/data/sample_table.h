#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// What the rows of a table are: samples at times, or states of rest one after the other, whose
/// "time" is the number of the row, from 0 on.
enum class Rows { time, rest };

/// Which of its columns a table must have.
enum class NeededAxes {
  all,      ///< every one
  present,  ///< at least one of each point's three
  any,      ///< at least one
};

/// A table of samples: a time that increases and is not negative, and the columns that are
/// expected, in any order and in the ways in which programs write their names. Everything comes in
/// SI units, whatever unit the header says. Columns that count the rows are told and passed over.
/// Keeps a reference to the diagnostics.
class SampleTable {
 public:
  /// `gaps`: cells but those of the time may be missing.
  SampleTable(const std::filesystem::path& file, bool gaps, Rows rows, Diagnostics& diagnostics);

  bool good() const { return diagnostics_.error_count() == before_; }
  const io::CsvTable& table() const { return table_; }
  /// But those that count, and the time.
  std::size_t columns() const {
    return table_.columns.size() - counters_.size() - (time_ < 0 ? 0 : 1);
  }
  double time(std::size_t row) const {
    return rows_ == Rows::rest ? static_cast<double>(row) : table_.rows[row][time_];
  }

  /// Each of `expected` once and nothing else: their indices, -1 where one may be missing and is.
  /// `all` says them in a sentence.
  std::vector<int> find(const std::vector<std::string>& expected, io::Quantity quantity,
                        const std::string& all, NeededAxes axes = NeededAxes::all);
  struct Wanted {
    std::string name;
    io::Quantity quantity;
  };
  /// Some of `wanted`, at least one, and nothing else: their indices, -1 for what is not there.
  std::vector<int> find_some(const std::vector<Wanted>& wanted, const std::string& all);
  /// The cells of a point's axes that have columns are all there or none is.
  void check_points(const std::vector<int>& columns);
  Samples samples(const std::vector<int>& columns) const;
  /// The same in row after row is said once.
  void row_error(const char* kind, std::size_t row, int column, const std::string& what);

 private:
  void error(int line, int column, const std::string& what);
  void find_time();
  void check_time();
  bool counts_frames(int column) const;
  void to_si(int column, const std::string& name, io::Quantity quantity);
  std::vector<int> match(const std::vector<std::string>& expected,
                         std::vector<std::string>& unknown, int& first_unknown);
  void say_differences(std::vector<std::string> unknown, int first_unknown,
                       const std::vector<std::string>& missing, const std::string& all);

  io::CsvTable table_;
  Rows rows_;
  int time_ = -1;
  std::vector<int> counters_;  ///< columns that count the rows
  Diagnostics& diagnostics_;
  int before_;
};

}  // namespace pedicel::discrepancy
