#pragma once

#include <string>
#include <vector>

namespace pedicel::io {

/// A YAML file as text, changed place by place: comments, order and layout of everything else stay.
///
/// A path is the keys from the outermost map on; in a list the number of an entry, from 0. Values
/// are YAML themselves ("0.2", "[0, 0, 1]", "{name: a}"). What cannot be changed so (a path through
/// a number, a block in the place of a value, aliases) is a UsageError, and then the text is as it
/// was; every change is read back before it is taken.
class YamlText {
 public:
  using Path = std::vector<std::string>;

  /// Throws UsageError where the text is no YAML.
  explicit YamlText(std::string text);

  /// Puts a value in the place of a scalar or of a list or map in brackets; a key that is not there
  /// is added at the end of its map, with the maps above it.
  void set(const Path& path, const std::string& value);
  /// Takes a key out of its map; nothing where it is not there. A map that is left empty stays, as
  /// {}.
  void remove(const Path& path);
  /// Adds an entry at the end of a list, which is made where it is not there.
  void append(const Path& list, const std::string& item);
  /// Takes an entry out of a list, with the comments within it.
  void erase(const Path& list, int index);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace pedicel::io
