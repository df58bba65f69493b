#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/render/offscreen.h"
#include "engine/render/overlay.h"
#include "engine/render/renderer.h"
#include "engine/render/video.h"
#include "engine/world/scene.h"

namespace pedicel::app {

/// Everything that a picture shows besides its camera: the things, and what is written over them.
struct Frame {
  double time = 0.0;  ///< s
  render::DrawList list;
  std::string caption;                               ///< upper left; empty: none
  std::string note;                                  ///< lower left; empty: none
  std::optional<render::Legend> legend;              ///< right
  std::vector<std::pair<Vec3, std::string>> labels;  ///< at places of the world
};

/// The frames of the last steps, so that "just before it broke" can be pictured once it has broken.
/// Reuses their memory.
class FrameHistory {
 public:
  static constexpr int kept = 3;

  /// The oldest frame, emptied, to be filled as the newest. Its ground stays.
  Frame& next();
  /// The newest frame (0), the one before it (1), ...; nothing where there were not so many.
  const Frame* back(int steps) const;

 private:
  std::array<Frame, kept> frames_;
  int newest_ = kept - 1, count_ = 0;
};

/// A scene's camera; `anchor_W` is the place of what it follows, where it follows something.
render::Camera camera_of(const world::SceneCamera& camera, const Vec3& anchor_W = Vec3::Zero());

/// Takes pictures and a video off screen. Where there is no OSMesa it takes none; why() says so, to
/// be told once. To be used and destroyed on the thread that made it.
class PictureTaker {
 public:
  /// Throws UsageError for bad settings.
  explicit PictureTaker(const render::RenderSettings& settings = {});
  ~PictureTaker();

  bool available() const { return renderer_ != nullptr; }
  /// Why there are no pictures; empty where there are.
  const std::string& why() const { return why_; }
  /// "llvmpipe (LLVM 15.0.6, 256 bits)"; empty where there are no pictures.
  std::string renderer_name() const;

  /// A picture with its texts; nothing where pictures cannot be taken.
  std::optional<render::Image> take(const Frame& frame, const render::Camera& camera, int width,
                                    int height);
  /// A picture without texts, its labels and its depths; without `colours` the picture is empty.
  /// Nothing where pictures cannot be taken.
  std::optional<render::Renderer::Labelled> sense(const Frame& frame, const render::Camera& camera,
                                                  int width, int height, bool colours = true);
  /// For the pictures from now on. Throws UsageError.
  void set(const render::RenderSettings& settings);
  /// Takes one and writes a PNG. False where pictures cannot be taken. Throws OutputError.
  bool save(const std::filesystem::path& path, const Frame& frame, const render::Camera& camera,
            int width, int height);

  /// Begins a video, or numbered pictures (video.h). Does nothing where pictures cannot be taken.
  void open_video(const std::filesystem::path& path, const world::SceneVideo& video);
  void add_to_video(const Frame& frame, const render::Camera& camera);
  /// Closes the video and returns the file or folder it is in, nothing where none was begun.
  std::optional<std::filesystem::path> finish_video();

 private:
  std::string why_;
  std::unique_ptr<render::OffscreenContext> context_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<render::VideoWriter> video_;
  std::array<int, 2> video_size_{0, 0};
};

}  // namespace pedicel::app
