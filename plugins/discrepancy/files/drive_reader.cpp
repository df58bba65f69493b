#include "plugins/discrepancy/files/drive_reader.h"

#include <cmath>

#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/plant/effect_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::DescribedMap;
using io::KeyType;
using io::Told;
using io::YamlNode;

constexpr double unit_within = 0.01;  // 1, of a unit vector's length

const io::KeyList& drive_list() {
  static const io::KeyList keys{"drive",
                                "a drive",
                                {{.name = "kind",
                                  .type = KeyType::word,
                                  .words = {"hold", "load", "base", "none"},
                                  .sentence = "what was done; `none` beside no other"}}};
  return keys;
}

const io::KeyList& hold_list() {
  static const io::KeyList keys{
      "hold",
      "a drive",
      {{.name = "path", .type = KeyType::path, .form = "a table", .sentence = "its known path"},
       {.name = "release",
        .unit = "s",
        .otherwise = Told{"end of the path"},
        .bounds = io::positive,
        .sentence = "free from then on"},
       {.name = "stiffness",
        .unit = "N/m",
        .otherwise = Told{"rigid"},
        .bounds = io::positive,
        .sentence = "spring between the point and its path"},
       {.name = "axes",
        .type = KeyType::list,
        .otherwise = Told{"all"},
        .words = {"x", "y", "z"},
        .sentence =
            "it leads along these axes of the world, and the point slides along the others"},
       {.name = "axis",
        .type = KeyType::vector,
        .unit = "1",
        .otherwise = Told{"all"},
        .form = "a unit vector",
        .sentence = "the same along one axis, in place of `axes`"},
       {.name = "one_sided",
        .type = KeyType::flag,
        .otherwise = Hold{}.one_sided,
        .form = "with one axis",
        .sentence = "it only pushes, along the axis"},
       {.name = "direction",
        .type = KeyType::flag,
        .otherwise = Hold{}.direction,
        .form = "with an orientation in the path",
        .sentence = "it leads the segment's direction, and its twist is free"}},
      "",
      {&drive_list(), &plant::place_keys()}};
  return keys;
}

const io::KeyList& load_list() {
  static const io::KeyList keys{
      "load",
      "a drive",
      {{.name = "force", .type = KeyType::vector, .unit = "N", .sentence = "in the world"},
       {.name = "from", .unit = "s", .otherwise = Told{"always"}, .sentence = "it acts from here"},
       {.name = "to",
        .unit = "s",
        .otherwise = Told{"always"},
        .form = "after `from`",
        .sentence = "it ends here"}},
      "",
      {&drive_list(), &plant::place_keys()}};
  return keys;
}

const io::KeyList& base_list() {
  static const io::KeyList keys{
      "base",
      "a drive",
      {{.name = "path",
        .type = KeyType::path,
        .otherwise = Told{"needed without `wrench`"},
        .form = "a table",
        .sentence = "path of the root; one base at most"},
       {.name = "wrench",
        .type = KeyType::path,
        .otherwise = Told{"none"},
        .form = "a table",
        .sentence = "[force and moment](#force-and-moment-at-the-root) at the root"}},
      "",
      {&drive_list()}};
  return keys;
}

class DriveReader {
 public:
  DriveReader(const std::filesystem::path& folder, const CheckPlace& check, Trial& trial,
              Diagnostics& diagnostics)
      : folder_(folder), check_(check), trial_(trial), diagnostics_(diagnostics) {}

  void read(const YamlNode& node) {
    DescribedMap map(node, drive_list());
    if (!map.required("kind")) return;
    const std::string kind = map.choice("kind");
    if (kind == "hold") trial_.holds.push_back(read_hold(node));
    if (kind == "load") trial_.loads.push_back(read_load(node));
    if (kind == "base") read_base(node);
    if (kind != "none") return;
    none_ = true;
    map.finish();
  }
  bool has_none() const { return none_; }

 private:
  /// The map of a kind, whose `kind` was read.
  static DescribedMap map_of(const YamlNode& node, const io::KeyList& keys) {
    DescribedMap map(node, keys);
    map.optional("kind");
    return map;
  }

  plant::CurvePlace place(DescribedMap& map) const {
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

  void read_base(const YamlNode& node) {
    DescribedMap map = map_of(node, base_list());
    if (has_base_) node.error("a second base, expected one at most");
    has_base_ = true;
    const auto wrench = map.optional("wrench");
    if (wrench) trial_.wrench_file = wrench->text("wrench");
    // A base that carries a force plate may stand still.
    const auto path_node = wrench ? map.optional("path") : map.required("path");
    if (path_node) trial_.base = path(path_node);
    map.finish();
  }

  Hold read_hold(const YamlNode& node) const {
    DescribedMap map = map_of(node, hold_list());
    Hold hold;
    hold.place = place(map);
    hold.path = path(map.required("path"));
    hold.release = map.optional_number("release").value_or(hold.release);
    hold.stiffness = map.optional_number("stiffness");
    read_axes(map, hold);
    hold.direction = map.boolean("direction");
    if (hold.direction && hold.path.rotation.empty() && !hold.path.time.empty())
      map.error("direction: true, and the path has no orientation, expected qx, qy, qz, qw in " +
                hold.path.file.string());
    map.finish();
    return hold;
  }

  void read_axes(DescribedMap& map, Hold& hold) const {
    if (const auto node = map.optional("axes")) {
      hold.axes = world_axes(*node, map.key("axes").words);
      if (map.has("axis")) node->error("axes beside axis, expected one of the two");
    }
    if (const auto node = map.optional("axis"))
      if (const auto axis = unit_axis(*node)) hold.axes = {*axis};
    hold.one_sided = map.boolean("one_sided");
    if (hold.one_sided && hold.axes.size() != 1)
      map.error("one_sided: true, and the hold leads along " +
                std::string(hold.axes.empty() ? "all axes" : "several axes") +
                ", expected axis, or axes with a single one");
  }

  static std::vector<Vec3> world_axes(const YamlNode& node, const std::vector<std::string>& words) {
    std::vector<Vec3> axes;
    bool there[3] = {};
    for (const YamlNode& one : node.list("axes")) {
      const std::string name = one.choice("axes", words);
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

  TimedLoad read_load(const YamlNode& node) const {
    DescribedMap map = map_of(node, load_list());
    TimedLoad load;
    load.place = place(map);
    load.force = map.vector("force");
    load.from = map.optional_number("from").value_or(load.from);
    load.to = map.optional_number("to").value_or(load.to);
    if (!(load.from < load.to)) map.error("the load ends before it begins, expected from < to");
    map.finish();
    return load;
  }

  const std::filesystem::path& folder_;
  const CheckPlace& check_;
  Trial& trial_;
  Diagnostics& diagnostics_;
  bool none_ = false, has_base_ = false;
};

}  // namespace

std::vector<const io::KeyList*> drive_keys() {
  return {&drive_list(), &hold_list(), &load_list(), &base_list()};
}

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
