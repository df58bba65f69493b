#include "plugins/skeleton/ply_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "engine/io/unit_text.h"
#include "plugins/skeleton/text_cells.h"

namespace pedicel::plant {

namespace {

constexpr std::size_t longest_ply_header = std::size_t{1} << 16;  ///< bytes
constexpr std::size_t most_ply_properties = 1000;

struct PlyType {
  const char* name;
  const char* other;
  int size;   ///< bytes
  char kind;  ///< i, u or f
};
constexpr std::array ply_types = {
    PlyType{"char", "int8", 1, 'i'},     PlyType{"uchar", "uint8", 1, 'u'},
    PlyType{"short", "int16", 2, 'i'},   PlyType{"ushort", "uint16", 2, 'u'},
    PlyType{"int", "int32", 4, 'i'},     PlyType{"uint", "uint32", 4, 'u'},
    PlyType{"float", "float32", 4, 'f'}, PlyType{"double", "float64", 8, 'f'}};

int ply_type(std::string_view name) {
  for (std::size_t t = 0; t < ply_types.size(); ++t)
    if (name == ply_types[t].name || name == ply_types[t].other) return static_cast<int>(t);
  return -1;
}

constexpr const char* blanks = " \t\r";

std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](std::string_view one) { return io::same_but_case(name, one); });
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& file, Diagnostics& diagnostics)
      : bytes_(bytes.substr(0, longest_ply_header)),
        file_(file),
        diagnostics_(diagnostics),
        before_(diagnostics.error_count()) {}

  std::optional<PlyHeader> parse() {
    if (!is_mark()) {
      error("no PLY file, expected \"ply\" as its first line");
      return std::nullopt;
    }
    std::string_view rest = bytes_;
    bool ended = false;
    while (!ended && !rest.empty() && good()) {
      const std::string_view line = take_line(rest);
      ++line_;
      ended = take(line);
    }
    if (good() && !ended) error("the header does not end, expected a line \"end_header\"");
    if (good() && !format_) error("no line \"format\", expected \"format ascii 1.0\" or binary");
    if (!good()) return std::nullopt;
    header_.body = bytes_.size() - rest.size();
    header_.body_line = line_;
    return std::move(header_);
  }

 private:
  bool good() const { return diagnostics_.error_count() == before_; }
  bool is_mark() const {
    return bytes_.starts_with("ply") && bytes_.size() > 3 &&
           (bytes_[3] == '\n' || bytes_[3] == '\r');
  }
  void error(const std::string& what) { diagnostics_.error({file_, std::max(line_, 1), 1}, what); }

  // True at the header's end.
  bool take(std::string_view line) {
    std::string_view rest = line;
    const std::string_view word = next_word(rest);
    if (word == "end_header") return true;
    if (word == "format")
      take_format(rest);
    else if (word == "element")
      take_element(rest);
    else if (word == "property")
      take_property(rest);
    else if (word == "comment" || word == "obj_info")
      header_.comments.push_back({std::string(rest), line_});
    else if (!word.empty() && !(line_ == 1 && word == "ply"))
      error(in_quotes(word) + ", expected format, comment, element, property or end_header");
    return false;
  }

  void take_format(std::string_view rest) {
    const std::string_view name = next_word(rest);
    format_ = true;
    if (name == "ascii")
      header_.format = PlyHeader::Format::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyHeader::Format::little_endian;
    else if (name == "binary_big_endian")
      header_.format = PlyHeader::Format::big_endian;
    else
      error("format is " + in_quotes(name) +
            ", expected ascii, binary_little_endian or binary_big_endian");
  }

  void take_element(std::string_view rest) {
    PlyElement element;
    element.name = next_word(rest);
    element.line = line_;
    const std::string_view count = next_word(rest);
    const auto [end, fault] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || fault != std::errc{} || end != count.data() + count.size())
      error("an element's count is " + in_quotes(count) + ", expected \"element NAME COUNT\"");
    header_.elements.push_back(std::move(element));
  }

  void take_property(std::string_view rest) {
    PlyProperty property;
    std::string_view type = next_word(rest);
    if (type == "list") {
      const std::string_view count = next_word(rest);
      property.count_type = ply_type(count);
      if (property.count_type < 0 || ply_types[property.count_type].kind == 'f')
        error("a list's length is of type " + in_quotes(count) + ", expected uchar or int");
      type = next_word(rest);
    }
    property.type = ply_type(type);
    property.name = next_word(rest);
    if (property.type < 0)
      error("type " + in_quotes(type) +
            ", expected char, uchar, short, ushort, int, uint, float or double");
    if (property.name.empty()) error("a property without a name, expected \"property TYPE NAME\"");
    if (header_.elements.empty())
      error("a property before any element, expected \"element NAME COUNT\" first");
    if (++properties_ > most_ply_properties)
      error("more than " + std::to_string(most_ply_properties) + " properties, expected fewer");
    if (good()) header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view bytes_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  int before_;
  int line_ = 0;
  bool format_ = false;
  std::size_t properties_ = 0;
  PlyHeader header_;
};

template <class Number>
double number_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, sizeof(Number));
  if (swapped) std::reverse(own.begin(), own.end());
  Number value;
  std::memcpy(&value, own.data(), sizeof(Number));
  return static_cast<double>(value);
}

