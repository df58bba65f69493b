#pragma once

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "pedicel/ros_messages/common_messages.h"

/// Messages as ROS 1 sends them: little-endian, packed, texts without a closing zero, and a header
/// that begins with a counter (`seq`). Fields are otherwise those of ROS 2.
namespace pedicel::ros {

static_assert(std::endian::native == std::endian::little, "ROS 1 has one byte order");

/// Never reads more than there is: good() is false once something did not fit, and stays so. Memory
/// grows only with what was read. Used through from_ros1().
class Ros1Reader {
 public:
  explicit Ros1Reader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  void operator()(const char*, T& value) {
    read(value);
  }
  bool good() const { return good_; }

 private:
  template <class T>
  void read(T& value) {
    if (!good_) return;
    if constexpr (std::is_same_v<T, Header>) {
      std::uint32_t seq = 0;
      number(seq);
      T::fields(value, *this);
    } else if constexpr (Message<T>) {
      T::fields(value, *this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      std::uint32_t size = 0;
      number(size);
      if (size > left_.size()) return fail();
      value.assign(left_.substr(0, size));
      left_.remove_prefix(size);
    } else if constexpr (IsVector<T>::value) {
      sequence(value);
    } else if constexpr (IsArray<T>::value) {
      for (auto& item : value) read(item);
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      number(byte);
      value = byte != 0;
    } else {
      number(value);
    }
  }
  template <class T>
  void sequence(std::vector<T>& items) {
    std::uint32_t count = 0;
    number(count);
    items.clear();
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (!good_ || count > left_.size() / sizeof(T)) return fail();
      items.resize(count);
      if (count > 0) std::memcpy(items.data(), left_.data(), count * sizeof(T));
      left_.remove_prefix(count * sizeof(T));
    } else {
      // Each item takes a byte at least, so a wrong count ends before it has taken much.
      if (!good_ || count > left_.size()) return fail();
      for (std::uint32_t i = 0; i < count && good_; ++i) read(items.emplace_back());
    }
  }
  template <class T>
  void number(T& value) {
    if (!good_ || left_.size() < sizeof(T)) return fail();
    std::memcpy(&value, left_.data(), sizeof(T));
    left_.remove_prefix(sizeof(T));
  }
  void fail() { good_ = false; }

  std::string_view left_;
  bool good_ = true;
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
