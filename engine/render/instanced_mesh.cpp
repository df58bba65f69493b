#include "engine/render/instanced_mesh.h"

#include <numeric>

namespace pedicel::render {

namespace {

/// Describes consecutive attributes of the buffer that is bound now.
void describe(const GlFunctions& gl, std::span<const int> sizes, GLuint location,
              std::size_t first_float, GLuint divisor) {
  const int stride = std::accumulate(sizes.begin(), sizes.end(), 0);
  std::size_t offset = first_float;
  for (const int size : sizes) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE,
                           stride * static_cast<GLsizei>(sizeof(float)),
                           reinterpret_cast<const void*>(offset * sizeof(float)));
    gl.VertexAttribDivisor(location, divisor);
    offset += static_cast<std::size_t>(size);
    ++location;
  }
}

}  // namespace

InstancedMesh::InstancedMesh(const GlFunctions& gl, const MeshData& data,
                             const VertexLayout& layout)
    : gl_(gl),
      instance_(layout.instance.begin(), layout.instance.end()),
      first_location_(static_cast<GLuint>(layout.base.size())),
      instance_floats_(std::accumulate(instance_.begin(), instance_.end(), 0)),
      index_count_(static_cast<int>(data.indices.size())) {
  gl_.GenVertexArrays(1, &array_);
  gl_.GenBuffers(1, &vertices_);
  gl_.GenBuffers(1, &indices_);
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(data.vertices.size() * sizeof(float)),
                 data.vertices.data(), GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(data.indices.size() * sizeof(std::uint32_t)),
                 data.indices.data(), GL_STATIC_DRAW);
  describe(gl_, layout.base, 0, 0, 0);
}

InstancedMesh::~InstancedMesh() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteBuffers(1, &indices_);
}

void InstancedMesh::draw(GLuint buffer, std::size_t first_float, int count) const {
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer);
  describe(gl_, instance_, first_location_, first_float, 1);
  gl_.DrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr, count);
}

}  // namespace pedicel::render
