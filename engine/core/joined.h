#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace pedicel {

/// "a, b, c": what `text` makes of each item (itself, a member, a function), one after another.
template <class Items, class Text = std::identity>
std::string joined(const Items& items, Text text = {}, std::string_view between = ", ") {
  std::string all;
  for (const auto& item : items) {
    if (!all.empty()) all += between;
    all += std::string_view(std::invoke(text, item));
  }
  return all;
}

}  // namespace pedicel
