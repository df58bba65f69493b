#pragma once

#include <string>
#include <vector>

namespace pedicel::io {

/// A YAML file as text, changed place by place: comments, order and layout of everything else stay.
///
/// A path is the keys from the outermost map on; in a list the number of an entry, from 0. Values
/// are YAML themselves ("0.2", "[0, 0, 1]", "{name: a}"). An anchor stays on what it is on; an
/// alias that a path goes through becomes what it stands for, so that the anchor's own value stays.
/// What cannot be changed so (a path through a number) is a UsageError, and then the text is as it
/// was; every change is read back before it is taken.
class YamlText {
 public:
  using Path = std::vector<std::string>;

  /// Throws UsageError where the text is no YAML.
  explicit YamlText(std::string text);

  /// Puts a value in the place of another; a key that is not there is added at the end of its map,
  /// with the maps above it. A list or map in lines becomes one in brackets.
  void set(const Path& path, const std::string& value);
  /// Takes a key out of its map; nothing where it is not there. A map that is left empty stays, as
  /// {}.
  void remove(const Path& path);
  /// Adds an entry at the end of a list, which is made where it is not there: in lines, where it
  /// belongs to the outermost map. The entry may be a map in lines, whose first column is 0.
  void append(const Path& list, const std::string& item);
  /// Takes an entry out of a list, with the comments within it.
  void erase(const Path& list, int index);
  /// Adds an entry before another; at the end where `index` is the list's length.
  void insert(const Path& list, int index, const std::string& item);

  const std::string& text() const { return text_; }

 private:
  void expand_aliases(const Path& path);
  void set_block(const Path& path, const std::string& value);
  std::string text_;
};

}  // namespace pedicel::io
