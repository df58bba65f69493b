#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/world/recorder.h"

namespace pedicel::simulation {

class Simulation;
struct Detached;

/// A quantity of a simulation as it stands; its name ends with its unit ("tool_z_m").
struct Channel {
  std::string name;
  std::function<double()> read;
};
/// Every column of log.csv. The simulation must outlive them.
std::vector<Channel> channels_of(const Simulation& simulation);

/// Adds the columns of log.csv: robot joints and torques, tool, contact force per link, organ and
/// fruit, strain of every fruit's stalk against its thresholds, energies, instruments. Organs are
/// left out where there are more than 60 of them (a forest), then each plant has one column.
void add_channels(world::Recorder& recorder, const Simulation& simulation);

/// The record of a fruit that came off, as events.csv has it.
world::Event to_event(const Detached& detached);
/// What came off a scene's plants so far: fruits, and stems that were cut, by time.
std::vector<world::Event> events_of(const Simulation& simulation);

}  // namespace pedicel::simulation
