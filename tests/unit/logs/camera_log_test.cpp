// Cameras in a log: what a client of ROS computes with these messages is where things are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/mcap/reader.h"
#include "engine/render/offscreen.h"
#include "engine/ros_messages/cdr.h"
#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

// Looks along +Y at the stem, which stands at (0.4, 0.3) from z = 0 to 0.6 m.
constexpr const char* camera =
    "cameras:\n  - {name: side view, eye: [0.4, -0.7, 0.3], target: [0.4, 0, 0.3], fov: 0.8, "
    "size: [256, 192], rate: 20, sensors: [rgb, depth, points, instances]}\n"
    "wrenches:\n  - {name: pad, link: finger, rate: 50}\n"
    "imus:\n  - {name: pad, link: finger, rate: 50}\n";

class CameraLog : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run_ = std::make_unique<LoggedRun>("0.3", 0.2, [](auto& files) { files.scene_more = camera; });
  }
  static void TearDownTestSuite() { run_.reset(); }
  void SetUp() override {
    std::string why;
    if (!render::OffscreenContext::create(why)) GTEST_SKIP() << why;
  }
  template <ros::Message M>
  static std::vector<M> all(const std::string& topic) {
    std::vector<M> messages;
    mcap::read(run_->log_file(), [&](const mcap::Message& m) {
      if (m.channel.topic != topic) return;
      const auto read = ros::from_cdr<M>(m.data);
      EXPECT_TRUE(read) << topic;
      messages.push_back(*read);
    });
    return messages;
  }
  static std::unique_ptr<LoggedRun> run_;
};
std::unique_ptr<LoggedRun> CameraLog::run_;

float number_at(const std::vector<std::uint8_t>& data, std::size_t at) {
  float value = 0.0F;
  std::memcpy(&value, data.data() + at, sizeof value);
  return value;
}

TEST_F(CameraLog, TellsEachPictureWhenItIsDue) {
  const auto images = all<ros::Image>("/side_view/image");
  ASSERT_EQ(images.size(), 5U);  // at 0, 0.05, ... 0.2 s
  EXPECT_EQ(images[0].encoding, "rgb8");
  EXPECT_EQ(images[0].header.frame_id, "side_view_optical_frame");
  EXPECT_EQ(images[0].data.size(), 256U * 192U * 3U);
  EXPECT_NEAR(ros::seconds_of(images[3].header.stamp), 0.15, 1e-9);
  EXPECT_EQ(all<ros::Image>("/side_view/depth_image").size(), 5U);
  EXPECT_EQ(all<ros::PointCloud2>("/side_view/points").size(), 5U);
  EXPECT_EQ(all<ros::Image>("/side_view/instances")[0].encoding, "16UC1");
  EXPECT_TRUE(all<ros::Image>("/side_view/classes").empty());
}

TEST_F(CameraLog, DepthsAndPointsLieOnThings) {
  const auto info = all<ros::CameraInfo>("/side_view/camera_info").at(0);
  EXPECT_NEAR(info.k[4], 96.0 / std::tan(0.4), 1e-9);
  EXPECT_EQ(info.k[2], 128.0);
  EXPECT_EQ(info.p[5], info.k[4]);
  const auto depth = all<ros::Image>("/side_view/depth_image").at(0);
  const auto cloud = all<ros::PointCloud2>("/side_view/points").at(0);
  ASSERT_EQ(cloud.point_fields.size(), 4U);
  EXPECT_EQ(cloud.point_fields[3].field, "rgb");
  // From the message's frame to the world, as /tf says.
  const auto log = discrepancy::read_log(run_->log_file());
  const Pose camera_pose =
      discrepancy::frame_at(log, "side_view_optical_frame", "world", 0.0, false);
  EXPECT_LT((camera_pose.position - Vec3(0.4, -0.7, 0.3)).norm(), 1e-9);
  int on_stem = 0;
  for (std::size_t i = 0; i < 256U * 192U; ++i) {
    const std::size_t at = i * cloud.point_step;
    const Vec3 p(number_at(cloud.data, at), number_at(cloud.data, at + 4),
                 number_at(cloud.data, at + 8));
    const float d = number_at(depth.data, 4 * i);
    ASSERT_EQ(std::isfinite(d), !p.hasNaN());
    if (p.hasNaN()) continue;
    EXPECT_EQ(p.z(), static_cast<double>(d));
    const Vec3 w = camera_pose * p;
    if (std::abs(w.y() - 0.3) < 0.006 && w.z() > 0.32 && w.z() < 0.58) {
      ++on_stem;
      EXPECT_NEAR(w.x(), 0.4, 0.02) << "only the stem is there";
    }
  }
  EXPECT_GT(on_stem, 5);
}

TEST_F(CameraLog, HasTheScenesImusWithTheirFrames) {
  const auto pad = all<ros::Imu>("/pad/imu");
  ASSERT_GE(pad.size(), 10U);
  EXPECT_EQ(pad.back().header.frame_id, "pad/imu");
  EXPECT_NEAR(pad.back().linear_acceleration.z, 9.81, 1e-3);
  const auto frames = all<ros::TFMessage>("/tf");
  EXPECT_TRUE(std::ranges::any_of(frames, [](const ros::TFMessage& message) {
    return std::ranges::any_of(message.transforms, [](const ros::TransformStamped& one) {
      return one.child_frame_id == "pad/imu" && one.header.frame_id == "world";
    });
  }));
}

TEST_F(CameraLog, HasTheScenesForceSensorsToo) {
  const auto pad = all<ros::WrenchStamped>("/pad/wrench");
  ASSERT_GE(pad.size(), 10U);
  EXPECT_EQ(pad.back().header.frame_id, "finger");
  EXPECT_NEAR(pad.back().wrench.force.z, -0.05 * 9.81, 0.02) << "the finger's weight";
}

}  // namespace
}  // namespace pedicel::app
