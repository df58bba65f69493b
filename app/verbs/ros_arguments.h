#pragma once

#include <optional>
#include <string>

#include "app/verbs/run_arguments.h"

namespace pedicel::app {

/// What the command line says of a run that is a node of ROS 2.
struct RosArguments {
  bool ros = false;
  std::optional<int> domain;
  std::optional<double> pace;
  std::string ros_namespace, interface;
};

void add_ros_options(CLI::App& app, RosArguments& a);

/// `pedicel SCENE --ros`: until it is stopped, or for the duration that was asked for. Returns the
/// exit code. Throws UsageError (also where the program was built without ROS 2), InvalidFile,
/// io::WriteError.
int ros_verb(const RosArguments& a, const RunArguments& run, bool paused);

}  // namespace pedicel::app
