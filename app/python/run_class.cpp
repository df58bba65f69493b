#include "app/python/run_class.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "app/python/scenes.h"
#include "app/session/document/document_parameters.h"
#include "app/steer/tool_reach.h"
#include "app/steer/visibility.h"
#include "engine/core/check.h"
#include "plugins/simulation/channels.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

using RunClass = py::class_<Run>;

/// Numbers a joint, or a map of joint names to numbers: the others stay as they are.
std::vector<double> joint_numbers(Run& self, const py::object& values) {
  self.alone([](app::SteeredRun& one) { app::robot_of(one.simulation()); });
  const std::vector<std::string>& names = self.state().layout().of(app::Rows::joint);
  const std::size_t joints = names.size();
  if (!py::isinstance<py::dict>(values))
    return numbers_of(values.cast<Numbers>(), joints, "joints");
  std::vector<double> numbers(joints, std::numeric_limits<double>::quiet_NaN());
  for (const auto& [name, value] : values.cast<py::dict>()) {
    const auto joint = std::ranges::find(names, name.cast<std::string>());
    if (joint == names.end())
      throw UsageError("no joint " + in_quotes(name.cast<std::string>()) +
                       ", expected one of: " + simulation::list_of(names));
    numbers[static_cast<std::size_t>(joint - names.begin())] = value.cast<double>();
  }
  return numbers;
}

void add_run_state(RunClass& run) {
  const auto all = simulation::quantities();
  for (std::size_t q = 0; q < all.size(); ++q) {
    if (all[q].name.empty()) continue;
    const std::string name(all[q].name), words = words_of(all[q], false);
    run.def_property_readonly(
        name.c_str(),
        [q](const py::object& self) {
          Run& one = self.cast<Run&>();
          if (one.state().want(q)) one.alone([&](app::SteeredRun&) { one.fill_all(); });
          return world_view(one.state(), q, one.world(), self);
        },
        words.c_str());
  }
  for (int kind = 1; kind < simulation::row_kinds; ++kind) {
    const auto rows = static_cast<app::Rows>(kind);
    const std::string one(name_of(rows));
    const std::string name = (rows == app::Rows::body       ? "body"
                              : rows == app::Rows::touching ? one
                                                            : one.substr(0, one.size() - 1)) +
                             "_names";
    const std::string words = "Names of the rows of arrays whose rows are " + one + ".";
    run.def_property_readonly(
        name.c_str(), [rows](Run& self) { return self.state().layout().of(rows); }, words.c_str());
  }
  run.def_property_readonly(
      "segment_organs",
      [](Run& self) { return py::array(py::cast(self.state().layout().segment_organ)); },
      "(segments,): index into organ_names.");
  run.def_property_readonly(
      "segment_parents",
      [](Run& self) { return py::array(py::cast(self.state().layout().segment_parent)); },
      "(segments,): index of the segment that each one starts from; -1: clamped.");
}

void add_robot(RunClass& run) {
  const auto targets = [&](const char* name, app::Act::Kind kind, const char* words) {
    run.def(
        name,
        [kind](Run& self, const py::object& values) {
          self.act({0, kind, "", joint_numbers(self, values)});
        },
        "values"_a, words);
  };
  targets("set_joint_positions", app::Act::Kind::position,
          "Targets of the joints' motors, rad or m: an array (joints,), or a dict of names. The "
          "scene's program ends with the first target. A target stays until the next one.");
  targets("set_joint_velocities", app::Act::Kind::velocity,
          "Likewise: speeds that the motors hold, rad/s or m/s.");
  targets("set_joint_torques", app::Act::Kind::torque,
          "Likewise: what the motors apply, N m or N, within their effort.");
  run.def(
      "go_to",
      [](Run& self, const py::object& values) {
        std::vector<double> numbers = joint_numbers(self, values);
        const Eigen::VectorXd goal =
            self.alone([](app::SteeredRun& one) { return app::robot_of(one.simulation()).goal(); });
        for (std::size_t i = 0; i < numbers.size(); ++i)
          if (std::isnan(numbers[i])) numbers[i] = goal[static_cast<Eigen::Index>(i)];
        self.act({0, app::Act::Kind::go_to, "", std::move(numbers)});
      },
      "values"_a,
      "Moves all joints evenly to positions (rad or m), at 1 rad/s or 0.25 m/s at most.");
  run.def(
      "reach",
      [](Run& self, const Numbers& position, const std::optional<Numbers>& orientation) {
        const Vec3 p = vec3_of(position, "position");
        std::optional<Quat> q;
        if (orientation) q = quat_of(*orientation, "orientation");
        return self.alone([&](app::SteeredRun& one) {
          const simulation::RobotControl& robot = app::robot_of(one.simulation());
          return app::reach_tool(one.simulation(), p, q, robot.robot().positions());
        });
      },
      "position"_a, "orientation"_a = py::none(),
      "Inverse kinematics: joint positions that bring the tool to a place (m, world), with an "
      "orientation (x y z w) where one is given. Returns a Reach; moves nothing.");
  run.def(
      "tool_jacobian",
      [](Run& self) {
        using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;
        const Jacobian j = self.alone([](app::SteeredRun& one) -> Jacobian {
          const simulation::RobotControl& robot = app::robot_of(one.simulation());
          return robot.robot().model().jacobian(robot.robot().positions(), robot.tool_link(),
                                                one.simulation().scene().robot->tool_offset);
        });
        return py::array_t<double>(
            {static_cast<py::ssize_t>(6), static_cast<py::ssize_t>(j.cols())}, j.data());
      },
      "(6, joints): velocity (m/s) and angular velocity (rad/s) of the tool in the world for each "
      "joint's speed.");
  const auto limits = [&](const char* name, auto read, const char* words) {
    run.def_property_readonly(
        name,
        [read](Run& self) {
          return array_of(self.alone([&](app::SteeredRun& one) -> Eigen::VectorXd {
            return read(app::robot_of(one.simulation()).robot().model());
          }));
        },
        words);
  };
  using Model = robot::KinematicModel;
  limits(
      "joint_lower", [](const Model& m) { return m.lower(); },
      "(joints,), rad or m: lower limits; -inf: none.");
  limits(
      "joint_upper", [](const Model& m) { return m.upper(); },
      "(joints,), rad or m: upper limits; inf: none.");
  limits(
      "joint_speeds", [](const Model& m) { return m.velocity_limits(); },
      "(joints,), rad/s or m/s: what the robot's file allows.");
  limits(
      "joint_efforts", [](const Model& m) { return m.effort_limits(); },
      "(joints,), N m or N: what the robot's file allows.");
  run.def_property_readonly(
      "gripper_joint",
      [](Run& self) {
        return self.alone(
            [](app::SteeredRun& one) { return app::robot_of(one.simulation()).gripper(); });
      },
      "Index of the joint that the scene calls the gripper; -1: none.");
}

