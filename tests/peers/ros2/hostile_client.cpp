// Sends a node all that it should refuse: bytes that are no messages to every topic and service
// that it reads, and messages that make no sense. Afterwards the node must answer and go on as
// before. Usage: hostile_client DOMAIN FIFO; ends with 0 where it does. FIFO: a pipe that nobody
// writes to. The last line of standard output is "malformed N": how many messages were no messages.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "tests/peers/ros2/fast_dds.h"

using namespace ros2_client;

namespace {

const std::string services = "simulation_interfaces::srv::dds_::";
const std::string actions = "control_msgs::action::dds_::";
int malformed = 0;

/// No message of any type: too short for a header, other encodings, and what a random source says
/// behind a first byte that no header has.
std::vector<std::string> no_messages() {
  std::vector<std::string> all = {"x", std::string("\0\1\0", 3),
                                  std::string("\0\7\0\0abcdefgh", 12), std::string(1000, '\xff')};
  std::mt19937 random(43);
  for (int i = 0; i < 20; ++i) {
    std::string bytes(1 + random() % 300, '\1');
    for (std::size_t at = 1; at < bytes.size(); ++at) bytes[at] = static_cast<char>(random());
    all.push_back(bytes);
  }
  return all;
}

/// A good header, and then counts that nothing bears out.
std::string empty_promise() {
  return std::string("\0\1\0\0", 4) + std::string(40, '\xff');
}

void send_bytes(Client& client) {
  std::vector<std::pair<std::string, std::string>> readers = {
      {"rt/joint_trajectory", "trajectory_msgs::msg::dds_::JointTrajectory_"}};
  const auto service = [&](const std::string& name, const std::string& type) {
    readers.emplace_back("rq" + name + "Request", type + "_Request_");
  };
  for (const auto& [name, type] : std::vector<std::pair<std::string, std::string>>{
           {"/get_simulator_features", "GetSimulatorFeatures"},
           {"/get_simulation_state", "GetSimulationState"},
           {"/set_simulation_state", "SetSimulationState"},
           {"/step_simulation", "StepSimulation"},
           {"/reset_simulation", "ResetSimulation"},
           {"/get_entities", "GetEntities"},
           {"/get_entity_state", "GetEntityState"},
           {"/get_entities_states", "GetEntitiesStates"},
           {"/spawn_entity", "SpawnEntity"},
           {"/delete_entity", "DeleteEntity"},
           {"/set_entity_state", "SetEntityState"}})
    service(name, services + type);
  for (const auto& [name, type] : std::vector<std::pair<std::string, std::string>>{
           {"/arm_controller/follow_joint_trajectory/_action/", "FollowJointTrajectory"},
           {"/gripper_controller/gripper_cmd/_action/", "GripperCommand"}}) {
    service(name + "send_goal", actions + type + "_SendGoal");
    service(name + "get_result", actions + type + "_GetResult");
    service(name + "cancel_goal", "action_msgs::srv::dds_::CancelGoal");
  }
  const std::vector<std::string> all = no_messages();
  for (const auto& [topic, type] : readers) {
    expect(client.write(topic, type, all), "bytes go to " + topic);
    malformed += static_cast<int>(all.size());
  }
  for (const auto& topic :
       {"rt/joint_trajectory", "rq/get_entitiesRequest", "rq/spawn_entityRequest"})
    for (const auto& [name, type] : readers)
      if (name == topic) {
        expect(client.write(name, type, {empty_promise()}), "empty promises go to " + name);
        ++malformed;
      }
  // Longer than what is taken at all.
  expect(client.write("rt/joint_trajectory", "trajectory_msgs::msg::dds_::JointTrajectory_",
                      {std::string("\0\1\0\0", 4) + std::string(17 << 20, 'x')}),
         "17 MB go");
  ++malformed;
}

std::string trajectory(const std::vector<std::string>& joints, const std::vector<double>& positions,
                       std::int32_t seconds, std::uint32_t nanoseconds, std::int32_t stamp = 0) {
  return bytes_of([&](Cdr& cdr) {
    const std::vector<double> none;
    cdr << stamp << std::uint32_t{0} << std::string() << joints << std::uint32_t{1} << positions
        << none << none << none << seconds << nanoseconds;
  });
}

// Well made, but of nothing that a robot can do.
void send_nonsense(Client& client) {
  const double inf = std::numeric_limits<double>::infinity(), most = 1.7e308;
  const std::vector<std::string> all = {
      trajectory({}, {}, 1, 0),
      trajectory({"joint1"}, {std::nan("")}, 1, 0),
      trajectory({"joint1"}, {inf}, 1, 0),
      trajectory({"joint1"}, {most}, 1, 0),
      trajectory({"joint1"}, {-most}, 0, 1),
      trajectory({"joint1", "joint1"}, {0, 0}, 1, 0),
      trajectory({"joint1"}, {0, 0, 0}, 1, 0),
      trajectory({std::string(100000, 'j')}, {0}, 1, 0),
      trajectory({"\x1b[2J\n"}, {0}, 1, 0),
      trajectory(std::vector<std::string>(10000, "joint1"), std::vector<double>(10000, 0.0), 1, 0)};
  expect(client.write("rt/joint_trajectory", "trajectory_msgs::msg::dds_::JointTrajectory_", all),
         "nonsense goes");
  malformed += static_cast<int>(all.size());
  // These make sense, and lead a joint within its limits and its motor's strength.
  expect(
      client.write("rt/joint_trajectory", "trajectory_msgs::msg::dds_::JointTrajectory_",
                   {trajectory({"joint1"}, {9000.0}, 0, 1), trajectory({"joint1"}, {-9000.0}, 0, 1),
                    trajectory({"joint1"}, {0.1}, 0x7fffffff, 0xffffffffU, 0x7fffffff),
                    trajectory({"joint1"}, {0.1}, -5, 0), trajectory({"joint1"}, {0.1}, 1, 0)}),
      "hasty paths go");
}

int get_entities(Client& client, const std::string& filter) {
  return result_of(client.call("/get_entities", services + "GetEntities", bytes_of([&](Cdr& cdr) {
                                 cdr << filter << std::uint32_t{0} << std::uint32_t{0}
                                     << std::uint8_t{0} << std::uint8_t{0} << std::uint32_t{0};
                               })));
}

void ask_for_too_much(Client& client, const std::string& pipe) {
  std::string nested = "a";
  for (int i = 0; i < 60; ++i) nested = "(" + nested + ")+";
  expect(get_entities(client, nested) == 4, "an expression that takes all memory is refused");
  expect(get_entities(client, "((a{255}){255}){255}") == 4, "and another one");
  expect(get_entities(client, "(.*)(.*)(.*)(.*)(.*)\\5\\4\\3\\2\\1x") == 4,
         "and one that takes all time");
  expect(result_of(client.call("/step_simulation", services + "StepSimulation",
                               bytes_of([](Cdr& cdr) { cdr << ~std::uint64_t{0}; }))) != 1,
         "all steps there are are refused");
  expect(result_of(client.call("/set_simulation_state", services + "SetSimulationState",
                               bytes_of([](Cdr& cdr) { cdr << std::uint8_t{0}; }))) == 1,
         "it is stopped");
  const auto spawn = [&](const std::string& name, const std::string& uri, const std::string& text,
                         double x) {
    return result_of(client.call("/spawn_entity", services + "SpawnEntity", bytes_of([&](Cdr& cdr) {
                                   cdr << name << false << uri << text << std::string();
                                   cdr << std::int32_t{0} << std::uint32_t{0} << std::string() << x
                                       << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 1.0;
                                 })));
  };
  expect(spawn("a", pipe, "", 0) == 106, "a pipe is not waited for");
  expect(spawn("a", "/dev/zero", "", 0) == 106, "nor is a device read");
  expect(spawn("a", "/nowhere", "", 0) == 106, "nor what is not there");
  std::string laughs = "a0: &a0 [x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 0; k < 8; ++k) laughs += ", " + before;
    laughs += "]\n";
  }
  expect(spawn("a", "", laughs, 0) == 106, "aliases that grow are refused");
  expect(spawn("a", "", std::string(100000, '['), 0) == 106, "lists in lists");
  expect(spawn("a", "", "{sphere: {radius: 1e300}, mass: 1e300}", 0) == 106,
         "a ball larger than the world");
  expect(spawn("a", "", "{sphere: {radius: 0.01}, mass: 0.1}", std::nan("")) == 109,
         "a place that is none");
  expect(
      spawn("a", "",
            "format: pedicel-plant\nversion: 1\nname: b\nsampling: {distance: 1.0e-9}\n"
            "root: [0, 0, 0]\ncurves:\n  - {name: stem, interpolation: linear, points: [[0, 0, 0], "
            "[0, 0, 0.6]], radius: 0.004}\n",
            0) != 1,
      "a plant of a billion elements");
  expect(get_entities(client, ".*") == 1, "it still answers");
  expect(result_of(client.call("/set_simulation_state", services + "SetSimulationState",
                               bytes_of([](Cdr& cdr) { cdr << std::uint8_t{1}; }))) == 1,
         "it plays again");
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  if (argc != 3) return 2;
  Client client(std::atoi(argv[1]));
  send_bytes(client);
  send_nonsense(client);
  ask_for_too_much(client, argv[2]);
  std::printf("malformed %d\n", malformed);
  return failures ? 1 : 0;
}
