#include "tests/discrepancy/scene_cases/drawn_case.h"

#include <gtest/gtest.h>

#include <algorithm>
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

// Figures are quoted by these numbers.
TEST(DrawnCase, TheFirstHundredStay) {
  const std::vector<Order> all = orders();
  ASSERT_GT(all.size(), 100U);
  int nothing = 0, outside = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].number, static_cast<int>(i));
    if (i >= 100) continue;
    nothing += all[i].kind == "null";
    outside += all[i].kind == "outside";
    EXPECT_FALSE(all[i].commands || all[i].torques || all[i].harvest) << i;
  }
  EXPECT_EQ(nothing, 30);
  EXPECT_EQ(outside, 14);
  EXPECT_EQ(all[13].names, std::vector<std::string>{"payload"});
  EXPECT_NEAR(hidden_number(drawn(all[13], 1), "payload", "mass", 0.0), 0.05641128817, 1.0e-11);
}

TEST(DrawnCase, EachLaterRecordHasNullCasesAndEffects) {
  const std::vector<Order> all = orders();
  const auto count = [&](const auto& wanted) {
    return std::count_if(all.begin() + 100, all.end(), wanted);
  };
  for (bool Order::*record : {&Order::commands, &Order::torques, &Order::harvest}) {
    EXPECT_GE(count([&](const Order& o) { return o.*record && o.kind == "null"; }), 2);
    EXPECT_GE(count([&](const Order& o) { return o.*record && o.kind == "effect"; }), 3);
  }
  for (const char* name : {"contact_compliance", "tracking_lag", "joint_friction", "fruit_mass",
                           "detachment_threshold"})
    EXPECT_EQ(count([&](const Order& o) { return o.names == std::vector<std::string>{name}; }), 3)
        << name;
}

}  // namespace
}  // namespace pedicel::scene_case
