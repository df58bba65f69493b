#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ros_messages/definition.h"

namespace pedicel::ros {

/// The fields of a message one by one, from bytes; what encodings have in common. Never reads more
/// than there is: good() is false once something did not fit, and stays so. Memory grows only with
/// what was read. `Self` is the encoding:
///   template <class T> void begin();    before a message of type T
///   void align(std::size_t size);       before a number of that size
///   bool turns();                       whether numbers are in another byte order than here
///   template <class T> void turn(T&);   such a number into one of this machine
///   void text(std::string&);
template <class Self>
class FieldReader {
 public:
  template <class T>
  void operator()(const char*, T& value) {
    read(value);
  }
  bool good() const { return good_; }
  std::size_t left() const { return bytes_.size() - at_; }

 protected:
  explicit FieldReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void read(T& value) {
    if (!good_) return;
    if constexpr (Message<T>) {
      self().template begin<T>();
      T::fields(value, self());
    } else if constexpr (std::is_same_v<T, std::string>) {
      self().text(value);
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
      self().align(sizeof(T));
      if (!good_ || count > left() / sizeof(T)) return fail();
      items.resize(count);
      std::memcpy(items.data(), bytes_.data() + at_, count * sizeof(T));
      at_ += count * sizeof(T);
      if (self().turns())
        for (T& item : items) self().turn(item);
    } else {
      // Each item takes a byte at least, so a wrong count ends before it has taken much.
      if (!good_ || count > left()) return fail();
      for (std::uint32_t i = 0; i < count && good_; ++i) read(items.emplace_back());
    }
  }
  template <class T>
  void number(T& value) {
    self().align(sizeof(T));
    if (!good_ || left() < sizeof(T)) return fail();
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (self().turns()) self().turn(value);
  }
  void fail() { good_ = false; }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool good_ = true;

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

}  // namespace pedicel::ros
