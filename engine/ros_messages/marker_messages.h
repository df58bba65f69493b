#pragma once

#include "engine/ros_messages/sensor_messages.h"

/// visualization_msgs: what RViz draws.
namespace pedicel::ros {

struct UVCoordinate {
  static constexpr const char* name = "visualization_msgs/msg/UVCoordinate";
  float u = 0, v = 0;
  PEDICEL_FIELDS(u, v)
};

struct MeshFile {
  static constexpr const char* name = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;
  PEDICEL_FIELDS(filename, data)
};

struct Marker {
  static constexpr const char* name = "visualization_msgs/msg/Marker";
  static constexpr std::int32_t cube = 1, sphere = 2, cylinder = 3, line_strip = 4, line_list = 5,
                                sphere_list = 7, triangle_list = 11;
  static constexpr std::int32_t add = 0, remove = 2, remove_all = 3;
  Header header;
  std::string ns;
  std::int32_t id = 0, type = 0, action = 0;
  PoseMessage pose;
  Vector3 scale;
  ColorRGBA color;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text, mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;
  PEDICEL_FIELDS(header, ns, id, type, action, pose, scale, color, lifetime, frame_locked, points,
                 colors, texture_resource, texture, uv_coordinates, text, mesh_resource, mesh_file,
                 mesh_use_embedded_materials)
};

struct MarkerArray {
  static constexpr const char* name = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  PEDICEL_FIELDS(markers)
};

}  // namespace pedicel::ros
