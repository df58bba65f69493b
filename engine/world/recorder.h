#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/io/csv.h"
#include "engine/world/step.h"

namespace pedicel::world {

/// Something that happened at a time: an organ that came off.
struct Event {
  double time = 0.0;     ///< s
  std::string organ;     ///< "truss/fruit_3"
  std::string cause;     ///< stretch | bend | force | moment | torsion
  double stretch = 0.0;  ///< 1
  double bend = 0.0;     ///< rad
  double force = 0.0;    ///< N
  double moment = 0.0;   ///< N m
  double torsion = 0.0;  ///< N m
  double angle = 0.0;    ///< rad, of the stalk to the vertical
  Pose tool;             ///< X_W of the gripper, NaN where there is none
};

/// Writes log.csv (time_s first, then every channel) at a fixed rate and events.csv as things
/// happen, each line flushed, so that a run that is killed leaves what was recorded until then.
/// Rows are kept in memory, too, for reports.
class Recorder : public Observer {
 public:
  /// `rate` in Hz of simulated time. An empty folder keeps the record in memory only.
  Recorder(std::filesystem::path folder, double rate);

  /// A column; its name ends with its unit ("tool_z_m"). Before open() only.
  void add_channel(std::string name, std::function<double()> read);
  /// Opens the files and writes their headers. Throws io::WriteError.
  void open();

  void observe(const SimWorld& world, const WorldReport& report) override;
  void add_event(const Event& event);

  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  const std::vector<Event>& events() const { return events_; }
  /// The values of a column, empty where there is none of that name.
  std::vector<double> values(const std::string& column) const;

 private:
  std::filesystem::path folder_;
  double rate_;
  long last_due_ = -1;
  std::vector<std::string> columns_ = {"time_s"};
  std::vector<std::function<double()>> channels_;
  std::vector<std::vector<double>> rows_;
  std::vector<Event> events_;
  std::unique_ptr<io::CsvWriter> log_, event_log_;
};

}  // namespace pedicel::world
