#include "app/report/sensor_recorder.h"

#include <algorithm>
#include <cstdio>

#include "app/sense/picture_files.h"
#include "engine/io/atomic_file.h"
#include "plugins/simulation/instrument.h"

namespace pedicel::app {

namespace {

/// Names of the scene as parts of files' names, in their order: "a/b" and "a_b" are two. The first
/// one keeps the plain name.
std::vector<std::string> file_parts(const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (std::string part : names) {
    for (char& c : part)
      if (c == '/' || c == '\\' || c == '.' || c == ' ') c = '_';
    std::string one = part;
    for (int n = 2; std::ranges::count(parts, one) > 0; ++n) one = part + "_" + std::to_string(n);
    parts.push_back(one);
  }
  return parts;
}

}  // namespace

SensorRecorder::SensorRecorder(const simulation::Simulation& simulation, io::OutputFolder& output,
                               PictureTaker* taker)
    : simulation_(simulation), taker_(taker) {
  open_tables(output);
  if (taker_ && taker_->available()) open_cameras(output);
}

SensorRecorder::~SensorRecorder() = default;

void SensorRecorder::open_cameras(io::OutputFolder& output) {
  for (const world::SceneCamera& one : simulation_.scene().cameras)
    if (!one.sensors.empty()) cameras_.push_back({&one, {}, 0});
  if (cameras_.empty()) return;
  const std::filesystem::path folder = output.file("sensors/");
  sensors_ = std::make_unique<SceneSensors>(simulation_);
  io::write_file_atomically(folder / "things.json", things_json(sensors_->things()).dump(1) + "\n");
  std::vector<std::string> names;
  for (const world::SceneCamera& one : simulation_.scene().cameras) names.push_back(one.name);
  const std::vector<std::string> parts = file_parts(names);
  for (Camera& camera : cameras_)
    camera.folder =
        folder / parts[static_cast<std::size_t>(camera.scene - simulation_.scene().cameras.data())];
}

void SensorRecorder::open_tables(io::OutputFolder& output) {
  for (const world::InstrumentKind& kind : world::instrument_kinds()) {
    std::vector<std::string> columns = {"time"}, names;
    for (const world::InstrumentVector& one : kind.vectors)
      columns.insert(columns.end(), one.columns.begin(), one.columns.end());
    std::vector<const simulation::Instrument*> own;
    for (const auto& one : simulation_.instruments())
      if (&one->kind() == &kind) own.push_back(one.get()), names.push_back(one->scene().name);
    const std::vector<std::string> parts = file_parts(names);
    for (std::size_t i = 0; i < own.size(); ++i)
      tables_.push_back({own[i], std::make_unique<io::CsvWriter>(
                                     output.file(kind.name + "_" + parts[i] + ".csv"), columns)});
  }
}

void SensorRecorder::record() {
  std::vector<double> row;
  for (const Table& table : tables_) {
    for (const auto& [time, value] : table.instrument->new_samples()) {
      row = {time};
      row.insert(row.end(), value.begin(), value.end());
      table.file->row(row);
    }
    if (!table.instrument->new_samples().empty()) table.file->flush();
  }
  if (!sensors_) return;
  sensors_->remember();
  const double time = simulation_.world().time();
  for (Camera& camera : cameras_)
    if (time >= static_cast<double>(camera.taken) / camera.scene->rate - 1.0e-9) take(camera);
}

void SensorRecorder::take(Camera& camera) {
  const auto& wanted = camera.scene->sensors;
  const auto wants = [&](world::Sensor one) { return std::ranges::count(wanted, one) > 0; };
  SenseRequest request{camera.scene->name, {}, true, true};
  request.colours = wants(world::Sensor::rgb) || wants(world::Sensor::points);
  const auto picture =
      sensors_->take(*taker_, request, static_cast<std::uint64_t>(simulation_.scene().seed));
  char name[32];
  std::snprintf(name, sizeof name, "%06ld", camera.taken);
  if (picture) write_sensors(camera.folder, name, *picture, sensors_->things(), wanted);
  ++camera.taken;
}

}  // namespace pedicel::app
