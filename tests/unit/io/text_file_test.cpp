// What a file is before its lines are read.
#include "engine/io/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/core/diagnostics.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using namespace std::string_literals;
using ::testing::HasSubstr;

std::string refusal(const std::string& bytes) {
  try {
    text_of_bytes(bytes, "f.csv");
  } catch (const InvalidFile& fault) {
    return fault.what();
  }
  return {};
}

TEST(TextFile, LeavesTheByteOrderMarkOut) {
  EXPECT_EQ(text_of_bytes("\xEF\xBB\xBFtime,x\n", "f"), "time,x\n");
}

TEST(TextFile, ReadsUtf16OfBothOrders) {
  EXPECT_EQ(text_of_bytes("\xFF\xFE"s + "a\0\xB5\0\n\0"s, "f"), "a\xC2\xB5\n");
  EXPECT_EQ(text_of_bytes("\xFE\xFF"s + "\0a\x20\xAC"s, "f"), "a\xE2\x82\xAC");
  EXPECT_EQ(text_of_bytes("\xFF\xFE"s + "\x3C\xD8\x31\xDF"s, "f"), "\xF0\x9F\x8C\xB1");
  EXPECT_THAT(refusal("\xFF\xFE"s + "a"), HasSubstr("UTF-16 with half a character"));
  EXPECT_THAT(refusal("\xFF\xFE"s + "\x3C\xD8"s), HasSubstr("broken UTF-16"));
  EXPECT_THAT(refusal("t\0i\0m\0e\0,\0"s), HasSubstr("is UTF-16 without a byte order mark"));
  EXPECT_THAT(refusal("\xFF\xFE\0\0t\0\0\0"s), HasSubstr("is UTF-32"));
}

TEST(TextFile, SaysWhatAFileIsInstead) {
  EXPECT_THAT(refusal("PK\x03\x04....[Content_Types].xml"),
              HasSubstr("f.csv: error: is an Excel workbook (.xlsx), expected a text"));
  EXPECT_THAT(refusal("PK\x03\x04mimetypeapplication/vnd.oasis.opendocument.spreadsheet"),
              HasSubstr("is a workbook (.ods)"));
  EXPECT_THAT(refusal("PK\x03\x04"), HasSubstr("is a zip archive"));
  EXPECT_THAT(refusal("\xD0\xCF\x11\xE0\xA1\xB1"), HasSubstr("old Office file (.xls"));
  EXPECT_THAT(refusal("\x1F\x8B\x08"), HasSubstr("compressed with gzip"));
  EXPECT_THAT(refusal("\x28\xB5\x2F\xFD..."), HasSubstr("compressed with zstd"));
  EXPECT_THAT(refusal("%PDF-1.4"), HasSubstr("a PDF document"));
  EXPECT_THAT(refusal("\x89HDF\r\n\x1A\n"), HasSubstr("HDF5"));
  EXPECT_THAT(refusal("<!DOCTYPE HTML><html>"), HasSubstr("is a web page"));
  EXPECT_THAT(refusal("version https://git-lfs.github.com/spec/v1\noid sha256:0\n"),
              HasSubstr("run git lfs pull"));
  EXPECT_EQ(text_of_bytes("PAR1,RIFF\n1,2\n", "f"), "PAR1,RIFF\n1,2\n");  // names of columns
}

TEST(TextFile, NamesTheFirstByteThatNoTextHas) {
  EXPECT_EQ(refusal("time,x\n0,\x1B[31m\n"),
            "f.csv:2:3: error: byte 1B (hex) is no text, expected a text file in UTF-8");
  EXPECT_EQ(text_of_bytes("a\n\x1A", "f"), "a\n");  // the end of a DOS text
}

TEST(TextFile, IsMeasuredBeforeItIsRead) {
  const TemporaryFolder folder;
  std::ofstream(folder / "long.csv") << "t\n";
  // Sparse: 2 GB that take no room.
  std::filesystem::resize_file(folder / "long.csv", std::uintmax_t{2} << 30);
  try {
    read_text_file(folder / "long.csv");
    FAIL() << "read";
  } catch (const InvalidFile& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("is longer than 128 MB"));
  }
  // A device without a size and without an end.
  EXPECT_THROW(read_text_file("/dev/zero", 1 << 20), InvalidFile);
  EXPECT_THROW(read_text_file(folder / "."), InvalidFile);
}

}  // namespace
}  // namespace pedicel::io
