#pragma once

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "engine/ros_messages/definition.h"
#include "engine/ros_messages/field_reader.h"

/// Messages as bytes and back: CDR as ROS 2 sends it (plain CDR version 1, four bytes of header,
/// each number at a multiple of its own size).
namespace pedicel::ros {

static_assert(std::endian::native == std::endian::little, "CDR is written as the machine has it");

inline constexpr std::size_t cdr_header_size = 4;

/// Writes little-endian CDR. Used through to_cdr().
class CdrWriter {
 public:
  CdrWriter() : bytes_("\0\1\0\0", cdr_header_size) {}

  template <class T>
  void operator()(const char*, const T& value) {
    write(value);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (Message<T>) {
      T::fields(value, *this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      number(static_cast<std::uint32_t>(value.size() + 1));
      bytes_.append(value.c_str(), value.size() + 1);
    } else if constexpr (IsVector<T>::value) {
      number(static_cast<std::uint32_t>(value.size()));
      write_all(value);
    } else if constexpr (IsArray<T>::value) {
      write_all(value);
    } else {
      number(value);
    }
  }
  template <class Items>
  void write_all(const Items& items) {
    using T = typename Items::value_type;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (items.empty()) return;
      align(sizeof(T));
      bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
    } else {
      for (const T& item : items) write(item);
    }
  }
  template <class T>
  void number(T value) {
    align(sizeof(T));
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void align(std::size_t size) {
    while ((bytes_.size() - cdr_header_size) % size != 0) bytes_.push_back('\0');
  }

  std::string bytes_;
};

/// Reads CDR of either byte order. Used through from_cdr().
class CdrReader : public FieldReader<CdrReader> {
 public:
  explicit CdrReader(std::string_view bytes);

 private:
  friend FieldReader<CdrReader>;
  template <class T>
  void begin() {}
  bool turns() const { return swapped_; }
  template <class T>
  void turn(T& value) const {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
  }
  void text(std::string& value);
  void align(std::size_t size);

  bool swapped_ = false;
};

/// With the header of four bytes.
template <Message M>
std::string to_cdr(const M& message) {
  CdrWriter writer;
  M::fields(message, writer);
  return writer.take();
}

/// Nothing where the bytes are no such message. What stands behind it is let alone: senders may
/// pad.
template <Message M>
std::optional<M> from_cdr(std::string_view bytes) {
  CdrReader reader(bytes);
  M message;
  M::fields(message, reader);
  if (!reader.good()) return std::nullopt;
  return message;
}

}  // namespace pedicel::ros
