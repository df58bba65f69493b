#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pedicel {

/// Bytes of the UTF-8 character that begins `text`, 0 where none does; its code in `code`. The text
/// is not empty.
std::size_t utf8_length(std::string_view text, std::uint32_t& code);

}  // namespace pedicel
