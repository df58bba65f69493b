#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/render/draw_list.h"

namespace pedicel::app {

/// A surface for glTF, ready to draw. With `joints` each vertex hangs on one joint of a skin, in
/// whose frame it is given.
struct GltfSurface {
  std::vector<float> positions, normals;  ///< m; three a vertex
  std::vector<std::uint32_t> indices;     ///< three a triangle
  std::vector<std::uint16_t> joints;      ///< one a vertex; empty: rigid
  render::Shading material;
  bool both_sides = false;
};

/// Puts together a binary glTF 2.0 file (.glb): one buffer, and the JSON that says what is where.
class GltfFile {
 public:
  /// Returns the index of the accessor. `type`: "SCALAR", "VEC3", "VEC4". `bounds`: min and max are
  /// said, as positions and times need it.
  int floats(std::span<const float> values, const std::string& type, bool bounds = false);
  /// Returns the mesh's index.
  int mesh(const std::string& name, const std::vector<GltfSurface>& surfaces);

  /// The document but for meshes, materials, accessors and buffers, which are made here.
  nlohmann::ordered_json& json() { return json_; }
  /// Throws io::WriteError.
  void write(const std::filesystem::path& file);

 private:
  enum class Target { none = 0, vertices = 34962, indices = 34963 };
  int view(const void* data, std::size_t size, Target target);
  int accessor(int view, int component, std::size_t count, const std::string& type);
  int material(const render::Shading& material, bool both_sides);
  static int floats_of(const std::string& type);

  nlohmann::ordered_json json_;
  std::string bytes_;
};

}  // namespace pedicel::app
