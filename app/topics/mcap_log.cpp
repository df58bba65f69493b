#include "app/topics/mcap_log.h"

#include <algorithm>

#include "app/report/version.h"

namespace pedicel::app {

namespace {

/// Quality of service as `ros2 bag` keeps it, so that what plays the file sends as we would.
std::string qos_text(Delivery delivery) {
  const bool latched = delivery == Delivery::latched;
  return std::string("- history: 1\n  depth: ") + (latched ? "1" : "10") +
         "\n  reliability: " + (delivery == Delivery::sensor ? "2" : "1") +
         "\n  durability: " + (latched ? "1" : "2") +
         "\n  deadline:\n    sec: 9223372036\n    nsec: 854775807\n  lifespan:\n    sec: "
         "9223372036\n    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n    "
         "sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false";
}

class McapWatcher : public RunWatcher {
 public:
  McapWatcher(simulation::Simulation& simulation, PictureTaker* taker,
              const std::filesystem::path& file)
      : sink_(file), topics_(simulation, sink_, rates_of_log(simulation), taker) {}
  void begin() override { topics_.begin(); }
  void after_step() override { topics_.after_step(); }
  void end() override { sink_.close(); }

 private:
  McapSink sink_;
  SimulationTopics topics_;
};

}  // namespace

McapSink::McapSink(const std::filesystem::path& file)
    : writer_(file, {.library = "pedicel " + version()}) {}

int McapSink::add(const Topic& topic) {
  const auto known = topics_.find(topic.name);
  if (known != topics_.end()) return known->second;
  std::map<std::string, std::string> metadata = topic.metadata;
  metadata["offered_qos_profiles"] = qos_text(topic.delivery);
  return topics_[topic.name] = writer_.add_channel(
             topic.name,
             {topic.definitions.front().name, "ros2msg", ros::schema_text(topic.definitions)},
             "cdr", std::move(metadata));
}

void McapSink::write(int topic, double time, std::string_view cdr) {
  writer_.write(static_cast<std::uint16_t>(topic),
                static_cast<std::uint64_t>(std::max<std::int64_t>(0, ros::nanoseconds_of(time))),
                cdr);
}

MakeWatcher mcap_log(const std::filesystem::path& file) {
  return [file](simulation::Simulation& simulation, PictureTaker* taker) {
    return std::make_unique<McapWatcher>(simulation, taker, file);
  };
}

}  // namespace pedicel::app
