#include "app/session/commands/command_line.h"

#include <cmath>

#include "engine/io/csv.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::optional<std::vector<double>> read_numbers(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ',')) {
    const auto value = world::to_number(part);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
  }
  return numbers;
}

std::optional<Vec3> read_point(const std::string& text) {
  const auto numbers = read_numbers(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

std::optional<std::vector<Vec3>> read_points(const std::string& text) {
  std::vector<Vec3> points;
  for (const std::string& part : split(text, ';')) {
    const auto point = read_point(part);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

template <class Result>
std::optional<Value> wrapped(const std::optional<Result>& result) {
  return result ? std::optional<Value>(*result) : std::nullopt;
}

std::string text_of(double value) {
  return io::exact_number(value);
}
std::string text_of(const Vec3& p) {
  return text_of(p.x()) + ',' + text_of(p.y()) + ',' + text_of(p.z());
}
template <class Item>
std::string list_text(const std::vector<Item>& items, char between) {
  std::string text;
  for (const Item& item : items) {
    if (!text.empty()) text += between;
    text += text_of(item);
  }
  return text;
}
std::string text_of(const std::vector<double>& numbers) {
  return list_text(numbers, ',');
}
std::string text_of(const std::vector<Vec3>& points) {
  return list_text(points, ';');
}
std::string text_of(const std::string& text) {
  const bool plain = !text.empty() && text.find_first_of(" \t\r\n\"\\#=") == std::string::npos;
  if (plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n')
      quoted += "\\n";
    else
      quoted += c;
  }
  return quoted + '"';
}

/// Reads the pieces of a line one character after another.
class Splitter {
 public:
  std::optional<std::vector<LineWord>> split(const std::string& line) {
    for (at_ = 0; at_ < line.size(); ++at_) {
      const char c = line[at_];
      if (in_quotes_)
        inside(line, c);
      else if (c == '#')
        break;
      else if (is_blank(c))
        in_word_ = false;
      else
        outside(c);
    }
    if (in_quotes_) return std::nullopt;
    return std::move(words_);
  }

 private:
  void inside(const std::string& line, char c) {
    if (c == '"') {
      in_quotes_ = false;
    } else if (c == '\\' && at_ + 1 < line.size()) {
      ++at_;
      words_.back().text += line[at_] == 'n' ? '\n' : line[at_];
    } else {
      words_.back().text += c;
    }
  }

  void outside(char c) {
    if (!in_word_) words_.push_back({{}, {}, static_cast<int>(at_) + 1, false});
    in_word_ = true;
    LineWord& word = words_.back();
    if (c == '"') {
      in_quotes_ = true;
      word.quoted = true;
    } else if (c == '=' && word.name.empty() && !word.quoted && !word.text.empty()) {
      word.name.swap(word.text);
    } else {
      word.text += c;
    }
  }

  std::vector<LineWord> words_;
  std::size_t at_ = 0;
  bool in_word_ = false, in_quotes_ = false;
};

}  // namespace

std::optional<std::vector<LineWord>> split_line(const std::string& line) {
  return Splitter().split(line);
}

std::optional<Value> read_value(ArgumentKind kind, const std::string& text) {
  switch (kind) {
    case ArgumentKind::word:
    case ArgumentKind::text:
      return Value(text);
    case ArgumentKind::point:
      return wrapped(read_point(text));
    case ArgumentKind::points:
      return wrapped(read_points(text));
    case ArgumentKind::numbers:
      return wrapped(read_numbers(text));
    case ArgumentKind::number:
    case ArgumentKind::whole:
      break;
  }
  const auto number = wrapped(world::to_number(text));
  return number && fits(kind, *number) ? number : std::nullopt;
}

bool fits(ArgumentKind kind, const Value& value) {
  const auto finite = [](const Vec3& p) { return p.allFinite(); };
  if (const auto* number = std::get_if<double>(&value.held))
    return (kind == ArgumentKind::number && std::isfinite(*number)) ||
           (kind == ArgumentKind::whole && *number == std::floor(*number) &&
            std::abs(*number) < 1.0e9);
  if (std::holds_alternative<std::string>(value.held))
    return kind == ArgumentKind::word || kind == ArgumentKind::text;
  if (const auto* p = std::get_if<Vec3>(&value.held))
    return kind == ArgumentKind::point && finite(*p);
  if (const auto* numbers = std::get_if<std::vector<double>>(&value.held)) {
    for (const double number : *numbers)
      if (!std::isfinite(number)) return false;
    return kind == ArgumentKind::numbers && !numbers->empty();
  }
  const auto& points = std::get<std::vector<Vec3>>(value.held);
  for (const Vec3& p : points)
    if (!finite(p)) return false;
  return kind == ArgumentKind::points && !points.empty();
}

std::string value_text(const Value& value) {
  return std::visit([](const auto& held) { return text_of(held); }, value.held);
}

std::string kind_text(ArgumentKind kind) {
  switch (kind) {
    case ArgumentKind::number:
      return "a number";
    case ArgumentKind::whole:
      return "a whole number";
    case ArgumentKind::word:
      return "a name";
    case ArgumentKind::text:
      return "a text";
    case ArgumentKind::point:
      return "a point x,y,z";
    case ArgumentKind::numbers:
      return "numbers a,b,c";
    case ArgumentKind::points:
      return "points x,y,z;x,y,z";
  }
  return "";
}

}  // namespace pedicel::app
