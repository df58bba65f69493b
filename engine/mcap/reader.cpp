#include "engine/mcap/reader.h"

#include <zstd.h>

#include <fstream>
#include <memory>

#include "engine/core/diagnostics.h"
#include "engine/mcap/unpack.h"

namespace pedicel::mcap {

namespace {

class FileReader {
 public:
  FileReader(std::istream& file, const std::string& name,
             const std::function<void(const Message&)>& take, const ReaderLimits& limits)
      : file_(file), name_(name), take_(take), limits_(limits) {}

  ReadEnd read() {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
    std::string head(magic.size(), '\0');
    if (size_ < head.size() ||
        !file_.read(head.data(), static_cast<std::streamsize>(head.size())) || head != magic)
      fail("no MCAP file, expected one that begins with \"\\x89MCAP0\\r\\n\"");
    at_ = head.size();
    while (next_record()) {
    }
    end_.at = at_;
    return end_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidFile({name_}, "at byte " + std::to_string(at_) + ": " + what);
  }

  /// False at the end, of whatever kind.
  bool next_record() {
    char head[record_head];
    if (size_ - at_ < record_head || !file_.read(head, record_head)) return false;
    Fields fields({head, record_head});
    const auto op = fields.number<Op>();
    const auto length = fields.number<std::uint64_t>();
    if (length > size_ - at_ - record_head) {
      if (has_its_end())
        fail("damaged: a record of " + std::to_string(length) + " bytes where " +
             std::to_string(size_ - at_ - record_head) +
             " are left, expected one that ends before the file does (mcap recover writes what is "
             "whole)");
      return false;  // cut off
    }
    if (length > limits_.record)
      fail("a record of " + std::to_string(length) + " bytes, expected at most " +
           std::to_string(limits_.record));
    content_.resize(length);
    if (!file_.read(content_.data(), static_cast<std::streamsize>(length))) return false;
    if (op == Op::data_end || op == Op::footer) {
      end_.whole = true;
      return false;
    }
    if (op == Op::chunk)
      chunk(content_);
    else
      simple(op, content_);
    at_ += record_head + length;
    return true;
  }

  /// Who is killed while writing leaves none.
  bool has_its_end() {
    if (size_ < 2 * magic.size()) return false;
    std::string tail(magic.size(), '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(size_ - magic.size()));
    return file_.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail == magic;
  }

  void chunk(std::string_view content) {
    Fields fields(content);
    fields.number<std::uint64_t>();
    fields.number<std::uint64_t>();
    const auto size = fields.number<std::uint64_t>();
    const auto crc = fields.number<std::uint32_t>();
    const std::string_view compression = fields.text();
    const std::string_view small = fields.block(fields.number<std::uint64_t>());
    if (!fields.good()) fail("a chunk that is shorter than its own fields");
    if (size > limits_.record)
      fail("a chunk of " + std::to_string(size) + " bytes, expected at most " +
           std::to_string(limits_.record));
    std::string_view records = small;
    if (compression == "zstd") {
      records = decompressed(small, size);
    } else if (compression == "lz4") {
      if (const std::string fault = unpack(compression, small, size, records_); !fault.empty())
        fail(fault);
      records = records_;
    } else if (!compression.empty()) {
      fail("a chunk is compressed with " + in_quotes(compression) +
           ", expected zstd, lz4 or none (mcap compress --compression zstd writes it anew)");
    }
    if (records.size() != size)
      fail("a chunk of " + std::to_string(records.size()) + " bytes, and its head says " +
           std::to_string(size));
    if (crc != 0 && crc_of(records) != crc) fail("a chunk is damaged: its CRC does not agree");
    records_of(records);
  }

  void records_of(std::string_view records) {
    Fields fields(records);
    while (!fields.empty()) {
      const auto op = fields.number<Op>();
      const std::string_view content = fields.block(fields.number<std::uint64_t>());
      if (!fields.good()) fail("a record in a chunk goes on behind the chunk's end");
      simple(op, content);
    }
  }

  /// Grows with what comes, not with what the file says.
  std::string_view decompressed(std::string_view small, std::uint64_t size) {
    if (!stream_) stream_.reset(ZSTD_createDStream());
    if (!stream_) throw std::bad_alloc();
    ZSTD_initDStream(stream_.get());
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, 27);
    records_.clear();
    ZSTD_inBuffer in{small.data(), small.size(), 0};
    std::size_t more = 1;
    std::string block(ZSTD_DStreamOutSize(), '\0');
    while (more != 0) {
      ZSTD_outBuffer out{block.data(), block.size(), 0};
      more = ZSTD_decompressStream(stream_.get(), &out, &in);
      if (ZSTD_isError(more)) fail(std::string("a chunk is no zstd: ") + ZSTD_getErrorName(more));
      records_.append(block.data(), out.pos);
      if (records_.size() > size) fail("a chunk is longer than its head says");
      if (more != 0 && in.pos == in.size && out.pos < out.size) fail("a chunk ends too soon");
    }
    return records_;
  }

