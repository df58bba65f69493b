#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"

namespace pedicel::discrepancy {

/// What a log's topics are in an experiment: the manual's page Logs describes the file.
struct LogMap {
  struct Joints {
    std::string topic;                         ///< empty: none
    std::map<std::string, std::string> names;  ///< of the log, to those of the URDF
    SourcePosition where;
  };
  struct Marker {
    std::string name;
    std::string source;              ///< a frame, or a topic of poses or points
    bool is_frame = false;           ///< which of both
    std::string text;                ///< the marker's other keys, as the experiment says them
    std::string link, fruit, curve;  ///< of those; empty: none
    std::string plant;
    SourcePosition where;
  };
  struct Wrench {
    std::string name, topic, link;
    bool tared = false;
    bool reversed = false;  ///< the log has what the carrier exerts
    SourcePosition where;
  };
  struct Trial {
    std::string log;  ///< the file's name; empty: any
    std::string name;
    std::optional<double> from, to;  ///< s of the log's clock; absent: the joints' first and last
    std::string use;                 ///< fit | check; empty: not said
    double clock = 0.0;              ///< s
    std::string text;                ///< further keys of a trial, as the experiment says them
    SourcePosition where;
  };

  std::filesystem::path file;
  std::string text;  ///< of the whole file
  std::string title;
  std::filesystem::path scene;  ///< from the map's folder
  SourcePosition scene_where;
  std::string frame = "world";  ///< the log's frame of what follows
  Pose X_WF;                    ///< of that frame in the scene's world
  bool logged_clock = false;    ///< times are those of the recording, not the stamps
  bool follows_commands = false;
  Joints joints, commands, torques;
  std::vector<Marker> markers;
  std::vector<Wrench> wrenches;
  std::string events;  ///< topic; empty: none
  SourcePosition events_where;
  std::string noise;  ///< as the experiment says it
  std::vector<Trial> trials;
};

/// Reads a map. Faults go to the diagnostics; nothing comes back where there is one.
std::optional<LogMap> read_log_map(const std::filesystem::path& file, Diagnostics& diagnostics);
/// The same from text; `name` stands for the file.
std::optional<LogMap> parse_log_map(const std::string& text, const std::filesystem::path& name,
                                    Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
