#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/core/frames.h"
#include "engine/io/bounds.h"

namespace pedicel::io {

/// Of a key that must be there.
struct Needed {};
/// Of a key in place of which no value is taken: what its absence means, in words ("none").
struct Told {
  std::string text;
};
/// What is taken for a key that is absent.
using Otherwise = std::variant<Needed, Told, double, bool, std::string, Vec3>;

/// What stands for a value in a file.
enum class KeyType { number, whole, flag, text, word, vector, rotation, numbers, list, map, path };

/// A key of a file, described once: its reader takes bounds, words and default from here
/// (DescribedMap), and the manual its row.
struct Key {
  std::string name;
  KeyType type = KeyType::number;
  std::string unit{};  ///< "1" of a number without one; empty where it is no number
  Otherwise otherwise = Needed{};
  Bounds bounds{};                   ///< of a number, of each number of several
  std::vector<std::string> words{};  ///< of a word
  std::string form{};                ///< what bounds and words leave open: "after `from`"
  std::string sentence{};            ///< what it is, as a phrase
};

/// `format` and `version`, the first two keys of all our files.
inline Key format_key(const std::string& format) {
  return {.name = "format",
          .type = KeyType::word,
          .words = {format},
          .sentence = "says what the file is"};
}
inline Key version_key() {
  return {.name = "version",
          .type = KeyType::whole,
          .bounds = {1, 1},
          .sentence = "version of the format"};
}

/// The keys of one map of a file.
struct KeyList {
  std::string name;  ///< what its table in the manual is called by: "body"
  std::string what;  ///< what errors call the map: "a body"
  std::vector<Key> keys;
  std::string within{};                ///< the key above, where tables show both: "repeat"
  std::vector<const KeyList*> also{};  ///< whose keys stand in the map, too: those of a place

  /// Null where there is none, in `also` neither.
  const Key* find(std::string_view key) const;
};

}  // namespace pedicel::io
