// A bag of ROS 1 by its own library: half a second of an arm, of a fruit's frame, of a tracker and
// of a force sensor. Usage: ros1_bag FILE none|bz2|lz4
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <string>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string packing = argv[2];
  rosbag::Bag bag(argv[1], rosbag::bagmode::Write);
  bag.setCompression(packing == "bz2"   ? rosbag::compression::BZ2
                     : packing == "lz4" ? rosbag::compression::LZ4
                                        : rosbag::compression::Uncompressed);
  bag.setChunkThreshold(10000);
  for (int i = 0; i <= 50; ++i) {
    const ros::Time time(1700000000 + i / 100, i % 100 * 10000000);
    sensor_msgs::JointState joints;
    joints.header.seq = 7 + i;
    joints.header.stamp = time;
    joints.name = {"joint2", "joint1"};
    joints.position = {0.002 * i, -0.001 * i};
    joints.effort = {1.0, 2.0};
    bag.write("/joint_states", time, joints);
    tf2_msgs::TFMessage frames;
    frames.transforms.resize(1);
    frames.transforms[0].header.stamp = time;
    frames.transforms[0].header.frame_id = "world";
    frames.transforms[0].child_frame_id = "truss/fruit_1";
    frames.transforms[0].transform.translation.x = 0.5 + 0.001 * i;
    frames.transforms[0].transform.rotation.w = 1.0;
    bag.write("/tf", time, frames);
    geometry_msgs::PoseStamped pose;
    pose.header.stamp = time;
    pose.header.frame_id = "world";
    pose.pose.position.z = 0.3 - 0.001 * i;
    bag.write("/tracker/pose", time, pose);
    geometry_msgs::WrenchStamped wrench;
    wrench.header.stamp = time;
    wrench.header.frame_id = "flange";
    wrench.wrench.force.z = -5.0;
    wrench.wrench.torque.x = 0.01 * i;
    bag.write("/wrist/wrench", time, wrench);
    sensor_msgs::Image image;
    image.data.assign(500, static_cast<unsigned char>(i));
    bag.write("/camera/image", time, image);
  }
  std_msgs::String event;
  event.data = R"({"event": "detached", "what": "truss/fruit_1", "by": ""})";
  bag.write("/events", ros::Time(1700000000, 300000000), event);
  bag.close();
  return 0;
}
