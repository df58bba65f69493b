#include "engine/rosbag/reader.h"

#include <algorithm>
#include <fstream>

#include "engine/core/diagnostics.h"
#include "engine/mcap/unpack.h"

namespace pedicel::rosbag {

namespace {

using mcap::Fields;

constexpr std::string_view version_2("#ROSBAG V2.0\n", 13);
constexpr std::string_view any_version("#ROSBAG V", 9);
enum class Op : unsigned char {
  message = 2,
  head = 3,
  index = 4,
  chunk = 5,
  info = 6,
  connection = 7
};

/// "sensor_msgs/JointState" as ROS 2 has it.
std::string name_of_type(std::string_view type) {
  if (type == "tf/tfMessage") return "tf2_msgs/msg/TFMessage";  // the same under its old name
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, slash)) + "/msg/" + std::string(type.substr(slash + 1));
}

/// The fields "name=value" of a record's head.
class Head {
 public:
  /// False where it is none.
  bool read(std::string_view bytes) {
    all_.clear();
    Fields fields(bytes);
    while (!fields.empty()) {
      const std::string_view field = fields.text();
      const std::size_t equals = field.find('=');
      if (!fields.good() || equals == std::string_view::npos || all_.size() == most) return false;
      all_.emplace_back(field.substr(0, equals), field.substr(equals + 1));
    }
    return true;
  }
  std::string_view text(std::string_view name) const {
    const auto found =
        std::ranges::find_if(all_, [&](const auto& one) { return one.first == name; });
    return found == all_.end() ? std::string_view() : found->second;
  }
  template <class T>
  bool number(std::string_view name, T& value) const {
    Fields fields(text(name));
    value = fields.number<T>();
    return fields.good() && fields.empty();
  }

 private:
  static constexpr std::size_t most = 100;
  std::vector<std::pair<std::string_view, std::string_view>> all_;
};

class BagReader {
 public:
  BagReader(std::istream& file, const std::string& name,
            const std::function<void(const mcap::Message&)>& take, const mcap::ReaderLimits& limits)
      : file_(file), name_(name), take_(take), limits_(limits) {}

  mcap::ReadEnd read() {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
    std::string head(version_2.size(), '\0');
    if (size_ < head.size() ||
        !file_.read(head.data(), static_cast<std::streamsize>(head.size())) || head != version_2)
      fail(head.starts_with(any_version)
               ? "a bag of another version, expected 2.0 (`rosbag migrate` writes it anew)"
               : "no bag of ROS 1, expected one that begins with \"#ROSBAG V2.0\"");
    at_ = head.size();
    while (next_record()) {
    }
    end_.at = at_;
    end_.whole = closed_ && at_ == size_;
    end_.library = "rosbag";
    return end_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidFile({name_}, "at byte " + std::to_string(at_) + ": " + what);
  }

  /// A length, and so many bytes. False where the file ends before.
  bool block(std::string& bytes) {
    char length[4];
    if (size_ - read_ < sizeof length || !file_.read(length, sizeof length)) return false;
    read_ += sizeof length;
    Fields fields({length, sizeof length});
    const auto size = fields.number<std::uint32_t>();
    if (size > size_ - read_) return false;  // cut off
    if (size > limits_.record)
      fail("a record of " + std::to_string(size) + " bytes, expected at most " +
           std::to_string(limits_.record));
    bytes.resize(size);
    if (!file_.read(bytes.data(), static_cast<std::streamsize>(size))) return false;
    read_ += size;
    return true;
  }

  bool next_record() {
    read_ = at_;
    if (!block(head_bytes_) || !block(content_)) return false;
    Head head;
    if (!head.read(head_bytes_)) fail("a record's head that is none");
    const Op op = op_of(head);
    if (op == Op::head)
      read_head(head);
    else if (op == Op::chunk)
      read_chunk(head);
    else
      simple(op, head, content_);
    at_ = read_;
    return true;
  }

  Op op_of(const Head& head) const {
    unsigned char op = 0;
    if (!head.number("op", op)) fail("a record without op");
    return static_cast<Op>(op);
  }

