#include "app/session/measured/scene_paths.h"

#include <cmath>
#include <limits>

namespace pedicel::app {

namespace {

using discrepancy::Experiment;
using discrepancy::Samples;
using discrepancy::Trial;
using Kind = SceneInstrument::Kind;

constexpr double unseen = std::numeric_limits<double>::quiet_NaN();
// Hz, of shapes in a trial without a table of markers: smooth to look at.
constexpr double picture_rate = 50.0;
constexpr const char* axes[] = {"x", "y", "z"};

/// A trial's tables and a model's readings have the same names.
template <class Tables>
const auto& table_of(const SceneInstrument& instrument, const Tables& tables) {
  const auto i = static_cast<std::size_t>(instrument.index);
  switch (instrument.kind) {
    case Kind::markers:
      return tables.markers;
    case Kind::image:
      return tables.pixels[i];
    case Kind::torques:
      return tables.torques;
    case Kind::encoders:
      return tables.joints;
    default:
      return tables.wrenches[i];
  }
}

std::vector<std::string> with_axes(const std::vector<discrepancy::Marker>& markers, int count) {
  std::vector<std::string> columns;
  for (const discrepancy::Marker& marker : markers)
    for (int a = 0; a < count; ++a) columns.push_back(marker.name + "." + axes[a]);
  return columns;
}

std::vector<std::string> joints_named(const Experiment& experiment, const std::vector<int>& dofs) {
  const std::vector<std::string> all = discrepancy::joint_names(experiment.robot);
  std::vector<std::string> columns;
  for (const int dof : dofs) columns.push_back(all[static_cast<std::size_t>(dof)]);
  return columns;
}

/// A table with further columns that nobody has measured.
void widen(Samples& table, Eigen::Index columns) {
  Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(table.size(), columns, unseen);
  wide.leftCols(table.value.cols()) = table.value;
  table.value = std::move(wide);
}

/// The experiment with the points of its plants as further markers.
Experiment with_shapes(Experiment experiment) {
  const std::vector<ScenePlantShape> shapes = shapes_of(experiment);
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    discrepancy::Marker marker;
    marker.plant = static_cast<int>(p);
    for (const ShapeCurve& curve : shapes[p].curves)
      for (const double at : curve.at) {
        marker.place = {
            experiment.plants[p].file.curves[static_cast<std::size_t>(curve.curve)].name, at, {}};
        experiment.markers.push_back(marker);
      }
    marker.place = {};
    for (std::size_t f = 0; f < shapes[p].fruits.size(); ++f) {
      marker.fruit = static_cast<int>(f);
      experiment.markers.push_back(marker);
    }
  }
  const auto all = static_cast<Eigen::Index>(experiment.markers.size());
  for (Trial& trial : experiment.trials) {
    const double end = trial.duration();
    if (trial.markers.size() == 0) {
      for (int i = 0; i <= std::lround(end * picture_rate); ++i)
        trial.markers.time.push_back(i / picture_rate);
      trial.markers.value.resize(trial.markers.size(), 0);
    }
    widen(trial.markers, 3 * all);
    for (Samples& image : trial.pixels) widen(image, 2 * all);
  }
  return experiment;
}

double rms_of(const SceneInstrument& instrument, const Trial& trial,
              const discrepancy::SceneReadings& readings) {
  const Samples& seen = measured_by(instrument, trial);
  const Eigen::MatrixXd& said = said_by(instrument, readings);
  const auto count = static_cast<Eigen::Index>(instrument.columns.size());
  if (said.rows() != seen.value.rows() || said.cols() < instrument.first + count) return unseen;
  double sum = 0.0;
  long values = 0;
  for (Eigen::Index c = instrument.first; c < instrument.first + count; ++c)
    for (Eigen::Index r = 0; r < said.rows(); ++r) {
      const double error = seen.value(r, c) - said(r, c);
      if (!std::isfinite(error)) continue;
      sum += error * error;
      ++values;
    }
  return values ? instrument.scale * std::sqrt(sum / static_cast<double>(values)) : unseen;
}

/// Takes the points of the shapes out of what the widened experiment's instruments say.
ScenePath split(discrepancy::SceneReadings readings, const Experiment& experiment, int t,
                const std::vector<double>& time) {
  const Trial& trial = experiment.trials[static_cast<std::size_t>(t)];
  const auto own = static_cast<Eigen::Index>(experiment.markers.size());
  ScenePath path;
  path.time = time;
  path.healthy = readings.healthy;
  path.readings = std::move(readings);
  Eigen::MatrixXd& all = path.readings.markers;
  if (!path.healthy || all.cols() < 3 * own) return path;
  path.places = all.leftCols(3 * own);
  path.shape = all.rightCols(all.cols() - 3 * own);
  if (trial.markers.size() > 0)
    all = path.places;
  else
    all.resize(0, 0);
  for (Eigen::MatrixXd& image : path.readings.pixels)
    image = Eigen::MatrixXd(image.leftCols(2 * own));
  for (const SceneInstrument& instrument : instruments_of(experiment, t))
    path.rms.push_back(rms_of(instrument, trial, path.readings));
  return path;
}

}  // namespace

