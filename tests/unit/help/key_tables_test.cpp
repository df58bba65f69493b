// The manual's tables of keys are those that the program writes.
#include "app/help/key_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"
#include "engine/io/key.h"
#include "tests/support/places.h"

namespace pedicel::app {
namespace {

using testing::HasSubstr;

std::string text_of(const std::string& page) {
  return io::read_file(pedicel::test::source_folder() / ("assets/manual/" + page + ".md"));
}

TEST(KeyTables, PagesAreAsTheProgramWritesThem) {
  for (const std::string& page : pages_of_keys()) {
    const std::string text = text_of(page);
    EXPECT_EQ(with_key_tables(page, text), text)
        << page << ".md: write it anew by build/release/pedicel manual --rewrite assets/manual";
  }
}

TEST(KeyTables, EveryKeyHasWhatItsRowNeeds) {
  for (const std::string& page : pages_of_keys())
    for (const io::KeyList* list : keys_of_page(page)) {
      EXPECT_FALSE(list->keys.empty()) << list->name;
      for (const io::Key& key : list->keys) {
        EXPECT_FALSE(key.sentence.empty()) << page << ": " << key.name << " of " << list->name;
        if (key.type == io::KeyType::number) {
          EXPECT_FALSE(key.unit.empty()) << page << ": " << key.name << " of " << list->name;
        }
        if (key.type == io::KeyType::word) {
          EXPECT_FALSE(key.words.empty()) << page << ": " << key.name << " of " << list->name;
        }
      }
    }
}

TEST(KeyTables, ARowSaysTypeUnitDefaultBoundsAndSentence) {
  const io::KeyList list{"thing",
                         "a thing",
                         {{.name = "size",
                           .unit = "m",
                           .otherwise = 0.5,
                           .bounds = io::positive,
                           .form = "below `length`",
                           .sentence = "how wide it is."},
                          {.name = "kind",
                           .type = io::KeyType::word,
                           .otherwise = "round",
                           .words = {"round", "flat"},
                           .sentence = "its shape"}},
                         "part"};
  EXPECT_EQ(key_table({&list}),
            "| key | type | unit | default | bounds | what it is |\n"
            "|---|---|---|---|---|---|\n"
            "| `size` (in `part`) | number | m | 0.5 | above 0, below `length` | how wide it is |\n"
            "| `kind` (in `part`) | word | | `round` | `round`, `flat` | its shape |\n");
}

TEST(KeyTables, OfAWrittenFileARowSaysWhenItsKeyIsAbsent) {
  const io::KeyList list{"thing",
                         "a thing",
                         {{.name = "size", .unit = "m", .sentence = "how wide it is"},
                          {.name = "kind",
                           .type = io::KeyType::word,
                           .otherwise = io::Told{"of a point"},
                           .words = {"round", "flat"},
                           .sentence = "its shape"}}};
  EXPECT_EQ(key_table({&list}, KeysOf::written_file),
            "| key | type | unit | absent | values | what it is |\n"
            "|---|---|---|---|---|---|\n"
            "| `size` | number | m | | | how wide it is |\n"
            "| `kind` | word | | of a point | `round`, `flat` | its shape |\n");
}

std::string fault_of(const std::string& text) {
  try {
    with_key_tables("scene_file", text);
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return "";
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = text_of("scene_file");
  return text.replace(text.find(from), from.size(), to);
}

TEST(KeyTables, APageWithAWrongRowOrMarkIsSeen) {
  const std::string page = text_of("scene_file");
  EXPECT_EQ(with_key_tables("scene_file", changed("above 0", "above 1")), page);
  EXPECT_EQ(with_key_tables("scene_file", changed("| `ground` |", "| `soil` |")), page);
  EXPECT_EQ(fault_of(page), "");
  EXPECT_THAT(fault_of(changed("<!-- keys: ground -->", "")),
              HasSubstr("the keys \"ground\" are missing"));
  EXPECT_THAT(fault_of(changed("<!-- keys: ground -->", "<!-- keys: soil -->")),
              HasSubstr("the program has no keys \"soil\""));
  EXPECT_THAT(fault_of(changed("<!-- keys: ground -->", "<!-- keys: body -->")),
              HasSubstr("the keys \"body\" stand there twice"));
  EXPECT_THAT(fault_of(page + "<!-- keys: scene -->\n"), HasSubstr("has no end"));
}

}  // namespace
}  // namespace pedicel::app
