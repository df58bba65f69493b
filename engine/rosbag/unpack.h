#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pedicel::rosbag {

/// Unpacks a chunk in "bz2" or "lz4" into `out`, which grows with what comes, to `size` bytes at
/// most. Returns what is wrong; empty: nothing.
std::string unpack(std::string_view compression, std::string_view packed, std::uint64_t size,
                   std::string& out);

}  // namespace pedicel::rosbag