void add_forces(RunClass& run) {
  run.def(
      "set_force",
      [](Run& self, const std::string& organ, const Numbers& force, double at,
         const Numbers& moment) {
        const Vec3 f = vec3_of(force, "force"), m = vec3_of(moment, "moment");
        self.act({0, app::Act::Kind::force, organ, {at, f[0], f[1], f[2], m[0], m[1], m[2]}});
      },
      "organ"_a, "force"_a, "at"_a = 1.0, "moment"_a = py::make_tuple(0.0, 0.0, 0.0),
      "A force (N) and a moment (N m) in the world on \"PLANT/FRUIT\" (its centre) or "
      "\"PLANT/STEM\" "
      "(a fraction `at` of its length from its foot). It acts until it is changed, also on a fruit "
      "that came off.");
  run.def(
      "clear_forces",
      [](Run& self) {
        self.act({0, app::Act::Kind::no_forces, "", {}});
      },
      "Takes all forces of set_force() away.");
  run.def(
      "push",
      [](Run& self, const std::string& body, const Numbers& force, const Numbers& point) {
        const Vec3 f = vec3_of(force, "force"), p = vec3_of(point, "point");
        self.act({0, app::Act::Kind::push, body, {f[0], f[1], f[2], p[0], p[1], p[2]}});
      },
      "body"_a, "force"_a, "point"_a,
      "A force (N) on a body at a point (m), both in the world, for the next step.");
  run.def(
      "cut",
      [](Run& self, const std::string& organ, double at) {
        self.act({0, app::Act::Kind::cut, organ, {at}});
      },
      "organ"_a, "at"_a = 0.0,
      "Cuts \"PLANT/STEM\" at a fraction `at` of its length from its foot, or the stalk of "
      "\"PLANT/FRUIT\". What it carried falls as one body, \"ORGAN_cut\".");
}

std::vector<world::Event> events_of(Run& self) {
  return self.alone([](app::SteeredRun& one) { return simulation::events_of(one.simulation()); });
}

py::dict quantities_of(Run& self) {
  const auto read = self.alone([](app::SteeredRun& one) {
    std::vector<std::pair<std::string, double>> all;
    for (const simulation::Channel& channel : simulation::channels_of(one.simulation()))
      all.emplace_back(channel.name, channel.read());
    return all;
  });
  py::dict all;
  for (const auto& [name, value] : read) all[name.c_str()] = value;
  return all;
}

py::dict parameters_of(Run& self) {
  const auto described = self.alone([](app::SteeredRun& one) {
    return app::document_parameters(one.constants().document, one.constants().files);
  });
  py::dict all;
  for (const app::SessionParameter& one : described) all[one.key.c_str()] = one;
  return all;
}

