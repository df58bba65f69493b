#include "tests/discrepancy/cane_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/io/csv.h"

namespace pedicel::discrepancy::testing {

namespace {

constexpr double newton_per_gram_force = 9.80665e-3;
constexpr double begin_of_line = 0.2;        // of the range of force
constexpr int first_samples = 5;             // whose mean is the load cell's zero
constexpr int points = 3;                    // a height, kept for the fit
constexpr double step_of_actuator = 5.0e-4;  // m

io::CsvTable read(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  io::CsvTable table =
      io::read_csv(path, {.empty_cells = true, .increasing_first = false}, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return table;
}

bool faulty(int bush, int branch, int trial) {
  return (bush == 4 && branch == 1 && trial == 1) || (bush == 2 && branch == 1 && trial == 3) ||
         (bush == 5 && branch == 2 && trial == 3);
}

/// Least squares y = a + b x.
struct Line {
  double a = 0.0, b = 0.0;
  Line(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      mx += x[i] / static_cast<double>(x.size());
      my += y[i] / static_cast<double>(x.size());
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mx) * (x[i] - mx);
      xy += (x[i] - mx) * (y[i] - my);
    }
    b = xy / xx;
    a = my - b * mx;
  }
};

void read_record(const std::filesystem::path& path, CanePush& push) {
  const io::CsvTable table = read(path);
  double zero = 0.0, most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double force = table.rows[i][2] * newton_per_gram_force;
    if (i < first_samples) zero += force / first_samples;
    most = std::max(most, force);
  }
  // Up to the largest force: what comes after is the way back.
  for (const std::vector<double>& row : table.rows) {
    const double force = row[2] * newton_per_gram_force - zero;
    if (force > begin_of_line * (most - zero)) {
      push.force.push_back(force);
      push.displacement.push_back(1.0e-3 * row[3]);
    }
    if (force >= most - zero) break;
  }
  const Line line(push.displacement, push.force);
  push.stiffness = line.b;
  for (double& x : push.displacement) x += line.a / line.b;
}

}  // namespace

std::vector<CanePush> read_cane_pushes(const std::filesystem::path& folder) {
  const io::CsvTable summary = read(folder / "SUMMARY_fits.csv");
  std::vector<CanePush> pushes;
  for (const std::vector<double>& row : summary.rows) {
    CanePush push;
    push.bush = static_cast<int>(row[0]);
    push.branch = static_cast<int>(row[1]);
    push.trial = static_cast<int>(row[2]);
    push.height = 1.0e-3 * row[summary.column("h_mm")];
    push.diameter = 1.0e-3 * row[summary.column("dia_mm")];
    if (faulty(push.bush, push.branch, push.trial)) continue;
    read_record(
        folder / ("bush_" + std::to_string(push.bush) + "_branch_" + std::to_string(push.branch) +
                  "_trial_" + std::to_string(push.trial) + ".csv"),
        push);
    pushes.push_back(push);
  }
  return pushes;
}

Experiment cane_experiment(const std::vector<CanePush>& pushes) {
  std::vector<CanePush> up = pushes;
  std::ranges::sort(up, {}, &CanePush::height);
  const CanePush& low = up.front();
  Experiment experiment;
  experiment.plant().name = "cane";
  experiment.plant().shape = plant::Shape::rest;
  // As stiff as the lowest push says: F = 3 E I / h^3 x.
  const double inertia = std::numbers::pi / 64.0 * std::pow(low.diameter, 4);
  experiment.plant().material = {low.stiffness * std::pow(low.height, 3) / (3.0 * inertia), 0.3,
                                 800.0, 0.01};
  experiment.plant().connect = 0.001;
  experiment.plant().distance = 0.02;
  plant::PlantCurve curve;
  curve.name = "cane";
  curve.interpolation = plant::Interpolation::linear;
  curve.points = {Vec3::Zero()};
  curve.radius = {0.5 * low.diameter};
  for (const CanePush& push : up) {
    curve.points.push_back(Vec3(0, 0, push.height));
    curve.radius.push_back(0.5 * push.diameter);
  }
  experiment.plant().curves = {curve};
  const double length = up.back().height;
  for (const CanePush& push : up)
    experiment.markers.push_back(
        {"h" + std::to_string(push.trial), {"cane", push.height / length, {}}});
  experiment.noise.position_std = step_of_actuator;
  for (std::size_t h = 0; h < up.size(); ++h) {
    const CanePush& push = up[h];
    for (int k = 0; k < points; ++k) {
      const std::size_t i = (push.force.size() - 1) * k / (points - 1);
      Trial trial;
      trial.name = experiment.markers[h].name + "_" + std::to_string(k);
      trial.gravity.setZero();
      trial.loads = {{experiment.markers[h].place, Vec3(push.force[i], 0, 0)}};
      trial.markers.time = {0.0};
      trial.markers.value.setConstant(1, 3 * up.size(), NAN);
      trial.markers.value(0, 3 * h) = push.displacement[i];
      experiment.trials.push_back(trial);
    }
  }
  return experiment;
}

}  // namespace pedicel::discrepancy::testing
