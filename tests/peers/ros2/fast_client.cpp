// A client of the services and actions of `pedicel SCENE --ros`, in a process of its own.
// Usage: fast_client DOMAIN; ends with 0 where all is as it should be.
#include <cmath>
#include <cstdlib>

#include "tests/peers/ros2/fast_dds.h"

using namespace ros2_client;

namespace {

const std::string services = "simulation_interfaces::srv::dds_::";
const std::string actions = "control_msgs::action::dds_::";

std::string nothing() {
  return bytes_of([](Cdr& cdr) { cdr << std::uint8_t{0}; });
}
std::string one_byte(std::uint8_t value) {
  return bytes_of([&](Cdr& cdr) { cdr << value; });
}
int state_of(std::string reply) {
  std::uint8_t state = 255;
  if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> state; });
  return state;
}

void check_services(Client& client) {
  std::string reply =
      client.call("/get_simulator_features", services + "GetSimulatorFeatures", nothing(), 15);
  std::vector<std::uint16_t> features;
  if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> features; });
  expect(features.size() >= 10, "features are told");
  const auto state = [&] {
    return state_of(
        client.call("/get_simulation_state", services + "GetSimulationState", nothing()));
  };
  const auto set = [&](int wanted) {
    return result_of(client.call("/set_simulation_state", services + "SetSimulationState",
                                 one_byte(static_cast<std::uint8_t>(wanted))));
  };
  const auto step = [&](std::uint64_t steps) {
    return result_of(client.call("/step_simulation", services + "StepSimulation",
                                 bytes_of([&](Cdr& cdr) { cdr << steps; })));
  };
  expect(state() == 1, "it plays");
  expect(step(1) == 3, "no step while it plays");
  expect(set(2) == 1 && state() == 2, "it is paused");
  expect(set(2) == 101, "it is paused already");
  const auto time = [&] {
    std::string said = client.call("/get_entity_state", services + "GetEntityState",
                                   bytes_of([](Cdr& cdr) { cdr << std::string("arm"); }));
    std::uint8_t result = 0;
    std::string text;
    std::int32_t sec = -1;
    std::uint32_t nanosec = 0;
    if (!said.empty()) read(said, [&](Cdr& cdr) { cdr >> result >> text >> sec >> nanosec; });
    return sec + 1e-9 * nanosec;
  };
  const double before = time();
  expect(step(20) == 1 && std::abs(time() - before - 20.0 / 240.0) < 1e-8, "twenty steps");
  expect(set(77) == 0, "no such state");
  expect(
      result_of(client.call("/reset_simulation", services + "ResetSimulation", one_byte(0))) == 1,
      "reset");
  expect(
      result_of(client.call("/reset_simulation", services + "ResetSimulation", one_byte(1))) == 0,
      "no reset of the time alone");

  const auto filter = [](const std::string& expression) {
    return bytes_of([&](Cdr& cdr) {
      cdr << expression << std::uint32_t{0} << std::uint32_t{0} << std::uint8_t{0}
          << std::uint8_t{0} << std::uint32_t{0};
    });
  };
  reply = client.call("/get_entities", services + "GetEntities", filter("truss/fruit_.*"));
  std::uint8_t result = 0;
  std::string text;
  std::vector<std::string> names;
  if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> result >> text >> names; });
  expect(result == 1 && names.size() == 5 && names[0] == "truss/fruit_1", "five fruits");
  expect(result_of(client.call("/get_entities", services + "GetEntities", filter("((("))) == 4,
         "a filter that is none is refused");
  const auto entity = [](const std::string& name) {
    return bytes_of([&](Cdr& cdr) { cdr << name; });
  };
  reply = client.call("/get_entity_state", services + "GetEntityState", entity("truss/fruit_1"));
  std::int32_t sec = -1;
  std::uint32_t nanosec = 1;
  double p[3] = {0, 0, 0};
  if (!reply.empty())
    read(reply, [&](Cdr& cdr) {
      cdr >> result >> text >> sec >> nanosec >> text >> p[0] >> p[1] >> p[2];
    });
  expect(sec == 0 && nanosec == 0 && text == "world" && std::abs(p[2] - 0.43) < 1e-6,
         "a fruit's place at time 0");
  expect(result_of(
             client.call("/get_entity_state", services + "GetEntityState", entity("nobody"))) == 2,
         "nobody is not found");
  expect(client.call("/step_simulation", services + "StepSimulation", "garbage", 1.0).empty(),
         "garbage has no answer");
  expect(set(1) == 1, "it plays again");
}

void put_pose(Cdr& cdr, const std::string& frame, double x, double y, double z, double w) {
  cdr << std::int32_t{0} << std::uint32_t{0} << frame << x << y << z << 0.0 << 0.0 << 0.0 << w;
}

