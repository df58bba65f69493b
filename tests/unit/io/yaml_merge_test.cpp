// What changed between two texts is done in a third that says the same in its own way.
#include "engine/io/yaml_merge.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <random>

#include "engine/core/check.h"
#include "engine/io/yaml_text.h"
#include "engine/io/yaml_words.h"

namespace pedicel::io {
namespace {

const char* const text = R"(# by hand
name: plant    # its name
material: &wood {modulus: 2e8, density: 800}   # measured
curves:
  # the trunk
  - name: trunk
    points:
      - [0, 0, 0]      # foot
      - [0, 0, 0.5]    # the kink
      - [0, 0, 1]
    radius: &thin [0.01, 0.008]

  - {name: branch, radius: *thin, material: *wood}   # from its middle
  - name: twig
    material:
      density: 700   # dried
root: [0, 0, 0]
)";

const char* const before =
    "name: plant\nmaterial: {modulus: 2.0e+8, density: 800}\ncurves:\n"
    "  - name: trunk\n    points: [[0, 0, 0], [0, 0, 0.5], [0, 0, 1]]\n    radius: [0.01, 0.008]\n"
    "  - {name: branch, radius: [0.01, 0.008], material: {modulus: 2.0e+8, density: 800}}\n"
    "  - {name: twig, material: {density: 700}}\n"
    "root: [0, 0, 0]\n";

std::string with(std::string of, const std::string& from, const std::string& to) {
  EXPECT_NE(of.find(from), std::string::npos) << from;
  return of.replace(of.find(from), from.size(), to);
}

std::string merged(const std::string& from, const std::string& to) {
  return merge_yaml(text, before, with(before, from, to));
}

TEST(YamlMerge, NothingChangedIsTheSameText) {
  EXPECT_EQ(merge_yaml(text, before, before), text);
}

TEST(YamlMerge, OnePointOfAListInLines) {
  EXPECT_EQ(merged("[0, 0, 0.5]", "[0, 0.1, 0.5]"),
            with(text, "[0, 0, 0.5]    # the kink", "[0, 0.1, 0.5]    # the kink"));
  EXPECT_EQ(merged("[0, 0, 0.5], ", ""), with(text, "      - [0, 0, 0.5]    # the kink\n", ""));
  EXPECT_EQ(merged("[0, 0, 1]]", "[0, 0, 0.8], [0, 0, 1]]"),
            with(text, "      - [0, 0, 1]\n", "      - [0, 0, 0.8]\n      - [0, 0, 1]\n"));
}

TEST(YamlMerge, WhatHasAnAnchorKeepsIt) {
  EXPECT_EQ(merged("material: {modulus: 2.0e+8, density: 800}\ncurves",
                   "material: {modulus: 2.0e+8, density: 650}\ncurves"),
            with(text, "density: 800}   # measured", "density: 650}   # measured"));
}

TEST(YamlMerge, AnAliasThatIsChangedBecomesItsOwn) {
  EXPECT_EQ(merged("material: {modulus: 2.0e+8, density: 800}}",
                   "material: {modulus: 2.0e+8, density: 650}}"),
            with(text, "*wood}   # from", "{modulus: 2e8, density: 650}}   # from"));
}

TEST(YamlMerge, NamedEntriesComeGoAndChangeTheirNames) {
  EXPECT_EQ(merged("  - {name: twig, material: {density: 700}}\n", ""),
            with(text, "  - name: twig\n    material:\n      density: 700   # dried\n", ""));
  EXPECT_EQ(merged("{name: twig, ", "{name: shoot, "), with(text, "name: twig", "name: shoot"));
  EXPECT_EQ(merged("root:", "  - {name: bud, radius: [1, 2]}\nroot:"),
            with(text, "root:", "  - {name: bud, radius: [1, 2]}\nroot:"));
  EXPECT_EQ(merged("root:", "  - name: bud\n    points: [[1, 2, 3]]\nroot:"),
            with(text, "root:", "  - name: bud\n    points: [[1, 2, 3]]\nroot:"));
}

TEST(YamlMerge, KeysComeAndGo) {
  EXPECT_EQ(merged("root: [0, 0, 0]\n", "root: [0, 0, 0]\nfruits:\n  - {name: f, at: 1}\n"),
            std::string(text) + "fruits:\n  - {name: f, at: 1}\n");
  EXPECT_EQ(merged(", material: {density: 700}", ""),
            with(text, "    material:\n      density: 700   # dried\n", ""));
  EXPECT_EQ(merged("root: [0, 0, 0]\n", ""), with(text, "root: [0, 0, 0]\n", ""));
}

TEST(YamlMerge, AnotherOrderIsRefused) {
  const char* const list = "a:\n  - {name: x}\n  - {name: y}\n";
  EXPECT_THROW(merge_yaml(list, list, "a:\n  - {name: y}\n  - {name: x}\n"), UsageError);
}

TEST(YamlText, AMapInLinesBecomesAValueInBrackets) {
  YamlText changed("a:\n  b: 1   # one\n  c: 2\nd: 3\n");
  changed.set({"a"}, "{b: 4}");
  EXPECT_EQ(changed.text(), "a: {b: 4}\nd: 3\n");
}

TEST(YamlText, EntriesAreInsertedInTheirPlace) {
  YamlText lines("a:\n  - 1\n  # two\n  - 2\nb: [1, 2]\n");
  lines.insert({"a"}, 0, "0");
  lines.insert({"a"}, 3, "3");
  lines.insert({"b"}, 1, "1.5");
  EXPECT_EQ(lines.text(), "a:\n  - 0\n  - 1\n  # two\n  - 2\n  - 3\nb: [1, 1.5, 2]\n");
  lines.append({"c"}, "{name: x}");
  EXPECT_TRUE(lines.text().ends_with("c:\n  - {name: x}\n")) << lines.text();
  EXPECT_THROW(lines.insert({"a"}, 9, "9"), UsageError);
}

TEST(YamlNumber, OtherReadersTakeThemForNumbers) {
  EXPECT_EQ(yaml_number(2.0e8), "2.0e+8");
  EXPECT_EQ(yaml_number(-1.0e-5), "-1.0e-5");
  EXPECT_EQ(yaml_number(1.25e-30), "1.25e-30");
  EXPECT_EQ(yaml_number(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(yaml_number(800.0), "800");
  EXPECT_EQ(yaml_number(-0.0), "-0");
}

TEST(YamlNumber, EveryNumberReadsBackToItsBits) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const std::string written = yaml_number(value);
    double read = 0.0;
    std::from_chars(written.data(), written.data() + written.size(), read);
    ASSERT_EQ(read, value) << written;
    const std::size_t power = written.find('e');
    if (power == std::string::npos) continue;
    ASSERT_LT(written.find('.'), power) << written;
    ASSERT_TRUE(written[power + 1] == '+' || written[power + 1] == '-') << written;
  }
}

}  // namespace
}  // namespace pedicel::io
