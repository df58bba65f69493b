#pragma once

#include <array>
#include <memory>

#include "engine/render/renderer.h"

namespace pedicel::app {

/// How much work goes into the picture of the scene. Software OpenGL pays by triangle and by pixel;
/// with `automatic`, quality falls until a picture takes less than 1/20 s, and rises again.
struct CanvasQuality {
  static constexpr int best = 0, coarsest = 5;
  bool automatic = true;
  int level = 1;  ///< best .. coarsest
};
render::RenderSettings settings_of_level(int level);
/// Share of the pixels' sides that is drawn at a level; the picture is stretched to its place.
double resolution_of_level(int level);

/// Stems that are thinner than so many pixels in a picture of that height, drawn that thick:
/// without samples between pixels they would be dotted lines. Zero: as they are.
double least_width_of_level(int level);
void widen(render::DrawList& list, const render::Camera& camera, int height, double pixels);

/// The scene as a texture that the interface shows as an image.
class SceneCanvas {
 public:
  explicit SceneCanvas(const render::GlFunctions& gl);
  ~SceneCanvas();
  SceneCanvas(const SceneCanvas&) = delete;
  SceneCanvas& operator=(const SceneCanvas&) = delete;

  /// Draws the scene for a place of that size (px). `quality` goes down or up with the time taken.
  /// Nothing is drawn where the picture would be the last one again; where that stays so for a
  /// moment, it is drawn once at the best quality. Whether something was drawn.
  bool draw(const render::DrawList& list, const render::Camera& camera, int width, int height,
            CanvasQuality& quality, bool shadows);
  /// A still picture of the scene at the best quality.
  render::Image still(const render::DrawList& list, const render::Camera& camera, int width,
                      int height);

  unsigned texture() const { return texture_; }
  double seconds() const { return seconds_; }  ///< s, of the last draw(), smoothed
  long triangles() const { return renderer_.triangles(); }

 private:
  /// What a picture depends on.
  struct Shown {
    std::uint64_t key = 0;
    int width = 0, height = 0, level = -1;
    bool shadows = false;
    bool operator==(const Shown&) const = default;
  };
  void paint(const render::DrawList& list, const render::Camera& camera, const Shown& what);
  void resize(int width, int height);
  void adapt(double seconds, CanvasQuality& quality);

  const render::GlFunctions& gl_;
  render::Renderer renderer_;
  GLuint texture_ = 0, framebuffer_ = 0;
  std::array<int, 2> size_{0, 0};
  Shown shown_;
  int same_ = 0;  // pictures that were not drawn again
  render::DrawList widened_;
  double seconds_ = 0.0;
  int calm_ = 0, level_ = -1;
};

}  // namespace pedicel::app
