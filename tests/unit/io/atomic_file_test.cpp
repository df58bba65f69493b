#include "engine/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "engine/core/diagnostics.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AtomicFile, WritesWhatIsReadBackAndReplacesTheOld) {
  TemporaryFolder folder;
  const auto path = folder / "deep/er/file.txt";
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file_atomically(path, "a much longer text that was there before");
  write_file_atomically(path, bytes);
  EXPECT_EQ(read_file(path), bytes);
  const auto entries = std::filesystem::directory_iterator(folder / "deep/er");
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "a temporary file was left behind";
}

// Renamed over it, a plain file would stand in its place.
TEST(AtomicFile, LeavesAPipeAlone) {
  TemporaryFolder folder;
  const auto pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT([&] { write_file_atomically(pipe, "x"); },
              ThrowsMessage<WriteError>(HasSubstr("expected a plain file")));
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THAT([&] { write_file_atomically(folder / "file/a.txt", ""); },
              ThrowsMessage<WriteError>(HasSubstr("cannot be")));
  EXPECT_THAT([&] { write_file_atomically(folder / "taken", ""); },
              ThrowsMessage<WriteError>(
                  AllOf(HasSubstr("taken: cannot be written: "), HasSubstr("directory"))));
  const auto entries = std::filesystem::directory_iterator(folder / ".");
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 2) << "a temporary file was left behind";
}

TEST(AtomicFile, ReadingSaysWhatIsWrong) {
  TemporaryFolder folder;
  EXPECT_THAT([&] { read_file(folder / "absent"); },
              ThrowsMessage<InvalidFile>(
                  EndsWith("absent: error: cannot be read: No such file or directory")));
  EXPECT_THAT([&] { read_file(folder / "."); },
              ThrowsMessage<InvalidFile>(EndsWith("error: is a folder, expected a file")));
}

// A file without an end, and one that is no text, are not taken into memory.
TEST(AtomicFile, ReadsAtMost256Megabytes) {
  TemporaryFolder folder;
  std::ofstream(folder / "disk.img") << "x";
  std::filesystem::resize_file(folder / "disk.img", std::uintmax_t{257} << 20);
  for (const std::filesystem::path& path :
       {folder / "disk.img", std::filesystem::path("/dev/zero")})
    EXPECT_THAT(
        [&] { read_file(path); },
        ThrowsMessage<InvalidFile>(HasSubstr("is larger than 256 MB, expected at most that")));
}

}  // namespace
}  // namespace pedicel::io
