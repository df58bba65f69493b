#pragma once

#include <cstdint>
#include <string_view>

namespace pedicel::discrepancy {

/// How a C3D file writes its numbers: as the computer that it was made on.
enum class C3dProcessor : int { intel = 84, dec = 85, mips = 86 };

/// Numbers in the bytes of a C3D file. Reading beyond the end gives 0: callers check lengths first.
class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, C3dProcessor processor) : bytes_(bytes), processor_(processor) {}

  std::size_t size() const { return bytes_.size(); }
  /// Whether `count` bytes are there from `at` on.
  bool has(std::size_t at, std::size_t count) const {
    return at <= bytes_.size() && count <= bytes_.size() - at;
  }
  std::uint8_t byte(std::size_t at) const;
  std::int8_t signed_byte(std::size_t at) const { return static_cast<std::int8_t>(byte(at)); }
  std::uint16_t word(std::size_t at) const;
  std::int16_t signed_word(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
  double real(std::size_t at) const;  ///< of 4 bytes
  std::string_view text(std::size_t at, std::size_t count) const;

 private:
  std::string_view bytes_;
  C3dProcessor processor_;
};

}  // namespace pedicel::discrepancy
