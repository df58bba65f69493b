#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"

namespace pedicel::app {

/// What an argument of a command may hold.
class Value {
 public:
  using Held = std::variant<double, std::string, Vec3, std::vector<double>, std::vector<Vec3>>;
  Value(double number) : held(number) {}
  Value(int whole) : held(static_cast<double>(whole)) {}
  Value(const char* text) : held(std::string(text)) {}
  Value(std::string text) : held(std::move(text)) {}
  Value(const Vec3& point) : held(point) {}
  Value(std::vector<double> numbers) : held(std::move(numbers)) {}
  Value(std::vector<Vec3> points) : held(std::move(points)) {}
  bool operator==(const Value&) const = default;

  Held held;
};

/// One thing that a user does, as data and as one line of text: a verb and named arguments, all of
/// them absolute, so that the same command twice is the same as once wherever that makes sense.
class Command {
 public:
  Command() = default;
  /// Throws UsageError for an unknown verb, an unknown argument, one of the wrong kind, or where
  /// one that is needed is left out: what the text form would refuse.
  Command(std::string verb, std::initializer_list<std::pair<const std::string, Value>> arguments);
  Command(std::string verb, std::map<std::string, Value> arguments);

  const std::string& verb() const { return verb_; }
  bool has(const std::string& argument) const { return arguments_.count(argument) > 0; }
  double number(const std::string& argument) const;
  double number_or(const std::string& argument, double value) const;
  int whole(const std::string& argument) const;
  int whole_or(const std::string& argument, int value) const;
  const std::string& word(const std::string& argument) const;
  std::string word_or(const std::string& argument, const std::string& value) const;
  /// The number of the word among those of its argument; 0 where it is left out.
  int choice(const std::string& argument) const;
  const Vec3& point(const std::string& argument) const;
  const std::vector<double>& numbers(const std::string& argument) const;
  const std::vector<Vec3>& points(const std::string& argument) const;

  /// The line that parse_command() reads back as the same command: needed arguments in the order of
  /// the description, then the others as name=value.
  std::string text() const;
  /// What a drag goes on changing: the verb and the arguments that name something, without values.
  /// Commands of one key within a gesture are one.
  std::string merge_key() const;

  bool operator==(const Command&) const = default;

 private:
  std::string verb_;
  std::map<std::string, Value> arguments_;
};

/// Reads one line: `move point tomato stem 2 0.01,0,0.2`, `add fruit tomato f1 stalk 1 0.012
/// bend=0.3`. Arguments without a name are the needed ones in their order, then the others. Words
/// with blanks are quoted ("..."; \" \\ \n inside); a point is x,y,z without blanks, several are
/// separated by
/// ";". Faults go to `diagnostics` with the column; then nothing comes back.
std::optional<Command> parse_command(const std::string& line, const SourcePosition& where,
                                     Diagnostics& diagnostics);

}  // namespace pedicel::app
