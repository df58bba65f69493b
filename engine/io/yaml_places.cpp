#include "engine/io/yaml_places.h"

#include <algorithm>
#include <cctype>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/yaml_words.h"

namespace pedicel::io {

namespace {

/// Behind a quoted scalar that begins at `at`.
std::size_t end_of_quoted(const std::string& text, std::size_t at) {
  const char quote = text[at];
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 >= text.size() || text[i + 1] != '\'') return i + 1;
      ++i;  // '' is a quote within
    }
  }
  return text.size();
}

bool begins_comment(const std::string& text, std::size_t at) {
  return text[at] == '#' && (at == 0 || std::isspace(static_cast<unsigned char>(text[at - 1])));
}

std::size_t end_of_line(const std::string& text, std::size_t at) {
  return std::min(text.find('\n', at), text.size());
}

/// Behind blanks, line ends and comments.
std::size_t next_token(const std::string& text, std::size_t at) {
  while (at < text.size()) {
    if (std::isspace(static_cast<unsigned char>(text[at])))
      ++at;
    else if (begins_comment(text, at))
      at = end_of_line(text, at);
    else
      break;
  }
  return at;
}

std::size_t end_of_plain(const std::string& text, std::size_t at, bool in_flow) {
  std::size_t end = at;
  for (std::size_t i = at; i < text.size() && text[i] != '\n'; ++i) {
    if (begins_comment(text, i)) break;
    if (in_flow && std::string(",}]").find(text[i]) != std::string::npos) break;
    if (!std::isspace(static_cast<unsigned char>(text[i]))) end = i + 1;
  }
  return end;
}

}  // namespace

std::size_t start_of(const YAML::Node& node) {
  return static_cast<std::size_t>(node.Mark().pos);
}

std::size_t start_of(const std::string& text, const YAML::Node& node) {
  std::size_t at = start_of(node);
  while (at < text.size() && (text[at] == '&' || text[at] == '!')) {
    at = std::min(text.find_first_of(" \t\r\n", at), text.size());
    at = next_token(text, at);
  }
  return at;
}

std::size_t end_of_key(const std::string& text, const YAML::Node& key) {
  const std::size_t from = start_of(key);
  const bool quoted = text[from] == '"' || text[from] == '\'';
  const std::size_t word = quoted ? end_of_quoted(text, from) : from + key.Scalar().size();
  return std::min(text.find(':', word), text.size() - 1) + 1;
}

std::size_t end_of_alias(const std::string& text, const YAML::Node& key, std::size_t& at) {
  at = next_token(text, end_of_key(text, key));
  if (at >= text.size() || text[at] != '*') return 0;
  return std::min(text.find_first_of(" \t\r\n,]}", at), text.size());
}

std::string flow_text(const YAML::Node& node) {
  if (node.IsSequence()) {
    std::string items = joined(node, [&](const auto& item) { return flow_text(item); });
    return "[" + items + "]";
  }
  if (node.IsMap()) {
    const std::string items = joined(node, [&](const auto& item) {
      return flow_text(item.first) + ": " + flow_text(item.second);
    });
    return "{" + items + "}";
  }
  if (!node.IsScalar()) return "null";
  const std::string& scalar = node.Scalar();
  const bool is_plain = node.Tag() != "!" && !scalar.empty() &&
                        scalar.find_first_of(",[]{}#&*!|>'\"%@`\n") == std::string::npos &&
                        scalar.find(": ") == std::string::npos;
  return is_plain ? scalar : yaml_quoted(scalar);
}

bool is_flow(const std::string& text, const YAML::Node& node) {
  const char first = text.at(start_of(text, node));
  return first == '{' || first == '[';
}

std::size_t end_of_flow(const std::string& text, std::size_t at) {
  int depth = 0;
  for (std::size_t i = at; i < text.size(); ++i) {
    const char c = text[i];
    const bool begins_word =
        i == 0 || std::string(" \n\t,[{:").find(text[i - 1]) != std::string::npos;
    if ((c == '"' || c == '\'') && begins_word) {
      i = end_of_quoted(text, i) - 1;
    } else if (begins_comment(text, i)) {
      i = end_of_line(text, i);
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ']') && --depth == 0) {
      return i + 1;
    }
  }
  return text.size();
}

std::size_t end_of_value(const std::string& text, const YAML::Node& node, bool in_flow) {
  const std::size_t at = start_of(text, node);
  if (!node.IsScalar() && !is_flow(text, node))
    throw UsageError("a block, expected a value in one line to change");
  if (!node.IsScalar()) return end_of_flow(text, at);
  if (node.Scalar().empty()) throw UsageError("an empty value, expected one to change");
  if (text[at] == '"' || text[at] == '\'') return end_of_quoted(text, at);
  if (text[at] == '|' || text[at] == '>')
    throw UsageError("a block of text, expected a short value");
  return end_of_plain(text, at, in_flow);
}

std::size_t line_start(const std::string& text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return before == std::string::npos ? 0 : before + 1;
}

std::size_t end_of_block_entry(const std::string& text, std::size_t at, std::size_t column,
                               bool is_list) {
  std::size_t end = std::min(end_of_line(text, at) + 1, text.size());
  for (std::size_t line = end; line < text.size();) {
    const std::size_t next = std::min(end_of_line(text, line) + 1, text.size());
    const std::size_t word = text.find_first_not_of(" \t\r", line);
    if (word >= next || text[word] == '\n' || text[word] == '#') {
      line = next;  // belongs to the entry only if something of it follows
      continue;
    }
    const bool dash = text[word] == '-' && !is_list && word - line == column;
    if (word - line <= column && !dash) break;
    end = line = next;
  }
  return end;
}

}  // namespace pedicel::io
