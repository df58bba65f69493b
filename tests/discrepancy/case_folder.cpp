#include <nlohmann/json.hpp>
#include <sstream>

#include "discrepancy/hidden_case.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"

namespace pedicel::hidden {

namespace {

using io::format_number;
using nlohmann::ordered_json;
using reference::TrialPlan;

std::string vector_text(const Vec3& v) {
  return "[" + format_number(v.x()) + ", " + format_number(v.y()) + ", " + format_number(v.z()) +
         "]";
}

std::string place_text(const plant::CurvePlace& place) {
  return "curve: " + place.curve + ", at: " + format_number(place.at);
}

// The first hold's path is hold.csv, as the formats have it.
std::string hold_file(std::size_t i) {
  return i == 0 ? "hold.csv" : "hold_" + std::to_string(i + 1) + ".csv";
}

std::string drive_text(const TrialPlan& trial) {
  std::ostringstream out;
  for (std::size_t i = 0; i < trial.holds.size(); ++i) {
    const reference::HoldPlan& hold = trial.holds[i];
    out << "      - {kind: hold, " << place_text(hold.place) << ", path: " << hold_file(i);
    if (hold.stiffness) out << ", stiffness: " << format_number(*hold.stiffness);
    if (std::isfinite(hold.release)) out << ", release: " << format_number(hold.release);
    out << "}\n";
  }
  for (const reference::LoadPlan& load : trial.loads) {
    out << "      - {kind: load, " << place_text(load.place)
        << ", force: " << vector_text(load.force);
    if (std::isfinite(load.from)) out << ", from: " << format_number(load.from);
    if (std::isfinite(load.to)) out << ", to: " << format_number(load.to);
    out << "}\n";
  }
  if (trial.base) out << "      - {kind: base, path: base.csv}\n";
  return out.str().empty() ? "      - {kind: none}\n" : out.str();
}

std::string experiment_text(const HiddenCase& c) {
  std::ostringstream out;
  out << "format: pedicel-experiment\nversion: 1\ntitle: " << c.name
      << "\nplant: plant.yaml\nmarkers:\n";
  for (const reference::MarkerPlan& m : c.setting.markers)
    out << "  - {name: " << m.name << ", " << place_text(m.place) << "}\n";
  if (c.order.number % 2)
    out << "noise: {position_std: " << format_number(c.noise.position_std)
        << ", force_std: " << format_number(c.noise.force_std) << "}\n";
  out << "trials:\n";
  for (const TrialPlan& t : c.trials) {
    out << "  - name: " << t.name << "\n    folder: " << t.name
        << "\n    clock: " << format_number(t.clock) << "\n    drive:\n"
        << drive_text(t);
  }
  return out.str();
}

void write_path(const std::filesystem::path& file, const reference::Rows& rows) {
  io::CsvWriter csv(file, {"time", "x", "y", "z"});
  for (std::size_t i = 0; i < rows.time.size(); ++i)
    csv.row(std::vector<double>{rows.time[i], rows.position[i].x(), rows.position[i].y(),
                                rows.position[i].z()});
}

void write_samples(const std::filesystem::path& file, const std::vector<std::string>& columns,
                   const std::vector<double>& time, const Eigen::MatrixXd& value) {
  io::CsvWriter csv(file, columns);
  for (int i = 0; i < value.rows(); ++i) {
    std::vector<double> row{time[i]};
    for (int k = 0; k < value.cols(); ++k) row.push_back(value(i, k));
    csv.row(row);
  }
}

void write_trial(const std::filesystem::path& folder, const HiddenCase& c, std::size_t index) {
  const TrialPlan& trial = c.trials[index];
  const reference::Record& record = c.records[index];
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < trial.holds.size(); ++i)
    write_path(folder / hold_file(i), trial.holds[i].path);
  if (trial.base) write_path(folder / "base.csv", *trial.base);
  std::vector<std::string> columns{"time"};
  for (const reference::MarkerPlan& m : c.setting.markers)
    for (const char* axis : {".x", ".y", ".z"}) columns.push_back(m.name + axis);
  write_samples(folder / "markers.csv", columns, record.time, record.markers);
  if (record.force.rows() > 0)
    write_samples(folder / "force.csv", {"time", "fx", "fy", "fz"}, record.time, record.force);
}

ordered_json effect_json(const plant::Effect& e) {
  ordered_json out{{"name", e.name}};
  if (e.place) out["where"] = {{"curve", e.place->curve}, {"at", e.place->at}};
  for (const auto& [key, value] : e.words) out[key] = value;
  for (const auto& [key, value] : e.numbers)
    if (value.size() == 1)
      out[key] = value.front();
    else
      out[key] = value;
  return out;
}

ordered_json outside_json(const reference::OutsideEffect& s) {
  return {{"kind", reference::name_of(s.kind)},
          {"where", {{"curve", s.place.curve}, {"at", s.place.at}}},
          {"point", {s.point.x(), s.point.y(), s.point.z()}},
          {"direction", {s.direction.x(), s.direction.y(), s.direction.z()}},
          {"size", s.size},
          {"slack", s.slack},
          {"frequency", s.frequency}};
}

}  // namespace

std::string truth_text(const HiddenCase& c) {
  ordered_json out{{"name", c.name},
                   {"seed", c.seed},
                   {"case", c.order.number},
                   {"kind", name_of(c.order.kind)},
                   {"plant", name_of(c.order.plant)},
                   {"pack", name_of(c.order.pack)},
                   {"expected", name_of(c.expected)}};
  for (const char* list : {"causes", "outside", "refitted"}) out[list] = ordered_json::array();
  for (const plant::Effect& e : c.causes) out["causes"].push_back(effect_json(e));
  for (const reference::OutsideEffect& s : c.outside) out["outside"].push_back(outside_json(s));
  for (const plant::Effect& e : c.refitted) out["refitted"].push_back(effect_json(e));
  out["look_alikes"] = c.look_alikes;
  out["sine"] = c.sine;
  out["times_smallest"] = c.order.size;
  out["smallest"] = c.smallest;
  out["size"] = c.size;
  out["visible"] = c.visible;
  if (c.nearest.distance > 0.0)
    out["nearest"] = {{"cause", c.nearest.cause}, {"distance", c.nearest.distance}};
  out["noise"] = {{"position_std", c.noise.position_std},
                  {"force_std", c.noise.force_std},
                  {"rho", c.noise.rho}};
  return out.dump(2) + "\n";
}

void write_case(const std::filesystem::path& folder, HiddenCase& c) {
  c.folder = folder / c.name;
  std::filesystem::create_directories(c.folder);
  plant::write_plant_file(c.folder / "plant.yaml", c.setting.plant);
  io::write_file_atomically(c.folder / "experiment.yaml", experiment_text(c));
  for (std::size_t i = 0; i < c.trials.size(); ++i) write_trial(c.folder / c.trials[i].name, c, i);
  io::write_file_atomically(folder / (c.name + ".truth.json"), truth_text(c));
}

}  // namespace pedicel::hidden
