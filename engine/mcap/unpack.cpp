#include "engine/mcap/unpack.h"

#include <algorithm>
#include <memory>
#include <new>

#ifdef PEDICEL_BZIP2
#include <bzlib.h>
#endif
#ifdef PEDICEL_LZ4
#include <lz4frame.h>
#endif

namespace pedicel::mcap {

namespace {

constexpr std::size_t block = 256 * 1024;

[[maybe_unused]] std::string missing(const char* what, const char* package) {
  return std::string("a chunk in ") + what +
         ", and this program was built without it, expected one " + "built with " + package +
         ", or a log whose chunks are not packed";
}

#ifdef PEDICEL_BZIP2
std::string unpack_bz2(std::string_view packed, std::uint64_t size, std::string& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  // bzip2 does not change what it reads.
  stream.next_in = const_cast<char*>(packed.data());
  stream.avail_in = static_cast<unsigned>(packed.size());
  std::string part(block, '\0');
  while (true) {
    stream.next_out = part.data();
    stream.avail_out = static_cast<unsigned>(part.size());
    const int code = BZ2_bzDecompress(&stream);
    if (code != BZ_OK && code != BZ_STREAM_END) return "a chunk is no bzip2";
    const std::size_t got = part.size() - stream.avail_out;
    if (out.size() + got > size) return "a chunk is longer than its head says";
    out.append(part, 0, got);
    if (code == BZ_STREAM_END) return "";
    if (got == 0 && stream.avail_in == 0) return "a chunk ends too soon";
  }
}
#endif

#ifdef PEDICEL_LZ4
std::string unpack_lz4(std::string_view packed, std::uint64_t size, std::string& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(
      made, LZ4F_freeDecompressionContext);
  std::string part(block, '\0');
  std::size_t more = 1;
  while (more != 0) {
    std::size_t got = part.size(), used = packed.size();
    more = LZ4F_decompress(context.get(), part.data(), &got, packed.data(), &used, nullptr);
    if (LZ4F_isError(more)) return std::string("a chunk is no LZ4: ") + LZ4F_getErrorName(more);
    packed.remove_prefix(used);
    if (out.size() + got > size) return "a chunk is longer than its head says";
    out.append(part, 0, got);
    if (more != 0 && got == 0 && used == 0) return "a chunk ends too soon";
  }
  return "";
}
#endif

}  // namespace

std::string unpack(std::string_view compression, std::string_view packed,
                   [[maybe_unused]] std::uint64_t size, std::string& out) {
  out.clear();
  if (compression == "bz2") {
#ifdef PEDICEL_BZIP2
    return unpack_bz2(packed, size, out);
#else
    return missing("bzip2", "libbz2-dev");
#endif
  }
  if (compression == "lz4") {
#ifdef PEDICEL_LZ4
    return unpack_lz4(packed, size, out);
#else
    return missing("LZ4", "liblz4-dev");
#endif
  }
  return "a chunk is packed in another way, expected none, bz2 or lz4";
}

}  // namespace pedicel::mcap
