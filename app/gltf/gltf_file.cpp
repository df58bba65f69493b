#include "app/gltf/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

constexpr int unsigned_short = 5123, unsigned_int = 5125, floating = 5126;

/// glTF's colours are linear.
float linear(float part) {
  return part <= 0.04045F ? part / 12.92F : std::pow((part + 0.055F) / 1.055F, 2.4F);
}

void append_number(std::string& bytes, std::uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

int GltfFile::view(const void* data, std::size_t size, Target target) {
  while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
  nlohmann::ordered_json view = {
      {"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
  if (target != Target::none) view["target"] = static_cast<int>(target);
  bytes_.append(static_cast<const char*>(data), size);
  json_["bufferViews"].push_back(view);
  return static_cast<int>(json_["bufferViews"].size()) - 1;
}

int GltfFile::accessor(int view, int component, std::size_t count, const std::string& type) {
  json_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
  return static_cast<int>(json_["accessors"].size()) - 1;
}

int GltfFile::floats_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
}

int GltfFile::floats(std::span<const float> values, const std::string& type, bool bounds) {
  const auto width = static_cast<std::size_t>(floats_of(type));
  const int index = accessor(view(values.data(), values.size_bytes(), Target::none), floating,
                             values.size() / width, type);
  if (!bounds) return index;
  std::vector<float> low(values.begin(), values.begin() + static_cast<long>(width)), high = low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    low[i % width] = std::min(low[i % width], values[i]);
    high[i % width] = std::max(high[i % width], values[i]);
  }
  json_["accessors"][static_cast<std::size_t>(index)]["min"] = low;
  json_["accessors"][static_cast<std::size_t>(index)]["max"] = high;
  return index;
}

int GltfFile::material(const render::Shading& look, bool both_sides) {
  const nlohmann::ordered_json made = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor",
         {linear(look.colour.r), linear(look.colour.g), linear(look.colour.b), 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", std::clamp(look.roughness, 0.0F, 1.0F)}}},
      {"doubleSided", both_sides}};
  auto& all = json_["materials"];
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] == made) return static_cast<int>(i);
  all.push_back(made);
  return static_cast<int>(all.size()) - 1;
}

int GltfFile::mesh(const std::string& name, const std::vector<GltfSurface>& surfaces) {
  nlohmann::ordered_json primitives = nlohmann::ordered_json::array();
  for (const GltfSurface& surface : surfaces) {
    const std::size_t count = surface.positions.size() / 3;
    const int positions = floats(surface.positions, "VEC3", true);
    const int normals = floats(surface.normals, "VEC3");
    for (const int index : {positions, normals}) {
      const std::size_t on = json_["accessors"][static_cast<std::size_t>(index)]["bufferView"];
      json_["bufferViews"][on]["target"] = static_cast<int>(Target::vertices);
    }
    nlohmann::ordered_json attributes = {{"POSITION", positions}, {"NORMAL", normals}};
    if (!surface.joints.empty()) {
      std::vector<std::uint16_t> joints(4 * count, 0);
      std::vector<float> weights(4 * count, 0.0F);
      for (std::size_t v = 0; v < count; ++v)
        joints[4 * v] = surface.joints[v], weights[4 * v] = 1.0F;
      attributes["JOINTS_0"] =
          accessor(view(joints.data(), 8 * count, Target::vertices), unsigned_short, count, "VEC4");
      attributes["WEIGHTS_0"] =
          accessor(view(weights.data(), 16 * count, Target::vertices), floating, count, "VEC4");
    }
    const int indices =
        accessor(view(surface.indices.data(), 4 * surface.indices.size(), Target::indices),
                 unsigned_int, surface.indices.size(), "SCALAR");
    primitives.push_back({{"attributes", attributes},
                          {"indices", indices},
                          {"material", material(surface.material, surface.both_sides)}});
  }
  json_["meshes"].push_back({{"name", name}, {"primitives", primitives}});
  return static_cast<int>(json_["meshes"].size()) - 1;
}

void GltfFile::write(const std::filesystem::path& file) {
  while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
  json_["buffers"] = nlohmann::ordered_json::array();
  json_["buffers"].push_back({{"byteLength", bytes_.size()}});
  std::string text = json_.dump();
  while (text.size() % 4 != 0) text.push_back(' ');
  std::string all = "glTF";
  append_number(all, 2);
  append_number(all, static_cast<std::uint32_t>(28 + text.size() + bytes_.size()));
  append_number(all, static_cast<std::uint32_t>(text.size()));
  all += "JSON" + text;
  append_number(all, static_cast<std::uint32_t>(bytes_.size()));
  all += std::string("BIN\0", 4) + bytes_;
  io::write_file_atomically(file, all);
}

}  // namespace pedicel::app
