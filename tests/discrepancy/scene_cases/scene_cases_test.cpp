#include <gtest/gtest.h>

#include "discrepancy/scene_cases/scored_case.h"
#include "support/temporary_folder.h"

namespace pedicel::scene_case {
namespace {

// A case of the bench: hidden in data of another engine, and found by the diagnosis from the files
// alone. Its size is what the seed draws.
struct Small {
  const char* name;
  std::vector<std::string> hidden;
  std::uint64_t seed;
};

std::ostream& operator<<(std::ostream& out, const Small& one) {
  return out << one.name;
}

class SceneCases : public testing::TestWithParam<Small> {
 protected:
  SceneScore diagnosed(const std::string& kind) {
    Order order;
    order.kind = kind;
    order.names = GetParam().hidden;
    return run_case(order, GetParam().seed, folder_ / "", 2, notes_);
  }
  TemporaryFolder folder_;
  std::string notes_;
};

class NothingHidden : public SceneCases {};
class OneHidden : public SceneCases {};
class Outsiders : public SceneCases {};

TEST_P(NothingHidden, IsAdequate) {
  const SceneScore score = diagnosed("null");
  EXPECT_EQ(score.outcome, "adequate") << notes_;
}

TEST_P(OneHidden, IsNamedAlone) {
  const SceneScore score = diagnosed("effect");
  EXPECT_EQ(score.outcome, "named") << notes_;
  EXPECT_EQ(score.said, score.hidden) << notes_;
}

TEST_P(Outsiders, AreUnknownWithTheirPlace) {
  const SceneScore score = diagnosed("outside");
  EXPECT_EQ(score.outcome, "unknown") << notes_;
  ASSERT_TRUE(score.place_off) << notes_;
  EXPECT_LT(*score.place_off, 0.03) << notes_;
}

std::string name_of(const testing::TestParamInfo<Small>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(SceneCases, NothingHidden,
                         testing::Values(Small{"first", {}, 1}, Small{"second", {}, 2},
                                         Small{"third", {}, 3}, Small{"fourth", {}, 4}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(
    SceneCases, OneHidden,
    testing::Values(Small{"contact_friction", {"contact_friction"}, 1},
                    Small{"plant_pose", {"plant_pose"}, 1}, Small{"tool_pose", {"tool_pose"}, 1},
                    Small{"joint_offset", {"joint_offset"}, 1},
                    Small{"robot_latency", {"robot_latency"}, 1},
                    Small{"reaction", {"reaction"}, 1}, Small{"payload", {"payload"}, 1},
                    Small{"wrench_bias", {"wrench_bias"}, 1},
                    Small{"wrench_gain", {"wrench_gain"}, 1},
                    Small{"youngs_modulus", {"youngs_modulus"}, 1},
                    Small{"damping_time", {"damping_time"}, 1},
                    Small{"friction_and_bias", {"contact_friction", "wrench_bias"}, 1}),
    name_of);

INSTANTIATE_TEST_SUITE_P(SceneCases, Outsiders,
                         testing::Values(Small{"post", {"post"}, 1}, Small{"string", {"string"}, 1}),
                         name_of);

}  // namespace
}  // namespace pedicel::scene_case
