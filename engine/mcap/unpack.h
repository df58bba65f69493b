#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// How a log's chunks are packed beside zstd: bags in bzip2 and LZ4, MCAP in LZ4.
namespace pedicel::mcap {

/// Unpacks a chunk in "bz2" or "lz4" into `out`, which grows with what comes, to `size` bytes at
/// most. Returns what is wrong; empty: nothing.
std::string unpack(std::string_view compression, std::string_view packed, std::uint64_t size,
                   std::string& out);

}  // namespace pedicel::mcap
