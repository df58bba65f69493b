#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "tests/discrepancy/hidden_case.h"

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

// What was let go before the record began is not in it.
bool is_told(const TrialPlan& trial, const reference::HoldPlan& hold) {
  return trial.begins == 0.0 || hold.release > trial.begins;
}

std::string guide_text(const reference::HoldPlan& hold) {
  std::string text;
  if (hold.axes.size() == 1) text += ", axis: " + vector_text(hold.axes.front());
  if (hold.one_sided) text += ", one_sided: true";
  return text;
}

std::string drive_text(const TrialPlan& trial) {
  std::ostringstream out;
  for (std::size_t i = 0; i < trial.holds.size(); ++i) {
    const reference::HoldPlan& hold = trial.holds[i];
    if (!is_told(trial, hold)) continue;
    out << "      - {kind: hold, " << place_text(hold.place) << ", path: " << hold_file(i);
    if (hold.stiffness) out << ", stiffness: " << format_number(*hold.stiffness);
    if (std::isfinite(hold.release)) out << ", release: " << format_number(hold.release);
    out << guide_text(hold) << "}\n";
  }
  for (const reference::LoadPlan& load : trial.loads) {
    out << "      - {kind: load, " << place_text(load.place)
        << ", force: " << vector_text(load.force);
    if (std::isfinite(load.from)) out << ", from: " << format_number(load.from - trial.begins);
    if (std::isfinite(load.to)) out << ", to: " << format_number(load.to - trial.begins);
    out << "}\n";
  }
  if (trial.base || trial.measures_wrench)
    out << "      - {kind: base" << (trial.base ? ", path: base.csv" : "")
        << (trial.measures_wrench ? ", wrench: base_wrench.csv" : "") << "}\n";
  return out.str().empty() ? "      - {kind: none}\n" : out.str();
}

std::string experiment_text(const HiddenCase& c) {
  std::ostringstream out;
  out << "format: pedicel-experiment\nversion: 1\ntitle: " << c.name
      << "\nplant: plant.yaml\nmarkers:\n";
  for (const reference::MarkerPlan& m : c.setting.markers)
    out << "  - {name: " << m.name << ", " << place_text(m.place) << "}\n";
  // Rows at rest once each do not show it.
  if (c.order.number % 2 || c.order.pack == PackKind::rest) {
    out << "noise: {position_std: " << format_number(c.noise.position_std)
        << ", force_std: " << format_number(c.noise.force_std);
    if (c.order.pack == PackKind::plate)
      out << ", moment_std: " << format_number(c.noise.moment_std);
    out << "}\n";
  }
  out << "trials:\n";
  for (const TrialPlan& t : c.trials) {
    out << "  - name: " << t.name << "\n    folder: " << t.name
        << "\n    clock: " << format_number(t.clock + t.begins) << "\n";
    if (t.begins > 0.0) out << "    begins: moving\n";
    if (t.is_static) out << "    static: true\n";
    out << "    drive:\n" << drive_text(t);
  }
  return out.str();
}

/// Columns and rows of a table to be.
struct Table {
  std::vector<std::string> columns;
  std::vector<Eigen::VectorXd> values;

  void add(const std::string& column, const Eigen::VectorXd& value) {
    columns.push_back(column);
    values.push_back(value);
  }
  void write(const std::filesystem::path& file) const {
    io::CsvWriter csv(file, columns);
    for (Eigen::Index i = 0; i < values.front().size(); ++i) {
      std::vector<double> row;
      for (const Eigen::VectorXd& value : values) row.push_back(value[i]);
      csv.row(row);
    }
  }
};

// A static series has no time.
Table table_of(const TrialPlan& trial, const std::vector<double>& time) {
  Table table;
  if (!trial.is_static)
    table.add("time", Eigen::Map<const Eigen::VectorXd>(time.data(),
                                                        static_cast<Eigen::Index>(time.size())));
  return table;
}

void write_path(const std::filesystem::path& file, const TrialPlan& trial,
                const reference::Rows& rows) {
  Table table = table_of(trial, rows.time);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd along(rows.position.size());
    for (Eigen::Index i = 0; i < along.size(); ++i) along[i] = rows.position[i][axis];
    table.add(std::string(1, static_cast<char>('x' + axis)), along);
  }
  table.write(file);
}

void write_trial(const std::filesystem::path& folder, const HiddenCase& c, std::size_t index) {
  const TrialPlan& trial = c.trials[index];
  const reference::Record& record = c.records[index];
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < trial.holds.size(); ++i)
    if (is_told(trial, trial.holds[i]))
      write_path(folder / hold_file(i), trial, trial.holds[i].path);
  if (trial.base) write_path(folder / "base.csv", trial, *trial.base);
  constexpr const char* axes[] = {".x", ".y", ".z"};
  Table markers = table_of(trial, record.time);
  for (std::size_t m = 0; m < c.setting.markers.size(); ++m)
    for (int k = 0; k < 3; ++k)
      if (measures_axis(c.order.pack, m, k))
        markers.add(c.setting.markers[m].name + axes[k],
                    record.markers.col(static_cast<Eigen::Index>(3 * m) + k));
  markers.write(folder / "markers.csv");
  const auto write_force = [&](const char* file, const Eigen::MatrixXd& value) {
    constexpr const char* columns[] = {"fx", "fy", "fz", "tx", "ty", "tz"};
    if (value.rows() == 0) return;
    Table table = table_of(trial, record.time);
    for (int k = 0; k < value.cols(); ++k)
      if (measures_force_axis(c.order.pack, k)) table.add(columns[k], value.col(k));
    table.write(folder / file);
  };
  write_force("force.csv", record.force);
  write_force("base_wrench.csv", record.wrench);
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
  if (c.order.pack == PackKind::plate) out["noise"]["moment_std"] = c.noise.moment_std;
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
