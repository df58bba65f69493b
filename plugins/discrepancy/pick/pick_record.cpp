#include "plugins/discrepancy/pick/pick_record.h"

#include <cctype>
#include <string_view>

#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/machine_table.h"

namespace pedicel::discrepancy {

namespace {

using io::Quantity;

/// fx, force_x, wrench.force.x, /ft_sensor/wrench/force/x, field.wrench.force.x, with or without a
/// unit behind it.
// Names as recorders of ROS and others give them. A letter before "force" makes another word:
// "reinforce_x" is none.
bool is_force_axis(const std::string& heading, char axis) {
  // Without the unit, which may itself end in a letter of an axis.
  std::string name = io::split_unit(heading).name;
  if (const auto mark = name.rfind('_'); mark != std::string::npos)
    if (const auto unit = io::unit_of(name.substr(mark + 1));
        unit && unit->quantity == Quantity::force)
      // "fx_N": the unit is read elsewhere.
      name.resize(mark);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string end(1, axis);
  // Short names must be the whole heading: "of_x" ends in one of them.
  if (name == "f" + end || name == "f_" + end) return true;
  // By the end of the name, since what stands before it is a topic or a sensor.
  for (const char* mark : {"_", ".", "/", " ", ""}) {
    const std::string wanted = std::string("force") + mark + end;
    if (!name.ends_with(wanted)) continue;
    const std::size_t before = name.size() - wanted.size();
    if (before == 0 || std::string_view("_./ ").find(name[before - 1]) != std::string_view::npos)
      return true;
  }
  return false;
}

class PickReader {
 public:
  PickReader(const std::filesystem::path& file, const PickColumns& said, Diagnostics& diagnostics,
             ImportNotes& notes)
      : file_(file.string()),
        said_(said),
        diagnostics_(diagnostics),
        notes_(notes),
        // Of other files: their faults are not this one's.
        before_(diagnostics.error_count()),
        table_(file, diagnostics, notes) {}

  PickRecord read() {
    PickRecord record;
    // Before anything can fail: answers about a file name it.
    record.file = file_;
    // A table that cannot be read would only lead to sentences about its columns.
    if (diagnostics_.error_count() > before_) return record;
    // Told here: a reader of numbers would only say that there are none.
    if (table_.rows() == 0) {
      table_.error("no row below the names, expected the rows of a record");
      return record;
    }
    record.time = table_.times(said_.time, {said_.time_unit, "--time-unit"},
                               "time or --time-column with one of: " + table_.names());
    // After the time, so that a table without either is told of both.
    const std::vector<const MachineColumn*> axes = force_columns();
    record.force.resize(static_cast<Eigen::Index>(table_.rows()),
                        static_cast<Eigen::Index>(axes.size()));
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
      const std::vector<double> values =
          // In newtons by what the table or the person states. A number in grams looks like any
          // other.
          table_.si_values(*axes[axis], Quantity::force, {said_.force_unit, "--force-unit"});
      // The faults are said, and further axes would repeat them.
      if (values.empty()) return record;
      record.force.col(static_cast<Eigen::Index>(axis)) = Eigen::Map<const Eigen::VectorXd>(
          values.data(), static_cast<Eigen::Index>(values.size()));
      // Told in the answer, since nobody named them.
      record.columns.push_back(axes[axis]->name);
    }
    return record;
  }

 private:
  std::vector<const MachineColumn*> force_columns() {
    std::vector<const MachineColumn*> found;
    for (const std::string& name : said_.force)
      // In the order in which they were given. A name that is wrong has been told, and the others
      // are read on.
      if (const MachineColumn* column = table_.named(name)) found.push_back(column);
    // What was asked for is not guessed at.
    if (!said_.force.empty()) return found;
    // In this order, whatever the table's is. One or two of them will do: sensors of one axis are
    // common.
    for (const char axis : {'x', 'y', 'z'}) {
      std::vector<const MachineColumn*> along;
      for (const MachineColumn& column : table_.columns())
        if (is_force_axis(column.name, axis)) along.push_back(&column);
      // Two sensors: a guess would be right half of the time.
      if (along.size() > 1) return several();
      found.insert(found.end(), along.begin(), along.end());
    }
    // A testing machine has one force, and no axes.
    if (found.empty())
      if (const MachineColumn* force =
              table_.lone_force("--force-column once an axis, with some of"))
        found.push_back(force);
    return found;
  }

  std::vector<const MachineColumn*> several() {
    // As something that nobody stated, and not as a fault: the table is right, and an option says
    // the rest.
    notes_.missing.push_back(file_ +
                             ": more than one sensor's force, expected --force-column once an "
                             "axis, with some of: " +
                             table_.names());
    return {};
  }

  std::string file_;
  const PickColumns& said_;
  Diagnostics& diagnostics_;
  ImportNotes& notes_;
  int before_;
  MachineTable table_;
};

}  // namespace

PickRecord read_pick_record(const std::filesystem::path& file, const PickColumns& columns,
                            Diagnostics& diagnostics, ImportNotes& notes) {
  return PickReader(file, columns, diagnostics, notes).read();
}

}  // namespace pedicel::discrepancy
