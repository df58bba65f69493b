#include "engine/render/render_target.h"

#include "engine/core/check.h"

namespace pedicel::render {

namespace {

void storage(const GlFunctions& gl, GLuint buffer, GLenum format, GLenum attachment, int samples,
             int width, int height) {
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

}  // namespace

RenderTarget::RenderTarget(const GlFunctions& gl, int width, int height, int samples)
    : gl_(gl), width_(width), height_(height), samples_(samples) {
  gl_.GenFramebuffers(1, &drawn_);
  gl_.GenFramebuffers(1, &resolved_);
  gl_.GenRenderbuffers(1, &colour_);
  gl_.GenRenderbuffers(1, &depth_);
  gl_.GenRenderbuffers(1, &plain_);
  GLint most = 0;
  gl_.GetIntegerv(GL_MAX_SAMPLES, &most);
  const int taken = samples > 1 ? std::min(samples, static_cast<int>(most)) : 0;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  storage(gl_, colour_, GL_RGBA8, GL_COLOR_ATTACHMENT0, taken, width, height);
  storage(gl_, depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, taken, width, height);
  PEDICEL_ASSERT(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_);
  storage(gl_, plain_, GL_RGBA8, GL_COLOR_ATTACHMENT0, 0, width, height);
  PEDICEL_ASSERT(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

RenderTarget::~RenderTarget() {
  gl_.DeleteFramebuffers(1, &drawn_);
  gl_.DeleteFramebuffers(1, &resolved_);
  gl_.DeleteRenderbuffers(1, &colour_);
  gl_.DeleteRenderbuffers(1, &depth_);
  gl_.DeleteRenderbuffers(1, &plain_);
}

void RenderTarget::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  gl_.Viewport(0, 0, width_, height_);
}

void RenderTarget::resolve_to(GLuint framebuffer) const {
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

Image RenderTarget::read() const {
  resolve_to(resolved_);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width_) * height_ * 4);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  Image image(width_, height_);
  for (int y = 0; y < height_; ++y) {  // OpenGL's rows come from the bottom
    const std::uint8_t* from = rgba.data() + static_cast<std::size_t>(height_ - 1 - y) * width_ * 4;
    std::uint8_t* to = image.at(0, y);
    for (int x = 0; x < width_; ++x, from += 4, to += 3) std::copy(from, from + 3, to);
  }
  return image;
}

}  // namespace pedicel::render
