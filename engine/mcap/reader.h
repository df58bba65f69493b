#pragma once

#include <filesystem>
#include <functional>
#include <istream>

#include "engine/mcap/records.h"

namespace pedicel::mcap {

/// A message as it stands in the file; valid during the call that gets it.
struct Message {
  const Channel& channel;
  const Schema& schema;            ///< without a name where the channel has none
  std::uint64_t log_time = 0;      ///< ns
  std::uint64_t publish_time = 0;  ///< ns
  std::string_view data;
};

/// Beyond these a file is refused, before memory is taken.
struct ReaderLimits {
  std::uint64_t record = 256u << 20;  ///< bytes of a record, and of a chunk's content
  std::size_t channels = 10000, schemas = 10000;
};

/// How a file ended.
struct ReadEnd {
  std::string library;  ///< that wrote the file, as it says
  std::uint64_t messages = 0;
  /// The file has its end; else it is one of a program that was killed, or was cut off, and what
  /// was whole has been read.
  bool whole = false;
  std::uint64_t at = 0;  ///< byte at which the first part that is not whole begins
};

/// Reads a file from front to back, chunks (plain, zstd or LZ4) and messages without, and needs
/// neither index nor summary. Throws InvalidFile with the byte where something is no MCAP, damaged
/// (CRC) or beyond the limits, and what `take` throws.
ReadEnd read(std::istream& file, const std::string& name,
             const std::function<void(const Message&)>& take, const ReaderLimits& limits = {});
ReadEnd read(const std::filesystem::path& file, const std::function<void(const Message&)>& take,
             const ReaderLimits& limits = {});

/// Whether a file begins as an MCAP.
bool is_mcap(const std::filesystem::path& file);

}  // namespace pedicel::mcap
