#include "engine/render/label_pass.h"

#include "engine/core/check.h"
#include "engine/render/shaders.h"

namespace pedicel::render {

LabelPass::LabelPass(const GlFunctions& gl) : gl_(gl) {
  for (const Kind kind : {Kind::tube, Kind::sphere, Kind::mesh, Kind::blade})
    programs_[static_cast<std::size_t>(kind)] =
        link_program(gl, vertex_stage(kind), shaders::label_fragment());
  ground_ = link_program(gl, shaders::ground_vertex(), shaders::ground_label_fragment());
}

LabelPass::~LabelPass() {
  for (const GLuint program : programs_) gl_.DeleteProgram(program);
  gl_.DeleteProgram(ground_);
  drop_target();
}

void LabelPass::drop_target() {
  gl_.DeleteFramebuffers(1, &frame_);
  gl_.DeleteRenderbuffers(1, &colour_);
  gl_.DeleteRenderbuffers(1, &depth_);
}

void LabelPass::prepare_target(int width, int height) {
  if (width_ == width && height_ == height) return;
  drop_target();
  width_ = width, height_ = height;
  gl_.GenFramebuffers(1, &frame_);
  gl_.GenRenderbuffers(1, &colour_);
  gl_.GenRenderbuffers(1, &depth_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
  const auto storage = [&](GLuint buffer, GLenum format, GLenum attachment) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, format, width, height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  storage(colour_, GL_RG32F, GL_COLOR_ATTACHMENT0);
  storage(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  PEDICEL_ASSERT(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

LabelMap LabelPass::draw(const FrameGeometry& geometry, bool ground, GLuint empty_array, int width,
                         int height) {
  prepare_target(width, height);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, frame_);
  gl_.Viewport(0, 0, width, height);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  for (const Kind kind : {Kind::tube, Kind::sphere, Kind::mesh, Kind::blade}) {
    gl_.UseProgram(programs_[static_cast<std::size_t>(kind)]);
    geometry.draw(kind, true);
  }
  if (ground) {
    gl_.BindVertexArray(empty_array);
    gl_.UseProgram(ground_);
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  return read();
}

LabelMap LabelPass::read() const {
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  std::vector<float> pixels(2 * width * height);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_.ReadPixels(0, 0, width_, height_, GL_RG, GL_FLOAT, pixels.data());
  LabelMap map(width_, height_);
  for (std::size_t y = 0; y < height; ++y) {  // OpenGL's rows come from the bottom
    const float* from = pixels.data() + 2 * width * (height - 1 - y);
    for (std::size_t i = y * width; i < (y + 1) * width; ++i, from += 2) {
      map.labels[i] = static_cast<Label>(from[0]);
      if (from[1] > 0.0f) map.depth[i] = from[1];
    }
  }
  return map;
}

}  // namespace pedicel::render
