#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/io/key.h"

namespace pedicel {

/// Texts of files in which a key of a list may stand: at "%". One for each case in which the reader
/// asks for other keys.
using KeyPlaces = std::map<std::string, std::vector<std::string>>;

/// The lists without those of these names, which belong to another kind of the file.
inline std::vector<const io::KeyList*> lists_without(std::vector<const io::KeyList*> lists,
                                                     const std::set<std::string>& names) {
  const auto left_out =
      std::erase_if(lists, [&](const io::KeyList* list) { return names.contains(list->name); });
  EXPECT_EQ(left_out, names.size());
  return lists;
}

/// Expects that the reader asks for every key that is described: alone, with a value that means
/// nothing, it is not called unknown in one of the list's places at least. `faults` reads a text as
/// the list's file and returns what is wrong with it.
inline void expect_every_key_is_read(
    const std::vector<const io::KeyList*>& lists, const KeyPlaces& places,
    const std::function<std::string(const std::string& list, const std::string& text)>& faults) {
  for (const io::KeyList* list : lists) {
    const auto found = places.find(list->name);
    ASSERT_NE(found, places.end()) << "no place for the keys of " << list->name;
    const auto read_as = [&](const std::string& key) {
      for (std::string text : found->second) {
        text.replace(text.find('%'), 1, key + ": 1");
        if (faults(list->name, text).find("unknown key \"" + key + "\"") == std::string::npos)
          return true;
      }
      return false;
    };
    for (const io::Key& key : list->keys)
      EXPECT_TRUE(read_as(key.name)) << key.name << " of " << list->name << " is never asked for";
    EXPECT_FALSE(read_as("no_such_key")) << "a place of " << list->name << " is not read";
  }
}

}  // namespace pedicel
