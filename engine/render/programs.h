#pragma once

#include <array>
#include <string>

#include "engine/render/gl_functions.h"

namespace pedicel::render {

/// What is drawn with instances.
enum class Kind { tube, sphere, mesh, blade, line };
inline constexpr int kind_count = 5;

/// The uniform block `Frame` of shaders.cpp, byte for byte (std140: only 4x4 and 4-vectors).
struct FrameUniforms {
  std::array<float, 16> view_projection{}, shadow_matrix{}, contact_matrix{};
  std::array<float, 4> eye{}, view_right{}, view_up{}, view_forward{};
  std::array<float, 4> sun_direction{}, sun_colour{}, zenith{}, horizon{}, bounce{};
  std::array<float, 4> viewport{}, ground_light{}, ground_dark{}, ground_fade{};
};

/// The texture units that the samplers of the shaders are tied to.
inline constexpr int shadow_unit = 0;
inline constexpr int contact_unit = 1;

/// A program of two stages, with the uniform block and the samplers tied to their places. Throws
/// std::runtime_error with the compiler's log where a shader is refused.
GLuint link_program(const GlFunctions& gl, const std::string& vertex, const std::string& fragment);
/// The vertex stage of what is drawn with instances.
std::string vertex_stage(Kind kind);

/// Compiled shader programs and the uniform block they share.
class Programs {
 public:
  /// Throws std::runtime_error with the compiler's log where a shader is refused.
  explicit Programs(const GlFunctions& gl);
  ~Programs();
  Programs(const Programs&) = delete;
  Programs& operator=(const Programs&) = delete;

  void set_frame(const FrameUniforms& frame) const;

  void use_lit(Kind kind) const { gl_.UseProgram(lit_[static_cast<int>(kind)]); }
  /// Depth only; there is none for lines, which cast no shadow.
  void use_depth(Kind kind) const { gl_.UseProgram(depth_[static_cast<int>(kind)]); }
  void use_ground() const { gl_.UseProgram(ground_); }
  void use_sky() const { gl_.UseProgram(sky_); }
  void use_blur() const { gl_.UseProgram(blur_); }

 private:
  const GlFunctions& gl_;
  std::array<GLuint, kind_count> lit_{}, depth_{};
  GLuint ground_ = 0, sky_ = 0, blur_ = 0, block_ = 0;
};

}  // namespace pedicel::render
