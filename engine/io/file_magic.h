#pragma once

#include <string>
#include <string_view>

namespace pedicel::io {

/// What a file is by its first bytes, where it is none of the texts that the program reads: "an
/// Excel workbook (.xlsx), expected ...". Empty where nothing is known of them.
std::string kind_of_bytes(std::string_view bytes);

/// The same for tables of motion capture, which have several lines of names in place of one and are
/// for `pedicel import`.
std::string kind_of_export(std::string_view text);

}  // namespace pedicel::io
