#include "engine/io/yaml_piece.h"

#include <algorithm>

#include "engine/io/yaml.h"
#include "engine/io/yaml_words.h"

namespace pedicel::io {

namespace {

constexpr int most_levels = 8;
constexpr std::size_t largest_piece = 100'000;

/// Writes a node as flow YAML, in one line, or with every value at its own line and column.
class FlowText {
 public:
  FlowText(int first_line, bool in_place) : line_(first_line), in_place_(in_place) {}

  void write(const YAML::Node& node, int level = 0) {
    too_large_ = too_large_ || level > most_levels || text_.size() > largest_piece;
    if (too_large_) return;
    if (node.IsMap()) {
      reach(node, 1);
      put("{");
      write_entries(node, level);
      put("}");
    } else if (node.IsSequence()) {
      reach(node, 1);
      put("[");
      bool first = true;
      for (const YAML::Node& item : node) {
        if (!first) put(in_place_ ? "," : ", ");
        first = false;
        write(item, level + 1);
      }
      put("]");
    } else {
      reach(node, 0);
      put(scalar(node));
    }
  }

  const std::string& text() const { return text_; }
  bool is_too_large() const { return too_large_; }

 private:
  void write_entries(const YAML::Node& node, int level) {
    bool first = true;
    for (const auto& entry : node) {
      if (!first) put(in_place_ ? "," : ", ");
      first = false;
      write(entry.first, level + 1);
      put(": ");
      write(entry.second, level + 1);
    }
  }

  // A block has no bracket: it begins with what stands first in it, so the bracket goes before.
  void reach(const YAML::Node& node, int bracket) {
    const YAML::Mark mark = node.Mark();
    if (!in_place_ || mark.line < 0) return;
    const bool is_block = bracket && node.Style() != YAML::EmitterStyle::Flow;
    const int column = std::max(0, mark.column - (is_block ? 1 : 0));
    for (; line_ < mark.line; ++line_) text_ += "\n", column_ = 0;
    if (line_ == mark.line && column_ < column)
      text_.append(static_cast<std::size_t>(column - column_), ' '), column_ = column;
  }

  void put(const std::string& piece) {
    text_ += piece;
    column_ += static_cast<int>(piece.size());
  }

  // What was quoted stays a text.
  static std::string scalar(const YAML::Node& node) {
    if (!node.IsScalar()) return "~";
    if (node.Tag() == "!") return yaml_quoted(node.Scalar());
    const std::string word = yaml_word(node.Scalar());
    const bool is_number = word != node.Scalar() &&
                           node.Scalar().find_first_not_of("+-0123456789.eE") == std::string::npos;
    return is_number || node.Scalar() == "true" || node.Scalar() == "false" ? node.Scalar() : word;
  }

  std::string text_;
  int line_, column_ = 0;
  bool in_place_, too_large_ = false;
};

}  // namespace

YamlPiece piece_of(const YamlNode& node) {
  YamlPiece piece;
  piece.where = node.position();
  FlowText flow(piece.where.line - 1, true);
  flow.write(node.raw());
  if (flow.is_too_large())
    node.error("is too large, expected at most " + std::to_string(most_levels) + " levels and " +
               std::to_string(largest_piece / 1000) + " kB");
  else
    piece.text = flow.text();
  return piece;
}

YamlNode read_piece(const YamlPiece& piece, Diagnostics& diagnostics) {
  const auto above = static_cast<std::size_t>(std::max(0, piece.where.line - 1));
  return parse_yaml(std::string(above, '\n') + piece.text, piece.where.file, diagnostics);
}

std::string piece_text(const YamlPiece& piece) {
  Diagnostics ignored;
  FlowText flow(0, false);
  flow.write(parse_yaml(piece.text, piece.where.file, ignored).raw());
  return flow.text();
}

}  // namespace pedicel::io