// Of one row at least: a text's number takes a character and what parts it from the next.
std::size_t smallest_row(const PlyElement& element, bool text) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties)
    size +=
        text ? 2
             : static_cast<std::size_t>(
                   ply_types[property.count_type >= 0 ? property.count_type : property.type].size);
  return size;
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names,
                                            bool list) const {
  for (std::size_t p = 0; p < properties.size(); ++p)
    if ((properties[p].count_type >= 0) == list && is_one_of(properties[p].name, names)) return p;
  return std::nullopt;
}

const PlyElement* PlyHeader::find(std::initializer_list<std::string_view> names) const {
  for (const PlyElement& element : elements)
    if (is_one_of(element.name, names)) return &element;
  return nullptr;
}

std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file,
                                         Diagnostics& diagnostics) {
  return HeaderParser(bytes, file, diagnostics).parse();
}

PlyRows::PlyRows(std::string_view bytes, const PlyHeader& header, std::string file,
                 Diagnostics& diagnostics)
    : bytes_(bytes),
      header_(header),
      file_(std::move(file)),
      diagnostics_(diagnostics),
      at_(header.body),
      line_(header.format == PlyHeader::Format::ascii ? header.body_line : 0) {}

bool PlyRows::error(const std::string& what) {
  diagnostics_.error(where(), what);
  return false;
}

bool PlyRows::cut_off(const PlyElement& element) {
  return error("the file ends within " + std::to_string(element.count) + " rows of element " +
               in_quotes(element.name) + ", expected all of them");
}

bool PlyRows::fits(const PlyElement& element) {
  if (element.count == 0) return true;
  const std::size_t row = smallest_row(element, header_.format == PlyHeader::Format::ascii);
  if (row == 0) {
    diagnostics_.error({file_, element.line, 1},
                       "element " + in_quotes(element.name) + " has no properties, expected some");
    return false;
  }
  // The last line may do without its end.
  return element.count <= (bytes_.size() - at_ + 1) / row || cut_off(element);
}

bool PlyRows::next(const PlyElement& element, std::vector<std::vector<double>>& values) {
  values.resize(element.properties.size());
  return header_.format == PlyHeader::Format::ascii ? text_row(element, values)
                                                    : binary_row(element, values);
}

bool PlyRows::skip(const PlyElement& element) {
  if (!fits(element)) return false;
  std::vector<std::vector<double>> values;
  for (std::size_t r = 0; r < element.count; ++r)
    if (!next(element, values)) return false;
  return true;
}

std::optional<double> PlyRows::binary_number(int type) {
  const PlyType& kind = ply_types[type];
  const auto size = static_cast<std::size_t>(kind.size);
  if (bytes_.size() - at_ < size) return std::nullopt;
  const char* from = bytes_.data() + at_;
  at_ += size;
  const bool own_little = std::endian::native == std::endian::little;
  const bool swapped = own_little != (header_.format == PlyHeader::Format::little_endian);
  const bool sign = kind.kind == 'i';
  if (kind.kind == 'f')
    return size == 4 ? number_at<float>(from, swapped) : number_at<double>(from, swapped);
  if (size == 1)
    return sign ? number_at<std::int8_t>(from, false) : number_at<std::uint8_t>(from, false);
  if (size == 2)
    return sign ? number_at<std::int16_t>(from, swapped) : number_at<std::uint16_t>(from, swapped);
  return sign ? number_at<std::int32_t>(from, swapped) : number_at<std::uint32_t>(from, swapped);
}

bool PlyRows::binary_row(const PlyElement& element, std::vector<std::vector<double>>& values) {
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    std::optional<double> count = 1.0;
    if (property.count_type >= 0) count = binary_number(property.count_type);
    const auto size = static_cast<std::size_t>(ply_types[property.type].size);
    if (!count || *count < 0.0 || *count > static_cast<double>((bytes_.size() - at_) / size))
      return cut_off(element);
    values[p].clear();
    for (auto n = static_cast<std::size_t>(*count); n > 0; --n)
      values[p].push_back(*binary_number(property.type));
  }
  return true;
}

std::optional<double> PlyRows::word(std::string_view& row) {
  const std::string_view text = next_word(row);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (!text.empty() && fault == std::errc{} && end == text.data() + text.size()) return value;
  error(text.empty() ? "the row ends early, expected a number for every property"
                     : in_quotes(text) + ", expected a number");
  return std::nullopt;
}

// Blank lines are passed over.
bool PlyRows::text_row(const PlyElement& element, std::vector<std::vector<double>>& values) {
  std::string_view row;
  do {
    if (at_ >= bytes_.size()) return cut_off(element);
    std::string_view rest = bytes_.substr(at_);
    row = take_line(rest);
    at_ = bytes_.size() - rest.size();
    ++line_;
  } while (row.find_first_not_of(blanks) == std::string_view::npos);
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    std::optional<double> count = 1.0;
    if (element.properties[p].count_type >= 0) count = word(row);
    if (!count) return false;
    if (!(*count >= 0.0 && *count <= static_cast<double>(row.size())))
      return error("a list of " + std::to_string(*count) + " numbers, expected as many in the row");
    values[p].clear();
    for (auto n = static_cast<std::size_t>(*count); n > 0; --n) {
      const std::optional<double> value = word(row);
      if (!value) return false;
      values[p].push_back(*value);
    }
  }
  if (row.find_first_not_of(blanks) != std::string_view::npos)
    return error("the row goes on with " + in_quotes(row) +
                 ", expected a number for every property");
  return true;
}

}  // namespace pedicel::plant
