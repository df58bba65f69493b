#include "pedicel/discrepancy/data/drive_reader.h"

#include <cmath>

#include "pedicel/discrepancy/data/experiment_tables.h"
#include "pedicel/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::YamlMap;
using io::YamlNode;

constexpr double unit_within = 0.01;  // 1, of a unit vector's length

class DriveReader {
 public:
  DriveReader(const std::filesystem::path& folder, const CheckPlace& check, Trial& trial,
              Diagnostics& diagnostics)
      : folder_(folder), check_(check), trial_(trial), diagnostics_(diagnostics) {}

  void read(const YamlNode& node) {
    YamlMap map(node, "a drive");
    if (!map.required("kind")) return;
    const std::string kind = map.choice("kind", {"hold", "load", "base", "none"}, "none");
    if (kind == "hold") trial_.holds.push_back(read_hold(map));
    if (kind == "load") trial_.loads.push_back(read_load(map));
    if (kind == "base") read_base(node, map);
    none_ = none_ || kind == "none";
    map.finish();
  }
  bool has_none() const { return none_; }

 private:
  plant::CurvePlace place(YamlMap& map) const {
    plant::CurvePlace found = plant::read_place(map);
    check_(found);
    return found;
  }

  DrivenPath path(const std::optional<YamlNode>& node) const {
    if (!node) return {};
    const std::string file = node->text("path");
    if (file.empty()) return {};
    DrivenPath path =
        read_path(folder_ / file, diagnostics_, trial_.is_static ? Rows::rest : Rows::time);
    path.file = file;
    return path;
  }

  void read_base(const YamlNode& node, YamlMap& map) {
    if (has_base_) node.error("a second base, expected one at most");
    has_base_ = true;
    const auto wrench = map.optional("wrench");
    if (wrench) trial_.wrench_file = wrench->text("wrench");
    // A base that carries a force plate may stand still.
    const auto path_node = wrench ? map.optional("path") : map.required("path");
    if (path_node) trial_.base = path(path_node);
  }

  Hold read_hold(YamlMap& map) const {
    Hold hold;
    hold.place = place(map);
    hold.path = path(map.required("path"));
    hold.release = map.number("release", io::positive, hold.release);
    if (const auto stiffness = map.optional("stiffness"))
      hold.stiffness = stiffness->number("stiffness", io::positive);
    read_axes(map, hold);
    hold.direction = map.boolean("direction", false);
    if (hold.direction && hold.path.rotation.empty() && !hold.path.time.empty())
      map.error("direction: true, and the path has no orientation, expected qx, qy, qz, qw in " +
                hold.path.file.string());
    return hold;
  }

  void read_axes(YamlMap& map, Hold& hold) const {
    if (const auto node = map.optional("axes")) {
      hold.axes = world_axes(*node);
      if (map.has("axis")) node->error("axes beside axis, expected one of the two");
    }
    if (const auto node = map.optional("axis"))
      if (const auto axis = unit_axis(*node)) hold.axes = {*axis};
    hold.one_sided = map.boolean("one_sided", false);
    if (hold.one_sided && hold.axes.size() != 1)
      map.error("one_sided: true, and the hold leads along " +
                std::string(hold.axes.empty() ? "all axes" : "several axes") +
                ", expected axis, or axes with a single one");
  }

  static std::vector<Vec3> world_axes(const YamlNode& node) {
    std::vector<Vec3> axes;
    bool there[3] = {};
    for (const YamlNode& one : node.list("axes")) {
      const std::string name = one.choice("axes", {"x", "y", "z"});
      const int axis = name[0] - 'x';
      if (there[axis]) one.error("axis " + name + " appears twice, expected it once");
      if (!there[axis]) axes.emplace_back(Vec3::Unit(axis));
      there[axis] = true;
    }
    if (node.is_list() && axes.empty()) node.error("no axes, expected one or more of x, y and z");
    return axes.size() == 3 ? std::vector<Vec3>() : axes;
  }

  static std::optional<Vec3> unit_axis(const YamlNode& node) {
    const Vec3 axis = node.vector("axis");
    const double length = axis.norm();
    if (std::abs(length - 1.0) <= unit_within) return axis / length;
    node.error("axis has the length " + io::format_number(length, 3) + ", expected a unit vector");
    return std::nullopt;
  }

  TimedLoad read_load(YamlMap& map) const {
    TimedLoad load;
    load.place = place(map);
    load.force = map.vector("force");
    load.from = map.number("from", io::any_number, load.from);
    load.to = map.number("to", io::any_number, load.to);
    if (!(load.from < load.to)) map.error("the load ends before it begins, expected from < to");
    return load;
  }

  const std::filesystem::path& folder_;
  const CheckPlace& check_;
  Trial& trial_;
  Diagnostics& diagnostics_;
  bool none_ = false, has_base_ = false;
};

}  // namespace

void read_drives(const YamlNode& list, const std::filesystem::path& folder, const CheckPlace& check,
                 Trial& trial) {
  DriveReader reader(folder, check, trial, list.diagnostics());
  const std::vector<YamlNode> all = list.list("drive");
  for (const YamlNode& node : all) reader.read(node);
  if (reader.has_none() && all.size() > 1)
    list.error("kind none beside another drive, expected it alone");
}

void check_static(const YamlNode& node, const Trial& trial, Diagnostics& diagnostics) {
  for (const Hold& hold : trial.holds)
    if (std::isfinite(hold.release))
      node.error("a static series with a release, expected none: it has no time");
  for (const TimedLoad& load : trial.loads)
    if (std::isfinite(load.from) || std::isfinite(load.to))
      node.error("a static series with from or to, expected loads that act always");
  if (!trial.events.empty())
    node.error("a static series with events.csv, expected none: it has no time");
  const int rows = trial.markers.size();
  const auto check = [&](const std::filesystem::path& file, int own, bool single) {
    if (own == 0 || own == rows || (single && own == 1) || rows == 0) return;
    diagnostics.error({(trial.folder / file).string(), 0, 0},
                      "has " + std::to_string(own) + " rows, and markers.csv has " +
                          std::to_string(rows) +
                          ": expected as many, row i of every table belongs together");
  };
  check("force.csv", trial.force.size(), false);
  check(trial.wrench_file, trial.wrench.size(), false);
  for (const Hold& hold : trial.holds)
    check(hold.path.file, static_cast<int>(hold.path.time.size()), true);
  if (trial.base) check(trial.base->file, static_cast<int>(trial.base->time.size()), true);
}

}  // namespace pedicel::discrepancy
