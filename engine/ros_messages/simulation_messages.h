#pragma once

#include "engine/ros_messages/common_messages.h"

/// simulation_interfaces 2.1: the services by which simulators are steered.
namespace pedicel::ros {

/// A message or service part without fields has this one in its bytes.
struct Nothing {
  std::uint8_t structure_needs_at_least_one_member = 0;
};

struct SimulationResult {
  static constexpr const char* name = "simulation_interfaces/msg/Result";
  static constexpr std::uint8_t unsupported = 0, ok = 1, not_found = 2, incorrect_state = 3,
                                operation_failed = 4;
  std::uint8_t result = ok;
  std::string error_message;
  PEDICEL_FIELDS(result, error_message)
};

struct SimulationState {
  static constexpr const char* name = "simulation_interfaces/msg/SimulationState";
  static constexpr std::uint8_t stopped = 0, playing = 1, paused = 2, quitting = 3;
  std::uint8_t state = stopped;
  PEDICEL_FIELDS(state)
};

struct SimulatorFeatures {
  static constexpr const char* name = "simulation_interfaces/msg/SimulatorFeatures";
  static constexpr std::uint16_t spawning = 0, deleting = 1, entity_categories = 8,
                                 spawning_resource_string = 9, entity_state_getting = 10,
                                 entity_state_setting = 11, simulation_reset = 20,
                                 simulation_reset_time = 21, simulation_reset_state = 22,
                                 simulation_reset_spawned = 23, simulation_state_getting = 24,
                                 simulation_state_setting = 25, simulation_state_pause = 26,
                                 step_single = 31, step_multiple = 32;
  std::vector<std::uint16_t> features;
  std::vector<std::string> spawn_formats;
  std::string custom_info;
  PEDICEL_FIELDS(features, spawn_formats, custom_info)
};

struct EntityCategory {
  static constexpr const char* name = "simulation_interfaces/msg/EntityCategory";
  static constexpr std::uint8_t object = 0, robot = 1, dynamic_object = 4, static_object = 5;
  std::uint8_t category = object;
  PEDICEL_FIELDS(category)
};

struct TagsFilter {
  static constexpr const char* name = "simulation_interfaces/msg/TagsFilter";
  std::vector<std::string> tags;
  std::uint8_t filter_mode = 0;
  PEDICEL_FIELDS(tags, filter_mode)
};

struct Bounds {
  static constexpr const char* name = "simulation_interfaces/msg/Bounds";
  std::uint8_t type = 0;
  std::vector<Vector3> points;
  PEDICEL_FIELDS(type, points)
};

struct EntityFilters {
  static constexpr const char* name = "simulation_interfaces/msg/EntityFilters";
  std::string filter;
  std::vector<EntityCategory> categories;
  TagsFilter tags;
  Bounds bounds;
  PEDICEL_FIELDS(filter, categories, tags, bounds)
};

struct EntityState {
  static constexpr const char* name = "simulation_interfaces/msg/EntityState";
  Header header;
  PoseMessage pose;
  TwistMessage twist;
  Accel acceleration;
  PEDICEL_FIELDS(header, pose, twist, acceleration)
};

/// A thing to be made: a file, or, where that is empty, its text.
struct Resource {
  static constexpr const char* name = "simulation_interfaces/msg/Resource";
  std::string uri, resource_string;
  PEDICEL_FIELDS(uri, resource_string)
};

/// Each service: its name, its request and its response.
struct GetSimulatorFeatures {
  static constexpr const char* service = "simulation_interfaces/srv/GetSimulatorFeatures";
  struct Request : Nothing {
    static constexpr const char* name = "simulation_interfaces/srv/GetSimulatorFeatures_Request";
    PEDICEL_FIELDS(structure_needs_at_least_one_member)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/GetSimulatorFeatures_Response";
    SimulatorFeatures features;
    PEDICEL_FIELDS(features)
  };
};

struct ResetSimulation {
  static constexpr const char* service = "simulation_interfaces/srv/ResetSimulation";
  static constexpr std::uint8_t scope_default = 0, scope_time = 1, scope_state = 2,
                                scope_spawned = 4;
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/ResetSimulation_Request";
    std::uint8_t scope = scope_default;
    PEDICEL_FIELDS(scope)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/ResetSimulation_Response";
    SimulationResult result;
    PEDICEL_FIELDS(result)
  };
};

