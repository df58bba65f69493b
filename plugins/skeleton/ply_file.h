#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::plant {

/// A property of a PLY element.
struct PlyProperty {
  std::string name;
  int type = 0;         ///< of its numbers, see ply_file.cpp
  int count_type = -1;  ///< of a list's length; -1: no list
};

/// An element as the header has it.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  int line = 0;  ///< of the header

  /// Of the first property of one of these names, whatever its capitals, that is a list or is none.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names,
                                  bool list = false) const;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  struct Comment {
    std::string text;
    int line = 0;
  };
  std::vector<Comment> comments;
  std::size_t body = 0;  ///< where the rows begin
  int body_line = 0;

  const PlyElement* find(std::initializer_list<std::string_view> names) const;
};

/// The header of a PLY file's bytes; nothing after an error.
std::optional<PlyHeader> read_ply_header(std::string_view bytes, const std::string& file,
                                         Diagnostics& diagnostics);

/// Rows of a PLY file, one after the other in the order of the header.
class PlyRows {
 public:
  /// `bytes` and `header` outlive it.
  PlyRows(std::string_view bytes, const PlyHeader& header, std::string file,
          Diagnostics& diagnostics);

  /// Whether what is left of the file can hold an element's rows: before memory is asked for.
  bool fits(const PlyElement& element);
  /// Reads a row into `values`, a list of numbers a property; false after an error.
  bool next(const PlyElement& element, std::vector<std::vector<double>>& values);
  /// Passes an element's rows over; false after an error.
  bool skip(const PlyElement& element);
  /// Of the row that was read last; without a line in a binary file.
  SourcePosition where() const { return {file_, line_, line_ > 0 ? 1 : 0}; }

 private:
  bool error(const std::string& what);
  bool binary_row(const PlyElement& element, std::vector<std::vector<double>>& values);
  bool text_row(const PlyElement& element, std::vector<std::vector<double>>& values);
  std::optional<double> binary_number(int type);
  std::optional<double> word(std::string_view& row);
  bool cut_off(const PlyElement& element);

  std::string_view bytes_;
  const PlyHeader& header_;
  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  int line_ = 0;
};

}  // namespace pedicel::plant
