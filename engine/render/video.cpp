#include "engine/render/video.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/check.h"
#include "engine/render/child_process.h"

namespace pedicel::render {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void check_frame(const Image& frame, int width, int height) {
  if (frame.width != width || frame.height != height)
    throw UsageError("frame of " + std::to_string(frame.width) + " x " +
                     std::to_string(frame.height) + " px: must be " + std::to_string(width) +
                     " x " + std::to_string(height) + " as the video");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be created: " + error.message());
}

// H.264 in yuv420p wants even sides. In fragments of a second, each playable once it is written:
// what is left of a film whose makers were killed plays, too.
std::vector<std::string> encoder_arguments(const std::filesystem::path& file, int width, int height,
                                           double rate) {
  const int second = std::max(1, static_cast<int>(std::lround(rate)));
  return {"ffmpeg",
          "-nostdin",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(width) + "x" + std::to_string(height),
          "-r",
          number(rate),
          "-i",
          "pipe:0",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-c:v",
          "libx264",
          "-preset",
          "fast",
          "-crf",
          "20",
          "-g",
          std::to_string(second),
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+frag_keyframe+empty_moov+default_base_moof",
          "-flush_packets",
          "1",
          "-f",
          "mp4",
          "file:" + file.string()};
}

/// Runs ffmpeg to its end; what it complains of, empty where all went well.
std::string complaint_of(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"ffmpeg", "-nostdin", "-loglevel", "error", "-xerror", "-y"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  ChildProcess program(all);
  const int code = program.finish();
  const std::string words = program.complaint();
  if (code != 0 || !words.empty()) return words.empty() ? "ffmpeg ended early" : words;
  return {};
}

/// The same film with its index at the front, as players like it; false where that cannot be done.
bool write_indexed(const std::filesystem::path& film, const std::filesystem::path& indexed) {
  const bool written = complaint_of({"-i", "file:" + film.string(), "-c", "copy", "-movflags",
                                     "+faststart", "-f", "mp4", "file:" + indexed.string()})
                           .empty();
  std::error_code error;
  if (!written) std::filesystem::remove(indexed, error);
  return written;
}

/// What is wrong with a film's file; empty: nothing.
std::string fault_of(const std::filesystem::path& film) {
  return complaint_of({"-i", "file:" + film.string(), "-c", "copy", "-f", "null", "-"});
}

/// "run.mp4.part", or where that is taken "run.mp4.part1234".
std::filesystem::path part_of(const std::filesystem::path& path) {
  std::filesystem::path part = path.string() + ".part";
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file >= 0) ::close(file);
  if (file < 0) part += std::to_string(::getpid());
  return part;
}

/// "frame_%05d.png", taken apart.
struct NumberedName {
  std::string before;
  int digits = 0;
  std::string after;

  std::string text(int number) const {
    std::string figures = std::to_string(number);
    if (static_cast<int>(figures.size()) < digits)
      figures.insert(0, static_cast<std::size_t>(digits) - figures.size(), '0');
    return before + figures + after;
  }
  std::string pattern() const { return before + "%0" + std::to_string(digits) + "d" + after; }
};

/// Throws UsageError where the name has no place for a number, or more than one.
NumberedName numbered_name(const std::string& name) {
  const std::size_t at = name.find("%0");
  const bool fits = at != std::string::npos && at + 3 < name.size() && name[at + 2] >= '1' &&
                    name[at + 2] <= '9' && name[at + 3] == 'd' &&
                    name.find('%', at + 1) == std::string::npos;
  if (!fits)
    throw UsageError("film \"" + name +
                     "\": expected *.mp4, or pictures with a place for their number "
                     "(frame_%05d.png)");
  return {name.substr(0, at), name[at + 2] - '0', name.substr(at + 4)};
}

class Mp4Writer : public VideoWriter {
 public:
  Mp4Writer(const std::filesystem::path& path, int width, int height, double rate)
      : path_(path),
        part_(part_of(path)),
        width_(width),
        height_(height),
        encoder_(encoder_arguments(part_, width, height, rate)) {}

  ~Mp4Writer() override {
    try {
      finish();
    } catch (const OutputError&) {  // a destructor has nobody to tell
    }
  }

  void add(const Image& frame) override {
    check_frame(frame, width_, height_);
    if (finished_) throw UsageError("VideoWriter: a frame after finish()");
    if (!encoder_.send(frame.rgb)) {
      ++frames_;
      finish();
      fail("it ended early");
    }
    ++frames_;
  }

