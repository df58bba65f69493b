#pragma once

#include "engine/mcap/reader.h"

/// Bags of ROS 1, format 2.0.
namespace pedicel::rosbag {

/// Reads a bag from front to back and needs no index. Messages have the encoding "ros1", and types
/// the names of ROS 2 ("sensor_msgs/msg/JointState"). ReadEnd::whole: the bag was closed. Throws
/// InvalidFile with the byte where something is no bag, damaged or beyond the limits, and what
/// `take` throws.
mcap::ReadEnd read(std::istream& file, const std::string& name,
                   const std::function<void(const mcap::Message&)>& take,
                   const mcap::ReaderLimits& limits = {});
mcap::ReadEnd read(const std::filesystem::path& file,
                   const std::function<void(const mcap::Message&)>& take,
                   const mcap::ReaderLimits& limits = {});

/// Whether a file begins as a bag of any version.
bool is_bag(const std::filesystem::path& file);

}  // namespace pedicel::rosbag
