#pragma once

#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::robot {

/// What is remarked of many elements of a file is one warning, at the first of them, with the names
/// of the others: a robot of fifty links does not say the same thing fifty times.
class UrdfRemarks {
 public:
  /// `who` is the element ("link 'base'"), `what` the remark; the same words are the same remark.
  /// A name that comes again is counted, not repeated.
  void add(SourcePosition where, const std::string& who, const std::string& what);
  /// Hands the warnings over, in the order in which they came up.
  void report(Diagnostics& diagnostics) const;

 private:
  struct Remark {
    std::string what;
    SourcePosition where;
    std::vector<std::string> who;
    int count = 0;
  };
  std::vector<Remark> remarks_;
};

/// "a, b, c and 5 more"
std::string first_names(const std::vector<std::string>& names, std::size_t shown = 3);

}  // namespace pedicel::robot
