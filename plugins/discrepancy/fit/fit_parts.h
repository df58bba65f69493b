#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/profile.h"

namespace pedicel::discrepancy {

/// Who does parts of a search that know nothing of each other. A search comes to the same parts
/// with the same numbers wherever it runs, so other processes may do them.
class FitParts {
 public:
  virtual ~FitParts() = default;
  /// The answers to `count` parts of a stage, in their order, each as `compute` gives it. May throw
  /// to end the search. `stage` is a word such as "starts"; a search may have several of one word.
  virtual std::vector<std::string> answers(const std::string& stage, int count,
                                           const std::function<std::string(int)>& compute) = 0;
};

/// A fit as text, without loss of a bit, and back. Throws std::runtime_error for what is none.
std::string to_text(const FitSummary& fit);
FitSummary fit_of_text(const std::string& text);
std::string to_text(const Profile& profile);
Profile profile_of_text(const std::string& text);

/// Fits one by one, or by `parts` where that is not null.
std::vector<FitSummary> fits_by(FitParts* parts, const std::string& stage, int count,
                                const std::function<FitSummary(int)>& one);
/// Profiles by `parts`.
std::vector<Profile> profiles_by(FitParts& parts, const std::string& stage, int count,
                                 const std::function<Profile(int)>& one);

}  // namespace pedicel::discrepancy
