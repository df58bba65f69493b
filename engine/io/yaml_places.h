#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

/// Where the parts of a YAML text begin and end, as byte offsets: what yaml-cpp does not tell.
namespace pedicel::io {

std::size_t start_of(const YAML::Node& node);
/// Whether a list or map stands in brackets.
bool is_flow(const std::string& text, const YAML::Node& node);
std::size_t line_start(const std::string& text, std::size_t at);
/// Behind the bracket that closes the one at `at`.
std::size_t end_of_flow(const std::string& text, std::size_t at);
/// Behind a value that can be replaced as a whole: a scalar in one line, a list or map in brackets.
/// Throws UsageError, without the value's name, for another.
std::size_t end_of_value(const std::string& text, const YAML::Node& node, bool in_flow);
/// Behind the last line that belongs to the entry of a block that begins in the line of `at`, whose
/// keys (or dashes, `is_list`) stand in that column.
std::size_t end_of_block_entry(const std::string& text, std::size_t at, std::size_t column,
                               bool is_list);

}  // namespace pedicel::io
