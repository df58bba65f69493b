#pragma once

#include <functional>

#include "app/ros/ros_server.h"
#include "engine/ros_messages/cdr.h"

namespace pedicel::app {

/// The services of simulation_interfaces that a server answers. Requests are done between two
/// steps.
class RosServices {
 public:
  /// The server must outlive it.
  explicit RosServices(RosServer& server);

 private:
  template <class Service>
  void serve(const std::string& name,
             std::function<typename Service::Response(const typename Service::Request&)> answer);
  ros::GetSimulatorFeatures::Response features() const;
  ros::SimulationResult reset(std::uint8_t scope);
  ros::SpawnEntity::Response spawn(const ros::SpawnEntity::Request& request);
  /// The scene is built with an edit, at time 0 only.
  template <class Edit>
  ros::SimulationResult edit(const Edit& change);
  ros::SimulationResult step(std::uint64_t steps);
  ros::SimulationResult set_state(std::uint8_t state);
  ros::GetEntityState::Response state_of(const std::string& entity) const;

  RosServer& server_;
};

}  // namespace pedicel::app
