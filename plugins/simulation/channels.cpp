#include "plugins/simulation/channels.h"

#include <algorithm>
#include <array>
#include <memory>
#include <sstream>

#include "plugins/simulation/instrument.h"
#include "plugins/simulation/plants/organ_contacts.h"
#include "plugins/simulation/quantities.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

namespace {

using Channels = std::vector<Channel>;

constexpr int most_organs = 60;

/// "*_stretch_1 *_bend_rad" of a row's name.
std::vector<std::string> columns_of(std::string_view log, const std::string& name) {
  std::vector<std::string> columns;
  std::istringstream words{std::string(log)};
  for (std::string word; words >> word;) {
    const std::size_t star = word.find('*');
    columns.push_back(star == word.npos ? word : word.replace(star, 1, name));
  }
  return columns;
}

bool slides(const Row& row) {
  const RobotControl& robot = *row.simulation.robot();
  const int joint = robot.description().joint(row.layout.of(Rows::joint)[row.index]);
  return robot.description().joints[joint].type == robot::JointType::prismatic;
}

// Row by row. `layout` is kept with what reads it.
void add_rows(Channels& all, const Simulation& simulation,
              const std::shared_ptr<const RowLayout>& layout, Rows kind) {
  each_row(simulation, *layout, kind, [&](const Row& row, int number) {
    for (const Quantity& one : quantities()) {
      if (one.rows != kind || (one.of_robot && !simulation.robot())) continue;
      std::vector<std::string> columns = columns_of(one.log, layout->of(kind)[number]);
      if (kind == Rows::joint && !columns.empty()) columns = {columns[slides(row) ? 1 : 0]};
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i] != "-")
          all.push_back({columns[i], [layout, row, &one, i] {
                           std::array<double, 7> numbers{};
                           one.read(row, numbers.data());
                           return numbers[i];
                         }});
    }
  });
}

void add_strings(Channels& all, const Simulation& simulation) {
  for (const SceneTies::One& tie : simulation.ties().all())
    all.push_back(
        {tie.name + "_N", [&simulation, &tie] { return simulation.ties().tension(tie); }});
  if (simulation.assets()->coupling.plant_contact)
    all.push_back({"contact_between_plants_N", [&simulation] {
                     double sum = 0.0;
                     for (const OrganContact& one : organ_contacts(simulation.rods()))
                       sum += one.normal;
                     return sum;
                   }});
}

void add_instruments(Channels& all, const Simulation& simulation) {
  for (const auto& one : simulation.instruments())
    for (std::size_t i = 0; i < 3 * one->kind().vectors.size(); ++i) {
      const world::InstrumentVector& vector = one->kind().vectors[i / 3];
      std::string unit = vector.unit;
      std::erase(unit, ' ');
      all.push_back(
          {one->kind().name + "_" + one->scene().name + "_" + vector.columns[i % 3] + "_" + unit,
           [&one, i] { return one->reading()[static_cast<long>(i)]; }});
    }
}

}  // namespace

std::vector<Channel> channels_of(const Simulation& simulation) {
  Channels all;
  const auto layout = std::make_shared<const RowLayout>(simulation);
  add_rows(all, simulation, layout, Rows::joint);
  add_rows(all, simulation, layout, Rows::one);
  add_strings(all, simulation);
  add_rows(all, simulation, layout, Rows::fruit);
  add_rows(all, simulation, layout, Rows::touching);
  if (layout->rows(Rows::organ) <= most_organs) add_rows(all, simulation, layout, Rows::organ);
  add_instruments(all, simulation);
  return all;
}

void add_channels(world::Recorder& recorder, const Simulation& simulation) {
  for (Channel& channel : channels_of(simulation))
    recorder.add_channel(std::move(channel.name), std::move(channel.read));
}

world::Event to_event(const Detached& detached) {
  const cosserat::DetachEvent& e = detached.event;
  return {e.time,  detached.fruit, e.cause,   e.stretch, e.bend,
          e.force, e.moment,       e.torsion, e.angle,   detached.tool};
}

std::vector<world::Event> events_of(const Simulation& simulation) {
  std::vector<world::Event> events;
  for (const Detached& one : simulation.plant_step().detached()) events.push_back(to_event(one));
  const auto& cuts = simulation.cutting().events();
  events.insert(events.end(), cuts.begin(), cuts.end());
  std::ranges::stable_sort(events, {}, &world::Event::time);
  return events;
}

}  // namespace pedicel::simulation
