#include "engine/urdf/urdf_text.h"

#include <algorithm>
#include <map>
#include <utility>

#include "engine/geometry/mesh_file.h"
#include "engine/io/file_magic.h"
#include "engine/io/xml_text.h"

namespace pedicel::robot {

namespace {

/// No robot needs more; entities of entities of entities could fill any memory.
constexpr std::size_t largest_text = 64u << 20;  // bytes
constexpr int most_levels = 200;                 // of elements within elements

std::optional<std::string> fault_of(const std::string& bytes, const std::string& file) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string::npos)
    return "an empty file, expected a URDF";
  if (geometry::is_lfs_pointer(bytes)) return geometry::lfs_advice;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff") ||
      (bytes.size() > 1 && (bytes[0] == '\0' || bytes[1] == '\0')))
    return "UTF-16: save as UTF-8 (iconv -f UTF-16 -t UTF-8 " + file + ")";
  if (const std::string kind = io::kind_of_bytes(bytes); !kind.empty()) return kind;
  if (bytes.find('\0') != std::string::npos) return "a binary file, expected a URDF";
  return {};
}

/// The quoted text that begins at the first quote after `from`; moves `from` behind it.
std::optional<std::string> quoted(const std::string& text, std::size_t& from, std::size_t end) {
  const std::size_t open = text.find_first_of("\"'", from);
  if (open >= end) return {};
  const std::size_t close = text.find(text[open], open + 1);
  if (close >= end) return {};
  from = close + 1;
  return text.substr(open + 1, close - open - 1);
}

/// Puts known entities in their places, once through.
std::string replaced(const std::string& text, const std::map<std::string, std::string>& entities) {
  std::string result;
  std::size_t at = 0;
  while (result.size() <= largest_text) {
    const std::size_t start = text.find('&', at);
    result.append(text, at, start - at);
    if (start == std::string::npos) break;
    const std::size_t stop = text.find(';', start);
    const auto known = stop == std::string::npos
                           ? entities.end()
                           : entities.find(text.substr(start + 1, stop - start - 1));
    if (known == entities.end()) {
      result += '&';
      at = start + 1;
    } else {
      result += known->second;
      at = stop + 1;
    }
  }
  return result;
}

/// Those of <!ENTITY NAME "TEXT"> in [begin, end). An entity may name those before it.
std::map<std::string, std::string> entities_in(const std::string& text, std::size_t begin,
                                               std::size_t end) {
  static const std::string mark = "<!ENTITY";
  std::map<std::string, std::string> entities;
  for (std::size_t at = text.find(mark, begin); at < end; at = text.find(mark, at)) {
    at += mark.size();
    const std::size_t first = std::min(text.find_first_not_of(" \t\r\n", at), end);
    const std::size_t last = std::min(text.find_first_of(" \t\r\n\"'", first), end);
    at = last;
    const auto value = quoted(text, at, end);
    if (value) entities[text.substr(first, last - first)] = replaced(*value, entities);
  }
  return entities;
}

/// Where the DOCTYPE that begins at `start` ends, behind its '>'.
std::size_t end_of_doctype(const std::string& text, std::size_t start) {
  const std::size_t plain = text.find('>', start), bracket = text.find('[', start);
  if (bracket > plain) return plain == std::string::npos ? text.size() : plain + 1;
  const std::size_t close = text.find("]", bracket);
  const std::size_t end = close == std::string::npos ? close : text.find('>', close);
  return end == std::string::npos ? text.size() : end + 1;
}

}  // namespace

std::optional<std::string> urdf_xml_text(const std::string& bytes, const std::string& file,
                                         Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& fault) {
    diagnostics.error({file}, fault);
    return std::nullopt;
  };
  if (const auto fault = fault_of(bytes, file)) return refuse(*fault);
  const std::string deep = "elements within elements, more than " + std::to_string(most_levels) +
                           " levels deep, expected a URDF";
  const std::size_t start = bytes.find("<!DOCTYPE"), root = bytes.find("<robot");
  if (start == std::string::npos || start > root) {
    if (io::is_xml_deeper(bytes, most_levels)) return refuse(deep);
    return io::xml_in_utf8(bytes, file, diagnostics);
  }
  const std::size_t end = end_of_doctype(bytes, start);
  const std::map<std::string, std::string> entities = entities_in(bytes, start, end);
  std::string text = bytes;
  for (std::size_t i = start; i < end; ++i)
    if (text[i] != '\n') text[i] = ' ';  // lines keep their numbers
  text = replaced(text, entities);
  if (text.size() > largest_text)
    return refuse("its entities make more than 64 MB of text, expected a URDF");
  if (io::is_xml_deeper(text, most_levels)) return refuse(deep);
  return io::xml_in_utf8(std::move(text), file, diagnostics);
}

}  // namespace pedicel::robot
