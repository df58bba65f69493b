#pragma once

#include <array>

#include "engine/render/frame_geometry.h"
#include "engine/render/label_map.h"
#include "engine/render/programs.h"

namespace pedicel::render {

/// Draws labels and depths in place of colours: flat, without blending and smooth edges. Lines and
/// ghosts are left out.
class LabelPass {
 public:
  explicit LabelPass(const GlFunctions& gl);
  ~LabelPass();
  LabelPass(const LabelPass&) = delete;
  LabelPass& operator=(const LabelPass&) = delete;

  /// With the frame's uniforms set. `empty_array`: a vertex array without attributes.
  LabelMap draw(const FrameGeometry& geometry, bool ground, GLuint empty_array, int width,
                int height);

 private:
  void prepare_target(int width, int height);
  void drop_target();
  LabelMap read() const;

  const GlFunctions& gl_;
  std::array<GLuint, kind_count> programs_{};
  GLuint ground_ = 0, frame_ = 0, colour_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace pedicel::render
