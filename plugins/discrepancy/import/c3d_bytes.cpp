#include "plugins/discrepancy/import/c3d_bytes.h"

#include <bit>
#include <cstddef>

namespace pedicel::discrepancy {

std::uint8_t C3dBytes::byte(std::size_t at) const {
  return at < bytes_.size() ? static_cast<std::uint8_t>(bytes_[at]) : 0;
}

std::uint16_t C3dBytes::word(std::size_t at) const {
  const unsigned first = byte(at), second = byte(at + 1);
  const bool big_end_first = processor_ == C3dProcessor::mips;
  return static_cast<std::uint16_t>(big_end_first ? first << 8 | second : second << 8 | first);
}

double C3dBytes::real(std::size_t at) const {
  const std::uint32_t first = word(at), second = word(at + 2);
  if (processor_ == C3dProcessor::intel) return std::bit_cast<float>(second << 16 | first);
  const std::uint32_t bits = first << 16 | second;
  if (processor_ == C3dProcessor::mips) return std::bit_cast<float>(bits);
  // DEC's F format has the halves the other way round and an exponent that is two more than IEEE's;
  // its smallest exponent stands for 0.
  return (bits & 0x7F800000U) == 0 ? 0.0 : 0.25 * std::bit_cast<float>(bits);
}

std::string_view C3dBytes::text(std::size_t at, std::size_t count) const {
  return has(at, count) ? bytes_.substr(at, count) : std::string_view();
}

}  // namespace pedicel::discrepancy
