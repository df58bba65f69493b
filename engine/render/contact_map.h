#pragma once

#include "engine/render/camera.h"
#include "engine/render/gl_functions.h"
#include "engine/render/programs.h"
#include "engine/render/shadow_map.h"

namespace pedicel::render {

/// How much of the sky things close above the ground hide from it: what lies within `reach` of the
/// ground, seen from below and blurred. It makes things stand on the floor instead of floating.
class ContactMap {
 public:
  explicit ContactMap(const GlFunctions& gl);
  ~ContactMap();
  ContactMap(const ContactMap&) = delete;
  ContactMap& operator=(const ContactMap&) = delete;

  /// World to clip space of the view from below; keeps to the casters and what they darken.
  static Mat4 view_from_below(const Eigen::AlignedBox3d& casters, double ground_height);

  /// Target of the depth pass.
  const DepthMap& depths() const { return depths_; }
  /// Blurs the depths into the map; the blur program's frame must be set.
  void blur(const Programs& programs, GLuint empty_array) const;
  void bind_texture(int unit) const;

 private:
  static constexpr int size = 128;
  const GlFunctions& gl_;
  DepthMap depths_;
  GLuint framebuffer_ = 0, texture_ = 0;
};

}  // namespace pedicel::render