// Plants and bodies come and go while the simulation stands at time 0.
void check_entities(Client& client) {
  const auto spawn = [&](const std::string& name, bool renaming, const std::string& text, double w,
                         std::string& got) {
    std::string reply =
        client.call("/spawn_entity", services + "SpawnEntity", bytes_of([&](Cdr& cdr) {
                      cdr << name << renaming << std::string() << text << std::string();
                      put_pose(cdr, "world", 0.8, 0.4, 0.2, w);
                    }));
    std::uint8_t result = 255;
    std::string fault;
    if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> result >> fault >> got; });
    return int{result};
  };
  const auto set_state = [&](const std::string& name, double z, bool twist) {
    return result_of(
        client.call("/set_entity_state", services + "SetEntityState", bytes_of([&](Cdr& cdr) {
                      cdr << name;
                      put_pose(cdr, "", 0.8, 0.4, z, 1.0);
                      for (int i = 0; i < 12; ++i) cdr << (i == 2 ? 0.5 : 0.0);
                      cdr << true << twist << false;
                    })));
  };
  const auto height = [&](const std::string& name) {
    std::string reply = client.call("/get_entity_state", services + "GetEntityState",
                                    bytes_of([&](Cdr& cdr) { cdr << name; }));
    std::uint8_t result = 255;
    std::string text;
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
    double p[3] = {0, 0, -1};
    if (!reply.empty())
      read(reply, [&](Cdr& cdr) {
        cdr >> result >> text >> sec >> nanosec >> text >> p[0] >> p[1] >> p[2];
      });
    return result == 1 ? p[2] : -1.0;
  };
  const auto remove = [&](const std::string& name) {
    return result_of(client.call("/delete_entity", services + "DeleteEntity",
                                 bytes_of([&](Cdr& cdr) { cdr << name; })));
  };
  const auto set = [&](std::uint8_t state) {
    return result_of(
        client.call("/set_simulation_state", services + "SetSimulationState", one_byte(state)));
  };
  const std::string ball = "{name: any, sphere: {radius: 0.02}, mass: 0.1}",
                    bush =
                        "format: pedicel-plant\nversion: 1\nname: bush\n"
                        "material: {youngs_modulus: 1.0e9, poisson_ratio: 0.35, density: 700, "
                        "damping_time: 0.01}\nsampling: {connect: 0.004, distance: 0.05}\n"
                        "root: [0, 0, 0]\ncurves:\n  - {name: stem, interpolation: linear, "
                        "points: [[0, 0, 0], [0, 0, 0.3]], radius: 0.004}\n";
  std::string got;
  expect(spawn("ball", false, ball, 1.0, got) == 3, "nothing is spawned while time goes on");
  expect(set(0) == 1, "it is stopped");
  expect(spawn("ball", false, ball, 1.0, got) == 1 && got == "ball", "a ball is spawned");
  expect(spawn("ball", false, ball, 1.0, got) == 101, "its name is taken then");
  expect(spawn("ball", true, ball, 1.0, got) == 1 && got == "ball_2", "or made another");
  expect(spawn("bush", false, bush, 1.0, got) == 1 && got == "bush", "a plant is spawned");
  expect(spawn("b2", false, "", 1.0, got) == 104, "nothing is no resource");
  expect(spawn("b2", false, "{box: 3", 1.0, got) == 106, "nor is broken YAML");
  expect(spawn("b2", false, ball, 0.0, got) == 109, "a quaternion of zeros is no pose");
  expect(spawn("a b", false, ball, 1.0, got) == 102, "a name with a space is none");
  expect(set_state("ball", 0.7, true) == 1 && std::abs(height("ball") - 0.7) < 1e-9,
         "a ball is moved");
  expect(set_state("bush", 0.1, false) == 1 && std::abs(height("bush") - 0.1) < 1e-9,
         "a plant is moved");
  expect(set_state("nobody", 0.7, false) == 2, "nobody is not");
  expect(set_state("bush", 0.1, true) == 4, "a plant has no twist");
  expect(result_of(client.call("/step_simulation", services + "StepSimulation",
                               bytes_of([](Cdr& cdr) { cdr << std::uint64_t{10}; }))) == 1 &&
             height("ball") > 0.7,
         "the ball flies up");
  expect(set_state("ball", 0.7, false) == 3, "nothing is moved under way");
  expect(set(0) == 1 && remove("ball_2") == 1 && height("ball_2") == -1, "a ball is deleted");
  expect(remove("ball_2") == 2, "once");
  expect(
      result_of(client.call("/reset_simulation", services + "ResetSimulation", one_byte(0))) == 1 &&
          height("ball") == -1 && height("bush") == -1,
      "a reset takes away what was spawned");
  expect(set(1) == 1, "it plays again");
}

void put_goal(Cdr& cdr, std::uint8_t id, const std::string& joint, double position,
              std::int32_t seconds, std::uint32_t nanoseconds) {
  const std::vector<double> none, positions = {position};
  for (int i = 0; i < 16; ++i) cdr << id;
  cdr << std::int32_t{0} << std::uint32_t{0} << std::string() << std::vector<std::string>{joint};
  cdr << std::uint32_t{1} << positions << none << none << none << seconds << nanoseconds;
  // No trajectory of several degrees of freedom, no tolerances.
  cdr << std::int32_t{0} << std::uint32_t{0} << std::string() << std::uint32_t{0}
      << std::uint32_t{0};
  for (int i = 0; i < 4; ++i) cdr << std::uint32_t{0};
  cdr << std::int32_t{0} << std::uint32_t{0};
}

