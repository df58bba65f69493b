// Messages as bytes: the bytes of the OMG's CDR, worked out by hand, and back.
#include "engine/ros_messages/cdr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/ros_messages/control_messages.h"
#include "engine/ros_messages/marker_messages.h"

namespace pedicel::ros {
namespace {

using ::testing::ElementsAre;

/// "00 01 00 00": hexadecimal pairs as bytes.
std::string bytes(const std::string& pairs) {
  std::string all;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 3)
    all.push_back(static_cast<char>(std::stoi(pairs.substr(i, 2), nullptr, 16)));
  return all;
}

TEST(Cdr, ATextHasItsLengthAndItsZero) {
  String hello;
  hello.data = "hi";
  EXPECT_EQ(to_cdr(hello), bytes("00 01 00 00 03 00 00 00 68 69 00"));
}

TEST(Cdr, NumbersStandAtMultiplesOfTheirSizeBehindTheHeader) {
  JointState state;
  state.header.stamp = {1, 2};
  state.names = {"a"};
  state.position = {1.0};
  // 4 + 4 stamp, 4 + 1 empty text, 3 to the next multiple of 4, 4 count, 4 + 2 text, 2, 4 count,
  // 0 to the next multiple of 8 (32), 8; two empty sequences.
  EXPECT_EQ(to_cdr(state), bytes("00 01 00 00 01 00 00 00 02 00 00 00 01 00 00 00 00 00 00 00 "
                                 "01 00 00 00 02 00 00 00 61 00 00 00 01 00 00 00 "
                                 "00 00 00 00 00 00 F0 3F 00 00 00 00 00 00 00 00"));
}

TEST(Cdr, EverythingReadsBack) {
  Marker marker;
  marker.header = {{12, 34}, "world"};
  marker.ns = "truss";
  marker.id = -7;
  marker.scale = {0.5, 0.25, 0.125};
  marker.frame_locked = true;
  marker.points = {{1, 2, 3}, {4, 5, 6}};
  marker.colors = {{0.1F, 0.2F, 0.3F, 1.0F}};
  marker.text = "x";
  marker.mesh_file.data = {1, 2, 3};
  marker.mesh_use_embedded_materials = true;
  const auto back = from_cdr<MarkerArray>(to_cdr(MarkerArray{{marker, marker}}));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->markers.size(), 2U);
  EXPECT_EQ(to_cdr(back->markers[1]), to_cdr(marker));
}

TEST(Cdr, BigEndianIsTurned) {
  const auto clock = from_cdr<Clock>(bytes("00 00 00 00 00 00 00 05 00 00 01 00"));
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->clock.sec, 5);
  EXPECT_EQ(clock->clock.nanosec, 256U);
  const auto value = from_cdr<InterfaceValue>(
      bytes("00 00 00 00 00 00 00 00 00 00 00 01 3F F0 00 00 00 00 00 00"));
  ASSERT_TRUE(value);
  EXPECT_THAT(value->values, ElementsAre(1.0));
}

TEST(Cdr, WhatIsNoMessageIsRefused) {
  const std::string good = to_cdr(JointState{{{1, 2}, "w"}, {"a", "b"}, {1, 2}, {3, 4}, {5, 6}});
  ASSERT_TRUE(from_cdr<JointState>(good));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(from_cdr<JointState>(std::string_view(good).substr(0, size))) << size;
  std::string other = good;
  other[1] = 7;  // another kind of CDR
  EXPECT_FALSE(from_cdr<JointState>(other));
  // Four billion names, four billion numbers: no memory is taken for them.
  EXPECT_FALSE(from_cdr<InterfaceValue>(bytes("00 01 00 00 FF FF FF FF 00 00 00 00")));
  EXPECT_FALSE(from_cdr<InterfaceValue>(bytes("00 01 00 00 00 00 00 00 FF FF FF FF")));
  // A text without its closing zero.
  EXPECT_FALSE(from_cdr<String>(bytes("00 01 00 00 02 00 00 00 68 69")));
}

TEST(Cdr, TimesAreNanosecondsBothWays) {
  EXPECT_EQ(stamp_of(1.5).sec, 1);
  EXPECT_EQ(stamp_of(1.5).nanosec, 500000000U);
  EXPECT_EQ(stamp_of(-0.25).sec, -1);
  EXPECT_EQ(stamp_of(-0.25).nanosec, 750000000U);
  EXPECT_EQ(stamp_of(0.9999999999).sec, 1);
  EXPECT_EQ(stamp_of(0.9999999999).nanosec, 0U);
  EXPECT_DOUBLE_EQ(seconds_of(stamp_of<Duration>(-0.25)), -0.25);
}

}  // namespace
}  // namespace pedicel::ros
