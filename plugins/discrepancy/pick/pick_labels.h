#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/pick/pick_text.h"

namespace pedicel::discrepancy {

/// What a person saw: whether the fruit of a record came off.
struct PickLabel {
  std::string name;  ///< of the record: its file's name, or the end of it ("06" of pick_06.csv)
  bool came_off = false;
  SourcePosition where;
};

/// Reads a table with a column pick, file or name, and a column outcome: detached or came_off, or
/// failed, slipped or held. Faults go to the diagnostics. Throws InvalidFile where the file cannot
/// be read.
std::vector<PickLabel> read_pick_labels(const std::filesystem::path& file,
                                        Diagnostics& diagnostics);

/// The judgement beside the labels. Response and sharpness are fitted to the labels (largest
/// likelihood); each record is then judged with what the others alone would have given.
struct LabelledPicks {
  struct Row {
    std::string file;
    bool came_off = false;     ///< as labelled
    bool right = false;        ///< judged with the settings as given
    bool right_alone = false;  ///< judged with the settings that the other records give
  };
  std::vector<Row> rows;
  double response = 0.0, sharpness = 0.0;  ///< s, 1: fitted to all; 0 where that cannot be done
  std::vector<std::string> without_label;  ///< files

  int right() const;
  int right_alone() const;
  std::string to_text() const;
};
LabelledPicks compare_with_labels(const std::vector<JudgedPick>& all,
                                  const std::vector<PickLabel>& labels);

}  // namespace pedicel::discrepancy
