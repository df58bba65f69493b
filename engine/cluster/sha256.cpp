#include "engine/cluster/sha256.h"

#include <sys/types.h>
// After the types that it uses.
#include <sha2.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::cluster {

namespace {

class Sha256 {
 public:
  Sha256() { SHA256Init(&state_); }
  void add(const char* bytes, std::size_t count) {
    SHA256Update(&state_, reinterpret_cast<const std::uint8_t*>(bytes), count);
  }
  std::string hexadecimal() {
    std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
    SHA256End(&state_, text.data());
    return text.data();
  }

 private:
  SHA2_CTX state_{};
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes.data(), bytes.size());
  return sum.hexadecimal();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InvalidFile({path.string()}, "is a folder, expected a file");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InvalidFile({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
  Sha256 sum;
  std::vector<char> piece(1 << 16);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    sum.add(piece.data(), static_cast<std::size_t>(file.gcount()));
  return sum.hexadecimal();
}

}  // namespace pedicel::cluster
