// Names of ROS 2 as they stand in DDS.
#include "app/ros/ros_name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/ros/interfaces.h"
#include "engine/core/check.h"

namespace pedicel::app {
namespace {

TEST(RosName, TopicsServicesAndTypes) {
  EXPECT_EQ(dds_topic("/arm/joint_states"), "rt/arm/joint_states");
  EXPECT_EQ(dds_request_topic("/step"), "rq/stepRequest");
  EXPECT_EQ(dds_reply_topic("/step"), "rr/stepReply");
  EXPECT_EQ(dds_type("sensor_msgs/msg/JointState"), "sensor_msgs::msg::dds_::JointState_");
  EXPECT_EQ(dds_type("a/srv/B_Request"), "a::srv::dds_::B_Request_");
}

TEST(RosName, NamespacesLeaveWhatAllNodesShare) {
  EXPECT_EQ(in_namespace("/arm", "/joint_states"), "/arm/joint_states");
  EXPECT_EQ(in_namespace("/arm", "/tf"), "/tf");
  EXPECT_EQ(in_namespace("/arm", "/clock"), "/clock");
  EXPECT_EQ(in_namespace("", "/joint_states"), "/joint_states");
  for (const char* good : {"", "/arm", "/a/b_2", "/_x"}) EXPECT_TRUE(is_namespace(good)) << good;
  for (const char* bad : {"arm", "/", "/arm/", "/a//b", "/2a", "/a-b", "/a b", "/\xc3\xa4"})
    EXPECT_FALSE(is_namespace(bad)) << bad;
}

TEST(Interfaces, AreFoundByNameAndByAddress) {
  EXPECT_EQ(address_of_interface("lo"), "127.0.0.1");
  EXPECT_EQ(address_of_interface("127.0.0.1"), "127.0.0.1");
  try {
    address_of_interface("10.255.255.254");
    FAIL() << "expected it to be refused";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("no interface of this machine, expected 127.0.0.1"));
  }
}

}  // namespace
}  // namespace pedicel::app
