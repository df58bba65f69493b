#pragma once

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "pedicel/ros_messages/definition.h"

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

/// Reads CDR of either byte order, and never more than there is: good() is false once something
/// did not fit, and stays so. Memory grows only with what was read. Used through from_cdr().
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes);

  template <class T>
  void operator()(const char*, T& value) {
    read(value);
  }
  bool good() const { return good_; }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  template <class T>
  void read(T& value) {
    if (!good_) return;
    if constexpr (Message<T>) {
      T::fields(value, *this);
    } else if constexpr (std::is_same_v<T, std::string>) {
      text(value);
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
      if (count == 0) return;
      align(sizeof(T));
      if (!good_ || count > left() / sizeof(T)) return fail();
      items.resize(count);
      std::memcpy(items.data(), bytes_.data() + at_, count * sizeof(T));
      at_ += count * sizeof(T);
      if (swapped_)
        for (T& item : items) item = turned(item);
    } else {
      // Each item takes a byte at least, so a wrong count ends before it has taken much.
      if (count > left()) return fail();
      for (std::uint32_t i = 0; i < count && good_; ++i) read(items.emplace_back());
    }
  }
  template <class T>
  void number(T& value) {
    align(sizeof(T));
    if (!good_ || left() < sizeof(T)) return fail();
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swapped_) value = turned(value);
  }
  template <class T>
  static T turned(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  void text(std::string& value);
  void align(std::size_t size);
  void fail() { good_ = false; }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true, swapped_ = false;
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
