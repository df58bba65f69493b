#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "engine/mcap/records.h"

namespace pedicel::mcap {

struct WriterOptions {
  std::string profile = "ros2";
  std::string library;                   ///< what wrote the file
  std::size_t chunk_size = 1 << 20;      ///< bytes of messages after which a chunk is written
  std::uint64_t chunk_time = 500000000;  ///< ns of log time after which it is
};

/// Writes an MCAP file: messages in chunks that zstd makes smaller, each with an index, and at the
/// end a summary. What a program that is killed leaves can be read up to the last whole chunk.
class Writer {
 public:
  /// Makes the file, and its folder. Throws io::WriteError, as all functions here, where another
  /// writer has the file, too. What does not fit on a disk leaves what was whole under the name
  /// with ".part", and nothing under the name itself.
  Writer(std::filesystem::path path, WriterOptions options);
  /// close(), without a word where that fails.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Returns the channel's id. Equal schemas are written once.
  std::uint16_t add_channel(const std::string& topic, const Schema& schema,
                            const std::string& message_encoding = "cdr",
                            std::map<std::string, std::string> metadata = {});
  /// Time in ns, never before 0; of the recording and of the sender alike.
  void write(std::uint16_t channel, std::uint64_t time, std::string_view data);
  /// The last chunk, the summary, the end. To be called once nothing more comes.
  void close();

 private:
  struct ChunkIndex {
    std::uint64_t first = 0, last = 0, offset = 0, length = 0, index_length = 0, compressed = 0,
                  uncompressed = 0;
    std::map<std::uint16_t, std::uint64_t> indices;  // offset, by channel
  };
  void put(std::string_view bytes);
  [[noreturn]] void fail();
  void end_chunk();
  void put_summary();
  std::string statistics() const;

  std::filesystem::path path_;
  WriterOptions options_;
  int file_ = -1;  // file descriptor, locked
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;  // of all that was written
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<std::uint32_t> sequences_;  // by channel
  std::string chunk_;
  ChunkIndex now_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> places_;
  std::vector<ChunkIndex> chunks_;
  bool closed_ = false;
};

}  // namespace pedicel::mcap
