#pragma once

#include <memory>

#include "engine/render/camera.h"
#include "engine/render/draw_list.h"
#include "engine/render/gl_functions.h"
#include "engine/render/image.h"
#include "engine/render/label_map.h"

namespace pedicel::render {

/// How pictures are made; the same for all frames of a renderer.
struct RenderSettings {
  int samples = 4;         ///< samples a pixel for smooth edges: 1, 2 or 4
  int shadow_size = 2048;  ///< side of the shadow map, px, 256 .. 8192
  bool shadows = true;
  bool contact = true;  ///< the ground is darker close to what stands on it
  /// 1, > 0: below 1 round things get fewer triangles, which is what software rendering costs by.
  double detail = 1.0;
  Vec3 to_sun{0.45, -0.55, 0.85};  ///< W, any length; z > 0
  double sun = 0.82;               ///< strength of the sun on a surface that faces it
  double exposure = 1.0;           ///< multiplies all light
};

/// Throws UsageError with field, value and broken bound.
void check(const RenderSettings& settings);

/// Turns draw lists into pictures with OpenGL 3.3 core. The context whose functions it was given
/// must be current on the calling thread in every call, and outlive it. The same list, camera and
/// size give the same bytes.
class Renderer {
 public:
  /// Throws UsageError (settings) or std::runtime_error (a driver that refuses our shaders).
  explicit Renderer(const GlFunctions& gl, const RenderSettings& settings = {});
  ~Renderer();

  /// For the pictures from now on. Throws UsageError.
  void set(const RenderSettings& settings);

  /// A picture in main memory, without text (overlay.h adds it). Throws UsageError for a size below
  /// 1 x 1 or above 8192, or a bad camera.
  Image render(const DrawList& list, const Camera& camera, int width, int height);

  /// What each pixel of such a picture shows, and how far away it is (label_map.h).
  LabelMap label(const DrawList& list, const Camera& camera, int width, int height);
  /// Both of one list, which saves preparing it twice.
  struct Labelled {
    Image image;
    LabelMap map;
  };
  Labelled render_labelled(const DrawList& list, const Camera& camera, int width, int height);

  /// The same into a framebuffer of the current context (0: the window), whose lower left corner
  /// gets the lower left corner of the picture.
  void draw(const DrawList& list, const Camera& camera, int width, int height,
            unsigned framebuffer);

  /// Triangles of the last picture, without the depth passes.
  long triangles() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pedicel::render
