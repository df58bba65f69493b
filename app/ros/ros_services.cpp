#include "app/ros/ros_services.h"

#include <algorithm>

#include "engine/core/stop.h"
#include "engine/ros_messages/type_hash.h"

namespace pedicel::app {

namespace {

using Result = ros::SimulationResult;

constexpr std::uint64_t most_steps = 10'000'000;

}  // namespace

template <class Service>
void RosServices::serve(
    const std::string& name,
    std::function<typename Service::Response(const typename Service::Request&)> answer) {
  // The number is known once the service is there, and a request may come before.
  const auto number = std::make_shared<int>(-1);
  const ServiceHashes hashes{ros::type_hash_of<typename Service::Request>(),
                             ros::type_hash_of<typename Service::Response>()};
  *number = server_.node_->serve(
      name, Service::service, hashes,
      [this, name, number, answer = std::move(answer)](const RequestId& id, std::string bytes) {
        server_.queue_.put([this, name, number, answer, id, bytes = std::move(bytes)] {
          const auto request = ros::from_cdr<typename Service::Request>(bytes);
          if (!request)
            return server_.refuse(name, "no request of " + std::string(Service::service));
          server_.node_->reply(*number, id, ros::to_cdr(answer(*request)));
        });
      });
}

RosServices::RosServices(RosServer& server) : server_(server) {
  using namespace ros;
  serve<GetSimulatorFeatures>("/get_simulator_features",
                              [this](const auto&) { return features(); });
  serve<ResetSimulation>("/reset_simulation", [this](const auto& request) {
    return ResetSimulation::Response{reset(request.scope)};
  });
  serve<StepSimulation>("/step_simulation", [this](const auto& request) {
    return StepSimulation::Response{step(request.steps)};
  });
  serve<GetSimulationState>("/get_simulation_state", [this](const auto&) {
    GetSimulationState::Response response;
    response.state.state = server_.state_ == RosServer::State::playing  ? SimulationState::playing
                           : server_.state_ == RosServer::State::paused ? SimulationState::paused
                                                                        : SimulationState::stopped;
    return response;
  });
  serve<SetSimulationState>("/set_simulation_state", [this](const auto& request) {
    return SetSimulationState::Response{set_state(request.state.state)};
  });
  serve<GetEntities>("/get_entities", [this](const auto& request) {
    GetEntities::Response response;
    if (const auto left =
            filtered(entities_of(*server_.simulation_), request.filters, response.result))
      for (const Entity& entity : *left) response.entities.push_back(entity.name);
    return response;
  });
  serve<GetEntityState>("/get_entity_state",
                        [this](const auto& request) { return state_of(request.entity); });
  serve<SpawnEntity>("/spawn_entity", [this](const auto& request) { return spawn(request); });
  serve<DeleteEntity>("/delete_entity", [this](const auto& request) {
    return DeleteEntity::Response{
        edit([&](SceneEdits& edits) { return edits.remove(request.entity); })};
  });
  serve<SetEntityState>("/set_entity_state", [this](const auto& request) {
    return SetEntityState::Response{
        edit([&](SceneEdits& edits) { return edits.set_state(request); })};
  });
  serve<GetEntitiesStates>("/get_entities_states", [this](const auto& request) {
    GetEntitiesStates::Response response;
    if (const auto left =
            filtered(entities_of(*server_.simulation_), request.filters, response.result))
      for (const Entity& entity : *left) {
        response.entities.push_back(entity.name);
        response.states.push_back(entity.state);
      }
    return response;
  });
}

template <class Edit>
Result RosServices::edit(const Edit& change) {
  if (server_.simulation_->world().steps() > 0)
    return {Result::incorrect_state,
            "plants and bodies change at time 0 only, expected the simulation stopped "
            "(set_simulation_state 0) or reset"};
  SceneEdits edits = server_.edits_;
  const Result said = change(edits);
  if (said.result != Result::ok) return said;
  std::string fault;
  if (!server_.rebuild(edits, fault)) return {Result::operation_failed, fault};
  return {};
}

ros::SpawnEntity::Response RosServices::spawn(const ros::SpawnEntity::Request& request) {
  ros::SpawnEntity::Response response;
  response.result = edit([&](SceneEdits& edits) {
    response = edits.spawn(request);
    return response.result;
  });
  if (response.result.result != Result::ok) response.entity_name.clear();
  return response;
}

ros::GetSimulatorFeatures::Response RosServices::features() const {
  using F = ros::SimulatorFeatures;
  return {{{F::spawning, F::deleting, F::entity_categories, F::spawning_resource_string,
            F::entity_state_getting, F::entity_state_setting, F::simulation_reset,
            F::simulation_reset_time, F::simulation_reset_state, F::simulation_reset_spawned,
            F::simulation_state_getting, F::simulation_state_setting, F::simulation_state_pause,
            F::step_single, F::step_multiple},
           {"pedicel-plant", "pedicel-body"},
           "Pedicel: plants as Cosserat rods; entities are the robot, plants, fruits and bodies"}};
}

Result RosServices::reset(std::uint8_t scope) {
  using Reset = ros::ResetSimulation;
  const bool time = scope & Reset::scope_time, state = scope & Reset::scope_state;
  // Time and state go back together: a run is the same from its beginning on.
  if (scope != Reset::scope_default && !(time && state))
    return {Result::unsupported,
            "time and state are set back together: expected scope 0, 3, 7 or 255"};
  const bool spawned = scope == Reset::scope_default || (scope & Reset::scope_spawned);
  if (!spawned || server_.edits_.is_as_given()) {
    server_.begin();
    return {};
  }
  SceneEdits edits = server_.edits_;
  edits.reset();
  std::string fault;
  if (!server_.rebuild(edits, fault)) return {Result::operation_failed, fault};
  return {};
}

Result RosServices::step(std::uint64_t steps) {
  if (server_.state_ == RosServer::State::playing)
    return {Result::incorrect_state, "the simulation plays, expected it paused"};
  if (steps > most_steps)
    return {Result::operation_failed,
            "more than " + std::to_string(most_steps) + " steps, expected fewer at once"};
  for (std::uint64_t i = 0; i < steps && !stop_requested; ++i)
    if (!server_.step()) return {Result::operation_failed, server_.failure_};
  server_.state_ = RosServer::State::paused;
  return {};
}

Result RosServices::set_state(std::uint8_t state) {
  using S = ros::SimulationState;
  using Set = ros::SetSimulationState;
  using State = RosServer::State;
  if (state == S::quitting) {
    server_.quits_ = true;
    return {};
  }
  if (state != S::stopped && state != S::playing && state != S::paused)
    return {Result::unsupported, "expected stopped (0), playing (1), paused (2) or quitting (3)"};
  const State wanted = state == S::playing  ? State::playing
                       : state == S::paused ? State::paused
                                            : State::stopped;
  if (wanted == server_.state_) return {Set::already_in_target_state, "it is in that state"};
  if (wanted == State::paused && server_.state_ == State::stopped)
    return {Set::incorrect_transition, "it is stopped, expected to be told to play first"};
  if (wanted == State::stopped) server_.begin();
  server_.state_ = wanted;
  server_.pace_wall_ = 0.0;
  return {};
}

ros::GetEntityState::Response RosServices::state_of(const std::string& entity) const {
  for (const Entity& one : entities_of(*server_.simulation_))
    if (one.name == entity) return {{}, one.state};
  return {{Result::not_found, "no entity of that name (get_entities lists them)"}, {}};
}

}  // namespace pedicel::app
