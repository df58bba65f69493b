#include "app/topics/camera_messages.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace pedicel::app {

namespace {

constexpr bool big_endian = false;  // as the machines are that this runs on

ros::Image empty_image(int width, int height, const char* encoding, std::size_t bytes_a_pixel) {
  ros::Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.encoding = encoding;
  image.is_bigendian = big_endian;
  image.step = image.width * static_cast<std::uint32_t>(bytes_a_pixel);
  image.data.resize(std::size_t{image.step} * image.height);
  return image;
}

template <class T>
ros::Image image_with(int width, int height, const char* encoding, std::size_t bytes_a_pixel,
                      const std::vector<T>& values) {
  ros::Image image = empty_image(width, height, encoding, bytes_a_pixel);
  std::memcpy(image.data.data(), values.data(), image.data.size());
  return image;
}

}  // namespace

ros::CameraInfo camera_info_of(const CameraMatrices& camera) {
  ros::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.d.assign(5, 0.0);
  for (std::size_t row = 0; row < 3; ++row) {
    info.r[4 * row] = 1.0;
    for (std::size_t column = 0; column < 3; ++column)
      info.k[3 * row + column] = info.p[4 * row + column] =
          camera.intrinsic(static_cast<long>(row), static_cast<long>(column));
  }
  return info;
}

ros::Image image_of(const render::Image& image) {
  return image_with(image.width, image.height, "rgb8", 3, image.rgb);
}

ros::Image depth_image_of(const render::LabelMap& map) {
  return image_with(map.width, map.height, "32FC1", sizeof(float), map.depth);
}

ros::Image mask_of(const render::GrayImage& mask) {
  return image_with(mask.width, mask.height, "16UC1", sizeof(std::uint16_t), mask.values);
}

ros::PointCloud2 points_of(const SensedPicture& picture) {
  const render::LabelMap& map = picture.map;
  const bool coloured = !picture.image.rgb.empty();
  ros::PointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t>(map.width);
  cloud.height = static_cast<std::uint32_t>(map.height);
  for (const char* name : {"x", "y", "z", "rgb"})
    if (coloured || std::strcmp(name, "rgb") != 0) {
      cloud.point_fields.push_back({name, cloud.point_step, ros::PointField::float32, 1});
      cloud.point_step += sizeof(float);
    }
  cloud.is_bigendian = big_endian;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
  const Mat3& k = picture.camera.intrinsic;
  std::uint8_t* to = cloud.data.data();
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x, to += cloud.point_step) {
      const float depth = map.depth[map.index(x, y)];
      float point[3] = {};
      const float none = std::numeric_limits<float>::quiet_NaN();
      const auto d = static_cast<double>(depth);
      point[0] =
          std::isfinite(depth) ? static_cast<float>((x + 0.5 - k(0, 2)) / k(0, 0) * d) : none;
      point[1] =
          std::isfinite(depth) ? static_cast<float>((y + 0.5 - k(1, 2)) / k(1, 1) * d) : none;
      point[2] = std::isfinite(depth) ? depth : none;
      std::memcpy(to, point, sizeof point);
      if (!coloured) continue;
      // Blue, green, red, nothing: a number 0x00RRGGBB in the place of a float, as ROS has it.
      const std::uint8_t* colour = picture.image.at(x, y);
      for (int i = 0; i < 3; ++i) to[sizeof point + static_cast<std::size_t>(i)] = colour[2 - i];
    }
  return cloud;
}

}  // namespace pedicel::app
