#include "engine/io/yaml_text.h"

#include <algorithm>
#include <cctype>

#include "engine/core/check.h"
#include "engine/io/yaml_places.h"

namespace pedicel::io {

namespace {

using Path = YamlText::Path;

std::string name_of(const Path& path) {
  std::string name;
  for (const std::string& part : path) name += (name.empty() ? "" : ".") + part;
  return name;
}

[[noreturn]] void refuse(const Path& path, const std::string& why) {
  throw UsageError(name_of(path) + ": " + why);
}

std::size_t end_of_value_at(const std::string& text, const YAML::Node& node, bool in_flow,
                            const Path& path) {
  try {
    return end_of_value(text, node, in_flow);
  } catch (const UsageError& fault) {
    refuse(path, fault.what());
  }
}

YAML::Node load(const std::string& text) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& fault) {
    throw UsageError(std::string("no YAML: ") + fault.what());
  }
}

/// Text for a new line before `end`, which may be the end of a file without a last line's end.
void insert_line(std::string& text, std::size_t end, const std::string& line) {
  const bool open = end == text.size() && !text.empty() && text.back() != '\n';
  text.insert(end, (open ? "\n" : "") + line + "\n");
}

void insert_in_flow(std::string& text, const YAML::Node& node, const std::string& entry) {
  const std::size_t close = end_of_flow(text, start_of(text, node)) - 1;
  std::size_t at = close;
  while (at > 0 && std::isspace(static_cast<unsigned char>(text[at - 1]))) --at;
  text.insert(at, (node.size() == 0 || text[at - 1] == ',' ? "" : ", ") + entry);
}

void insert_key(std::string& text, const YAML::Node& map, const std::string& key,
                const std::string& value) {
  const std::string entry = key + (value.front() == '\n' ? ":" : ": ") + value;
  if (is_flow(text, map)) return insert_in_flow(text, map, entry);
  std::size_t last = start_of(text, map);
  for (const auto& item : map) last = std::max(last, start_of(item.first));
  const std::size_t column = static_cast<std::size_t>(map.begin()->first.Mark().column);
  insert_line(text, end_of_block_entry(text, last, column, false),
              std::string(column, ' ') + entry);
}

/// The dash of an entry of a list in lines, whose text begins at `at`.
std::size_t dash_of(const std::string& text, std::size_t at) {
  return text.rfind('-', at == 0 ? 0 : at - 1);
}

/// Follows a path as far as it goes; `left` is what of it is not there.
YAML::Node follow(const std::string& text, const Path& path, Path& left, bool& in_flow) {
  YAML::Node node = load(text);
  in_flow = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!node.IsMap() && !node.IsSequence()) refuse(path, "goes through a value");
    in_flow = in_flow || is_flow(text, node);
    YAML::Node next;
    if (node.IsSequence()) {
      const std::size_t index = std::stoul(path[i]);
      if (index >= node.size()) refuse(path, "there is no such entry");
      next.reset(node[index]);
    } else if (const YAML::Node found = node[path[i]]; found.IsDefined()) {
      next.reset(found);
    } else {
      left.assign(path.begin() + static_cast<long>(i), path.end());
      return node;
    }
    node.reset(next);
  }
  left.clear();
  return node;
}

bool same(const YAML::Node& a, const YAML::Node& b) {
  return flow_text(a) == flow_text(b);
}

/// Whether a changed text says a value.
void check_value(const std::string& changed, const Path& path, const std::string& value) {
  Path left;
  bool in_flow = false;
  const YAML::Node now = follow(changed, path, left, in_flow);
  if (!left.empty() || !same(now, load(value)))
    refuse(path, "cannot be changed where it stands, expected a plain map and value");
}

/// An entry in lines, all but its first moved to the right.
std::string moved(const std::string& item, std::size_t column) {
  std::string text;
  for (const char c : item) {
    text += c;
    if (c == '\n') text += std::string(column, ' ');
  }
  return text;
}

bool is_in_lines(const std::string& item) {
  return item.find('\n') != std::string::npos;
}

/// As an entry of a list in brackets.
std::string in_flow_text(const std::string& item) {
  return is_in_lines(item) ? flow_text(load(item)) : item;
}

}  // namespace

