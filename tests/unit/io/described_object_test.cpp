#include "engine/io/described_object.h"

#include <gtest/gtest.h>

namespace pedicel::io {
namespace {

const KeyList& result_list() {
  static const KeyList keys{
      "result",
      "a result",
      {{.name = "is", .type = KeyType::word, .words = {"good", "bad"}},
       {.name = "size", .unit = "m"},
       {.name = "note", .type = KeyType::text, .otherwise = Told{"where there is none"}}}};
  return keys;
}

TEST(DescribedObject, StandsInTheOrderInWhichItIsSet) {
  DescribedObject object(result_list());
  object.set("size", 0.5).set("is", "good").set_other("own", 1);
  EXPECT_EQ(object.json().dump(), R"({"size":0.5,"is":"good","own":1})");
  EXPECT_EQ(DescribedObject(result_list()).set("size", nullptr).set("is", "bad").json().dump(),
            R"({"size":null,"is":"bad"})");
}

TEST(DescribedObjectDeathTest, WhatIsNotDescribedCannotBeWritten) {
  DescribedObject object(result_list());
  EXPECT_DEATH(object.set("new", 1), "key");
  EXPECT_DEATH(object.set("is", "fair"), "fits");
  EXPECT_DEATH(object.set("size", "large"), "fits");
  object.set("size", 1.0);
  EXPECT_DEATH(object.json(), "contains");
}

}  // namespace
}  // namespace pedicel::io
