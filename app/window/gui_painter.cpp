#include "app/window/gui_painter.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pedicel::app {

namespace {

using render::GlFunctions;

constexpr const char* vertex_shader = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 letter;
layout(location = 2) in vec4 tint;
uniform vec2 size;
out vec2 at;
out vec4 colour;
void main() {
  at = letter;
  colour = tint;
  gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);
}
)";

constexpr const char* fragment_shader = R"(#version 330 core
in vec2 at;
in vec4 colour;
uniform sampler2D image;
out vec4 result;
void main() { result = colour * texture(image, at); }
)";

GLuint compile(const GlFunctions& gl, GLenum kind, const char* source) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 1024> log{};
  gl.GetShaderInfoLog(shader, log.size(), nullptr, log.data());
  gl.DeleteShader(shader);
  throw std::runtime_error(std::string("interface shader refused: ") + log.data());
}

GLuint link(const GlFunctions& gl) {
  const GLuint program = gl.CreateProgram();
  for (const auto& [kind, source] : {std::pair{GL_VERTEX_SHADER, vertex_shader},
                                     std::pair{GL_FRAGMENT_SHADER, fragment_shader}}) {
    const GLuint shader = compile(gl, static_cast<GLenum>(kind), source);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program);
  GLint good = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("interface shaders do not fit together");
  return program;
}

const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

}  // namespace

GuiPainter::GuiPainter(const GlFunctions& gl) : gl_(gl), program_(link(gl)) {
  gl_.UseProgram(program_);
  gl_.Uniform1i(gl_.GetUniformLocation(program_, "image"), 0);
  size_place_ = gl_.GetUniformLocation(program_, "size");
  gl_.GenVertexArrays(1, &array_);
  gl_.GenBuffers(1, &vertices_);
  gl_.GenBuffers(1, &indices_);
  gl_.GenTextures(1, &letters_);
}

GuiPainter::~GuiPainter() {
  gl_.DeleteTextures(1, &letters_);
  gl_.DeleteBuffers(1, &indices_);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteProgram(program_);
}

void GuiPainter::upload(ImFontAtlas& fonts) {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, letters_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  fonts.SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(letters_)));
}

void GuiPainter::tie_attributes(unsigned first_vertex) const {
  const std::size_t start = first_vertex * sizeof(ImDrawVert);
  const auto tie = [&](GLuint index, int count, GLenum type, bool fraction, std::size_t member) {
    gl_.EnableVertexAttribArray(index);
    gl_.VertexAttribPointer(index, count, type, fraction, sizeof(ImDrawVert),
                            offset(start + member));
  };
  tie(0, 2, GL_FLOAT, false, offsetof(ImDrawVert, pos));
  tie(1, 2, GL_FLOAT, false, offsetof(ImDrawVert, uv));
  tie(2, 4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col));
}

void GuiPainter::paint(const ImDrawData& data) {
  gl_.UseProgram(program_);
  gl_.Uniform2f(size_place_, data.DisplaySize.x, data.DisplaySize.y);
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.ActiveTexture(GL_TEXTURE0);
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    gl_.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
                   GL_STREAM_DRAW);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                   GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) paint(command, data.DisplaySize.y);
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
  gl_.BindVertexArray(0);
}

void GuiPainter::paint(const ImDrawCmd& command, float height) const {
  const ImVec4& clip = command.ClipRect;
  const int left = static_cast<int>(std::max(clip.x, 0.0f));
  const int bottom = static_cast<int>(std::max(height - clip.w, 0.0f));
  const int width = static_cast<int>(clip.z) - left;
  const int tall = static_cast<int>(height - clip.y) - bottom;
  if (command.UserCallback || command.ElemCount == 0 || width <= 0 || tall <= 0) return;
  gl_.Scissor(left, bottom, width, tall);
  gl_.BindTexture(GL_TEXTURE_2D,
                  static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
  tie_attributes(command.VtxOffset);
  gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                            sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                            offset(command.IdxOffset * sizeof(ImDrawIdx)), 1);
}

std::uint64_t interface_key(const ImDrawData& data) {
  std::uint64_t key = static_cast<std::uint64_t>(data.TotalVtxCount);
  const auto add = [&key](const void* from, std::size_t bytes) {
    const std::string_view part(static_cast<const char*>(from), bytes);
    key = (key ^ std::hash<std::string_view>{}(part)) * 0x9e3779b97f4a7c15ull;
  };
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
    add(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
    for (const ImDrawCmd& command : list.CmdBuffer) add(&command.ClipRect, sizeof(ImVec4));
  }
  return key;
}

}  // namespace pedicel::app
