#include "discrepancy/scene_cases/drawn_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::scene_case {
namespace {

// A post beside another place than the stem's hides nothing.
TEST(DrawnCase, AFingerPushesTheStemAgainstEveryPost) {
  int posts = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const Order& order : orders()) {
      if (order.kind != "outside" || order.names.front() != "post") continue;
      const Setting setting = drawn(order, seed);
      const auto axis = [&](std::size_t a) {
        return hidden_number(setting, "post", "position", 0.0, a) -
               setting.root[static_cast<long>(a)];
      };
      EXPECT_DOUBLE_EQ(axis(0), 0.0);
      // m, from where the stem stands to where it touches.
      const double gap = std::abs(axis(1)) - setting.radius;
      // A finger takes 0.55 of the height aside by 30 mm. Below, a stem that bends stays nearer to
      // where it stood than a straight line does; above, it goes on along its tangent.
      const double height = axis(2) / (0.55 * setting.height);
      const double way = 0.03 * (height < 1.0 ? height : 1.0 + 1.5 * (height - 1.0));
      EXPECT_GT(gap, 0.0) << "seed " << seed << ", case " << order.number;
      EXPECT_LT(gap, 0.66 * way) << "seed " << seed << ", case " << order.number;
      ++posts;
    }
  EXPECT_EQ(posts, 20 * 7);
}

}  // namespace
}  // namespace pedicel::scene_case