std::string id_bytes(std::uint8_t id) {
  return bytes_of([&](Cdr& cdr) {
    for (int i = 0; i < 16; ++i) cdr << id;
  });
}

void check_actions(Client& client) {
  const std::string follow = "/arm_controller/follow_joint_trajectory/_action/";
  fdds::DataReader* feedback =
      client.reader("rt" + follow + "feedback", actions + "FollowJointTrajectory_FeedbackMessage_");
  const auto send = [&](std::uint8_t id, const std::string& joint, double position,
                        std::int32_t seconds, std::uint32_t nanoseconds) {
    std::string reply = client.call(
        follow + "send_goal", actions + "FollowJointTrajectory_SendGoal",
        bytes_of([&](Cdr& cdr) { put_goal(cdr, id, joint, position, seconds, nanoseconds); }));
    bool accepted = false;
    if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> accepted; });
    return accepted;
  };
  const auto wait_for = [&](std::uint8_t id, std::int32_t& error) {
    std::string reply = client.call(follow + "get_result",
                                    actions + "FollowJointTrajectory_GetResult", id_bytes(id), 10);
    std::int8_t status = -1;
    if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> status >> error; });
    return int{status};
  };
  std::int32_t error = 99;
  expect(!send(1, "no_such_joint", 0, 1, 0), "a joint that is not there is refused");
  expect(!send(1, "joint1", std::nan(""), 1, 0), "a place that is no number is refused");
  expect(send(2, "joint1", 0.2, 1, 0), "a goal is accepted");
  expect(wait_for(2, error) == 4 && error == 0, "and reached");
  int told = 0;
  std::string bytes;
  fdds::SampleInfo info;
  double actual = 0.0;
  while (feedback->take_next_sample(&bytes, &info) ==
         eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    ++told;
    read(bytes, [&](Cdr& cdr) {
      std::uint8_t byte = 0;
      std::int32_t sec = 0;
      std::uint32_t nanosec = 0;
      std::string frame;
      std::vector<std::string> joints;
      std::vector<double> desired[4], is;
      for (int i = 0; i < 16; ++i) cdr >> byte;
      cdr >> sec >> nanosec >> frame >> joints;
      for (auto& one : desired) cdr >> one;
      cdr >> sec >> nanosec >> is;
      actual = is.empty() ? 0.0 : is[0];
    });
  }
  expect(told >= 5 && std::abs(actual - 0.2) < 0.05,
         "on the way it is told of: " + std::to_string(told));
  expect(wait_for(3, error) == 0, "an unknown goal has no status");
  expect(send(4, "joint1", -0.5, 30, 0), "a long goal");
  std::string reply = client.call(follow + "cancel_goal", "action_msgs::srv::dds_::CancelGoal",
                                  bytes_of([](Cdr& cdr) {
                                    for (int i = 0; i < 16; ++i) cdr << std::uint8_t{4};
                                    cdr << std::int32_t{0} << std::uint32_t{0};
                                  }));
  std::int8_t code = 9;
  std::uint32_t canceling = 0;
  if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> code >> canceling; });
  expect(code == 0 && canceling == 1 && wait_for(4, error) == 5, "is given up");
  expect(send(5, "joint1", 0.0, 30, 0) && send(6, "joint1", 0.1, 0, 500000000),
         "a goal in place of another");
  expect(wait_for(5, error) == 6 && wait_for(6, error) == 4, "ends that one");

  const std::string grip = "/gripper_controller/gripper_cmd/_action/";
  reply =
      client.call(grip + "send_goal", actions + "GripperCommand_SendGoal", bytes_of([](Cdr& cdr) {
                    for (int i = 0; i < 16; ++i) cdr << std::uint8_t{7};
                    cdr << 0.015 << 5.0;
                  }));
  bool accepted = false;
  if (!reply.empty()) read(reply, [&](Cdr& cdr) { cdr >> accepted; });
  expect(accepted, "the gripper takes a command");
  reply = client.call(grip + "get_result", actions + "GripperCommand_GetResult", id_bytes(7), 10);
  std::int8_t status = -1;
  double position = 0, effort = 0;
  bool stalled = true, reached = false;
  if (!reply.empty())
    read(reply, [&](Cdr& cdr) { cdr >> status >> position >> effort >> stalled >> reached; });
  expect(status == 4 && reached && !stalled && std::abs(position - 0.015) < 2e-3,
         "and opens to 15 mm");
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  if (argc != 2) return 2;
  Client client(std::atoi(argv[1]));
  check_services(client);
  check_entities(client);
  check_actions(client);
  return failures ? 1 : 0;
}
