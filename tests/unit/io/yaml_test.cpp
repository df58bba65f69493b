#include "engine/io/yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Reads one value written after "v: " and gives the complaint, empty where there is none.
template <class Read>
std::string complaint(const std::string& value, const Read& read) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("v: " + value + "\n", "f", diagnostics), "a test");
  const auto node = map.required("v");
  if (node) read(*node);
  return diagnostics.text();
}

std::string number_complaint(const std::string& value, const Bounds& bounds = any_number) {
  return complaint(value, [&](const YamlNode& node) { node.number("v", bounds); });
}

TEST(YamlNumber, TakesEveryWayToWriteOne) {
  Diagnostics diagnostics;
  const YamlNode root = parse_yaml("[1, -2.5, 5e+08, 5E8, +3, .5, 1., 1e-3]", "f", diagnostics);
  EXPECT_THAT(root.numbers("v"), ElementsAre(1, -2.5, 5e8, 5e8, 3, 0.5, 1, 1e-3));
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
}

TEST(YamlNumber, SaysWhatWasExpected) {
  EXPECT_EQ(number_complaint("abc"), "f:1:4: error: v is \"abc\", expected a finite number");
  EXPECT_EQ(number_complaint("0", positive), "f:1:4: error: v is \"0\", expected a number > 0");
  EXPECT_EQ(number_complaint("-1", not_negative),
            "f:1:4: error: v is \"-1\", expected a number >= 0");
  EXPECT_EQ(number_complaint("1.1", fraction),
            "f:1:4: error: v is \"1.1\", expected a number between 0 and 1");
  EXPECT_EQ(number_complaint("[1]"), "f:1:4: error: v is a list, expected a finite number");
  EXPECT_EQ(number_complaint("{a: 1}"), "f:1:4: error: v is a map, expected a finite number");
  EXPECT_EQ(number_complaint("0", not_negative), "");
  EXPECT_EQ(number_complaint("1", fraction), "");
}

TEST(YamlNumber, RefusesWhatIsNoNumber) {
  for (const char* text : {".nan", ".inf", "-.inf", "nan", "inf", "\"1\"", "'1'", "1m", "0x10",
                           "1,5", "~", "1e999", "+-1", "++1", "true"})
    EXPECT_THAT(number_complaint(text), HasSubstr("expected a finite number")) << text;
}

TEST(YamlInteger, WholeNumbersInRange) {
  const auto of = [](const std::string& text) {
    return complaint(text, [](const YamlNode& node) { node.integer("v", 1, 9); });
  };
  EXPECT_EQ(of("9"), "");
  for (const char* text : {"0", "10", "1.5", "x", "1e10"})
    EXPECT_THAT(of(text), HasSubstr("expected a whole number between 1 and 9")) << text;
}

TEST(YamlBoolean, OnlyTrueAndFalse) {
  const auto of = [](const std::string& text) {
    return complaint(text, [](const YamlNode& node) { node.boolean("v"); });
  };
  EXPECT_EQ(of("true"), "");
  EXPECT_EQ(of("false"), "");
  for (const char* text : {"yes", "1", "True", "[true]"})
    EXPECT_THAT(of(text), HasSubstr("expected true or false")) << text;
}

TEST(YamlText, RefusesListsAndNothing) {
  const auto of = [](const std::string& text) {
    return complaint(text, [](const YamlNode& node) { node.text("v"); });
  };
  EXPECT_EQ(of("stem"), "");
  EXPECT_EQ(of("[a]"), "f:1:4: error: v is a list, expected a text");
  EXPECT_THAT(of("\"\""), HasSubstr("expected a text"));
}

TEST(YamlChoice, ListsTheWords) {
  const auto read = [](const YamlNode& node) { node.choice("v", {"drawn", "rest"}); };
  EXPECT_EQ(complaint("rest", read), "");
  EXPECT_EQ(complaint("hung", read), "f:1:4: error: v is \"hung\", expected one of: drawn, rest");
}