  void read_head(const Head& head) {
    std::uint64_t index = 0;
    if (!head.number("index_pos", index)) fail("a head without index_pos");
    closed_ = index != 0;
    if (!head.text("encryptor").empty())
      fail("the bag is encrypted, expected one that is not (`rosbag decrypt`)");
  }

  void read_chunk(const Head& head) {
    std::uint32_t size = 0;
    if (!head.number("size", size)) fail("a chunk without size");
    if (size > limits_.record)
      fail("a chunk of " + std::to_string(size) + " bytes, expected at most " +
           std::to_string(limits_.record));
    const std::string compression(head.text("compression"));
    std::string_view records = content_;
    if (compression != "none") {
      if (const std::string fault = mcap::unpack(compression, content_, size, unpacked_);
          !fault.empty())
        fail(fault);
      records = unpacked_;
    }
    if (records.size() != size)
      fail("a chunk of " + std::to_string(records.size()) + " bytes, and its head says " +
           std::to_string(size));
    Fields fields(records);
    while (!fields.empty()) {
      const std::string_view inner_head = fields.text(), content = fields.text();
      Head inner;
      if (!fields.good()) fail("a record in a chunk goes on behind the chunk's end");
      if (!inner.read(inner_head)) fail("a record's head in a chunk that is none");
      simple(op_of(inner), inner, content);
    }
  }

  // The index and what is unknown are passed over.
  void simple(Op op, const Head& head, std::string_view content) {
    if (op == Op::connection)
      read_connection(head, content);
    else if (op == Op::message)
      read_message(head, content);
  }

  void read_connection(const Head& head, std::string_view content) {
    std::uint32_t id = 0;
    Head about;
    if (!head.number("conn", id) || !about.read(content)) fail("a connection that is none");
    if (connections_.size() >= limits_.channels && !connections_.contains(id))
      fail("too many connections");
    Connection& one = connections_[id];
    one.channel.topic = head.text("topic");
    one.channel.message_encoding = "ros1";
    one.channel.schema = 1;
    one.schema = {name_of_type(about.text("type")), "ros1msg",
                  std::string(about.text("message_definition"))};
  }

  void read_message(const Head& head, std::string_view content) {
    std::uint32_t id = 0;
    std::uint64_t time = 0;
    if (!head.number("conn", id) || !head.number("time", time))
      fail("a message without its fields");
    const auto connection = connections_.find(id);
    if (connection == connections_.end()) fail("a message of a connection that is not there");
    // Seconds in the lower half, nanoseconds in the upper one.
    const std::uint64_t at = (time & 0xffffffffU) * 1'000'000'000 + (time >> 32);
    ++end_.messages;
    take_({connection->second.channel, connection->second.schema, at, at, content});
  }

  struct Connection {
    mcap::Channel channel;
    mcap::Schema schema;
  };
  std::istream& file_;
  const std::string& name_;
  const std::function<void(const mcap::Message&)>& take_;
  const mcap::ReaderLimits& limits_;
  std::uint64_t size_ = 0, at_ = 0, read_ = 0;  // bytes; of the file, of whole records, read
  std::string head_bytes_, content_, unpacked_;
  std::map<std::uint32_t, Connection> connections_;
  bool closed_ = false;
  mcap::ReadEnd end_;
};

}  // namespace

mcap::ReadEnd read(std::istream& file, const std::string& name,
                   const std::function<void(const mcap::Message&)>& take,
                   const mcap::ReaderLimits& limits) {
  return BagReader(file, name, take, limits).read();
}

mcap::ReadEnd read(const std::filesystem::path& path,
                   const std::function<void(const mcap::Message&)>& take,
                   const mcap::ReaderLimits& limits) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InvalidFile({path.string()}, "cannot be read, expected a bag");
  return rosbag::read(file, path.string(), take, limits);
}

bool is_bag(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(any_version.size(), '\0');
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && head == any_version;
}

}  // namespace pedicel::rosbag