  void simple(Op op, std::string_view content) {
    Fields fields(content);
    if (op == Op::schema) {
      const auto id = fields.number<std::uint16_t>();
      const std::string_view name = fields.text(), encoding = fields.text(), data = fields.text();
      if (!fields.good() || id == 0) fail("a schema that is none");
      if (schemas_.size() >= limits_.schemas && !schemas_.contains(id)) fail("too many schemas");
      schemas_[id] = {std::string(name), std::string(encoding), std::string(data)};
    } else if (op == Op::channel) {
      read_channel(fields);
    } else if (op == Op::message) {
      read_message(fields);
    } else if (op == Op::header) {
      fields.text();
      const std::string_view library = fields.text();
      if (!fields.good()) fail("a head that is none");
      end_.library = library;
    }
  }

  void read_channel(Fields& fields) {
    const auto id = fields.number<std::uint16_t>();
    Channel channel;
    channel.schema = fields.number<std::uint16_t>();
    channel.topic = fields.text();
    channel.message_encoding = fields.text();
    Fields pairs(fields.text());
    while (fields.good() && !pairs.empty() && pairs.good()) {
      const std::string key(pairs.text());
      channel.metadata[key] = pairs.text();
    }
    if (!fields.good() || !pairs.good()) fail("a channel that is none");
    if (channel.schema != 0 && !schemas_.contains(channel.schema))
      fail("the channel " + in_quotes(channel.topic) + " names a schema that is not there");
    if (channels_.size() >= limits_.channels && !channels_.contains(id)) fail("too many channels");
    channels_[id] = std::move(channel);
  }

  void read_message(Fields& fields) {
    const auto id = fields.number<std::uint16_t>();
    fields.number<std::uint32_t>();
    const auto log_time = fields.number<std::uint64_t>();
    const auto publish_time = fields.number<std::uint64_t>();
    if (!fields.good()) fail("a message that is shorter than its own fields");
    const auto channel = channels_.find(id);
    if (channel == channels_.end()) fail("a message of a channel that is not there");
    static const Schema none;
    const auto schema = schemas_.find(channel->second.schema);
    ++end_.messages;
    take_({channel->second, schema == schemas_.end() ? none : schema->second, log_time,
           publish_time, fields.rest()});
  }

  struct FreeStream {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };

  std::istream& file_;
  const std::string& name_;
  const std::function<void(const Message&)>& take_;
  const ReaderLimits& limits_;
  std::uint64_t size_ = 0, at_ = 0;
  std::string content_, records_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::unique_ptr<ZSTD_DStream, FreeStream> stream_;
  ReadEnd end_;
};

}  // namespace

namespace {

std::string why_not(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return "is a folder, expected an MCAP file";
  return error ? error.message() : "expected an MCAP file that can be";
}

}  // namespace

ReadEnd read(std::istream& file, const std::string& name,
             const std::function<void(const Message&)>& take, const ReaderLimits& limits) {
  return FileReader(file, name, take, limits).read();
}

ReadEnd read(const std::filesystem::path& path, const std::function<void(const Message&)>& take,
             const ReaderLimits& limits) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InvalidFile({path.string()}, "cannot be read: " + why_not(path));
  return read(file, path.string(), take, limits);
}

bool is_mcap(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(magic.size(), '\0');
  return file.read(head.data(), static_cast<std::streamsize>(head.size())) && head == magic;
}

}  // namespace pedicel::mcap