  // The encoder's word is not enough: on a full disk it may end well and leave half a film.
  void finish() override {
    if (finished_) return;
    finished_ = true;
    const int code = encoder_.finish();
    if (frames_ == 0) return drop();
    if (code != 0) fail("it ended early");
    const std::filesystem::path indexed = part_.string() + "0";
    if (write_indexed(part_, indexed)) {
      drop();
      return place(indexed);
    }
    if (const std::string fault = fault_of(part_); !fault.empty()) fail(fault);
    place(part_);
  }

  int frames() const override { return frames_; }
  std::string description() const override { return path_.string() + " (H.264)"; }
  std::filesystem::path result() const override { return path_; }

 private:
  void drop() const {
    std::error_code error;
    std::filesystem::remove(part_, error);
  }

  void place(const std::filesystem::path& film) const {
    std::error_code error, ignored;
    // Renaming would put a plain file in the place of a device or a pipe.
    if (std::filesystem::is_other(path_, ignored))
      error = std::make_error_code(std::errc::not_supported);
    else
      std::filesystem::rename(film, path_, error);
    if (!error) return;
    std::filesystem::remove(film, ignored);
    throw OutputError(path_.string() + ": cannot be written: " + error.message());
  }

  [[noreturn]] void fail(const std::string& otherwise) const {
    drop();
    const std::string words = encoder_.complaint();
    throw OutputError(path_.string() + ": ffmpeg failed: " + (words.empty() ? otherwise : words));
  }

  std::filesystem::path path_, part_;
  int width_, height_, frames_ = 0;
  bool finished_ = false;
  ChildProcess encoder_;
};

class PictureWriter : public VideoWriter {
 public:
  PictureWriter(const std::filesystem::path& folder, int width, int height, std::string why,
                NumberedName name = {"frame_", 5, ".png"})
      : folder_(folder),
        name_(std::move(name)),
        width_(width),
        height_(height),
        why_(std::move(why)) {
    make_folder(folder);
    const std::filesystem::path first = folder_ / name_.text(0);
    if (std::filesystem::exists(first))
      throw OutputError(first.string() +
                        ": is there already, expected a folder without an earlier film's pictures");
  }

  void add(const Image& frame) override {
    check_frame(frame, width_, height_);
    write_png(folder_ / name_.text(frames_), frame);
    ++frames_;
  }
  void finish() override {}
  int frames() const override { return frames_; }
  std::string description() const override {
    return (folder_ / name_.pattern()).string() + (why_.empty() ? "" : " (" + why_ + ")");
  }
  std::filesystem::path result() const override { return folder_.empty() ? "." : folder_; }

 private:
  std::filesystem::path folder_;
  NumberedName name_;
  int width_, height_, frames_ = 0;
  std::string why_;
};

}  // namespace

bool ffmpeg_encodes() {
  static const bool works = [] {
    ChildProcess probe({"ffmpeg", "-nostdin", "-loglevel", "error", "-f", "lavfi", "-i",
                        "color=size=64x64:rate=5:duration=0.2", "-c:v", "libx264", "-f", "null",
                        "-"});
    return probe.finish() == 0;
  }();
  return works;
}

std::unique_ptr<VideoWriter> VideoWriter::open(const std::filesystem::path& path, int width,
                                               int height, double frames_per_second) {
  if (width < 1 || height < 1 || width > 8192 || height > 8192)
    throw UsageError("video of " + std::to_string(width) + " x " + std::to_string(height) +
                     " px: must be between 1 x 1 and 8192 x 8192");
  if (!(frames_per_second > 0.0 && frames_per_second <= 1000.0))
    throw UsageError("frames_per_second = " + number(frames_per_second) +
                     ": must be > 0 and at most 1000");
  if (path.extension() != ".mp4" && path.extension() != ".png")
    throw UsageError("film \"" + path.filename().string() +
                     "\": expected *.mp4, or pictures such as frame_%05d.png");
  if (path.extension() == ".png")
    return std::make_unique<PictureWriter>(path.parent_path(), width, height, "",
                                           numbered_name(path.filename().string()));
  make_folder(path.parent_path());
  if (ffmpeg_encodes()) return std::make_unique<Mp4Writer>(path, width, height, frames_per_second);
  const std::filesystem::path folder = path.parent_path() / (path.stem().string() + "_frames");
  return std::make_unique<PictureWriter>(folder, width, height, "no ffmpeg that encodes H.264");
}

std::unique_ptr<VideoWriter> VideoWriter::open_pictures(const std::filesystem::path& folder,
                                                        int width, int height) {
  return std::make_unique<PictureWriter>(folder, width, height, "");
}

}  // namespace pedicel::render
