#pragma once

#include "engine/render/camera.h"
#include "engine/render/gl_functions.h"

namespace pedicel::render {

/// A parallel projection that holds all casters, seen from the sun.
struct SunView {
  Mat4 matrix = Mat4::Identity();  ///< world to clip space
  double texel = 0.0;              ///< side of a texel, m
};

/// Fits the projection to the sphere about `casters`. Its size grows in steps and it moves by whole
/// texels, so that shadow edges do not shimmer while things move.
SunView fit_sun(const Eigen::AlignedBox3d& casters, const Vec3& to_sun, int size);

/// Side of the shadow map of a picture, px: finer than the picture can show is lost time. A power
/// of two from 256 on, at least three times the picture's longer side, and at most `largest`.
int shadow_side(int largest, int width, int height);

/// Turns clip space (-1 .. 1) into texture space (0 .. 1).
Mat4 to_texture(const Mat4& clip);

/// A square depth texture with its framebuffer.
class DepthMap {
 public:
  /// `compare`: sampled as shadow map (1 where lit), beyond its edges everything is lit; otherwise
  /// as plain depths.
  DepthMap(const GlFunctions& gl, int size, bool compare);
  ~DepthMap();
  DepthMap(const DepthMap&) = delete;
  DepthMap& operator=(const DepthMap&) = delete;

  int size() const { return size_; }
  /// Makes it the target of drawing and clears it.
  void begin() const;
  void bind_texture(int unit) const;

 private:
  const GlFunctions& gl_;
  int size_;
  GLuint framebuffer_ = 0, texture_ = 0;
};

}  // namespace pedicel::render