void add_rest(RunClass& run) {
  run.def("step", &Run::step, "count"_a = 1,
          "So many steps of dt. Other threads of Python go on meanwhile. Raises Unstable where the "
          "run can go no further.");
  run.def(
      "reset", &Run::reset, "seed"_a = py::none(), "settings"_a = py::dict(),
      "To time 0 of the scene, with its own program and constants, and with more settings (keys "
      "of `--set`) until the next reset. The steps draw no random numbers: the same acts give "
      "the same bits with any seed. `seed` is kept for what draws some, as noise and variation "
      "do.");
  run.def_property(
      "seed", [](Run& self) { return self.sensed().seed; },
      [](Run& self, long seed) { self.sensed().seed = checked_seed(seed); },
      "Of everything random: a whole number from 0 on.");
  run.def(
      "save",
      [](Run& self) {
        const std::string text =
            self.alone([](app::SteeredRun& one) { return to_text(one.save()); });
        return py::bytes(text);
      },
      "The state as bytes: everything that was done since the start, and the hash that proves it.");
  run.def(
      "restore",
      [](Run& self, const std::string& saved) {
        self.alone([&](app::SteeredRun& one) {
          one.restore(app::saved_run_of_text(saved));
          self.fill();
        });
      },
      "saved"_a,
      "Goes to a saved state of the same scene, to the same bits. Steps that lead there are done "
      "again, so it takes their time.");
  run.def(
      "set",
      [](Run& self, const std::string& key, const py::object& value) {
        self.act({0, app::Act::Kind::set, key + "=" + setting_text(value), {}});
      },
      "key"_a, "value"_a,
      "Changes a constant while it runs (a key of `--set`): moduli, density, damping, thresholds, "
      "solver, friction. What is set up once raises UsageError.");
  run.def_property_readonly("parameters", parameters_of,
                            "Described numbers by key: Parameter with value, unit and bounds.");
  run.def("quantities", quantities_of,
          "Every column of log.csv as it stands now, by name with its unit.");
  run.def_property_readonly("events", events_of,
                            "Fruits that came off and stems that were cut, in their order.");
  run.def("render", &Run::render, "camera"_a = "", "width"_a = 640, "height"_a = 480,
          "strain"_a = false, "text"_a = false,
          "A picture, (height, width, 3) uint8, off screen: by a camera of the scene (empty: the "
          "first, or one that shows everything). `strain`: stems in the colour of their strain. "
          "Raises NoPictures where there is no OpenGL.");
  run.def(
      "visible_share",
      [](Run& self, const std::string& fruit, const py::object& from) {
        std::optional<Vec3> eye;
        if (!py::isinstance<py::str>(from)) eye = vec3_of(from.cast<Numbers>(), "camera");
        const std::string camera = eye ? "" : from.cast<std::string>();
        return self.alone([&](app::SteeredRun& one) {
          const Vec3 place = eye ? *eye : app::camera_place(one.simulation(), camera);
          return app::visible_share(one.simulation(), fruit, place);
        });
      },
      "fruit"_a, "camera"_a = "",
      "Share of a fruit's disc, 0 to 1, that nothing stands before, seen from a camera of the "
      "scene "
      "(empty: the first) or from a place (m, world). By geometry, without a picture.");
  const auto reads = [&](const char* name, auto read, const char* words) {
    run.def_property_readonly(
        name, [read](Run& self) { return self.alone(read); }, words);
  };
  using One = app::SteeredRun&;
  reads(
      "time", [](One one) { return one.simulation().world().time(); }, "Simulated time, s.");
  reads(
      "steps", [](One one) { return one.steps(); }, "Steps since the start.");
  reads(
      "dt", [](One one) { return one.simulation().world().dt(); }, "s, of a step.");
  reads(
      "duration", [](One one) { return one.simulation().scene().duration; },
      "s, that the scene runs for; step() goes beyond it.");
  reads(
      "state_hash",
      [](One one) {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx",
                      static_cast<unsigned long long>(one.simulation().state_hash()));
        return std::string(text);
      },
      "Of the whole state, bit by bit: that of a run off screen with the same steps.");
  reads(
      "notes", [](One one) { return one.simulation().notes(); },
      "What is worth knowing of the scene and stops nothing, one sentence each.");
  reads(
      "camera_names",
      [](One one) {
        std::vector<std::string> names;
        for (const world::SceneCamera& camera : one.simulation().scene().cameras)
          names.push_back(camera.name);
        return names;
      },
      "Cameras of the scene.");
}

}  // namespace

void add_run_class(py::module_& module) {
  RunClass run(
      module, "Run",
      "A run that is led from Python: a Simulation, or one of several Worlds.\n\n"
      "Arrays are views of buffers that are written at the end of step(), reset() and "
      "restore(). They cannot be written, and keep the run alive. Units are SI; rows are in "
      "the order of segment_names, fruit_names, organ_names, joint_names, link_names, "
      "body_names and touching_names.");
  add_run_state(run);
  add_robot(run);
  add_forces(run);
  add_cameras(run);
  add_rest(run);
}

}  // namespace pedicel::python
