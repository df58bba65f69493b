#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/pictures.h"
#include "engine/robot/description.h"
#include "engine/ros_messages/marker_messages.h"
#include "plugins/discrepancy/log_import/log_contents.h"

namespace pedicel::app {

/// Whether a file is a log that can be played (MCAP).
bool is_playable(const std::string& file);

/// A log as a picture at any of its times.
class LogFilm {
 public:
  /// Bytes of markers that are kept.
  static constexpr std::size_t most_markers = std::size_t{2} << 30;

  /// `packages`: "NAME=PATH", for the robot's meshes. Throws InvalidFile where the file is no log,
  /// or nothing in it can be shown.
  LogFilm(const std::filesystem::path& file, const std::vector<std::string>& packages);

  double begin() const { return begin_; }  ///< s, the first stamp of what is shown
  double end() const { return end_; }      ///< s, the last
  /// What a person should know: a robot without meshes, a log that was cut off.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Adds what is there at a time (s) to an empty list.
  void fill(double time, render::DrawList& list) const;
  /// The place of a frame of /tf in the world then (m); nothing where there is none.
  std::optional<Vec3> place_of(const std::string& frame, double time) const;
  /// What happened last up to a time: "t = 2.310 s: truss/fruit_1 detached"; empty: nothing.
  std::string event_at(double time) const;

 private:
  struct Marked {
    double time = 0.0;
    std::string cdr;
  };
  void read_markers();
  void read_robot(const std::vector<std::string>& packages);
  void find_times();

  std::filesystem::path file_;
  discrepancy::LogContents log_;
  std::map<std::string, std::vector<Marked>> markers_;  // by topic, in the order of time
  std::filesystem::path urdf_;                          // as the log says
  std::optional<robot::RobotDescription> robot_;
  std::vector<render::DrawList> shapes_;  // of its links
  double begin_ = 0.0, end_ = 0.0;
  std::vector<std::string> notes_;
};

}  // namespace pedicel::app
