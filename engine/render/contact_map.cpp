#include "engine/render/contact_map.h"

#include <cmath>

#include "engine/core/check.h"

namespace pedicel::render {

ContactMap::ContactMap(const GlFunctions& gl) : gl_(gl), depths_(gl, 2 * size, false) {
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const float beyond[] = {0.0f, 0.0f, 0.0f, 0.0f};
  gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, beyond);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  PEDICEL_ASSERT(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

ContactMap::~ContactMap() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

Mat4 ContactMap::view_from_below(const Eigen::AlignedBox3d& casters, double ground_height) {
  const double half = 0.5 * casters.diagonal().head<2>().maxCoeff();
  // Steps, and a margin for the blur, so that the map does not swim while things move.
  const double side = std::exp2(std::ceil(4.0 * std::log2(std::max(half * 1.25, 0.05))) / 4.0);
  const double texel = side / size;
  const double reach = std::min(0.15 * side, 0.12);
  Mat4 matrix = Mat4::Identity();
  const Vec3 centre = casters.center();
  matrix(0, 0) = matrix(1, 1) = 1.0 / side;
  matrix(0, 3) = -std::round(centre.x() / texel) * texel / side;
  matrix(1, 3) = -std::round(centre.y() / texel) * texel / side;
  // The ground is at depth 0 (a little below, for what rests on it), `reach` above it at 1.
  const double low = ground_height - 0.05 * reach;
  matrix(2, 2) = 2.0 / reach;
  matrix(2, 3) = -2.0 * low / reach - 1.0;
  return matrix;
}

void ContactMap::blur(const Programs& programs, GLuint empty_array) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, size, size);
  depths_.bind_texture(contact_unit);
  programs.use_blur();
  gl_.Disable(GL_DEPTH_TEST);
  gl_.BindVertexArray(empty_array);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Enable(GL_DEPTH_TEST);
}

void ContactMap::bind_texture(int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
}

}  // namespace pedicel::render