YamlText::YamlText(std::string text) : text_(std::move(text)) {
  load(text_);
}

// Down the path; what an alias stood for has none of its own that matter, or is expanded further
// down.
void YamlText::expand_aliases(const Path& path) {
  YAML::Node node = load(text_);
  for (const std::string& part : path) {
    if (node.IsSequence()) {
      const std::size_t index = std::stoul(part);
      if (index >= node.size()) return;
      const std::size_t at = start_of(node[index]);
      if (at < start_of(node)) refuse(path, "goes through an alias in a list");
      node.reset(node[index]);
      continue;
    }
    if (!node.IsMap() || !node[part].IsDefined()) return;
    std::size_t at = 0, end = 0;
    for (const auto& item : node)
      if (item.first.Scalar() == part) end = end_of_alias(text_, item.first, at);
    if (end > 0) {
      text_.replace(at, end - at, flow_text(node[part]));
      return expand_aliases(path);
    }
    node.reset(node[part]);
  }
}

void YamlText::set(const Path& path, const std::string& value) {
  if (path.empty()) refuse(path, "the whole file, expected a key");
  expand_aliases(path);
  std::string changed = text_;
  Path left;
  bool in_flow = false;
  const YAML::Node node = follow(changed, path, left, in_flow);
  if (left.empty() && !node.IsScalar() && !node.IsNull() && !is_flow(changed, node))
    return set_block(path, value);
  if (left.empty()) {
    const std::size_t at = start_of(changed, node);
    changed.replace(at, end_of_value_at(changed, node, in_flow, path) - at, value);
  } else {
    std::string nested = value;
    for (std::size_t i = left.size(); i > 1; --i) nested = "{" + left[i - 1] + ": " + nested + "}";
    if (!node.IsMap() || (node.size() == 0 && !is_flow(changed, node)))
      refuse(path, "expected a map to add it to");
    insert_key(changed, node, left.front(), nested);
  }
  check_value(changed, path, value);
  text_ = std::move(changed);
}

// From behind its key to its last line.
void YamlText::set_block(const Path& path, const std::string& value) {
  Path left;
  bool in_flow = false;
  const YAML::Node map = follow(text_, Path(path.begin(), path.end() - 1), left, in_flow);
  if (!map.IsMap()) refuse(path, "a block in a list, expected a value in one line to change");
  std::string changed = text_;
  for (const auto& item : map) {
    if (item.first.Scalar() != path.back()) continue;
    const std::size_t key = start_of(item.first), from = end_of_key(changed, item.first);
    std::size_t end = end_of_block_entry(changed, key, key - line_start(changed, key), false);
    while (end > from && std::isspace(static_cast<unsigned char>(changed[end - 1]))) --end;
    changed.replace(from, end - from, " " + value);
    break;
  }
  check_value(changed, path, value);
  text_ = std::move(changed);
}

void YamlText::remove(const Path& path) {
  expand_aliases(Path(path.begin(), path.end() - 1));
  Path left;
  bool in_flow = false;
  follow(text_, path, left, in_flow);
  if (!left.empty()) return;
  const Path above(path.begin(), path.end() - 1);
  const YAML::Node map = follow(text_, above, left, in_flow);
  YAML::Node wanted = YAML::Clone(map);
  wanted.remove(path.back());
  std::size_t from = 0, to = 0, own = 0, next = std::string::npos, before = 0;
  for (const auto& item : map) {
    const std::size_t key = start_of(item.first);
    if (item.first.Scalar() == path.back()) {
      own = key;
    } else if (own && key > own) {
      next = std::min(next, key);
    } else if (!own) {
      before = key;
    }
  }
  std::string changed = text_;
  if (is_flow(changed, map)) {
    const std::size_t open = start_of(text_, map);
    from = before ? changed.rfind(',', own) : open + 1;
    to = end_of_flow(changed, open) - 1;
    if (next != std::string::npos) from = own, to = next;
    changed.erase(from, to - from);
  } else {
    from = line_start(changed, own);
    to = end_of_block_entry(changed, own, own - from, false);
    changed.erase(from, to - from);
    if (map.size() == 1 && from > 0) changed.insert(changed.rfind(':', from) + 1, " {}");
  }
  const YAML::Node now = follow(changed, above, left, in_flow);
  if (!left.empty() || !same(now, wanted)) refuse(path, "cannot be taken out where it stands");
  text_ = std::move(changed);
}

