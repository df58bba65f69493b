#pragma once

#include "engine/ros_messages/common_messages.h"

/// sensor_msgs.
namespace pedicel::ros {

struct JointState {
  static constexpr const char* name = "sensor_msgs/msg/JointState";
  Header header;
  std::vector<std::string> names;
  std::vector<double> position, velocity, effort;  // rad or m, rad/s or m/s, N m or N
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("name", self.names);
    visit("position", self.position);
    visit("velocity", self.velocity);
    visit("effort", self.effort);
  }
};

struct Imu {
  static constexpr const char* name = "sensor_msgs/msg/Imu";
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};  // -1 first: there is no orientation
  Vector3 angular_velocity;                        // rad/s
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;  // m/s2
  std::array<double, 9> linear_acceleration_covariance{};
  PEDICEL_FIELDS(header, orientation, orientation_covariance, angular_velocity,
                 angular_velocity_covariance, linear_acceleration, linear_acceleration_covariance)
};

struct Image {
  static constexpr const char* name = "sensor_msgs/msg/Image";
  Header header;
  std::uint32_t height = 0, width = 0;  // px
  std::string encoding;                 // "rgb8", "32FC1"
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;  // bytes a row
  std::vector<std::uint8_t> data;
  PEDICEL_FIELDS(header, height, width, encoding, is_bigendian, step, data)
};

struct CompressedImage {
  static constexpr const char* name = "sensor_msgs/msg/CompressedImage";
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;
  PEDICEL_FIELDS(header, format, data)
};

struct RegionOfInterest {
  static constexpr const char* name = "sensor_msgs/msg/RegionOfInterest";
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;
  bool do_rectify = false;
  PEDICEL_FIELDS(x_offset, y_offset, height, width, do_rectify)
};

struct CameraInfo {
  static constexpr const char* name = "sensor_msgs/msg/CameraInfo";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{}, r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;
  PEDICEL_FIELDS(header, height, width, distortion_model, d, k, r, p, binning_x, binning_y, roi)
};

struct PointField {
  static constexpr const char* name = "sensor_msgs/msg/PointField";
  static constexpr std::uint8_t float32 = 7;
  std::string field;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("name", self.field);
    visit("offset", self.offset);
    visit("datatype", self.datatype);
    visit("count", self.count);
  }
};

struct PointCloud2 {
  static constexpr const char* name = "sensor_msgs/msg/PointCloud2";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::vector<PointField> point_fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("header", self.header);
    visit("height", self.height);
    visit("width", self.width);
    visit("fields", self.point_fields);
    visit("is_bigendian", self.is_bigendian);
    visit("point_step", self.point_step);
    visit("row_step", self.row_step);
    visit("data", self.data);
    visit("is_dense", self.is_dense);
  }
};

}  // namespace pedicel::ros
