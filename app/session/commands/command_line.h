#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/commands/command_table.h"

/// The text form of commands, piece by piece.
namespace pedicel::app {

/// A piece of a line between blanks, with what quotes and backslashes stand for.
struct LineWord {
  std::string name;  ///< before an unquoted "=", empty: none
  std::string text;
  int column = 1;  ///< counts from 1
  bool quoted = false;
};

/// Splits a line; from an unquoted "#" on it is a comment. Nothing where a quote is left open.
std::optional<std::vector<LineWord>> split_line(const std::string& line);

/// Reads a text as a kind; nothing where it is none.
std::optional<Value> read_value(ArgumentKind kind, const std::string& text);
bool fits(ArgumentKind kind, const Value& value);
/// As it stands in a line, quoted where needed; numbers exact.
std::string value_text(const Value& value);
/// "a number", "points x,y,z;x,y,z"
std::string kind_text(ArgumentKind kind);

}  // namespace pedicel::app
