#include "plugins/discrepancy/import/world_frame.h"

#include <optional>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/io/number_text.h"

namespace pedicel::discrepancy {

namespace {

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

/// "-z" as a vector.
std::optional<Vec3> signed_axis(std::string_view text) {
  const double sign = text.starts_with('-') ? -1.0 : 1.0;
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  return sign * Vec3::Unit(text[0] - 'x');
}

[[noreturn]] void refuse_words(std::string_view text, const std::string& option,
                               const std::string& expected) {
  throw UsageError(option + " " + in_quotes(text) + ": expected " + expected);
}

std::optional<std::vector<double>> numbers_of(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view part : parts_of(text)) {
    const io::NumberText number = io::number_of(part);
    if (number.kind != io::NumberText::Kind::number) return std::nullopt;
    numbers.push_back(number.value);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

}  // namespace

Vec3 direction_of_text(std::string_view text, const std::string& option) {
  constexpr double shortest = 1.0e-9;
  if (const auto axis = signed_axis(text)) return *axis;
  const auto numbers = numbers_of(text, 3);
  if (!numbers) refuse_words(text, option, "an axis (x, -z) or three numbers (0.6,0,0.8)");
  const Vec3 direction(numbers->data());
  if (!(direction.norm() > shortest)) refuse_words(text, option, "a direction of some length");
  return direction.normalized();
}

Mat3 turn_of_axes(std::string_view text, const std::string& option) {
  constexpr const char* expected = "three axes of the file, each once (x,-z,y)";
  const std::vector<std::string_view> parts = parts_of(text);
  if (parts.size() != 3) refuse_words(text, option, expected);
  Mat3 turn;
  for (int row = 0; row < 3; ++row) {
    const auto axis = signed_axis(parts[static_cast<std::size_t>(row)]);
    if (!axis) refuse_words(text, option, expected);
    turn.row(row) = axis->transpose();
  }
  const double handed = turn.determinant();
  if (handed == 0.0) refuse_words(text, option, expected);
  if (handed < 0.0)
    refuse_words(text, option, "right-handed axes: these are a mirror image, one sign is wrong");
  return turn;
}

Mat3 turn_of_up(char axis) {
  if (axis == 'z') return Mat3::Identity();
  return turn_of_axes(axis == 'y' ? "x,-z,y" : "y,z,x", "--up");
}

Vec3 numbers3_of_text(std::string_view text, const std::string& option) {
  const auto numbers = numbers_of(text, 3);
  if (!numbers) refuse_words(text, option, "three numbers (0.1,0,0.5)");
  return Vec3(numbers->data());
}

Eigen::Vector2d numbers2_of_text(std::string_view text, const std::string& option) {
  const auto numbers = numbers_of(text, 2);
  if (!numbers) refuse_words(text, option, "two numbers (640,470.5)");
  return Eigen::Vector2d(numbers->data());
}

}  // namespace pedicel::discrepancy
