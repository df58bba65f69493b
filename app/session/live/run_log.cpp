#include "app/session/live/run_log.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/simulation/plants/surface_strain.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

namespace {

/// Nothing where the simulation has no such organ.
std::optional<OrganLoad> load_of(const simulation::Simulation& simulation,
                                 const std::string& organ) {
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const cosserat::RodState& state = simulation.rods().state(p);
    const auto found = std::find(model.organs.begin(), model.organs.end(), organ);
    if (found == model.organs.end()) continue;
    OrganLoad load;
    load.time = simulation.world().time();
    for (int e = 0; e < model.size(); ++e) {
      if (!state.alive[e] || model.elements[e].organ != found - model.organs.begin()) continue;
      const cosserat::JointLoad joint = cosserat::joint_load(model, state, e);
      load.strain = std::max(load.strain, simulation::surface_strain(model, state, e));
      load.force = std::max(load.force, joint.force.norm());
      load.moment = std::max(load.moment, joint.moment.norm());
    }
    return load;
  }
  return std::nullopt;
}

template <class Row>
void push(std::deque<Row>& rows, Row row) {
  rows.push_back(std::move(row));
  if (rows.size() > RunLog::most_rows) rows.pop_front();
}

}  // namespace

void RunLog::begin(const simulation::Simulation& simulation) {
  std::vector<simulation::Channel> channels = simulation::channels_of(simulation);
  const std::lock_guard lock(mutex_);
  channels_ = std::move(channels);
  rows_.clear();
  loads_.clear();
  last_due_ = -1;
}

void RunLog::observe(const simulation::Simulation& simulation) {
  const double time = simulation.world().time();
  const long due = static_cast<long>(std::floor(time * rate + 1.0e-6));
  if (due <= last_due_) return;
  last_due_ = due;
  std::vector<double> row = {time};
  for (const simulation::Channel& channel : channels_) row.push_back(channel.read());
  std::string organ;
  {
    const std::lock_guard lock(mutex_);
    organ = organ_;
  }
  const auto load = organ.empty() ? std::nullopt : load_of(simulation, organ);
  const std::lock_guard lock(mutex_);
  push(rows_, std::move(row));
  if (load) push(loads_, *load);
}

void RunLog::watch(std::string organ) {
  const std::lock_guard lock(mutex_);
  if (organ != organ_) loads_.clear();
  organ_ = std::move(organ);
}

std::vector<std::string> RunLog::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const simulation::Channel& channel : channels_) names.push_back(channel.name);
  return names;
}

RunLog::Series RunLog::series(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  Series series;
  const auto found = std::find_if(channels_.begin(), channels_.end(),
                                  [&](const simulation::Channel& one) { return one.name == name; });
  if (found == channels_.end()) return series;
  const std::size_t column = 1 + static_cast<std::size_t>(found - channels_.begin());
  for (const std::vector<double>& row : rows_) {
    series.time.push_back(row[0]);
    series.value.push_back(row[column]);
  }
  return series;
}

double RunLog::last(const std::string& name) const {
  const Series all = series(name);
  return all.value.empty() ? std::numeric_limits<double>::quiet_NaN() : all.value.back();
}

std::vector<OrganLoad> RunLog::loads() const {
  const std::lock_guard lock(mutex_);
  return {loads_.begin(), loads_.end()};
}

}  // namespace pedicel::app
