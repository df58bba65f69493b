#include "engine/io/yaml_merge.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <vector>

#include "engine/core/check.h"
#include "engine/io/yaml_places.h"
#include "engine/io/yaml_text.h"

namespace pedicel::io {

namespace {

using Path = YamlText::Path;

Path operator/(Path path, const std::string& part) {
  path.push_back(part);
  return path;
}

bool same(const YAML::Node& a, const YAML::Node& b) {
  return flow_text(a) == flow_text(b);
}

std::string name_of(const YAML::Node& item) {
  if (!item.IsMap()) return {};
  const YAML::Node name = item["name"];
  return name.IsDefined() && name.IsScalar() ? name.Scalar() : std::string();
}

/// Empty where an entry has no name, or two have the same.
std::vector<std::string> names_of(const YAML::Node& list) {
  std::vector<std::string> names;
  for (const auto& item : list) {
    const std::string name = name_of(item);
    if (name.empty() || std::ranges::find(names, name) != names.end()) return {};
    names.push_back(name);
  }
  return names;
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

class Merge {
 public:
  explicit Merge(const std::string& text) : text_(text) {}
  const std::string& text() const { return text_.text(); }

  void node(const Path& path, const YAML::Node& was, const YAML::Node& is) {
    if (same(was, is)) return;
    if (was.IsMap() && is.IsMap() && is.size() > 0) return map(path, was, is);
    if (was.IsSequence() && is.IsSequence() && is.size() > 0 && was.size() > 0)
      return list(path, was, is);
    text_.set(path, flow_text(is));
  }

 private:
  void map(const Path& path, const YAML::Node& was, const YAML::Node& is) {
    for (const auto& item : is) {
      const std::string& key = item.first.Scalar();
      const YAML::Node before = was[key];
      if (before.IsDefined())
        node(path / key, before, item.second);
      else
        add_key(path / key, item.second);
    }
    for (const auto& item : was)
      if (!is[item.first.Scalar()].IsDefined()) text_.remove(path / item.first.Scalar());
  }

  /// A list of the outermost map in lines, since it is long.
  void add_key(const Path& path, const YAML::Node& value) {
    if (path.size() > 1 || !value.IsSequence() || value.size() == 0 || !value[0].IsMap())
      return text_.set(path, flow_text(value));
    text_.remove(path);  // an empty one
    for (const auto& item : value) text_.append(path, item_text(item));
  }

  void list(const Path& path, const YAML::Node& was, const YAML::Node& is) {
    const auto before = names_of(was), now = names_of(is);
    if (!before.empty() && !now.empty()) return named_list(path, was, is, before, now);
    std::size_t head = 0, tail = 0;
    const std::size_t least = std::min(was.size(), is.size());
    while (head < least && same(was[head], is[head])) ++head;
    while (tail < least - head && same(was[was.size() - 1 - tail], is[is.size() - 1 - tail]))
      ++tail;
    const std::size_t both = least - head - tail;
    constexpr std::size_t many = 100;  // each change reads the whole text anew
    if (std::max(was.size(), is.size()) - head - tail > many) return text_.set(path, flow_text(is));
    for (std::size_t i = head; i < head + both; ++i) node(path / std::to_string(i), was[i], is[i]);
    for (std::size_t i = was.size() - tail; i > head + both; --i)
      text_.erase(path, static_cast<int>(i) - 1);
    for (std::size_t i = head + both; i + tail < is.size(); ++i)
      text_.insert(path, static_cast<int>(i), item_text(is[i]));
  }

  /// An entry that is another one but for its name and where it stands has a new name; others are
  /// new.
  void named_list(const Path& path, const YAML::Node& was, const YAML::Node& is,
                  std::vector<std::string> before, const std::vector<std::string>& now) {
    std::vector<std::size_t> old(before.size());  // where each that is left stood
    for (std::size_t i = 0; i < old.size(); ++i) old[i] = i;
    rename(path, was, is, before, now);
    for (std::size_t i = before.size(); i > 0; --i)
      if (index_of(now, before[i - 1]) < 0) {
        text_.erase(path, static_cast<int>(i) - 1);
        before.erase(before.begin() + static_cast<long>(i) - 1);
        old.erase(old.begin() + static_cast<long>(i) - 1);
      }
    for (std::size_t i = 0; i < now.size(); ++i) {
      const int at = index_of(before, now[i]);
      if (at >= 0 && at != static_cast<int>(i))
        throw UsageError("entries in another order, expected them to stay");
      if (at < 0) {
        text_.insert(path, static_cast<int>(i), item_text(is[i]));
        before.insert(before.begin() + static_cast<long>(i), now[i]);
        old.insert(old.begin() + static_cast<long>(i), was.size());
      } else {
        node(path / std::to_string(i), renamed(was[old[i]], now[i]), is[i]);
      }
    }
  }

  /// What a thing is, wherever it stands and whatever it is called.
  static YAML::Node without_place(const YAML::Node& item) {
    YAML::Node other = YAML::Clone(item);
    for (const char* key : {"name", "position", "orientation", "set"}) other.remove(key);
    return other;
  }

  static YAML::Node renamed(const YAML::Node& item, const std::string& name) {
    YAML::Node other = YAML::Clone(item);
    other["name"] = name;
    return other;
  }

  void rename(const Path& path, const YAML::Node& was, const YAML::Node& is,
              std::vector<std::string>& before, const std::vector<std::string>& now) {
    for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i) {
      if (index_of(now, before[i]) >= 0 || index_of(before, now[i]) >= 0) continue;
      if (!same(without_place(was[i]), without_place(is[i]))) continue;
      text_.set(path / std::to_string(i) / "name", flow_text(is[i]["name"]));
      before[i] = now[i];
    }
  }

  /// In lines where it holds a list of points, else in brackets.
  static std::string item_text(const YAML::Node& item) {
    if (!item.IsMap()) return flow_text(item);
    const bool is_long = std::ranges::any_of(item, [](const auto& one) {
      return one.second.IsSequence() && one.second.size() > 0 && one.second[0].IsSequence();
    });
    if (!is_long) return flow_text(item);
    std::string lines;
    for (const auto& one : item)
      lines += (lines.empty() ? "" : "\n") + one.first.Scalar() + ": " + flow_text(one.second);
    return lines;
  }

  YamlText text_;
};

}  // namespace

std::string merge_yaml(const std::string& text, const std::string& before, const std::string& now) {
  Merge merge(text);
  merge.node({}, YAML::Load(before), YAML::Load(now));
  return merge.text();
}

}  // namespace pedicel::io
