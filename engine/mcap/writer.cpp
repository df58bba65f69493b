#include "engine/mcap/writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/output_check.h"

namespace pedicel::mcap {

namespace {

constexpr int compression_level = 1;  // a run is not to wait for its log

std::string compressed(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), compression_level);
  if (ZSTD_isError(size)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::string reason() {
  return std::strerror(errno);
}

}  // namespace

Writer::Writer(std::filesystem::path path, WriterOptions options)
    : path_(std::move(path)), options_(std::move(options)) {
  std::error_code none;
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), none);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw io::WriteError(path_.string() + ": cannot be written: " + reason());
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(file_);
    throw io::WriteError(path_.string() + ": " + io::other_run_writes);
  }
  if (::ftruncate(file_, 0) != 0) fail();
  put(magic);
  put(record(Op::header, Bytes().text(options_.profile).text(options_.library).all()));
}

Writer::~Writer() {
  try {
    close();
  } catch (const std::exception&) {  // NOLINT: nobody is there to hear it
  }
}

/// Handed to the system at once, so that a killed program leaves it.
void Writer::put(std::string_view bytes) {
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t n = ::write(file_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  offset_ += bytes.size();
  crc_ = crc_of(bytes, crc_);
}

void Writer::fail() {
  std::string text = path_.string() + ": cannot be written: " + reason();
  const std::filesystem::path part = path_.string() + ".part";
  std::error_code error;
  const bool kept = !chunks_.empty() && ::ftruncate(file_, static_cast<off_t>(offset_)) == 0;
  if (kept) std::filesystem::rename(path_, part, error);
  if (!kept || error)
    std::filesystem::remove(path_, error);
  else
    text += "; what was whole is in " + part.string();
  ::close(std::exchange(file_, -1));
  closed_ = true;
  throw io::WriteError(text);
}

std::uint16_t Writer::add_channel(const std::string& topic, const Schema& schema,
                                  const std::string& message_encoding,
                                  std::map<std::string, std::string> metadata) {
  PEDICEL_ASSERT(channels_.size() < std::numeric_limits<std::uint16_t>::max());
  const auto known = std::ranges::find_if(schemas_, [&](const Schema& one) {
    return one.name == schema.name && one.data == schema.data && one.encoding == schema.encoding;
  });
  const auto schema_id = static_cast<std::uint16_t>(known - schemas_.begin() + 1);
  if (known == schemas_.end()) {
    schemas_.push_back(schema);
    chunk_ += schema_record(schema_id, schema);
  }
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back({schema_id, topic, message_encoding, std::move(metadata)});
  sequences_.push_back(0);
  chunk_ += channel_record(id, channels_.back());
  return id;
}

void Writer::write(std::uint16_t channel, std::uint64_t time, std::string_view data) {
  PEDICEL_ASSERT(channel < channels_.size() && !closed_);
  const bool late = !places_.empty() && time >= now_.first + options_.chunk_time;
  if (chunk_.size() >= options_.chunk_size || late) end_chunk();
  if (places_.empty()) now_.first = now_.last = time;
  now_.first = std::min(now_.first, time);
  now_.last = std::max(now_.last, time);
  places_[channel].emplace_back(time, chunk_.size());
  chunk_ += record(Op::message, Bytes()
                                    .number(channel)
                                    .number(sequences_[channel]++)
                                    .number(time)
                                    .number(time)
                                    .raw(data)
                                    .all());
}

void Writer::end_chunk() {
  if (chunk_.empty()) return;
  const std::string small = compressed(chunk_);
  now_.offset = offset_;
  now_.compressed = small.size();
  now_.uncompressed = chunk_.size();
  std::string all = record(Op::chunk, Bytes()
                                          .number(now_.first)
                                          .number(now_.last)
                                          .number(now_.uncompressed)
                                          .number(crc_of(chunk_))
                                          .text("zstd")
                                          .number(now_.compressed)
                                          .raw(small)
                                          .all());
  now_.length = all.size();
  for (const auto& [channel, places] : places_) {
    now_.indices[channel] = offset_ + all.size();
    Bytes pairs;
    for (const auto& [time, place] : places) pairs.number(time).number(place);
    all += record(Op::message_index, Bytes().number(channel).text(pairs.all()).all());
  }
  now_.index_length = all.size() - now_.length;
  put(all);
  chunks_.push_back(std::move(now_));
  now_ = {};
  places_.clear();
  chunk_.clear();
}

std::string Writer::statistics() const {
  std::uint64_t messages = 0, first = 0, last = 0;
  bool any = false;
  Bytes counts;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    messages += sequences_[c];
    counts.number(static_cast<std::uint16_t>(c)).number(std::uint64_t{sequences_[c]});
  }
  for (const ChunkIndex& chunk : chunks_) {
    if (chunk.indices.empty()) continue;
    first = any ? std::min(first, chunk.first) : chunk.first;
    last = std::max(last, chunk.last);
    any = true;
  }
  return record(Op::statistics, Bytes()
                                    .number(messages)
                                    .number(static_cast<std::uint16_t>(schemas_.size()))
                                    .number(static_cast<std::uint32_t>(channels_.size()))
                                    .number(std::uint32_t{0})
                                    .number(std::uint32_t{0})
                                    .number(static_cast<std::uint32_t>(chunks_.size()))
                                    .number(first)
                                    .number(last)
                                    .text(counts.all())
                                    .all());
}

