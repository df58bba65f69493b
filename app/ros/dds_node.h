#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "app/topics/topic_sink.h"

namespace pedicel::app {

struct NodeOptions {
  int domain = 0;
  std::string ros_namespace;  ///< "/arm"; empty: none
  /// Address of the network interface that is used; empty: the machine itself only (loopback);
  /// "any": all of them.
  std::string interface;
};

/// Who asked, so that the answer finds back.
struct RequestId {
  std::array<unsigned char, 16> writer{};
  std::int64_t number = 0;
};

/// What ROS 2 tells the two halves of a service's definition by: "RIHS01_...".
struct ServiceHashes {
  std::string request, response;
};

/// A participant of DDS that speaks as a node of ROS 2 does. Bytes are CDR with its header.
/// Callbacks come on threads of DDS. Throws std::runtime_error where DDS refuses.
class DdsNode {
 public:
  static constexpr std::size_t longest_message = 16u << 20;  ///< bytes, of what is received
  static constexpr int domains = 233;                        ///< from 0 on

  explicit DdsNode(const NodeOptions& options);
  ~DdsNode();
  DdsNode(const DdsNode&) = delete;
  DdsNode& operator=(const DdsNode&) = delete;

  /// Returns the publisher's number. `type`: "sensor_msgs/msg/JointState"; `hash`: its RIHS01.
  int publish(const std::string& topic, const std::string& type, const std::string& hash,
              Delivery delivery);
  void write(int publisher, std::string_view cdr);
  void subscribe(const std::string& topic, const std::string& type, const std::string& hash,
                 std::function<void(std::string)> take);
  /// Returns the service's number. `type`: "pkg/srv/Name"; hashes: RIHS01 of its two halves.
  int serve(const std::string& service, const std::string& type, const ServiceHashes& hashes,
            std::function<void(RequestId, std::string)> take);
  void reply(int service, const RequestId& to, std::string_view cdr);

  /// Messages that were longer than longest_message, or arrived as nothing.
  std::uint64_t refused() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pedicel::app
