#include "engine/urdf/urdf_remarks.h"

#include <algorithm>
#include <utility>

namespace pedicel::robot {

std::string first_names(const std::vector<std::string>& names, std::size_t shown) {
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > shown) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

void UrdfRemarks::add(SourcePosition where, const std::string& who, const std::string& what) {
  auto remark = std::find_if(remarks_.begin(), remarks_.end(),
                             [&](const Remark& known) { return known.what == what; });
  if (remark == remarks_.end())
    remark = remarks_.insert(remarks_.end(), {what, std::move(where), {}, 0});
  ++remark->count;
  if (std::find(remark->who.begin(), remark->who.end(), who) == remark->who.end())
    remark->who.push_back(who);
}

void UrdfRemarks::report(Diagnostics& diagnostics) const {
  for (const Remark& remark : remarks_) {
    const std::string times =
        remark.count > 1 ? " (" + std::to_string(remark.count) + " times)" : "";
    diagnostics.warning(remark.where, first_names(remark.who) + ": " + remark.what + times);
  }
}

}  // namespace pedicel::robot