void Writer::put_summary() {
  const std::uint64_t start = offset_;
  std::string summary;
  std::string offsets;
  const auto end_group = [&](Op op, std::size_t begin) {
    if (summary.size() == begin) return;
    offsets += record(Op::summary_offset, Bytes()
                                              .number(op)
                                              .number(start + begin)
                                              .number(std::uint64_t{summary.size() - begin})
                                              .all());
  };
  std::size_t begin = 0;
  for (std::size_t s = 0; s < schemas_.size(); ++s)
    summary += schema_record(static_cast<std::uint16_t>(s + 1), schemas_[s]);
  end_group(Op::schema, begin);
  begin = summary.size();
  for (std::size_t c = 0; c < channels_.size(); ++c)
    summary += channel_record(static_cast<std::uint16_t>(c), channels_[c]);
  end_group(Op::channel, begin);
  begin = summary.size();
  summary += statistics();
  end_group(Op::statistics, begin);
  begin = summary.size();
  for (const ChunkIndex& chunk : chunks_) {
    Bytes indices;
    for (const auto& [channel, offset] : chunk.indices) indices.number(channel).number(offset);
    summary += record(Op::chunk_index, Bytes()
                                           .number(chunk.first)
                                           .number(chunk.last)
                                           .number(chunk.offset)
                                           .number(chunk.length)
                                           .text(indices.all())
                                           .number(chunk.index_length)
                                           .text("zstd")
                                           .number(chunk.compressed)
                                           .number(chunk.uncompressed)
                                           .all());
  }
  end_group(Op::chunk_index, begin);
  // The footer without its last field counts for the CRC, too.
  const std::uint64_t offsets_start = start + summary.size();
  summary += offsets;
  summary += Bytes()
                 .number(Op::footer)
                 .number(std::uint64_t{20})
                 .number(start)
                 .number(offsets_start)
                 .all();
  summary += Bytes().number(crc_of(summary)).all();
  put(summary);
}

void Writer::close() {
  if (closed_) return;
  closed_ = true;
  end_chunk();
  put(record(Op::data_end, Bytes().number(crc_).all()));
  put_summary();
  put(magic);
  if (::close(std::exchange(file_, -1)) != 0)
    throw io::WriteError(path_.string() + ": cannot be written: " + reason());
}

}  // namespace pedicel::mcap