std::vector<SceneInstrument> instruments_of(const Experiment& experiment, int t) {
  std::vector<SceneInstrument> list;
  const Trial& trial = experiment.trials[static_cast<std::size_t>(t)];
  if (trial.markers.size() > 0)
    list.push_back({Kind::markers, 0, "markers", "mm", with_axes(experiment.markers, 3), 0, 1.0e3});
  for (std::size_t c = 0; c < trial.pixels.size(); ++c)
    if (trial.pixels[c].size() > 0)
      list.push_back({Kind::image, static_cast<int>(c), "camera " + experiment.cameras[c].name,
                      "px", with_axes(experiment.markers, 2)});
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w) {
    if (trial.wrenches[w].size() == 0) continue;
    const std::string& name = experiment.wrenches[w].name;
    list.push_back({Kind::force, static_cast<int>(w), "force at " + name, "N", {"x", "y", "z"}});
    list.push_back(
        {Kind::moment, static_cast<int>(w), "moment at " + name, "N m", {"x", "y", "z"}, 3});
  }
  if (trial.torques.size() > 0)
    list.push_back(
        {Kind::torques, 0, "motors", "N m (N)", joints_named(experiment, trial.torque_columns)});
  if (trial.follows_commands && trial.joints.size() > 0)
    list.push_back(
        {Kind::encoders, 0, "encoders", "rad (m)", joints_named(experiment, trial.joint_columns)});
  return list;
}

const Samples& measured_by(const SceneInstrument& instrument, const Trial& trial) {
  return table_of(instrument, trial);
}

const Eigen::MatrixXd& said_by(const SceneInstrument& instrument,
                               const discrepancy::SceneReadings& readings) {
  return table_of(instrument, readings);
}

std::vector<ScenePlantShape> shapes_of(const Experiment& experiment) {
  std::vector<ScenePlantShape> shapes;
  int points = 0;
  for (const discrepancy::ExperimentPlant& plant : experiment.plants) {
    ScenePlantShape shape;
    shape.curves = shape_of(plant.file);
    for (ShapeCurve& curve : shape.curves) {
      curve.first = points;
      points += static_cast<int>(curve.at.size());
    }
    for (const plant::PlantFruit& fruit : plant.file.fruits) {
      shape.fruits.push_back(points++);
      shape.radii.push_back(fruit.radius);
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

void simulate_scene_paths(const Experiment& experiment,
                          const std::vector<discrepancy::SceneVariant>& variants,
                          const std::atomic<bool>& stop,
                          const std::function<void(int trial, int variant, ScenePath path)>& done) {
  const Experiment wide = with_shapes(experiment);
  discrepancy::SceneSimulator simulator(wide, {}, 1, &stop);
  for (std::size_t t = 0; t < wide.trials.size(); ++t) {
    std::vector<discrepancy::SceneSimulator::Request> requests;
    for (const discrepancy::SceneVariant& variant : variants)
      requests.push_back({&variant, static_cast<int>(t)});
    std::vector<discrepancy::SceneReadings> all = simulator.run(requests);
    if (stop) return;
    for (std::size_t v = 0; v < all.size(); ++v)
      done(static_cast<int>(t), static_cast<int>(v),
           split(std::move(all[v]), experiment, static_cast<int>(t), wide.trials[t].markers.time));
  }
}

discrepancy::JointPath measured_arm(const Experiment& experiment, int t) {
  Trial trial = experiment.trials[static_cast<std::size_t>(t)];
  trial.follows_commands = false;
  if (trial.joints.size() == 0) {
    trial.joints = trial.commands;
    trial.joint_columns = trial.command_columns;
  }
  return discrepancy::path_of(experiment, trial);
}

}  // namespace pedicel::app
