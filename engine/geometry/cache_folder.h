#pragma once

#include <cstdint>
#include <filesystem>

namespace pedicel::geometry {

/// The most that is kept there, bytes: 512 MB.
inline constexpr std::uintmax_t cache_bound = 512u << 20;

/// $PEDICEL_CACHE, else $XDG_CACHE_HOME/pedicel, else ~/.cache/pedicel; empty (no cache) where none
/// of these is set, and where PEDICEL_CACHE is "off".
std::filesystem::path default_cache_folder();

/// Notes that a file of the cache was used now.
void mark_used(const std::filesystem::path& file);

/// Removes files of the cache, those that were used longest ago first, until no more than `bound`
/// bytes are left; `keep` stays. Left-overs of programs that were stopped while writing go, too,
/// when they are an hour old. Other files are not touched. Several programs may do this at once: a
/// file that another has removed is nothing to worry about, and one that is being read can be read
/// to its end. Returns the bytes that are left.
std::uintmax_t trim_cache(const std::filesystem::path& folder, std::uintmax_t bound,
                          const std::filesystem::path& keep = {});

}  // namespace pedicel::geometry
