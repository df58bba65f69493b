#include "app/verbs/ros_arguments.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/output_kind.h"
#ifdef PEDICEL_ROS
#include "app/ros/interfaces.h"
#include "app/ros/ros_name.h"
#include "app/ros/ros_server.h"
#endif

namespace pedicel::app {

void add_ros_options(CLI::App& app, RosArguments& a) {
  CLI::Option* ros =
      app.add_flag("--ros", a.ros, "run off screen as a node of ROS 2, until it is stopped");
  app.add_option("--domain", a.domain, "of ROS 2 (default: ROS_DOMAIN_ID, else 0)")
      ->check(CLI::Range(0, 232))
      ->needs(ros);
  app.add_option("--namespace", a.ros_namespace, "of its topics and services: /arm")->needs(ros);
  app.add_option(
         "--ros-interface", a.interface,
         "name or address of the network interface that ROS 2 uses, or any (default: this machine "
         "only)")
      ->needs(ros);
  app.add_option("--pace", a.pace,
                 "simulated seconds a second with --ros; 0: as fast as it can (default: 1)")
      ->check(CLI::Range(0.0, 1.0e3))
      ->needs(ros);
}

#ifdef PEDICEL_ROS

namespace {

int domain_of(const RosArguments& a) {
  if (a.domain) return *a.domain;
  const char* said = std::getenv("ROS_DOMAIN_ID");
  if (!said || !*said) return 0;
  char* end = nullptr;
  const long domain = std::strtol(said, &end, 10);
  if (*end || domain < 0 || domain >= DdsNode::domains)
    throw UsageError("ROS_DOMAIN_ID is " + in_quotes(said) +
                     ", expected a whole number from 0 to 232");
  return static_cast<int>(domain);
}

}  // namespace

int ros_verb(const RosArguments& a, const RunArguments& run, bool paused) {
  if (run.scene.empty()) throw UsageError("--ros: no scene given, expected one");
  run.refuse({"--out", "--events", "--gltf", "--compare", "--save-state", "--json", "--load-state",
              "--script", "--param-sweep"},
             "is of a run with an end, expected it without --ros");
  if (!run.log.empty() && !run.log.ends_with(".mcap"))
    throw UsageError("--log " + run.log + ": expected a name that ends in .mcap beside --ros");
  if (!is_namespace(a.ros_namespace))
    throw UsageError("--namespace " + a.ros_namespace +
                     ": expected one such as /arm: a slash, then letters, digits and _");
  RosOptions options;
  options.node = {domain_of(a), a.ros_namespace, a.interface};
  if (!a.interface.empty() && a.interface != "any")
    options.node.interface = address_of_interface(a.interface);
  options.simulation = run_options(run).simulation;
  options.pace = a.pace.value_or(1.0);
  options.paused = paused;
  options.log = run.log;
  options.pictures = !run.no_pictures;
  if (!run.log.empty()) io::check_output_file(run.log, io::OutputKind::mcap);
  options.quiet = run.quiet;
  const world::Scene scene = load_scene(run);
  if (run.steps)
    options.duration = static_cast<double>(*run.steps) * scene.dt;
  else if (!run.number("duration").empty())
    options.duration = scene.duration;
  RosServer server(scene, options);
  stop_in_good_order();
  return server.run();
}

#else

int ros_verb(const RosArguments&, const RunArguments&, bool) {
  throw UsageError(
      "--ros: this program was built without ROS 2, expected one built with libfastrtps-dev "
      "installed (PEDICEL_ROS)");
}

#endif

}  // namespace pedicel::app
