#pragma once

#include "engine/ros_messages/sensor_messages.h"

/// visualization_msgs: what RViz draws.
namespace pedicel::ros {

struct UVCoordinate {
  static constexpr const char* name = "visualization_msgs/msg/UVCoordinate";
  float u = 0, v = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("u", self.u);
    visit("v", self.v);
  }
};

struct MeshFile {
  static constexpr const char* name = "visualization_msgs/msg/MeshFile";
  std::string filename;
  std::vector<std::uint8_t> data;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("filename", self.filename);
    visit("data", self.data);
  }
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
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("ns", self.ns);
    visit("id", self.id);
    visit("type", self.type);
    visit("action", self.action);
    visit("pose", self.pose);
    visit("scale", self.scale);
    visit("color", self.color);
    visit("lifetime", self.lifetime);
    visit("frame_locked", self.frame_locked);
    visit("points", self.points);
    visit("colors", self.colors);
    visit("texture_resource", self.texture_resource);
    visit("texture", self.texture);
    visit("uv_coordinates", self.uv_coordinates);
    visit("text", self.text);
    visit("mesh_resource", self.mesh_resource);
    visit("mesh_file", self.mesh_file);
    visit("mesh_use_embedded_materials", self.mesh_use_embedded_materials);
  }
};

struct MarkerArray {
  static constexpr const char* name = "visualization_msgs/msg/MarkerArray";
  std::vector<Marker> markers;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("markers", self.markers);
  }
};

}  // namespace pedicel::ros
