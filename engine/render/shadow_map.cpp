#include "engine/render/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace pedicel::render {

SunView fit_sun(const Eigen::AlignedBox3d& casters, const Vec3& to_sun, int size) {
  const double around = std::max(0.5 * casters.diagonal().norm(), 0.01) * 1.02;
  const double radius = std::exp2(std::ceil(8.0 * std::log2(around)) / 8.0);
  SunView sun;
  sun.texel = 2.0 * radius / size;
  const Vec3 back = to_sun.normalized();
  Vec3 right = Vec3::UnitZ().cross(back);
  if (right.norm() < 1e-6) right = Vec3::UnitX();
  right.normalize();
  const Vec3 up = back.cross(right);
  const Vec3 centre = casters.center();
  const double x = std::round(right.dot(centre) / sun.texel) * sun.texel;
  const double y = std::round(up.dot(centre) / sun.texel) * sun.texel;
  sun.matrix.row(0) << right.transpose() / radius, -x / radius;
  sun.matrix.row(1) << up.transpose() / radius, -y / radius;
  sun.matrix.row(2) << -back.transpose() / radius, back.dot(centre) / radius;
  return sun;
}

int shadow_side(int largest, int width, int height) {
  int side = 256;
  while (side < 3 * std::max(width, height)) side *= 2;
  return std::min(side, largest);
}

Mat4 to_texture(const Mat4& clip) {
  Mat4 half = Mat4::Identity() * 0.5;
  half.col(3) << 0.5, 0.5, 0.5, 1.0;
  return half * clip;
}

DepthMap::DepthMap(const GlFunctions& gl, int size, bool compare) : gl_(gl), size_(size) {
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT,
                 GL_FLOAT, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const float beyond[] = {1.0f, 1.0f, 1.0f, 1.0f};
  gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, beyond);
  if (compare) {
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  PEDICEL_ASSERT(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

DepthMap::~DepthMap() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

void DepthMap::begin() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, size_, size_);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void DepthMap::bind_texture(int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
}

}  // namespace pedicel::render
