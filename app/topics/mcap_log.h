#pragma once

#include <filesystem>

#include "app/report/run_watcher.h"
#include "app/topics/simulation_topics.h"
#include "engine/mcap/writer.h"

namespace pedicel::app {

/// Topics as an MCAP file (profile ros2). A topic that is added again is the same one.
class McapSink : public TopicSink {
 public:
  /// Throws io::WriteError, as all functions here.
  explicit McapSink(const std::filesystem::path& file);
  int add(const Topic& topic) override;
  void write(int topic, double time, std::string_view cdr) override;
  void close() { writer_.close(); }

 private:
  mcap::Writer writer_;
  std::map<std::string, int> topics_;
};

/// What writes all topics of a run to a file, at the scene's log_rate.
MakeWatcher mcap_log(const std::filesystem::path& file);

}  // namespace pedicel::app