TEST(YamlVector, ThreeFiniteNumbers) {
  const auto read = [](const YamlNode& node) { node.vector("v"); };
  EXPECT_EQ(complaint("[0, 0, 1]", read), "");
  EXPECT_EQ(complaint("[0, 0]", read), "f:1:4: error: v is a list of 2, expected [x, y, z]");
  EXPECT_EQ(complaint("5", read), "f:1:4: error: v is \"5\", expected [x, y, z]");
  EXPECT_THAT(complaint("[0, .nan, 0]", read), HasSubstr("f:1:8: error"));
}

TEST(YamlQuaternion, IsReadXyzwAndNormalised) {
  Diagnostics diagnostics;
  const Quat q = parse_yaml("[0, 0, 3, 4]", "f", diagnostics).quaternion("v");
  EXPECT_NEAR(q.z(), 0.6, 1e-15);
  EXPECT_NEAR(q.w(), 0.8, 1e-15);
  const auto read = [](const YamlNode& node) { node.quaternion("v"); };
  EXPECT_THAT(complaint("[0, 0, 0, 0]", read), HasSubstr("v has length 0, expected a rotation"));
  EXPECT_THAT(complaint("[0, 0, 1]", read), HasSubstr("expected [x, y, z, w]"));
}

TEST(YamlList, SaysWhatIsThereInstead) {
  EXPECT_EQ(complaint("3", [](const YamlNode& node) { node.list("v"); }),
            "f:1:4: error: v is \"3\", expected a list");
}

TEST(YamlFile, PositionsCountFromOneInLongFiles) {
  Diagnostics diagnostics;
  YamlMap map(parse_yaml("# comment\na: 1\nb:\n  - {c: x}\n", "g.yaml", diagnostics), "a test");
  map.optional("a");
  const auto list = map.list("b");
  ASSERT_EQ(list.size(), 1u);
  YamlMap(list[0], "an item").number("c", any_number);
  EXPECT_EQ(diagnostics.text(), "g.yaml:4:9: error: c is \"x\", expected a finite number");
}

TEST(YamlFile, BrokenYamlNamesThePlace) {
  Diagnostics diagnostics;
  EXPECT_THAT([&] { parse_yaml("a: [1, 2\nb: 3\n", "f", diagnostics); },
              ThrowsMessage<InvalidFile>(HasSubstr("error: not valid YAML: ")));
  EXPECT_THAT([&] { load_yaml("/no/such/file.yaml", diagnostics); },
              ThrowsMessage<InvalidFile>(HasSubstr("cannot be read: No such file")));
}

TEST(YamlFile, DuplicateKeysAreErrorsAtAnyDepth) {
  Diagnostics diagnostics;
  parse_yaml("a: 1\nb:\n  - c: 1\n    c: 2\n", "f", diagnostics);
  EXPECT_EQ(diagnostics.text(), "f:4:5: error: key \"c\" appears twice, expected once");
}

// Aliases can say in a few lines what no memory holds.
TEST(YamlFile, RefusesWhatAliasesMakeEndless) {
  Diagnostics diagnostics;
  const auto parse = [&](const std::string& text) { parse_yaml(text, "f", diagnostics); };
  EXPECT_THAT([&] { parse("a: &a [*a]\n"); },
              ThrowsMessage<InvalidFile>(HasSubstr("nested more than 100 deep")));
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 10; ++i) {
    const std::string above = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + above;
    for (int k = 1; k < 9; ++k) bomb += ", " + above;
    bomb += "]\n";
  }
  EXPECT_THAT([&] { parse(bomb); },
              ThrowsMessage<InvalidFile>(HasSubstr("values with aliases written out")));
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(YamlFile, IsAtMostFourMegabytes) {
  Diagnostics diagnostics;
  EXPECT_THAT(
      [&] { parse_yaml(std::string(9 << 20, ' '), "f", diagnostics); },
      ThrowsMessage<InvalidFile>(HasSubstr("f: error: has 9 MB of YAML, expected at most 4 MB")));
}

TEST(YamlFile, SaysThatAKeyIsNoName) {
  Diagnostics diagnostics;
  parse_yaml("{[1, 2]: 3}\n", "f", diagnostics);
  EXPECT_EQ(diagnostics.text(), "f:1:2: error: a key that is no text, expected a name");
}

}  // namespace
}  // namespace pedicel::io
