#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/gl_functions.h"

namespace pedicel::render {

/// Vertices as the vertex stages want them, and triangles as indices.
struct MeshData {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
};

/// Numbers of floats of consecutive vertex attributes.
struct VertexLayout {
  std::span<const int> base;      ///< of the shape's own vertices, from location 0
  std::span<const int> instance;  ///< of what is said once an instance, from the next location
};

/// A shape in graphics memory, drawn many times with one call.
class InstancedMesh {
 public:
  InstancedMesh(const GlFunctions& gl, const MeshData& data, const VertexLayout& layout);
  ~InstancedMesh();
  InstancedMesh(const InstancedMesh&) = delete;
  InstancedMesh& operator=(const InstancedMesh&) = delete;

  /// Draws `count` instances whose floats lie in `buffer` from `first_float` on.
  void draw(GLuint buffer, std::size_t first_float, int count) const;

  /// Its back faces are never seen from outside: they may be left out.
  void set_closed(bool closed) { closed_ = closed; }
  bool is_closed() const { return closed_; }

  /// Floats that one instance takes.
  int instance_floats() const { return instance_floats_; }
  int triangles() const { return index_count_ / 3; }

 private:
  const GlFunctions& gl_;
  std::vector<int> instance_;
  GLuint first_location_ = 0;
  GLuint array_ = 0, vertices_ = 0, indices_ = 0;
  int instance_floats_ = 0, index_count_ = 0;
  bool closed_ = false;
};

}  // namespace pedicel::render
