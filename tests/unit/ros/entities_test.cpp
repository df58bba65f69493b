// Filters of entities: what they leave, and those that would take all memory or all time.
#include "app/ros/entities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pedicel::app {
namespace {

using ::testing::ElementsAre;

/// The names that a filter leaves; "refused N" where it is refused with that code.
std::vector<std::string> left_by(const std::string& expression,
                                 std::vector<std::uint8_t> categories = {}) {
  std::vector<Entity> all;
  for (const char* name : {"arm", "truss", "truss/fruit_1", "truss/fruit_12", "a+b"})
    all.push_back({name, ros::EntityCategory::object, {}});
  all[0].category = ros::EntityCategory::robot;
  ros::EntityFilters filters;
  filters.filter = expression;
  for (const std::uint8_t one : categories) filters.categories.push_back({one});
  ros::SimulationResult result;
  const auto left = filtered(all, filters, result);
  if (!left) return {"refused " + std::to_string(result.result)};
  std::vector<std::string> names;
  for (const Entity& entity : *left) names.push_back(entity.name);
  return names;
}

TEST(EntityFilter, IsOfTheWholeName) {
  EXPECT_EQ(left_by("").size(), 5U);
  EXPECT_THAT(left_by("truss"), ElementsAre("truss"));
  EXPECT_THAT(left_by("truss/fruit_[0-9]+"), ElementsAre("truss/fruit_1", "truss/fruit_12"));
  EXPECT_THAT(left_by("(truss/)?fruit_[^]2]{1,3}"), ElementsAre("truss/fruit_1"));
  EXPECT_THAT(left_by("arm|a\\+b"), ElementsAre("arm", "a+b"));
  EXPECT_THAT(left_by("[[:alpha:]]+"), ElementsAre("arm", "truss"));
  EXPECT_THAT(left_by("", {ros::EntityCategory::robot}), ElementsAre("arm"));
}

TEST(EntityFilter, WhatWouldTakeAllMemoryOrTimeIsRefused) {
  const std::string no = "refused " + std::to_string(ros::SimulationResult::operation_failed);
  EXPECT_THAT(left_by("((("), ElementsAre(no));
  EXPECT_THAT(left_by(std::string(201, 'a')), ElementsAre(no));
  // Each would be written out to more parts than there is memory.
  std::string nested = "a", counted = "a";
  for (int i = 0; i < 60; ++i) nested = "(" + nested + ")+";
  for (int i = 0; i < 20; ++i) counted += "{1,255}";
  EXPECT_THAT(left_by(nested), ElementsAre(no));
  EXPECT_THAT(left_by(counted), ElementsAre(no));
  EXPECT_THAT(left_by("((a{255}){255}){255}"), ElementsAre(no));
  EXPECT_THAT(left_by("(.*)(.*)(.*)(.*)(.*)\\5\\4\\3\\2\\1x"), ElementsAre(no)) << "it looks back";
  EXPECT_THAT(left_by("\\\\1"), ElementsAre()) << "a backslash and a one";
}

}  // namespace
}  // namespace pedicel::app
