// What a table that is being written looks like when its writer ends badly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Files of this process grow to so many bytes at most: as on a disk that is full then.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

std::vector<double> wide_row(double value) {
  return std::vector<double>(200, value);
}
std::vector<std::string> wide_header() {
  std::vector<std::string> names = {"time_s"};
  for (int i = 1; i < 200; ++i) names.push_back("c" + std::to_string(i) + "_1");
  return names;
}

TEST(CsvWriter, KeepsWholeRowsOnAFullDiskAndSaysWhy) {
  TemporaryFolder folder;
  const auto path = folder / "log.csv";
  const SmallDisk disk(10000);
  CsvWriter writer(path, wide_header());
  const auto fill = [&] {
    for (int i = 0; i < 100; ++i) {
      writer.row(wide_row(i + 0.123456));
      writer.flush();
    }
  };
  EXPECT_THAT(fill, ThrowsMessage<WriteError>(HasSubstr("log.csv: cannot be written: File too")));
  Diagnostics diagnostics;
  const CsvTable table = read_csv(path, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  EXPECT_GE(table.rows.size(), 2u);
}

TEST(CsvWriter, LeavesNoEmptyFile) {
  TemporaryFolder folder;
  const SmallDisk disk(10);
  EXPECT_THROW(CsvWriter(folder / "log.csv", wide_header()), WriteError);
  EXPECT_FALSE(std::filesystem::exists(folder / "log.csv"));
}

TEST(CsvWriter, SaysTheSystemsReason) {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT([&] { CsvWriter(folder / "file/log.csv", {"time_s"}); },
              ThrowsMessage<WriteError>(HasSubstr("log.csv: cannot be written: Not a directory")));
  std::filesystem::create_directory(folder / "log.csv");
  EXPECT_THAT([&] { CsvWriter(folder / "log.csv", {"time_s"}); },
              ThrowsMessage<WriteError>(HasSubstr("cannot be written: Is a directory")));
}

// Killed at any moment.
TEST(CsvWriter, OneWhoIsKilledLeavesWholeRows) {
  TemporaryFolder folder;
  const auto path = folder / "log.csv";
  const pid_t child = ::fork();
  if (child == 0) {
    CsvWriter writer(path, wide_header());
    for (double i = 0;; ++i) {
      writer.row(wide_row(i));
      writer.flush();
    }
  }
  for (int i = 0;
       i < 200 && (!std::filesystem::exists(path) || std::filesystem::file_size(path) < 100000);
       ++i)
    ::usleep(10000);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  const std::string text = read_file(path);
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  Diagnostics diagnostics;
  EXPECT_GT(read_csv(path, {}, diagnostics).rows.size(), 10u) << diagnostics.text();
}

TEST(AtomicFile, LeavesNothingBesideItsTargetOnAFullDisk) {
  TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  const SmallDisk disk(1000);
  EXPECT_THAT([&] { write_file_atomically(folder / "a.txt", std::string(5000, 'x')); },
              ThrowsMessage<WriteError>(
                  AllOf(HasSubstr("a.txt: cannot be written: "), HasSubstr("File too large"))));
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  const auto entries = std::filesystem::directory_iterator(folder / ".");
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "a temporary file was left behind";
}

}  // namespace
}  // namespace pedicel::io
