#include "engine/io/yaml.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"
#include "engine/io/bounds.h"
#include "engine/io/csv.h"

namespace pedicel::io {

namespace {

/// Bytes; as nodes a text takes a hundred times as much memory. Measured: 0.7 GB for 4 MB of 51,000
/// curves, their plant included; 0.83 GB for 8 MB. 150,000 drawn points are 4 MB.
constexpr std::size_t largest_yaml = std::size_t{4} << 20;

std::optional<double> parse_number(const YAML::Node& node) {
  if (!node.IsScalar() || node.Tag() == "!") return std::nullopt;  // "!" marks a quoted scalar
  const std::string& text = node.Scalar();
  const char* first = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  double value = 0.0;
  if (first != text.data() && first != last && *first == '-') return std::nullopt;  // "+-1"
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last || first == last) return std::nullopt;
  return value;
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "\"" + node.Scalar() + "\"";
  if (node.IsSequence()) return "a list";
  if (node.IsMap()) return "a map";
  return "nothing";
}

/// Looks at every value once before anybody reads the file. Aliases make that needful: a list that
/// holds itself has no end, and nine lists of nine aliases each, nine deep, have 4e8 values in a
/// few lines.
class Surveyor {
 public:
  Surveyor(const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  void look(const YAML::Node& node, int depth = 0) {
    if (depth > deepest)
      refuse(node, "values nested more than " + std::to_string(deepest) +
                       " deep (an alias may stand within its own anchor), expected fewer");
    if (++values_ > most_values)
      refuse(node, "more than " + std::to_string(most_values) +
                       " values with aliases written out, expected fewer");
    if (node.IsSequence())
      for (const YAML::Node& item : node) look(item, depth + 1);
    if (node.IsMap()) look_at_map(node, depth);
  }

 private:
  static constexpr int deepest = 100;
  static constexpr int most_values = 4'000'000;

  void look_at_map(const YAML::Node& node, int depth) {
    std::set<std::string> seen;
    for (const auto& item : node) {
      if (!item.first.IsScalar()) {
        diagnostics_.error(position(item.first), "a key that is no text, expected a name");
        continue;
      }
      if (!seen.insert(item.first.Scalar()).second)
        diagnostics_.error(position(item.first),
                           "key \"" + item.first.Scalar() + "\" appears twice, expected once");
      look(item.second, depth + 1);
    }
  }

  SourcePosition position(const YAML::Node& node) const {
    return {file_, node.Mark().line + 1, node.Mark().column + 1};
  }
  [[noreturn]] void refuse(const YAML::Node& node, std::string what) const {
    throw InvalidFile(position(node), std::move(what));
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
  int values_ = 0;
};

}  // namespace

std::string bounds_text(const Bounds& bounds) {
  if (bounds.open_minimum && std::isfinite(bounds.maximum))
    return "a number > " + format_number(bounds.minimum) + " and at most " +
           format_number(bounds.maximum);
  if (std::isfinite(bounds.minimum) && std::isfinite(bounds.maximum))
    return "a number between " + format_number(bounds.minimum) + " and " +
           format_number(bounds.maximum);
  if (std::isfinite(bounds.minimum))
    return std::string("a number ") + (bounds.open_minimum ? "> " : ">= ") +
           format_number(bounds.minimum);
  return "a finite number";
}

bool within(double value, const Bounds& bounds) {
  if (!std::isfinite(value) || value > bounds.maximum) return false;
  return bounds.open_minimum ? value > bounds.minimum : value >= bounds.minimum;
}

SourcePosition YamlNode::position() const {
  const YAML::Mark mark = node_.Mark();
  return {file_, mark.line + 1, mark.column + 1};
}

void YamlNode::error(std::string what) const {
  diagnostics_->error(position(), std::move(what));
}

double YamlNode::number(const std::string& what, const Bounds& bounds) const {
  const std::optional<double> value = parse_number(node_);
  if (value && within(*value, bounds)) return *value;
  error(what + " is " + shown(node_) + ", expected " + bounds_text(bounds));
  return std::isfinite(bounds.minimum) ? bounds.minimum : 0.0;
}

int YamlNode::integer(const std::string& what, int minimum, int maximum) const {
  const std::optional<double> value = parse_number(node_);
  if (value && *value == std::floor(*value) && *value >= minimum && *value <= maximum)
    return static_cast<int>(*value);
  error(what + " is " + shown(node_) + ", expected a whole number between " +
        std::to_string(minimum) + " and " + std::to_string(maximum));
  return minimum;
}

bool YamlNode::boolean(const std::string& what) const {
  if (node_.IsScalar() && node_.Scalar() == "true") return true;
  if (node_.IsScalar() && node_.Scalar() == "false") return false;
  error(what + " is " + shown(node_) + ", expected true or false");
  return false;
}

std::string YamlNode::text(const std::string& what) const {
  if (node_.IsScalar() && !node_.Scalar().empty()) return node_.Scalar();
  error(what + " is " + shown(node_) + ", expected a text");
  return {};
}

std::string YamlNode::choice(const std::string& what,
                             const std::vector<std::string>& allowed) const {
  if (node_.IsScalar() && std::ranges::count(allowed, node_.Scalar()) > 0) return node_.Scalar();
  error(what + " is " + shown(node_) + ", expected one of: " + joined(allowed));
  return allowed.front();
}

Vec3 YamlNode::vector(const std::string& what) const {
  if (!node_.IsSequence() || node_.size() != 3) {
    error(what + " is " + shown(node_) +
          (node_.IsSequence() ? " of " + std::to_string(node_.size()) : "") +
          ", expected [x, y, z]");
    return Vec3::Zero();
  }
  Vec3 value;
  for (int i = 0; i < 3; ++i) value[i] = YamlNode(node_[i], file_, *diagnostics_).number(what);
  return value;
}

Quat YamlNode::quaternion(const std::string& what) const {
  if (!node_.IsSequence() || node_.size() != 4) {
    error(what + " is " + shown(node_) + ", expected [x, y, z, w]");
    return Quat::Identity();
  }
  Quat value;
  for (int i = 0; i < 4; ++i)
    value.coeffs()[i] = YamlNode(node_[i], file_, *diagnostics_).number(what);
  if (value.norm() < 1e-6) {
    error(what + " has length 0, expected a rotation [x, y, z, w]");
    return Quat::Identity();
  }
  return value.normalized();
}

std::vector<double> YamlNode::numbers(const std::string& what, const Bounds& bounds) const {
  std::vector<double> values;
  for (const YamlNode& item : list(what)) values.push_back(item.number(what, bounds));
  return values;
}

std::vector<YamlNode> YamlNode::list(const std::string& what) const {
  std::vector<YamlNode> items;
  if (!node_.IsSequence()) {
    error(what + " is " + shown(node_) + ", expected a list");
    return items;
  }
  for (const YAML::Node& item : node_) items.emplace_back(item, file_, *diagnostics_);
  return items;
}

YamlMap::YamlMap(const YamlNode& node, std::string what) : node_(node), what_(std::move(what)) {
  if (!node_.is_map()) node_.error(what_ + " is " + shown(node_.raw()) + ", expected a map");
}

bool YamlMap::has(const std::string& key) const {
  return node_.is_map() && node_.raw()[key].IsDefined();
}

std::optional<YamlNode> YamlMap::optional(const std::string& key) {
  asked_.insert(key);
  if (!has(key)) return std::nullopt;
  return YamlNode(node_.raw()[key], node_.file(), node_.diagnostics());
}

std::optional<YamlNode> YamlMap::required(const std::string& key) {
  auto node = optional(key);
  if (!node && node_.is_map()) error("missing key \"" + key + "\", expected in " + what_);
  return node;
}

double YamlMap::number(const std::string& key, const Bounds& bounds) {
  const auto node = required(key);
  return node ? node->number(key, bounds) : 0.0;
}
double YamlMap::number(const std::string& key, const Bounds& bounds, double otherwise) {
  const auto node = optional(key);
  return node ? node->number(key, bounds) : otherwise;
}
int YamlMap::integer(const std::string& key, int minimum, int maximum, int otherwise) {
  const auto node = optional(key);
  return node ? node->integer(key, minimum, maximum) : otherwise;
}
bool YamlMap::boolean(const std::string& key, bool otherwise) {
  const auto node = optional(key);
  return node ? node->boolean(key) : otherwise;
}
std::string YamlMap::text(const std::string& key) {
  const auto node = required(key);
  return node ? node->text(key) : std::string{};
}
std::string YamlMap::text(const std::string& key, const std::string& otherwise) {
  const auto node = optional(key);
  return node ? node->text(key) : otherwise;
}
std::string YamlMap::choice(const std::string& key, const std::vector<std::string>& allowed,
                            const std::string& otherwise) {
  const auto node = optional(key);
  return node ? node->choice(key, allowed) : otherwise;
}
Vec3 YamlMap::vector(const std::string& key) {
  const auto node = required(key);
  return node ? node->vector(key) : Vec3(Vec3::Zero());
}
Vec3 YamlMap::vector(const std::string& key, const Vec3& otherwise) {
  const auto node = optional(key);
  return node ? node->vector(key) : otherwise;
}
Quat YamlMap::quaternion(const std::string& key, const Quat& otherwise) {
  const auto node = optional(key);
  return node ? node->quaternion(key) : otherwise;
}
std::vector<YamlNode> YamlMap::list(const std::string& key) {
  const auto node = optional(key);
  return node ? node->list(key) : std::vector<YamlNode>{};
}

void YamlMap::finish() {
  if (!node_.is_map()) return;
  const std::string expected = joined(asked_);
  for (const auto& item : node_.raw()) {
    if (asked_.contains(item.first.Scalar())) continue;
    YamlNode(item.first, node_.file(), node_.diagnostics())
        .error("unknown key \"" + item.first.Scalar() + "\" in " + what_ +
               ", expected one of: " + expected);
  }
}

YamlNode load_yaml(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return parse_yaml(read_file(path), path.string(), diagnostics);
}

YamlNode parse_yaml(const std::string& text, const std::string& name, Diagnostics& diagnostics) {
  if (text.size() > largest_yaml)
    throw InvalidFile({name}, "has " + std::to_string(text.size() >> 20) +
                                  " MB of YAML, expected at most " +
                                  std::to_string(largest_yaml >> 20) + " MB");
  YAML::Node node;
  try {
    node = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InvalidFile({name, error.mark.line + 1, error.mark.column + 1},
                      "not valid YAML: " + error.msg);
  }
  Surveyor(name, diagnostics).look(node);
  return YamlNode(node, name, diagnostics);
}

bool check_format(YamlMap& map, const std::string& format, int version) {
  const auto format_node = map.required("format");
  if (!format_node) return false;
  if (format_node->text("format") != format) {
    format_node->error("format is " + shown(format_node->raw()) + ", expected " + format);
    return false;
  }
  const auto version_node = map.required("version");
  if (!version_node) return false;
  const int before = map.node().diagnostics().error_count();
  const int found = version_node->integer("version", 1, 1000000);
  if (map.node().diagnostics().error_count() > before) return false;
  if (found == version) return true;
  version_node->error("version is " + std::to_string(found) + ", expected " +
                      std::to_string(version));
  return false;
}

}  // namespace pedicel::io
