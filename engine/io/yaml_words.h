#pragma once

#include <string>

namespace pedicel::io {

/// The shortest text that reads back as the same number and that every YAML reader takes for one:
/// "2.0e+8", since YAML 1.1 readers take "2e+08" and "2e8" for words.
std::string yaml_number(double value);

/// A text as YAML reads it back: plain where nothing in it has a meaning there, else quoted.
std::string yaml_word(const std::string& text);

/// The same in quotes.
std::string yaml_quoted(const std::string& text);

}  // namespace pedicel::io
