#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/gl_functions.h"

struct ImDrawData;
struct ImDrawCmd;
struct ImFontAtlas;

namespace pedicel::app {

/// A number that is another where the interface would look otherwise (a hash of all its corners).
std::uint64_t interface_key(const ImDrawData& data);

/// Paints what Dear ImGui drew, with the project's own table of OpenGL functions: the same code in
/// a window and off screen. (The packaged back end looks for its functions in a window system.)
class GuiPainter {
 public:
  /// Throws std::runtime_error where a shader is refused.
  explicit GuiPainter(const render::GlFunctions& gl);
  ~GuiPainter();
  GuiPainter(const GuiPainter&) = delete;
  GuiPainter& operator=(const GuiPainter&) = delete;

  /// Uploads the letters, anew after the fonts changed.
  void upload(ImFontAtlas& fonts);
  /// Paints over the framebuffer that is bound, whose size is the data's DisplaySize. Leaves
  /// blending and scissors off.
  void paint(const ImDrawData& data);

 private:
  void paint(const ImDrawCmd& command, float height) const;
  void tie_attributes(unsigned first_vertex) const;

  const render::GlFunctions& gl_;
  GLuint program_ = 0, array_ = 0, vertices_ = 0, indices_ = 0, letters_ = 0;
  GLint size_place_ = -1;
};

}  // namespace pedicel::app
