#include "engine/io/described_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pedicel::io {
namespace {

using testing::HasSubstr;

const KeyList& place_list() {
  static const KeyList keys{
      "place", "a place", {{.name = "at", .unit = "1", .otherwise = 0.5, .bounds = fraction}}};
  return keys;
}

const KeyList& thing_list() {
  static const KeyList keys{
      "thing",
      "a thing",
      {{.name = "size", .unit = "m", .bounds = positive},
       {.name = "count", .type = KeyType::whole, .otherwise = 3.0, .bounds = {1, 9}},
       {.name = "kind", .type = KeyType::word, .otherwise = "round", .words = {"round", "flat"}},
       {.name = "way", .type = KeyType::vector, .otherwise = Vec3(0, 0, 1)},
       {.name = "own", .type = KeyType::text, .otherwise = Told{"none"}},
       {.name = "end", .unit = "m", .otherwise = Told{"none"}, .bounds = positive}},
      "",
      {&place_list()}};
  return keys;
}

TEST(DescribedMap, TakesDefaultsFromTheDescription) {
  Diagnostics diagnostics;
  DescribedMap map(parse_yaml("{size: 2}", "f", diagnostics), thing_list());
  EXPECT_EQ(map.number("size"), 2.0);
  EXPECT_EQ(map.integer("count"), 3);
  EXPECT_EQ(map.choice("kind"), "round");
  EXPECT_EQ(map.vector("way"), Vec3(0, 0, 1));
  EXPECT_EQ(map.text("own"), "");
  EXPECT_EQ(map.optional_number("end"), std::nullopt);
  EXPECT_EQ(map.number("at"), 0.5);  // of the list that stands in the map, too
  map.finish();
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
}

TEST(DescribedMap, TakesBoundsWordsAndNamesFromTheDescription) {
  Diagnostics diagnostics;
  DescribedMap map(parse_yaml("{count: 10, kind: long, end: 0, at: 2, other: 1}", "f", diagnostics),
                   thing_list());
  map.number("size");
  map.integer("count");
  map.choice("kind");
  map.optional_number("end");
  map.number("at");
  map.finish();
  for (const char* said :
       {"missing key \"size\", expected in a thing",
        "count is \"10\", expected a whole number between 1 and 9",
        "kind is \"long\", expected one of: round, flat", "end is \"0\", expected a number > 0",
        "at is \"2\", expected a number between 0 and 1",
        "unknown key \"other\" in a thing, expected one of: at, count, end, kind, size"})
    EXPECT_THAT(diagnostics.text(), HasSubstr(said));
  EXPECT_EQ(diagnostics.error_count(), 6);
}

TEST(DescribedMapDeathTest, AKeyWithoutADescriptionCannotBeRead) {
  Diagnostics diagnostics;
  DescribedMap map(parse_yaml("{size: 2, new: 1}", "f", diagnostics), thing_list());
  EXPECT_DEATH(map.number("new"), "found");
  EXPECT_DEATH(map.optional("new"), "found");
  EXPECT_DEATH(map.text("size"), "described.type");
}

}  // namespace
}  // namespace pedicel::io
