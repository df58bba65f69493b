#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/pick/pick.h"

namespace pedicel::discrepancy {

/// A record with its judgement.
struct JudgedPick {
  PickRecord record;
  Pick pick;
};

/// For a person: the sentence and the numbers behind it.
std::string to_text(const JudgedPick& judged);
/// For a person: a row a record.
std::string to_table(const std::vector<JudgedPick>& all);
/// An object for one record, an array of them for several or none.
std::string to_json(const std::vector<JudgedPick>& all);

}  // namespace pedicel::discrepancy
