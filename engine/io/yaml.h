#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "engine/io/bounds.h"

namespace pedicel::io {

/// A node of a YAML file that knows where it stands. Everything that reads it adds to the
/// diagnostics it was made with and goes on, so that one pass shows every fault of a file. A read
/// that failed returns a harmless value; the caller asks diagnostics().has_errors() at the end.
class YamlNode {
 public:
  YamlNode(YAML::Node node, std::string file, Diagnostics& diagnostics)
      : node_(std::move(node)), file_(std::move(file)), diagnostics_(&diagnostics) {}

  SourcePosition position() const;
  Diagnostics& diagnostics() const { return *diagnostics_; }
  void error(std::string what) const;
  const YAML::Node& raw() const { return node_; }
  const std::string& file() const { return file_; }

  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  /// A finite number within bounds; `what` names it in the error ("radius").
  double number(const std::string& what, const Bounds& bounds = any_number) const;
  int integer(const std::string& what, int minimum, int maximum) const;
  bool boolean(const std::string& what) const;
  std::string text(const std::string& what) const;
  /// One of the given words; on error the first of them.
  std::string choice(const std::string& what, const std::vector<std::string>& allowed) const;
  Vec3 vector(const std::string& what) const;      ///< [x, y, z]
  Quat quaternion(const std::string& what) const;  ///< [x, y, z, w], normalised; zero is refused
  std::vector<double> numbers(const std::string& what, const Bounds& bounds = any_number) const;
  std::vector<YamlNode> list(const std::string& what) const;

 private:
  YAML::Node node_;
  std::string file_;
  Diagnostics* diagnostics_;
};

/// Reads a map key by key; finish() reports the keys that nobody asked for.
class YamlMap {
 public:
  /// `what` names the map in errors ("a fruit").
  YamlMap(const YamlNode& node, std::string what);

  bool has(const std::string& key) const;
  /// The node of a key that may be absent.
  std::optional<YamlNode> optional(const std::string& key);
  /// The node of a key that must be there; reports "missing key" once and returns nothing
  /// otherwise.
  std::optional<YamlNode> required(const std::string& key);

  // Shorthands: an absent optional key gives the default.
  double number(const std::string& key, const Bounds& bounds);
  double number(const std::string& key, const Bounds& bounds, double otherwise);
  int integer(const std::string& key, int minimum, int maximum, int otherwise);
  bool boolean(const std::string& key, bool otherwise);
  std::string text(const std::string& key);
  std::string text(const std::string& key, const std::string& otherwise);
  std::string choice(const std::string& key, const std::vector<std::string>& allowed,
                     const std::string& otherwise);
  Vec3 vector(const std::string& key);
  Vec3 vector(const std::string& key, const Vec3& otherwise);
  Quat quaternion(const std::string& key, const Quat& otherwise);
  std::vector<YamlNode> list(const std::string& key);  ///< empty where absent

  /// Every key not yet asked for is an error that lists what was expected.
  void finish();

  SourcePosition position() const { return node_.position(); }
  const YamlNode& node() const { return node_; }
  void error(std::string what) const { node_.error(std::move(what)); }

 private:
  YamlNode node_;
  std::string what_;
  std::set<std::string> asked_;
};

/// Parses a file. Throws InvalidFile where it cannot be read, is no YAML, has more than 8 MB, or
/// says more than 4 million values or 100 levels once its aliases are written out. Duplicate keys
/// are errors.
YamlNode load_yaml(const std::filesystem::path& path, Diagnostics& diagnostics);

/// The same from text; `name` stands for the file in errors.
YamlNode parse_yaml(const std::string& text, const std::string& name, Diagnostics& diagnostics);

/// Checks `format:` and `version:`, the first two keys of all our files. False after an error.
bool check_format(YamlMap& map, const std::string& format, int version);

}  // namespace pedicel::io
