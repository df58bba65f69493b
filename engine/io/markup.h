#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pedicel::io {

/// A text that HTML and SVG show as it is: & < > and quotes escaped, control characters that XML
/// does not allow left out.
std::string escape_markup(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace pedicel::io
