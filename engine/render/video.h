#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/render/image.h"

namespace pedicel::render {

/// A video under construction: H.264 in an MP4 file (yuv420p, constant rate factor 20, index at the
/// front) where the program `ffmpeg` is installed and can encode it, numbered pictures otherwise.
/// While it is made it is called "run.mp4.part", which plays, too, as far as it got, also where the
/// program is killed.
class VideoWriter {
 public:
  /// `path` is the MP4 file wanted ("run.mp4"); without ffmpeg the pictures go to the folder beside
  /// it ("run_frames/frame_00000.png"). A path such as "frame_%05d.png" asks for numbered pictures,
  /// from 0. Throws UsageError for another ending, a bad size or rate, OutputError where the place
  /// cannot be written to or holds such pictures already.
  static std::unique_ptr<VideoWriter> open(const std::filesystem::path& path, int width, int height,
                                           double frames_per_second);
  /// Numbered pictures in a folder, whatever is installed.
  static std::unique_ptr<VideoWriter> open_pictures(const std::filesystem::path& folder, int width,
                                                    int height);

  /// Finishes the file if finish() was not called: a run that is stopped early leaves a video that
  /// plays. Errors are lost here, so call finish() where you can.
  virtual ~VideoWriter() = default;
  VideoWriter() = default;
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// Adds a frame of the size given to open(). Throws UsageError for another size, OutputError with
  /// the encoder's own words where it has failed.
  virtual void add(const Image& frame) = 0;
  /// Closes the video; nothing can be added afterwards. Throws OutputError, and leaves nothing
  /// behind, where it is not whole.
  virtual void finish() = 0;

  virtual int frames() const = 0;
  /// What is being made, to be shown: "run.mp4 (H.264)", or "run_frames/frame_%05d.png (ffmpeg is
  /// not installed)".
  virtual std::string description() const = 0;
  /// The MP4 file, or the folder of pictures.
  virtual std::filesystem::path result() const = 0;
};

/// Whether `ffmpeg` can be started and encodes H.264 (asked once).
bool ffmpeg_encodes();

}  // namespace pedicel::render
