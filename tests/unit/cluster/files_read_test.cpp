// Which files a reader opened.
#include "engine/core/files_read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/atomic_file.h"

namespace pedicel {
namespace {

TEST(FilesRead, HoldsWhatIsReadWhileItIsThere) {
  const auto folder = std::filesystem::weakly_canonical(::testing::TempDir()) / "files_read";
  const auto before = folder / "before.txt", within = folder / "within.txt";
  io::write_file_atomically(before, "a");
  io::write_file_atomically(within, "b");
  io::read_file(before);
  {
    const FilesRead files;
    io::read_file(within);
    io::read_file(folder / "." / "within.txt");
    EXPECT_THAT(files.files(), ::testing::ElementsAre(within));
  }
  const FilesRead files;
  EXPECT_THAT(files.files(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace pedicel
