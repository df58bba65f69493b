#include "engine/geometry/grid_file.h"

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <string>

#include "engine/core/state_hash.h"

namespace pedicel::geometry {

namespace {

constexpr char magic[8] = {'P', 'E', 'D', 'I', 'S', 'D', 'F', '1'};
constexpr std::uintmax_t header_bytes =
    sizeof magic + sizeof(std::uint64_t) + 10 * sizeof(double) + 3 * sizeof(int);

/// Of bytes that come in pieces: eight of them a word, what is left one by one.
class Checksum {
 public:
  void add(const void* data, std::size_t count) {
    const char* next = static_cast<const char*>(data);
    for (; filled_ != 0 && count > 0; --count) put(*next++);
    for (; count >= sizeof word_; count -= sizeof word_, next += sizeof word_) {
      std::uint64_t word;
      std::memcpy(&word, next, sizeof word);
      hash_.add(word);
    }
    for (; count > 0; --count) put(*next++);
  }
  std::uint64_t value() const {
    StateHash hash = hash_;
    for (std::size_t i = 0; i < filled_; ++i)
      hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(word_[i])));
    return hash.value();
  }

 private:
  void put(char byte) {
    word_[filled_++] = byte;
    if (filled_ < sizeof word_) return;
    std::uint64_t word;
    std::memcpy(&word, word_, sizeof word);
    hash_.add(word);
    filled_ = 0;
  }

  StateHash hash_;
  char word_[8] = {};
  std::size_t filled_ = 0;
};

class Writer {
 public:
  explicit Writer(std::ofstream& file) : file_(file) {}
  void put(const void* data, std::size_t bytes) {
    file_.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    sum_.add(data, bytes);
  }
  void end() {
    const std::uint64_t sum = sum_.value();
    file_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  }

 private:
  std::ofstream& file_;
  Checksum sum_;
};

class Reader {
 public:
  explicit Reader(std::ifstream& file) : file_(file) {}
  bool take(void* data, std::size_t bytes) {
    file_.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
    if (file_) sum_.add(data, bytes);
    return static_cast<bool>(file_);
  }
  bool ends_well() {
    std::uint64_t sum = 0;
    file_.read(reinterpret_cast<char*>(&sum), sizeof sum);
    return file_ && sum == sum_.value();
  }

 private:
  std::ifstream& file_;
  Checksum sum_;
};

}  // namespace

bool GridFile::write(const std::filesystem::path& path, const GridDistance& grid,
                     std::uint64_t key) {
  static std::atomic<unsigned> count{0};  // two threads may build the same grid
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  const std::filesystem::path part =
      path.string() + ".part" + std::to_string(::getpid()) + "_" + std::to_string(count++);
  std::ofstream file(part, std::ios::binary | std::ios::trunc);
  Writer writer(file);
  writer.put(magic, sizeof magic);
  writer.put(&key, sizeof key);
  writer.put(grid.mesh_box_.min().data(), 3 * sizeof(double));
  writer.put(grid.mesh_box_.max().data(), 3 * sizeof(double));
  writer.put(grid.origin_.data(), 3 * sizeof(double));
  writer.put(&grid.spacing_, sizeof grid.spacing_);
  writer.put(grid.nodes_.data(), 3 * sizeof(int));
  writer.put(grid.samples_.data(), grid.samples_.size() * sizeof(float));
  writer.end();
  file.close();
  if (file) std::filesystem::rename(part, path, error);
  if (file && !error) return true;
  std::filesystem::remove(part, error);
  return false;
}

std::optional<GridDistance> GridFile::read(const std::filesystem::path& path, std::uint64_t key) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (!file || error || bytes < header_bytes + sizeof key) return std::nullopt;
  Reader reader(file);
  char found_magic[sizeof magic];
  std::uint64_t found_key = 0;
  GridDistance grid;
  const bool whole = reader.take(found_magic, sizeof found_magic) &&
                     reader.take(&found_key, sizeof found_key) &&
                     reader.take(grid.mesh_box_.min().data(), 3 * sizeof(double)) &&
                     reader.take(grid.mesh_box_.max().data(), 3 * sizeof(double)) &&
                     reader.take(grid.origin_.data(), 3 * sizeof(double)) &&
                     reader.take(&grid.spacing_, sizeof grid.spacing_) &&
                     reader.take(grid.nodes_.data(), 3 * sizeof(int));
  if (!whole || std::memcmp(found_magic, magic, sizeof magic) != 0 || found_key != key)
    return std::nullopt;
  const std::uintmax_t samples = (bytes - header_bytes - sizeof key) / sizeof(float);
  if (bytes != header_bytes + samples * sizeof(float) + sizeof key || grid.nodes_.minCoeff() < 2 ||
      grid.nodes_.cast<double>().prod() != static_cast<double>(samples))
    return std::nullopt;
  grid.samples_.resize(samples);
  if (!reader.take(grid.samples_.data(), samples * sizeof(float)) || !reader.ends_well())
    return std::nullopt;
  return grid;
}

}  // namespace pedicel::geometry
