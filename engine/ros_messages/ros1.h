#pragma once

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "engine/ros_messages/common_messages.h"
#include "engine/ros_messages/field_reader.h"

/// Messages as ROS 1 sends them: little-endian, packed, texts without a closing zero, and a header
/// that begins with a counter (`seq`). Fields are otherwise those of ROS 2.
namespace pedicel::ros {

static_assert(std::endian::native == std::endian::little, "ROS 1 has one byte order");

/// Used through from_ros1().
class Ros1Reader : public FieldReader<Ros1Reader> {
 public:
  explicit Ros1Reader(std::string_view bytes) : FieldReader(bytes) {}

 private:
  friend FieldReader<Ros1Reader>;
  template <class T>
  void begin() {
    std::uint32_t seq = 0;
    if constexpr (std::is_same_v<T, Header>) number(seq);
  }
  static bool turns() { return false; }
  template <class T>
  void turn(T&) const {}
  void align(std::size_t) {}
  void text(std::string& value) {
    std::uint32_t size = 0;
    number(size);
    if (!good_ || size > left()) return fail();
    value.assign(bytes_.substr(at_, size));
    at_ += size;
  }
};

/// Nothing where the bytes are no such message.
template <Message M>
std::optional<M> from_ros1(std::string_view bytes) {
  Ros1Reader reader(bytes);
  M message;
  M::fields(message, reader);
  if (!reader.good()) return std::nullopt;
  return message;
}

}  // namespace pedicel::ros
