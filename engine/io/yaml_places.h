#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

/// Where the parts of a YAML text begin and end, as byte offsets: what yaml-cpp does not tell.
namespace pedicel::io {

/// Where a key, or a value without an anchor and a tag, begins.
std::size_t start_of(const YAML::Node& node);
/// Where a value begins, behind its anchor and tag.
std::size_t start_of(const std::string& text, const YAML::Node& node);
/// Behind the colon of a key.
std::size_t end_of_key(const std::string& text, const YAML::Node& key);
/// Behind the "*name" that is a key's value in place of one of its own; 0: the value is its own.
/// `at` becomes the star's place.
std::size_t end_of_alias(const std::string& text, const YAML::Node& key, std::size_t& at);
/// A value in one line: lists and maps in brackets, quoted words quoted. Numbers stay as written.
std::string flow_text(const YAML::Node& node);
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
