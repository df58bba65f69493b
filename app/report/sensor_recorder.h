#pragma once

#include <memory>
#include <vector>

#include "app/sense/scene_sensors.h"
#include "engine/io/csv.h"
#include "engine/io/output_folder.h"

namespace pedicel::app {

/// Writes what the sensors of a scene say while it runs: for every camera with `sensors` the files
/// sensors/CAMERA/000000.rgb.png and so on, sensors/things.json, and for every instrument
/// KIND_NAME.csv.
class SensorRecorder {
 public:
  /// All must outlive it. `taker` may be null, or take no pictures: then there are none.
  SensorRecorder(const simulation::Simulation& simulation, io::OutputFolder& output,
                 PictureTaker* taker);
  ~SensorRecorder();

  /// What is due now: to be called at the start, and after every step.
  void record();

 private:
  struct Camera {
    const world::SceneCamera* scene = nullptr;
    std::filesystem::path folder;
    long taken = 0;
  };
  struct Table {
    const simulation::Instrument* instrument = nullptr;
    std::unique_ptr<io::CsvWriter> file;
  };
  void open_cameras(io::OutputFolder& output);
  void open_tables(io::OutputFolder& output);
  void take(Camera& camera);

  const simulation::Simulation& simulation_;
  PictureTaker* taker_;
  std::unique_ptr<SceneSensors> sensors_;
  std::vector<Camera> cameras_;
  std::vector<Table> tables_;
};

}  // namespace pedicel::app
