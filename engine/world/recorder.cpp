#include "engine/world/recorder.h"

#include <cmath>

#include "engine/core/check.h"
#include "engine/world/sim_world.h"

namespace pedicel::world {

namespace {

const std::vector<std::string> event_columns = {
    "time_s",     "organ",       "cause",     "stretch_1", "bend_rad", "force_N",
    "moment_N_m", "torsion_N_m", "angle_rad", "tool_x_m",  "tool_y_m", "tool_z_m",
    "tool_qx_1",  "tool_qy_1",   "tool_qz_1", "tool_qw_1"};

std::vector<std::string> cells_of(const Event& e) {
  std::vector<std::string> cells = {io::format_number(e.time), e.organ, e.cause};
  for (double value : {e.stretch, e.bend, e.force, e.moment, e.torsion, e.angle})
    cells.push_back(io::format_number(value));
  for (int i = 0; i < 3; ++i) cells.push_back(io::format_number(e.tool.position[i]));
  for (int i = 0; i < 4; ++i) cells.push_back(io::format_number(e.tool.rotation.coeffs()[i]));
  return cells;
}

}  // namespace

Recorder::Recorder(std::filesystem::path folder, double rate)
    : folder_(std::move(folder)), rate_(rate) {
  if (!(rate > 0.0)) throw UsageError("Recorder.rate: must be > 0 Hz");
}

void Recorder::add_channel(std::string name, std::function<double()> read) {
  if (!rows_.empty() || log_) throw UsageError("Recorder: channels are added before open()");
  columns_.push_back(std::move(name));
  channels_.push_back(std::move(read));
}

void Recorder::open() {
  if (folder_.empty()) return;
  log_ = std::make_unique<io::CsvWriter>(folder_ / "log.csv", columns_);
  event_log_ = std::make_unique<io::CsvWriter>(folder_ / "events.csv", event_columns);
}

void Recorder::observe(const SimWorld& world, const WorldReport& /*report*/) {
  // The small addition keeps a time such as 0.1 from falling short of its own multiple.
  const long due = static_cast<long>(std::floor(world.time() * rate_ + 1e-9));
  if (due == last_due_) return;
  last_due_ = due;
  std::vector<double> row = {world.time()};
  for (const auto& read : channels_) row.push_back(read());
  if (log_) {
    log_->row(row);
    log_->flush();
  }
  rows_.push_back(std::move(row));
}

void Recorder::add_event(const Event& event) {
  events_.push_back(event);
  if (!event_log_) return;
  event_log_->text_row(cells_of(event));
  event_log_->flush();
}

std::vector<double> Recorder::values(const std::string& column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] != column) continue;
    std::vector<double> values;
    for (const auto& row : rows_) values.push_back(row[i]);
    return values;
  }
  return {};
}

}  // namespace pedicel::world
