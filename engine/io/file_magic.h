#pragma once

#include <string>
#include <string_view>

namespace pedicel::io {

/// What a file is by its first bytes, where it is none of the texts that the program reads: "an
/// Excel workbook (.xlsx), expected ...". Empty where nothing is known of them.
std::string kind_of_bytes(std::string_view bytes);

}  // namespace pedicel::io
