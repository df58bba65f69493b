#include "engine/io/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace pedicel::io {

namespace {

using Kind = NumberText::Kind;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

bool is_missing(std::string_view text) {
  constexpr std::array<std::string_view, 27> words = {
      "na",   "n/a", "#n/a",    "nan",       "-nan",    "+nan", "1.#qnan", "-1.#ind", "null",
      "none", "nil", "missing", "nodata",    "no data", "-",    "--",      "---",     ".",
      "..",   "?",   "<na>",    "-nan(ind)", "n.a.",    "n.a",  "*",       "1.#ind",  "-1.#qnan"};
  if (text.empty()) return true;
  if (text.size() > 9) return false;
  const std::string lower = lower_case(text);
  return std::find(words.begin(), words.end(), lower) != words.end() || lower == "\xE2\x80\x93" ||
         lower == "\xE2\x80\x94";
}

// Minus signs and dashes of typesetters as '-', groups' apostrophes and narrow blanks as '\''.
std::string plain(std::string_view text) {
  struct Pair {
    std::string_view from;
    char to;
  };
  constexpr std::array pairs = {Pair{"\xE2\x88\x92", '-'},  Pair{"\xE2\x80\x93", '-'},
                                Pair{"\xE2\x80\x90", '-'},  Pair{"\xE2\x80\x91", '-'},
                                Pair{"\xE2\x80\xAF", '\''}, Pair{"\xE2\x80\x89", '\''},
                                Pair{"\xE2\x80\x99", '\''}, Pair{"\xC2\xA0", '\''}};
  if (std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x80; }))
    return std::string(text);
  std::string out;
  while (!text.empty()) {
    const auto* pair = std::find_if(pairs.begin(), pairs.end(),
                                    [&](const Pair& p) { return text.starts_with(p.from); });
    out += pair != pairs.end() ? pair->to : text.front();
    text.remove_prefix(pair != pairs.end() ? pair->from.size() : 1);
  }
  return out;
}

/// A number taken apart; `fits` is false where it is none.
struct Parts {
  bool fits = false;
  std::string whole;     ///< digits and marks before the exponent
  std::string exponent;  ///< "e-3"
  bool negative = false;
};

Parts parts_of(std::string_view text) {
  const std::string source = plain(text);
  Parts parts;
  std::size_t at = 0;
  if (at < source.size() && (source[at] == '+' || source[at] == '-'))
    parts.negative = source[at++] == '-';
  const std::size_t start = at;
  bool digits = false;
  while (at < source.size() &&
         (is_digit(source[at]) || source[at] == '.' || source[at] == ',' || source[at] == '\''))
    digits = is_digit(source[at++]) || digits;
  parts.whole = source.substr(start, at - start);
  if (!digits) return parts;
  if (at < source.size()) {
    constexpr std::string_view letters = "eEdD";
    if (letters.find(source[at]) == std::string_view::npos) return parts;
    std::string rest = source.substr(at + 1);
    const bool sign = !rest.empty() && (rest[0] == '+' || rest[0] == '-');
    if (rest.size() == (sign ? 1u : 0u) || !std::all_of(rest.begin() + sign, rest.end(), is_digit))
      return parts;
    if (sign && rest[0] == '+') rest.erase(0, 1);
    parts.exponent = "e" + rest;
  }
  parts.fits = true;
  return parts;
}

// One to three digits, then groups of exactly three, parted by `mark`; no group alone.
bool is_grouped(std::string_view digits, char mark) {
  std::size_t end = std::min(digits.find(mark), digits.size());
  if (end == 0 || end > 3 || end == digits.size() || digits.front() == '0') return false;
  while (end < digits.size()) {
    const std::size_t next = std::min(digits.find(mark, end + 1), digits.size());
    if (next - end != 4) return false;
    end = next;
  }
  return std::all_of(digits.begin(), digits.end(),
                     [&](char c) { return is_digit(c) || c == mark; });
}

int count(std::string_view text, char c) {
  return static_cast<int>(std::count(text.begin(), text.end(), c));
}

// "12345.6" of "12,345.6" and the like; empty where the groups are not whole.
std::string without_groups(std::string_view digits, char mark, char decimal) {
  const std::size_t point = std::min(digits.find(decimal), digits.size());
  if (!is_grouped(digits.substr(0, point), mark)) return {};
  if (digits.find(mark, point) != std::string_view::npos) return {};
  std::string out(digits);
  std::erase(out, mark);
  return out;
}

