#include "pedicel/app/report/sensor_recorder.h"

#include <algorithm>
#include <cstdio>

#include "pedicel/app/run/wrench_sensor.h"
#include "pedicel/app/sense/picture_files.h"
#include "pedicel/io/atomic_file.h"

namespace pedicel::app {

namespace {

/// A name of the scene as part of a file's name.
std::string file_part(const std::string& name) {
  std::string part = name;
  for (char& c : part)
    if (c == '/' || c == '\\' || c == '.' || c == ' ') c = '_';
  return part;
}

}  // namespace

SensorRecorder::SensorRecorder(const Simulation& simulation, io::OutputFolder& output,
                               PictureTaker* taker)
    : simulation_(simulation), taker_(taker) {
  open_wrenches(output);
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
  for (Camera& camera : cameras_) camera.folder = folder / file_part(camera.scene->name);
}

void SensorRecorder::open_wrenches(io::OutputFolder& output) {
  for (const WrenchSensor& one : simulation_.wrenches()) {
    tables_.push_back(std::make_unique<io::CsvWriter>(
        output.file("wrench_" + file_part(one.scene().name) + ".csv"),
        std::vector<std::string>{"time", "fx", "fy", "fz", "tx", "ty", "tz"}));
    written_.push_back(0);
  }
}

void SensorRecorder::record() {
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const WrenchSensor& sensor = simulation_.wrenches()[i];
    if (sensor.samples() == written_[i]) continue;
    written_[i] = sensor.samples();
    const Wrench& now = sensor.reading();
    const double row[] = {sensor.reading_time(), now[0], now[1], now[2], now[3], now[4], now[5]};
    tables_[i]->row(row);
    tables_[i]->flush();
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
