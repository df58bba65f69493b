#include "engine/io/table_records.h"

#include <algorithm>
#include <array>

namespace pedicel::io {

namespace {

constexpr std::string_view blanks = " \t\f\v\r\n";
// What Unicode has for a blank: that does not break, thin, narrow, of a digit's width, wide; and
// the mark that begins a file, wherever two files were put together.
constexpr std::array<std::string_view, 7> wide_blanks = {
    "\xC2\xA0",     "\xE2\x80\x89", "\xE2\x80\xAF", "\xE2\x80\x87",
    "\xE2\x80\x8A", "\xE3\x80\x80", "\xEF\xBB\xBF"};

// A quote opens a quoted cell only where a cell begins.
bool opens_cell(std::string_view text, std::size_t at) {
  constexpr std::string_view before = ",;\t| ";
  return at == 0 || before.find(text[at - 1]) != std::string_view::npos;
}

std::size_t closing_quote(std::string_view text, std::size_t open) {
  std::size_t at = open + 1;
  while (true) {
    at = text.find('"', at);
    if (at == std::string_view::npos || at + 1 >= text.size() || text[at + 1] != '"') return at;
    at += 2;
  }
}

std::string_view trimmed(std::string_view text) {
  const auto strip_front = [&] {
    if (!text.empty() && blanks.find(text.front()) != std::string_view::npos) {
      text.remove_prefix(1);
      return true;
    }
    const auto* wide =
        std::find_if(wide_blanks.begin(), wide_blanks.end(),
                     [&](std::string_view blank) { return text.starts_with(blank); });
    if (wide == wide_blanks.end()) return false;
    text.remove_prefix(wide->size());
    return true;
  };
  const auto strip_back = [&] {
    if (!text.empty() && blanks.find(text.back()) != std::string_view::npos) {
      text.remove_suffix(1);
      return true;
    }
    const auto* wide = std::find_if(wide_blanks.begin(), wide_blanks.end(),
                                    [&](std::string_view blank) { return text.ends_with(blank); });
    if (wide == wide_blanks.end()) return false;
    text.remove_suffix(wide->size());
    return true;
  };
  while (strip_front()) {
  }
  while (strip_back()) {
  }
  return text;
}

}  // namespace

bool is_blank(std::string_view record) {
  return trimmed(record).empty();
}

bool is_comment(std::string_view record) {
  std::string_view text = trimmed(record);
  if (text.starts_with('"')) text.remove_prefix(1);
  if (text.starts_with("//")) return true;
  if (text.empty() || (text.front() != '#' && text.front() != '%')) return false;
  return !text.starts_with("#N/A") && !text.starts_with("#n/a");
}

bool is_comment_above_header(std::string_view record) {
  const std::string_view text = trimmed(record);
  return text.size() > 2 && text[0] == ';' && text[1] == ' ' &&
         text.find(';', 1) == std::string_view::npos;
}

bool is_rule(std::string_view record) {
  const std::string_view text = trimmed(record);
  return text.find("---") != std::string_view::npos &&
         text.find_first_not_of("-|+: \t") == std::string_view::npos &&
         text.find_first_of("|+") != std::string_view::npos;
}

bool RecordScanner::next() {
  if (rest_.empty()) return false;
  line_ = next_line_;
  before_ = rest_;
  open_quote_ = false;
  std::size_t at = 0;
  while (true) {
    at = rest_.find_first_of("\r\n\"", at);
    if (at == std::string_view::npos || rest_[at] != '"') break;
    if (!opens_cell(rest_, at)) {
      ++at;
      continue;
    }
    const std::size_t close = closing_quote(rest_, at);
    open_quote_ = close == std::string_view::npos;
    if (open_quote_) {
      at = rest_.find_first_of("\r\n", at);
      break;
    }
    const std::string_view within = rest_.substr(at, close - at);
    next_line_ += static_cast<int>(std::count(within.begin(), within.end(), '\n'));
    at = close + 1;
  }
  record_ = rest_.substr(0, at);
  if (at == std::string_view::npos) {
    rest_ = {};
    return true;
  }
  ++next_line_;
  const bool both = rest_[at] == '\r' && at + 1 < rest_.size() && rest_[at + 1] == '\n';
  rest_.remove_prefix(at + (both ? 2 : 1));
  return true;
}

void RecordScanner::again() {
  rest_ = before_;
  next_line_ = line_;
}

void CellSplitter::add(std::string_view raw, std::size_t start) {
  std::string_view text = trimmed(raw);
  const std::size_t lead = text.empty() ? 0 : static_cast<std::size_t>(text.data() - raw.data());
  const bool double_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  const bool single_quoted = text.size() >= 2 && text.front() == '\'' && text.back() == '\'';
  if (double_quoted || single_quoted) {
    text = text.substr(1, text.size() - 2);
    if (double_quoted && text.find("\"\"") != std::string_view::npos) {
      std::string& plain = unquoted_.emplace_back();
      for (std::size_t i = 0; i < text.size(); ++i) {
        plain += text[i];
        if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
      }
      text = plain;
    }
    text = trimmed(text);
  }
  cells_.push_back({text, static_cast<int>(start + lead) + 1});
}

const std::vector<TableCell>& CellSplitter::split(std::string_view record) {
  cells_.clear();
  unquoted_.clear();
  if (separator_ == ' ') {
    split_blanks(record);
  } else if (record.find('"') != std::string_view::npos) {
    split_quoted(record);
  } else {
    for (std::size_t start = 0; start <= record.size();) {
      const std::size_t end = std::min(record.find(separator_, start), record.size());
      add(record.substr(start, end - start), start);
      start = end + 1;
    }
  }
  return cells_;
}

void CellSplitter::split_quoted(std::string_view record) {
  std::size_t start = 0;
  while (start <= record.size()) {
    std::size_t first = std::min(record.find_first_not_of(" \f\v", start), record.size());
    std::size_t end = first;
    if (first < record.size() && record[first] == '"') {
      const std::size_t close = closing_quote(record, first);
      end = close == std::string_view::npos ? first : close;
    }
    end = std::min(record.find(separator_, end), record.size());
    add(record.substr(start, end - start), start);
    start = end + 1;
  }
}

void CellSplitter::split_blanks(std::string_view record) {
  std::size_t at = 0;
  while ((at = record.find_first_not_of(blanks, at)) != std::string_view::npos) {
    std::size_t end = at;
    if (record[at] == '"') {
      const std::size_t close = closing_quote(record, at);
      if (close != std::string_view::npos) end = close;
    }
    end = std::min(record.find_first_of(blanks, end), record.size());
    add(record.substr(at, end - at), at);
    at = end;
  }
}

}  // namespace pedicel::io
