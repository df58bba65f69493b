#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/yaml.h"

namespace pedicel::io {
namespace {

using testing::HasSubstr;

TEST(YamlMap, ReadsEveryKindAndItsDefaults) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("n: 2.5\ni: 3\nb: true\nt: stem\nc: rest\nv: [1, 2, 3]\n"
                         "q: [0, 0, 0, 1]\nl: [1, 2]\n",
                         "f", diagnostics),
              "a test");
  EXPECT_EQ(map.number("n", positive), 2.5);
  EXPECT_EQ(map.number("absent", positive, 7.0), 7.0);
  EXPECT_EQ(map.integer("i", 0, 9, 1), 3);
  EXPECT_EQ(map.integer("absent", 0, 9, 1), 1);
  EXPECT_TRUE(map.boolean("b", false));
  EXPECT_EQ(map.text("t"), "stem");
  EXPECT_EQ(map.text("absent", "leaf"), "leaf");
  EXPECT_EQ(map.choice("c", {"drawn", "rest"}, "drawn"), "rest");
  EXPECT_EQ(map.choice("absent", {"drawn", "rest"}, "drawn"), "drawn");
  EXPECT_EQ(map.vector("v"), Vec3(1, 2, 3));
  EXPECT_EQ(map.vector("absent", Vec3::UnitX()), Vec3::UnitX());
  EXPECT_EQ(map.quaternion("q", Quat::Identity()).w(), 1.0);
  EXPECT_EQ(map.list("l").size(), 2u);
  EXPECT_TRUE(map.list("absent").empty());
  map.finish();
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
}

TEST(YamlMap, UnknownKeyListsWhatWasExpected) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("radius: 1\nradus: 2\n", "f", diagnostics), "a fruit");
  map.number("radius", positive);
  map.optional("density");
  map.finish();
  EXPECT_EQ(diagnostics.text(),
            "f:2:1: error: unknown key \"radus\" in a fruit, expected one of: density, radius");
}

TEST(YamlMap, MissingKeyIsSaidOnceAndReadingGoesOn) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("a: 1\n", "f", diagnostics), "a fruit");
  EXPECT_EQ(map.number("radius", positive), 0.0);
  EXPECT_EQ(map.number("a", any_number), 1.0);
  EXPECT_EQ(diagnostics.text(), "f:1:1: error: missing key \"radius\", expected in a fruit");
}

TEST(YamlMap, WhatIsNoMapIsSaidOnce) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("[1]", "f", diagnostics), "a fruit");
  map.number("radius", positive);
  map.finish();
  EXPECT_EQ(diagnostics.text(), "f:1:1: error: a fruit is a list, expected a map");
}

bool checked(const std::string& text, std::string& complaint) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml(text, "f", diagnostics), "a plant");
  const bool good = check_format(map, "pedicel-plant", 1);
  complaint = diagnostics.text();
  return good;
}

TEST(CheckFormat, TakesTheRightOneOnly) {
  std::string complaint;
  EXPECT_TRUE(checked("format: pedicel-plant\nversion: 1\n", complaint));
  EXPECT_EQ(complaint, "");
  EXPECT_FALSE(checked("format: pedicel-scene\nversion: 1\n", complaint));
  EXPECT_EQ(complaint, "f:1:9: error: format is \"pedicel-scene\", expected pedicel-plant");
  EXPECT_FALSE(checked("format: pedicel-plant\nversion: 2\n", complaint));
  EXPECT_EQ(complaint, "f:2:10: error: version is 2, expected 1");
  EXPECT_FALSE(checked("version: 1\n", complaint));
  EXPECT_THAT(complaint, HasSubstr("missing key \"format\""));
  EXPECT_FALSE(checked("format: pedicel-plant\n", complaint));
  EXPECT_THAT(complaint, HasSubstr("missing key \"version\""));
  EXPECT_FALSE(checked("format: pedicel-plant\nversion: one\n", complaint));
  EXPECT_THAT(complaint, HasSubstr("version is \"one\", expected a whole number"));
}

}  // namespace
}  // namespace pedicel::io
