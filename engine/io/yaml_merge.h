#pragma once

#include <string>

namespace pedicel::io {

/// What changed between two YAML texts (`before` and `now`, the same things in the same order but
/// for the change), done in a third that says what `before` says in its own way: comments, order,
/// anchors and layout of everything else stay (YamlText). Entries of lists that have a `name` are
/// known by it, others by their place. Throws UsageError where the text cannot be changed so.
///
/// A value that an anchor is on is changed for its aliases, too: who calls compares what came out.
std::string merge_yaml(const std::string& text, const std::string& before, const std::string& now);

}  // namespace pedicel::io