struct StepSimulation {
  static constexpr const char* service = "simulation_interfaces/srv/StepSimulation";
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/StepSimulation_Request";
    std::uint64_t steps = 1;
    PEDICEL_FIELDS(steps)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/StepSimulation_Response";
    SimulationResult result;
    PEDICEL_FIELDS(result)
  };
};

struct GetSimulationState {
  static constexpr const char* service = "simulation_interfaces/srv/GetSimulationState";
  struct Request : Nothing {
    static constexpr const char* name = "simulation_interfaces/srv/GetSimulationState_Request";
    PEDICEL_FIELDS(structure_needs_at_least_one_member)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/GetSimulationState_Response";
    SimulationState state;
    SimulationResult result;
    PEDICEL_FIELDS(state, result)
  };
};

struct SetSimulationState {
  static constexpr const char* service = "simulation_interfaces/srv/SetSimulationState";
  static constexpr std::uint8_t already_in_target_state = 101, incorrect_transition = 103;
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/SetSimulationState_Request";
    SimulationState state;
    PEDICEL_FIELDS(state)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/SetSimulationState_Response";
    SimulationResult result;
    PEDICEL_FIELDS(result)
  };
};

struct GetEntities {
  static constexpr const char* service = "simulation_interfaces/srv/GetEntities";
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntities_Request";
    EntityFilters filters;
    PEDICEL_FIELDS(filters)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntities_Response";
    SimulationResult result;
    std::vector<std::string> entities;
    PEDICEL_FIELDS(result, entities)
  };
};

struct GetEntityState {
  static constexpr const char* service = "simulation_interfaces/srv/GetEntityState";
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntityState_Request";
    std::string entity;
    PEDICEL_FIELDS(entity)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntityState_Response";
    SimulationResult result;
    EntityState state;
    PEDICEL_FIELDS(result, state)
  };
};

struct GetEntitiesStates {
  static constexpr const char* service = "simulation_interfaces/srv/GetEntitiesStates";
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntitiesStates_Request";
    EntityFilters filters;
    PEDICEL_FIELDS(filters)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/GetEntitiesStates_Response";
    SimulationResult result;
    std::vector<std::string> entities;
    std::vector<EntityState> states;
    PEDICEL_FIELDS(result, entities, states)
  };
};

struct SpawnEntity {
  static constexpr const char* service = "simulation_interfaces/srv/SpawnEntity";
  static constexpr std::uint8_t name_not_unique = 101, name_invalid = 102, unsupported_format = 103,
                                no_resource = 104, namespace_invalid = 105,
                                resource_parse_error = 106, invalid_pose = 109;
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/SpawnEntity_Request";
    std::string entity;
    bool allow_renaming = false;
    Resource entity_resource;
    std::string entity_namespace;
    PoseStamped initial_pose;
    template <class Self, class Visit>
    static void fields(Self& self, Visit& visit) {
      visit("name", self.entity);
      visit("allow_renaming", self.allow_renaming);
      visit("entity_resource", self.entity_resource);
      visit("entity_namespace", self.entity_namespace);
      visit("initial_pose", self.initial_pose);
    }
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/SpawnEntity_Response";
    SimulationResult result;
    std::string entity_name;
    PEDICEL_FIELDS(result, entity_name)
  };
};

struct DeleteEntity {
  static constexpr const char* service = "simulation_interfaces/srv/DeleteEntity";
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/DeleteEntity_Request";
    std::string entity;
    PEDICEL_FIELDS(entity)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/DeleteEntity_Response";
    SimulationResult result;
    PEDICEL_FIELDS(result)
  };
};

struct SetEntityState {
  static constexpr const char* service = "simulation_interfaces/srv/SetEntityState";
  static constexpr std::uint8_t invalid_pose = 101;
  struct Request {
    static constexpr const char* name = "simulation_interfaces/srv/SetEntityState_Request";
    std::string entity;
    EntityState state;
    bool set_pose = false, set_twist = false, set_acceleration = false;
    PEDICEL_FIELDS(entity, state, set_pose, set_twist, set_acceleration)
  };
  struct Response {
    static constexpr const char* name = "simulation_interfaces/srv/SetEntityState_Response";
    SimulationResult result;
    PEDICEL_FIELDS(result)
  };
};

}  // namespace pedicel::ros
