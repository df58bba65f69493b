#include "engine/render/video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "engine/core/check.h"
#include "engine/render/child_process.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::render {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Image frame_of(int number, int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(x + 5 * number);
      image.at(x, y)[1] = static_cast<std::uint8_t>(y);
    }
  return image;
}

/// What ffprobe says of a file: "h264,66,42,yuv420p,30".
std::string probed(const std::filesystem::path& file) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v -show_entries "
      "stream=codec_name,width,height,pix_fmt,nb_read_frames -of csv=p=0 '" +
      file.string() + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  char line[256] = "";
  if (pipe && !std::fgets(line, sizeof line, pipe)) line[0] = '\0';
  if (pipe) ::pclose(pipe);
  std::string text = line;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

TEST(Video, Mp4HasEveryFrame) {
  if (!ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  TemporaryFolder folder;
  const auto path = folder / "deep/run.mp4";
  const auto video = VideoWriter::open(path, 65, 41, 30.0);  // odd sides are padded
  EXPECT_EQ(video->description(), path.string() + " (H.264)");
  for (int i = 0; i < 30; ++i) video->add(frame_of(i, 65, 41));
  EXPECT_FALSE(std::filesystem::exists(path)) << "half a video under the final name";
  video->finish();
  EXPECT_EQ(video->frames(), 30);
  EXPECT_EQ(probed(video->result()), "h264,66,42,yuv420p,30");
  EXPECT_THROW(video->add(frame_of(0, 65, 41)), UsageError);
}

TEST(Video, EarlyStopLeavesAVideoThatPlays) {
  if (!ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  TemporaryFolder folder;
  {
    const auto video = VideoWriter::open(folder / "run.mp4", 64, 64, 25.0);
    for (int i = 0; i < 7; ++i) video->add(frame_of(i, 64, 64));
  }
  EXPECT_EQ(probed(folder / "run.mp4"), "h264,64,64,yuv420p,7");
}

TEST(Video, NoFrameNoFile) {
  if (!ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  TemporaryFolder folder;
  VideoWriter::open(folder / "run.mp4", 64, 64, 25.0)->finish();
  EXPECT_FALSE(std::filesystem::exists(folder / "run.mp4"));
}

TEST(Video, FileNameIsNeverAShellCommand) {
  if (!ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  TemporaryFolder folder;
  const auto path = folder / "-a; touch $(pwd)x `b` %03d.mp4";
  const auto video = VideoWriter::open(path, 32, 32, 25.0);
  video->add(frame_of(0, 32, 32));
  video->finish();
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(Video, EncoderThatFailsIsReportedInItsOwnWords) {
  if (!ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "run.mp4");  // in the way of the finished file
  const auto video = VideoWriter::open(folder / "run.mp4", 32, 32, 25.0);
  video->add(frame_of(0, 32, 32));
  EXPECT_THAT([&] { video->finish(); },
              ThrowsMessage<OutputError>(HasSubstr("run.mp4: cannot be written")));
}

TEST(Video, PicturesAreNumberedFromZero) {
  TemporaryFolder folder;
  const auto video = VideoWriter::open_pictures(folder / "frames", 20, 10);
  EXPECT_THAT(video->description(), HasSubstr("frames/frame_%05d.png"));
  for (int i = 0; i < 3; ++i) video->add(frame_of(i, 20, 10));
  video->finish();
  EXPECT_EQ(read_png(video->result() / "frame_00002.png").rgb, frame_of(2, 20, 10).rgb);
  EXPECT_FALSE(std::filesystem::exists(video->result() / "frame_00003.png"));
}

TEST(Video, RefusesWrongFramesAndRates) {
  TemporaryFolder folder;
  const auto video = VideoWriter::open_pictures(folder / "frames", 20, 10);
  EXPECT_THAT([&] { video->add(Image(10, 10)); },
              ThrowsMessage<UsageError>(HasSubstr("10 x 10 px: must be 20 x 10")));
  EXPECT_THROW(VideoWriter::open(folder / "a.mp4", 0, 10, 30.0), UsageError);
  EXPECT_THAT([&] { VideoWriter::open(folder / "a.mp4", 10, 10, 0.0); },
              ThrowsMessage<UsageError>(HasSubstr("frames_per_second = 0: must be > 0")));
}

TEST(Video, SaysWhereItCannotWrite) {
  TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT([&] { VideoWriter::open_pictures(folder / "file/frames", 2, 2); },
              ThrowsMessage<OutputError>(HasSubstr("cannot be created")));
}

TEST(ChildProcess, TellsWhatBecameOfIt) {
  ChildProcess missing({"pedicel-no-such-program"});
  EXPECT_FALSE(missing.started());
  EXPECT_EQ(missing.finish(), -1);
  ChildProcess code({"sh", "-c", "cat >/dev/null; echo gone wrong >&2; exit 3"});
  const std::vector<std::uint8_t> bytes(1000, 1);
  EXPECT_TRUE(code.send(bytes));
  EXPECT_EQ(code.finish(), 3);
  EXPECT_EQ(code.complaint(), "gone wrong");
}

TEST(ChildProcess, ProgramThatGoesAwayRaisesNoSignal) {
  ChildProcess child({"true"});
  const std::vector<std::uint8_t> bytes(4 << 20, 1);
  EXPECT_FALSE(child.send(bytes));
  EXPECT_EQ(child.finish(), 0);
}

TEST(NumberedPictures, AreNamedAsAskedAndOtherEndingsRefused) {
  TemporaryFolder folder;
  const auto film = VideoWriter::open(folder / "shot_%03d_a.png", 8, 6, 30.0);
  film->add(frame_of(0, 8, 6));
  film->add(frame_of(1, 8, 6));
  film->finish();
  EXPECT_TRUE(std::filesystem::exists(folder / "shot_000_a.png"));
  EXPECT_EQ(read_png(folder / "shot_001_a.png").rgb, frame_of(1, 8, 6).rgb);
  EXPECT_THAT(film->description(), HasSubstr("shot_%03d_a.png"));
  for (const char* name : {"a.png", "a_%d.png", "a_%03d_%03d.png", "a_%03x.png"})
    EXPECT_THAT([&] { VideoWriter::open(folder / name, 8, 6, 30.0); },
                ThrowsMessage<UsageError>(HasSubstr("place for their number")))
        << name;
  EXPECT_THAT([&] { VideoWriter::open(folder / "a.avi", 8, 6, 30.0); },
              ThrowsMessage<UsageError>(HasSubstr("expected *.mp4")));
}

}  // namespace
}  // namespace pedicel::render