void YamlText::append(const Path& list, const std::string& item) {
  expand_aliases(list);
  Path left;
  bool in_flow = false;
  const YAML::Node node = follow(text_, list, left, in_flow);
  if (!left.empty()) {
    const bool lines = list.size() == 1 && !is_flow(text_, node);
    return set(list, lines ? "\n  - " + moved(item, 4) : "[" + in_flow_text(item) + "]");
  }
  if (!node.IsSequence()) refuse(list, "no list, expected one to add to");
  insert(list, static_cast<int>(node.size()), item);
}

void YamlText::insert(const Path& list, int index, const std::string& item) {
  expand_aliases(list);
  Path left;
  bool in_flow = false;
  const YAML::Node node = follow(text_, list, left, in_flow);
  const std::size_t count = left.empty() && node.IsSequence() ? node.size() : 0;
  const auto at = static_cast<std::size_t>(index);
  if (!left.empty() || !node.IsSequence() || index < 0 || at > count)
    refuse(list, "there is no place " + std::to_string(index));
  std::string changed = text_;
  if (is_flow(changed, node) && at == count) {
    insert_in_flow(changed, node, in_flow_text(item));
  } else if (is_flow(changed, node)) {
    changed.insert(start_of(node[at]), in_flow_text(item) + ", ");
  } else {
    const std::size_t dash = dash_of(changed, start_of(node[at == 0 ? 0 : at - 1]));
    const std::size_t line = line_start(changed, dash), column = dash - line;
    insert_line(changed, at == 0 ? line : end_of_block_entry(changed, dash, column, true),
                std::string(column, ' ') + "- " + moved(item, column + 2));
  }
  const YAML::Node now = follow(changed, list, left, in_flow);
  bool as_meant = left.empty() && now.IsSequence() && now.size() == count + 1;
  for (std::size_t i = 0; as_meant && i <= count; ++i)
    as_meant = same(now[i], i == at ? load(item) : node[i < at ? i : i - 1]);
  if (!as_meant) refuse(list, "cannot be added to, expected a plain list");
  text_ = std::move(changed);
}

void YamlText::erase(const Path& list, int index) {
  expand_aliases(list);
  Path left;
  bool in_flow = false;
  const YAML::Node node = follow(text_, list, left, in_flow);
  const std::size_t count = left.empty() && node.IsSequence() ? node.size() : 0;
  const auto at = static_cast<std::size_t>(index);
  if (index < 0 || at >= count) refuse(list, "there is no entry " + std::to_string(index));
  std::string changed = text_;
  if (count == 1 && is_flow(changed, node)) {
    const std::size_t open = start_of(changed, node);
    changed.replace(open, end_of_flow(changed, open) - open, "[]");
  } else if (is_flow(changed, node)) {
    const std::size_t own = start_of(node[at]);
    const Path path = {name_of(list), std::to_string(index)};
    std::size_t from = own, to = end_of_value_at(changed, node[at], true, path);
    if (at + 1 < count)
      to = start_of(node[at + 1]);
    else
      from = end_of_value_at(changed, node[at - 1], true, path);
    changed.erase(from, to - from);
  } else {
    const std::size_t dash = dash_of(changed, start_of(node[at]));
    const std::size_t line = line_start(changed, dash);
    changed.erase(line, end_of_block_entry(changed, dash, dash - line, true) - line);
    if (count == 1) {
      const std::size_t key = changed.rfind(':', line);
      if (key == std::string::npos) refuse(list, "its last entry cannot be taken out");
      changed.insert(key + 1, " []");
    }
  }
  const YAML::Node now = follow(changed, list, left, in_flow);
  bool as_meant = left.empty() && now.IsSequence() && now.size() + 1 == count;
  for (std::size_t i = 0; as_meant && i + 1 < count; ++i)
    as_meant = same(now[i], node[i < at ? i : i + 1]);
  if (!as_meant) refuse(list, "entry " + std::to_string(index) + " cannot be taken out");
  text_ = std::move(changed);
}

}  // namespace pedicel::io
