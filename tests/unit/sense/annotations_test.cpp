#include <gtest/gtest.h>

#include <map>

#include "app/dataset/run_length.h"
#include "app/dataset/split.h"
#include "app/sense/noise.h"

namespace pedicel::app {
namespace {

/// Every pixel again, down the columns.
std::vector<int> unrolled(const RunLength& run) {
  std::vector<int> pixels;
  for (std::size_t i = 0; i < run.counts.size(); ++i)
    pixels.insert(pixels.end(), run.counts[i], static_cast<int>(i % 2));
  return pixels;
}

TEST(RunLength, SaysEveryPixelOfRandomMaps) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const int labels = random.integer(1, 5);
    render::LabelMap map(random.integer(1, 9), random.integer(1, 9));
    for (render::Label& label : map.labels)
      label = static_cast<render::Label>(random.integer(0, labels));
    const std::vector<RunLength> runs = run_lengths(map, static_cast<std::size_t>(labels) + 1);
    for (int l = 0; l <= labels; ++l) {
      std::vector<int> expected;
      int left = map.width, top = map.height, right = -1, bottom = -1;
      for (int x = 0; x < map.width; ++x)
        for (int y = 0; y < map.height; ++y) {
          const bool own = map.labels[map.index(x, y)] == static_cast<render::Label>(l);
          expected.push_back(own);
          if (!own) continue;
          left = std::min(left, x), right = std::max(right, x);
          top = std::min(top, y), bottom = std::max(bottom, y);
        }
      const RunLength& run = runs[static_cast<std::size_t>(l)];
      EXPECT_EQ(unrolled(run), expected);
      EXPECT_EQ(run.area, std::count(expected.begin(), expected.end(), 1));
      if (run.area > 0) {
        EXPECT_EQ(run.box, (std::array<int, 4>{left, top, right - left + 1, bottom - top + 1}));
      }
      for (std::size_t i = 1; i < run.counts.size(); ++i) EXPECT_GT(run.counts[i], 0u);
    }
  }
}

TEST(Split, HasEightOneAndOneOfEveryTen) {
  for (const std::uint64_t seed : {0u, 1u, 77u})
    for (long block = 0; block < 30; ++block) {
      std::map<std::string_view, int> found;
      for (long i = 0; i < 10; ++i) ++found[split_of(10 * block + i, seed)];
      EXPECT_EQ(found["train"], 8);
      EXPECT_EQ(found["val"], 1);
      EXPECT_EQ(found["test"], 1);
    }
}

TEST(DepthPicture, RoundsToMillimetresAndLeavesOutWhatHasNone) {
  const std::vector<float> depth = {
      1.2344f, 1.2346f, render::LabelMap::nothing, std::numeric_limits<float>::quiet_NaN(),
      65.535f, 66.0f};
  const render::GrayImage picture = depth_millimetres(depth, 6, 1);
  EXPECT_EQ(picture.values, (std::vector<std::uint16_t>{1234, 1235, 0, 0, 65535, 0}));
}

}  // namespace
}  // namespace pedicel::app
