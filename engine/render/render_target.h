#pragma once

#include "engine/render/gl_functions.h"
#include "engine/render/image.h"

namespace pedicel::render {

/// Where a picture is drawn: a multisampled framebuffer and the plain one that it is resolved into.
class RenderTarget {
 public:
  RenderTarget(const GlFunctions& gl, int width, int height, int samples);
  ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }

  /// Makes it the target of drawing, its whole area.
  void bind() const;
  /// Averages the samples into another framebuffer (0: the window), lower left corner to lower
  /// left.
  void resolve_to(GLuint framebuffer) const;
  /// Averages the samples and brings the picture to main memory.
  Image read() const;

 private:
  const GlFunctions& gl_;
  int width_, height_, samples_;
  GLuint drawn_ = 0, colour_ = 0, depth_ = 0, resolved_ = 0, plain_ = 0;
};

}  // namespace pedicel::render
