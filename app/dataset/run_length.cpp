#include "app/dataset/run_length.h"

#include <algorithm>

namespace pedicel::app {

namespace {

/// One label's run that is being gathered.
struct Growing {
  std::uint32_t end = 0;  // of its last run, px from the start
  int left = 1 << 30, right = -1, top = 1 << 30, bottom = -1;
};

}  // namespace

std::vector<RunLength> run_lengths(const render::LabelMap& map, std::size_t labels) {
  std::vector<RunLength> all(labels);
  std::vector<Growing> growing(labels);
  std::uint32_t at = 0;
  for (int x = 0; x < map.width; ++x)
    for (int y = 0; y < map.height; ++y, ++at) {
      const render::Label label = map.labels[map.index(x, y)];
      if (label >= labels) continue;
      RunLength& run = all[label];
      Growing& grown = growing[label];
      if (run.counts.empty() || grown.end != at) {
        run.counts.push_back(at - grown.end);
        run.counts.push_back(0);
      }
      ++run.counts.back();
      ++run.area;
      grown.end = at + 1;
      grown.left = std::min(grown.left, x), grown.right = std::max(grown.right, x);
      grown.top = std::min(grown.top, y), grown.bottom = std::max(grown.bottom, y);
    }
  for (std::size_t l = 0; l < labels; ++l) {
    if (growing[l].end < at || all[l].counts.empty()) all[l].counts.push_back(at - growing[l].end);
    if (all[l].area > 0)
      all[l].box = {growing[l].left, growing[l].top, growing[l].right - growing[l].left + 1,
                    growing[l].bottom - growing[l].top + 1};
  }
  return all;
}

}  // namespace pedicel::app
