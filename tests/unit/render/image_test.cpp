#include "engine/render/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/random.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::render {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Image, PngGivesTheSameBytesBack) {
  Random random(7);
  TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {320, 200}}) {
    Image image(width, height);
    for (std::uint8_t& byte : image.rgb) byte = static_cast<std::uint8_t>(random.next());
    const auto path = folder / "deep/er/picture.png";
    write_png(path, image);
    const Image back = read_png(path);
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, image.rgb);
  }
  const auto entries = std::filesystem::directory_iterator(folder / "deep/er");
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1) << "a temporary file was left behind";
}

TEST(Image, RefusesEmptyPicture) {
  EXPECT_THAT([] { encode_png(Image()); },
              ThrowsMessage<UsageError>(HasSubstr("0 x 0 px: must be at least 1 x 1")));
}

TEST(Image, SaysWhereItCannotWrite) {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT([&] { write_png(folder / "file/picture.png", Image(2, 2)); },
              ThrowsMessage<OutputError>(AllOf(HasSubstr("file/picture.png"),
                                               HasSubstr("cannot be written: Not a directory"))));
}

TEST(Image, LeavesDevicesAndPipesAlone) {
  TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe.png";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT([&] { write_png(pipe, Image(2, 2)); },
              ThrowsMessage<OutputError>(HasSubstr("is a device or a pipe")));
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(Image, SaysWhatIsNoPng) {
  TemporaryFolder folder;
  std::ofstream(folder / "a.png") << "no picture";
  EXPECT_THAT([&] { read_png(folder / "a.png"); },
              ThrowsMessage<InvalidFile>(HasSubstr("a.png: error: cannot be read as PNG")));
  EXPECT_THROW(read_png(folder / "absent.png"), InvalidFile);
}

}  // namespace
}  // namespace pedicel::render
