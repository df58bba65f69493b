// Bags put together byte by byte after the format's description.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "engine/core/diagnostics.h"
#include "engine/ros_messages/ros1.h"
#include "engine/ros_messages/sensor_messages.h"
#include "engine/rosbag/reader.h"

namespace pedicel::rosbag {
namespace {

using mcap::Bytes;
using ::testing::HasSubstr;

std::string field(const std::string& name, const std::string& value) {
  return Bytes().text(name + "=" + value).all();
}
template <class T>
std::string number(T value) {
  return Bytes().number(value).all();
}
std::string record(unsigned char op, const std::string& fields, const std::string& content) {
  return Bytes().text(field("op", number(op)) + fields).text(content).all();
}
std::string bag_head(std::uint64_t index = 4711, const std::string& more = "") {
  return record(3, field("index_pos", number(index)) + more, std::string(20, ' '));
}
std::string connection(std::uint32_t id, const std::string& topic, const std::string& type) {
  return record(
      7, field("conn", number(id)) + field("topic", topic),
      field("topic", topic) + field("type", type) + field("message_definition", "int8 a"));
}
std::string message(std::uint32_t id, std::uint32_t sec, std::uint32_t nsec,
                    const std::string& data) {
  return record(2, field("conn", number(id)) + field("time", number(sec) + number(nsec)), data);
}
std::string chunk(const std::string& records, const std::string& compression = "none",
                  std::uint32_t size = 0) {
  return record(5,
                field("compression", compression) +
                    field("size", number(size ? size : static_cast<std::uint32_t>(records.size()))),
                records);
}
const std::string version = "#ROSBAG V2.0\n";

struct Read {
  mcap::ReadEnd end;
  std::vector<std::string> told;
};
Read read_text(const std::string& bytes) {
  std::istringstream file(bytes);
  Read out;
  out.end = read(file, "a.bag", [&](const mcap::Message& m) {
    out.told.push_back(m.channel.topic + " " + m.schema.name + " " + std::to_string(m.log_time) +
                       " " + std::string(m.data));
  });
  return out;
}
std::string fault(const std::string& bytes) {
  try {
    read_text(bytes);
  } catch (const InvalidFile& invalid) {
    return invalid.what();
  }
  return "";
}

const std::string good = version + bag_head() +
                         chunk(connection(0, "/a", "std_msgs/String") + message(0, 2, 5, "one") +
                               connection(3, "/tf", "tf/tfMessage") + message(3, 2, 6, "two")) +
                         record(4, "", "index") + connection(0, "/a", "std_msgs/String");

TEST(Rosbag, HandsOutMessagesWithTheirTypes) {
  const Read read = read_text(good);
  EXPECT_TRUE(read.end.whole);
  EXPECT_THAT(read.told, ::testing::ElementsAre("/a std_msgs/msg/String 2000000005 one",
                                                "/tf tf2_msgs/msg/TFMessage 2000000006 two"));
}

TEST(Rosbag, ReadsWhatIsWholeOfABagThatWasCutOff) {
  const Read read = read_text(good.substr(0, good.size() - 4));
  EXPECT_FALSE(read.end.whole);
  EXPECT_EQ(read.told.size(), 2U);
  // A recorder that was killed has not written where its index is.
  EXPECT_FALSE(read_text(version + bag_head(0)).end.whole);
}

TEST(Rosbag, RefusesWhatIsNoBag) {
  EXPECT_THAT(fault("hello"), HasSubstr("a.bag: error: at byte 0: no bag of ROS 1, expected"));
  EXPECT_THAT(fault("#ROSBAG V1.2\nxx"), HasSubstr("another version, expected 2.0"));
  EXPECT_THAT(fault(version + bag_head(9, field("encryptor", "rosbag/AesCbcEncryptor"))),
              HasSubstr("encrypted"));
  EXPECT_THAT(fault(version + Bytes().text("abc").text("").all()), HasSubstr("head that is none"));
  EXPECT_THAT(fault(version + Bytes().text(field("a", "b")).text("").all()),
              HasSubstr("without op"));
  EXPECT_THAT(fault(version + message(5, 0, 0, "")),
              HasSubstr("a message of a connection that is not there"));
  EXPECT_THAT(fault(version + chunk("abc")), HasSubstr("goes on behind the chunk's end"));
  EXPECT_THAT(fault(version + chunk("abcd", "none", 9)), HasSubstr("its head says 9"));
  EXPECT_THAT(fault(version + chunk("abcd", "bz2", 9)), HasSubstr("chunk"));
  EXPECT_THAT(fault(version + chunk("abcd", "lz4", 9)), HasSubstr("chunk"));
  EXPECT_THAT(fault(version + chunk("abcd", "zip", 9)), HasSubstr("expected none, bz2 or lz4"));
  EXPECT_THAT(fault(version + chunk("abcd", "bz2", 4000000000U)), HasSubstr("expected at most"));
}

TEST(Rosbag, MessagesOfRos1HaveACounterInTheirHeader) {
  const std::string bytes = Bytes()
                                .number(std::uint32_t{77})
                                .number(std::uint32_t{5})
                                .number(std::uint32_t{250000000})
                                .text("base")
                                .number(std::uint32_t{1})
                                .text("turn")
                                .number(std::uint32_t{1})
                                .number(0.5)
                                .number(std::uint32_t{0})
                                .number(std::uint32_t{0})
                                .all();
  const auto state = ros::from_ros1<ros::JointState>(bytes);
  ASSERT_TRUE(state);
  EXPECT_EQ(ros::seconds_of(state->header.stamp), 5.25);
  EXPECT_EQ(state->header.frame_id, "base");
  EXPECT_EQ(state->names, std::vector<std::string>{"turn"});
  EXPECT_EQ(state->position, std::vector<double>{0.5});
  for (std::size_t cut = 0; cut < bytes.size(); ++cut)
    EXPECT_FALSE(ros::from_ros1<ros::JointState>(bytes.substr(0, cut))) << cut;
}

}  // namespace
}  // namespace pedicel::rosbag
