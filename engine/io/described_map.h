#pragma once

#include "engine/io/key.h"
#include "engine/io/yaml.h"

namespace pedicel::io {

/// A map that is read as its keys are described: names, bounds, words and defaults come from the
/// list. Asking for a key that is not described, or as another type, is our own bug (an assertion).
/// Faults of the file go to the node's diagnostics, as YamlMap tells them.
class DescribedMap {
 public:
  /// `keys` outlives the map. `what` names it in errors where the list's own words do not do.
  DescribedMap(const YamlNode& node, const KeyList& keys, const std::string& what = {});

  const Key& key(const std::string& name) const;
  bool has(const std::string& name) const;
  /// The node of a key that may be absent; whether it is needed does not count.
  std::optional<YamlNode> optional(const std::string& name);
  /// The node of a key that must be there in this case, whatever its description says.
  std::optional<YamlNode> required(const std::string& name);
  /// The node of a key; "missing key" where it is absent and described as needed.
  std::optional<YamlNode> asked(const std::string& name);

  /// The node of a key that does not belong here and is refused with a sentence of its own.
  std::optional<YamlNode> misplaced(const std::string& name);

  // The value, or the described default. Keys whose default is told in words have none: ask for
  // them with optional() or optional_number().
  double number(const std::string& name);
  int integer(const std::string& name);
  bool boolean(const std::string& name);
  std::string text(const std::string& name);  ///< empty where its default is told in words
  std::string choice(const std::string& name);
  Vec3 vector(const std::string& name);
  Quat quaternion(const std::string& name);
  std::vector<YamlNode> list(const std::string& name);  ///< empty where absent

  /// Within the described bounds; nothing where absent.
  std::optional<double> optional_number(const std::string& name);
  /// Of a key that must be there in this case, whatever its description says.
  double required_number(const std::string& name);

  /// `format` and `version`, the first two keys of all our files: the described word and number.
  /// False after an error.
  bool has_format();
  /// Every key not yet asked for is an error that lists what was expected.
  void finish() { map_.finish(); }

  SourcePosition position() const { return map_.position(); }
  const YamlNode& node() const { return map_.node(); }
  void error(std::string what) const { map_.error(std::move(what)); }

 private:
  const Key& key(const std::string& name, KeyType type) const;
  template <class Value>
  const Value& otherwise(const Key& key) const;

  const KeyList& keys_;
  YamlMap map_;
};

}  // namespace pedicel::io
