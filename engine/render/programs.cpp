#include "engine/render/programs.h"

#include <stdexcept>
#include <string>

#include "engine/render/shaders.h"

namespace pedicel::render {

namespace {

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  throw std::runtime_error("the OpenGL driver refused a shader: " + log.substr(0, length));
}

void tie_sampler(const GlFunctions& gl, GLuint program, const char* name, int unit) {
  const GLint location = gl.GetUniformLocation(program, name);
  if (location >= 0) gl.Uniform1i(location, unit);
}

}  // namespace

GLuint link_program(const GlFunctions& gl, const std::string& vertex, const std::string& fragment) {
  const GLuint program = gl.CreateProgram();
  const GLuint stages[] = {compile(gl, GL_VERTEX_SHADER, vertex),
                           compile(gl, GL_FRAGMENT_SHADER, fragment)};
  for (const GLuint stage : stages) {
    gl.AttachShader(program, stage);
    gl.DeleteShader(stage);
  }
  gl.LinkProgram(program);
  GLint good = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
    throw std::runtime_error("the OpenGL driver refused a program: " + log.substr(0, length));
  }
  const GLuint block = gl.GetUniformBlockIndex(program, "Frame");
  if (block != GL_INVALID_INDEX) gl.UniformBlockBinding(program, block, 0);
  gl.UseProgram(program);
  tie_sampler(gl, program, "shadow_map", shadow_unit);
  tie_sampler(gl, program, "contact_map", contact_unit);
  tie_sampler(gl, program, "depth_map", contact_unit);
  return program;
}

std::string vertex_stage(Kind kind) {
  switch (kind) {
    case Kind::tube:
      return shaders::tube_vertex();
    case Kind::sphere:
      return shaders::sphere_vertex();
    case Kind::mesh:
      return shaders::mesh_vertex();
    case Kind::blade:
      return shaders::blade_vertex();
    case Kind::line:
      break;
  }
  return shaders::line_vertex();
}

Programs::Programs(const GlFunctions& gl) : gl_(gl) {
  for (int i = 0; i < kind_count; ++i) {
    const bool line = i == static_cast<int>(Kind::line);
    const std::string vertex = vertex_stage(static_cast<Kind>(i));
    lit_[i] = link_program(gl, vertex, line ? shaders::line_fragment() : shaders::lit_fragment());
    if (!line) depth_[i] = link_program(gl, vertex, shaders::empty_fragment());
  }
  ground_ = link_program(gl, shaders::ground_vertex(), shaders::ground_fragment());
  sky_ = link_program(gl, shaders::full_screen_vertex(), shaders::sky_fragment());
  blur_ = link_program(gl, shaders::full_screen_vertex(), shaders::blur_fragment());
  gl.GenBuffers(1, &block_);
}

Programs::~Programs() {
  for (const GLuint program : lit_) gl_.DeleteProgram(program);
  for (const GLuint program : depth_) gl_.DeleteProgram(program);
  for (const GLuint program : {ground_, sky_, blur_}) gl_.DeleteProgram(program);
  gl_.DeleteBuffers(1, &block_);
}

void Programs::set_frame(const FrameUniforms& frame) const {
  gl_.BindBuffer(GL_UNIFORM_BUFFER, block_);
  gl_.BufferData(GL_UNIFORM_BUFFER, sizeof frame, &frame, GL_DYNAMIC_DRAW);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
}

}  // namespace pedicel::render
