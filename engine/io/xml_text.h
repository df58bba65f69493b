#pragma once

#include <string>

#include "engine/core/diagnostics.h"

/// What XML must satisfy before TinyXML reads it.
namespace pedicel::io {

/// Whether elements lie within elements to more than `levels`, which recursion may not bear.
bool is_xml_deeper(const std::string& text, int levels);

/// With every byte that is no UTF-8 as '?', and a warning: TinyXML takes what follows a byte such
/// as Latin-1's for a part of the same character, a closing quote or the end of the text, too.
std::string xml_in_utf8(std::string text, const std::string& file, Diagnostics& diagnostics);

}  // namespace pedicel::io