NumberText value_of(std::string digits, const Parts& parts, char decimal) {
  std::replace(digits.begin(), digits.end(), decimal, '.');
  if (count(digits, '.') > 1) return {};
  const std::string text = (parts.negative ? "-" : "") + digits + parts.exponent;
  // A wider type tells what is too large from what is too small, which is 0.
  long double value = 0.0L;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return {};
  if (fault == std::errc::result_out_of_range)
    return parts.exponent.starts_with("e-") ? NumberText{Kind::number, 0.0}
                                            : NumberText{Kind::infinite, 0.0};
  if (fault != std::errc{}) return {};
  double narrow = 0.0;
  const auto second = std::from_chars(text.data(), text.data() + text.size(), narrow);
  if (second.ec != std::errc{}) narrow = static_cast<double>(value);
  if (!std::isfinite(narrow)) return {Kind::infinite, 0.0};
  return {Kind::number, narrow};
}

bool is_infinite(std::string_view text) {
  std::string lower = lower_case(plain(text));
  if (!lower.empty() && (lower[0] == '+' || lower[0] == '-')) lower.erase(0, 1);
  return lower == "inf" || lower == "infinity" || lower == "1.#inf" || lower == "\xE2\x88\x9E";
}

// 1:02:03.4, 2026-03-01, 03/01/2026
bool is_clock_or_date(std::string_view text) {
  if (text.empty() || !is_digit(text.front())) return false;
  const bool marks = count(text, ':') > 0 || count(text, '/') == 2 || count(text, '-') == 2;
  return marks && std::all_of(text.begin(), text.end(), [](char c) {
           return is_digit(c) || std::string_view(":/-. TZ+").find(c) != std::string_view::npos;
         });
}

}  // namespace

NumberText number_of(std::string_view text, const NumberStyle& style) {
  // The common case first: digits alone, as programs write them.
  double quick = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, quick);
  const bool whole = !text.empty() && fault == std::errc{} && stop == end && std::isfinite(quick);
  if (whole && (style.decimal == '.' || text.find('.') == std::string_view::npos))
    return {Kind::number, quick};
  if (is_missing(text)) return {Kind::missing, 0.0};
  if (is_infinite(text)) return {Kind::infinite, 0.0};
  const Parts parts = parts_of(text);
  if (!parts.fits) return {};
  const char other = style.decimal == '.' ? ',' : '.';
  std::string digits = parts.whole;
  if (count(digits, '\'') > 0) {
    digits = without_groups(digits, '\'', style.decimal);
    if (digits.empty() || count(digits, other) > 0) return {};
  } else if (count(digits, other) > 0) {
    if (style.decimal == ',' && count(digits, ',') == 0 && count(digits, '.') == 1)
      return {Kind::unclear, 0.0};
    digits = without_groups(digits, other, style.decimal);
    if (digits.empty()) return {};
  }
  return value_of(digits, parts, style.decimal);
}

CommaUse comma_use(std::string_view text) {
  if (text.find(',') == std::string_view::npos) return CommaUse::none;
  const Parts parts = parts_of(text);
  const int commas = count(parts.whole, ','), points = count(parts.whole, '.');
  if (!parts.fits || commas == 0) return CommaUse::none;
  if (!without_groups(parts.whole, ',', '.').empty() && points <= 1)
    return commas == 1 && points == 0 && parts.exponent.empty() ? CommaUse::either
                                                                : CommaUse::groups;
  if (commas != 1) return CommaUse::none;
  if (points > 0 && without_groups(parts.whole, '.', ',').empty()) return CommaUse::none;
  return CommaUse::decimal;
}

bool has_decimal_point(std::string_view text) {
  if (text.find('.') == std::string_view::npos) return false;
  const Parts parts = parts_of(text);
  return parts.fits && count(parts.whole, '.') == 1 && count(parts.whole, ',') == 0 &&
         !is_grouped(parts.whole, '.');
}

std::string why_no_number(std::string_view text, const NumberStyle& style) {
  const NumberText found = number_of(text, style);
  if (found.kind == Kind::unclear)
    return "may be a fraction or have groups of three digits: the other numbers have a decimal "
           "comma, expected one way of writing";
  const std::string plainly = "is not a finite number";
  if (found.kind != Kind::other) return plainly;
  if (is_clock_or_date(text)) return plainly + " but a date or a time of day, expected seconds";
  const std::size_t digits = text.find_first_not_of("+-0123456789.,eE");
  if (digits > 0 && digits < text.size() && number_of(text.substr(0, digits)).kind == Kind::number)
    return plainly + ", expected the number alone (a unit stands in the header: \"x (mm)\")";
  return plainly;
}

}  // namespace pedicel::io
