#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

/// MCAP's records as bytes: the open specification, version 0 of the format. All numbers are
/// little-endian; a text or a block has its length before it.
namespace pedicel::mcap {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as the machine has them");

inline constexpr std::string_view magic("\x89MCAP0\r\n", 8);

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0a,
  statistics = 0x0b,
  metadata = 0x0c,
  metadata_index = 0x0d,
  summary_offset = 0x0e,
  data_end = 0x0f,
};
/// Of a record before its content: the op and eight bytes of length.
inline constexpr std::size_t record_head = 9;

/// What a topic's messages are: `data` is the text of their definition.
struct Schema {
  std::string name;      ///< "sensor_msgs/msg/JointState"
  std::string encoding;  ///< "ros2msg"
  std::string data;
};

struct Channel {
  std::uint16_t schema = 0;  ///< id; 0: none
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  std::map<std::string, std::string> metadata;
};

/// Puts values one behind the other.
class Bytes {
 public:
  template <class T>
  Bytes& number(T value) {
    all_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    all_.append(value);
    return *this;
  }
  Bytes& raw(std::string_view value) {
    all_.append(value);
    return *this;
  }
  const std::string& all() const { return all_; }

 private:
  std::string all_;
};

/// Takes values from the front; good() is false once one did not fit, and stays so.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : left_(bytes) {}

  template <class T>
  T number() {
    T value{};
    if (!take(sizeof value)) return value;
    std::memcpy(&value, taken_.data(), sizeof value);
    return value;
  }
  std::string_view text() { return block(number<std::uint32_t>()); }
  std::string_view block(std::uint64_t size) { return take(size) ? taken_ : std::string_view(); }
  std::string_view rest() { return block(left_.size()); }
  bool empty() const { return left_.empty(); }
  bool good() const { return good_; }

 private:
  bool take(std::uint64_t size) {
    good_ = good_ && size <= left_.size();
    if (!good_) return false;
    taken_ = left_.substr(0, size);
    left_.remove_prefix(size);
    return true;
  }
  std::string_view left_, taken_;
  bool good_ = true;
};

/// A whole record.
std::string record(Op op, std::string_view content);
std::string schema_record(std::uint16_t id, const Schema& schema);
std::string channel_record(std::uint16_t id, const Channel& channel);

/// zlib's CRC-32 of more bytes after those that gave `crc` (0: none).
std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace pedicel::mcap
