#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tests/discrepancy/scene_cases/scene_case.h"

namespace pedicel::scene_case {

namespace {

constexpr double joint_std = 2.0e-5, position_std = 3.0e-4, force_std = 0.03, moment_std = 2.0e-3;
constexpr double torque_std = 0.05;   // N m or N
constexpr double pixel_std = 0.4;     // px
constexpr double focal = 900.0;       // px
constexpr double joint_rate = 250.0;  // Hz

std::string list(const std::vector<double>& values) {
  std::ostringstream out;
  out.precision(10);
  if (values.size() > 1) out << "[";
  for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? ", " : "") << values[i];
  if (values.size() > 1) out << "]";
  return out.str();
}
std::string list(const Vec3& v) {
  return list(std::vector<double>{v.x(), v.y(), v.z()});
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

std::string link(const std::string& name, const std::string& centre, double mass,
                 const std::string& inertia, const std::string& shape = "") {
  double x = 0.0, y = 0.0, z = 0.0;
  std::istringstream(inertia) >> x >> y >> z;
  std::ostringstream out;
  out << "  <link name=\"" << name << "\"><inertial><origin xyz=\"" << centre
      << "\"/><mass value=\"" << mass << "\"/><inertia ixx=\"" << x
      << "\" ixy=\"0\" ixz=\"0\" iyy=\"" << y << "\" iyz=\"0\" izz=\"" << z << "\"/></inertial>"
      << shape << "</link>\n";
  return out.str();
}

std::string joint(const std::string& name, const std::string& kind, const std::string& parent,
                  const std::string& child, const std::string& origin) {
  std::string text = "  <joint name=\"" + name + "\" type=\"" + kind + "\"><parent link=\"" +
                     parent + "\"/><child link=\"" + child + "\"/><origin xyz=\"" + origin + "\"/>";
  if (kind != "fixed")
    text +=
        "<axis xyz=\"0 0 1\"/><limit lower=\"-3.1\" upper=\"3.1\" effort=\"60\" velocity=\"3\"/>";
  return text + "</joint>\n";
}

std::string urdf(const Setting& s) {
  std::ostringstream shape;
  for (const char* kind : {"visual", "collision"}) {
    shape << "<" << kind << "><origin xyz=\"" << 0.5 * finger_length
          << " 0 0\" rpy=\"0 1.57079632679 0\"/><geometry><cylinder radius=\"" << finger_radius
          << "\" length=\"" << finger_length << "\"/></geometry></" << kind << ">";
    // In a harvest the stem slides off the fingertip, which is round.
    if (s.truss)
      shape << "<" << kind << "><origin xyz=\"" << finger_length
            << " 0 0\"/><geometry><sphere radius=\"" << finger_radius << "\"/></geometry></" << kind
            << ">";
  }
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<robot name=\"reacher\">\n"
      << link("base", "0 0 0.05", 3.0, "0.02 0.02 0.02")
      << link("upper", "0.125 0 0", 0.8, "0.0004 0.0045 0.0045")
      << joint("shoulder", "revolute", "base", "upper", "0 0 " + std::to_string(shoulder_height))
      << link("fore", "0.1 0 0", 0.5, "0.0002 0.0018 0.0018")
      << joint("elbow", "revolute", "upper", "fore", std::to_string(upper_length) + " 0 0")
      << link("carriage", "0 0 0", 0.2, "0.0001 0.0001 0.0001")
      << joint("lift", "prismatic", "fore", "carriage", std::to_string(fore_length - 0.05) + " 0 0")
      << link("hand", "0.015 0 0", hand_mass, "0.00008 0.00008 0.00008")
      << joint("sensor_mount", "fixed", "carriage", "hand", "0.02 0 0")
      << link("finger", std::to_string(0.5 * finger_length) + " 0 0", finger_mass,
              "0.000002 0.00009 0.00009", shape.str())
      << joint("tool_mount", "fixed", "hand", "finger", "0.03 0 0") << "</robot>\n";
  return out.str();
}

std::string plant(const Setting& s) {
  std::ostringstream out;
  out.precision(10);
  out << std::showpoint << "format: pedicel-plant\nversion: 1\nname: bush\n"
      << "material: {youngs_modulus: " << s.modulus
      << ", poisson_ratio: 0.35, density: " << s.density << ", damping_time: " << s.damping_time
      << "}\n"
      << "sampling: {connect: 0.004, distance: 0.02}\nroot: [0, 0, 0]\ncurves:\n"
      << "  - {name: stem, interpolation: linear, points: [[0, 0, 0], [0, 0, " << s.height
      << "]], radius: " << s.radius << "}\n";
  if (!s.truss) return out.str();
  const Truss& truss = *s.truss;
  const Vec3 foot(0.0, 0.0, truss.from);
  out << "  - {name: truss, interpolation: linear, points: [" << list(foot) << ", "
      << list(Vec3(foot + truss.length * truss.direction)) << "], radius: " << truss.radius
      << "}\nfruits:\n  - {name: fruit, curve: truss, at: 1, radius: " << truss.fruit_radius
      << ", density: " << truss.fruit_density << ", detach: {force: " << truss.strength << "}}\n";
  return out.str();
}

std::string scene(const Setting& s, const Vec3& start) {
  std::ostringstream out;
  out.precision(10);
  out << "format: pedicel-scene\nversion: 1\nname: nominal\n"
      << "purpose: The nominal scene of a measured experiment, as believed.\n"
      << "see: A finger " << (s.truss ? "takes a fruit and pulls it off" : "pushes a stem")
      << ".\nduration: 3\ndt: 0.001\ncoupling: {friction: " << s.friction
      << "}\nplants:\n  - {name: bush, file: plant.yaml, position: " << list(s.root)
      << "}\nrobot:\n  {name: arm, file: reacher.urdf, joints: {shoulder: " << start[0]
      << ", elbow: " << start[1] << ", lift: " << start[2] << "}, tool: finger}\n";
  return out.str();
}

// A pinhole beside the plant: x to the right, y down, z forward.
const Vec3 camera_place(0.5, -0.9, 0.35), camera_target(0.45, 0.0, 0.2);
const Eigen::Vector2d camera_centre(640.0, 360.0);

Eigen::Matrix3d camera_axes() {
  const Vec3 forward = (camera_target - camera_place).normalized();
  const Vec3 right = forward.cross(Vec3(0, 0, 1)).normalized();
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return axes;
}

Vec3 hidden_vector(const Setting& s, const std::string& name, const std::string& parameter) {
  return {hidden_number(s, name, parameter, 0.0, 0), hidden_number(s, name, parameter, 0.0, 1),
          hidden_number(s, name, parameter, 0.0, 2)};
}

// Where the camera really sees a place.
Eigen::Vector2d seen(const Setting& s, const Vec3& place) {
  const Vec3 turn = hidden_vector(s, "camera_pose", "rotation");
  Eigen::Matrix3d axes = camera_axes();
  if (turn.norm() > 0.0)
    axes = axes * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  const Vec3 p =
      axes.transpose() * (place - camera_place - hidden_vector(s, "camera_pose", "offset"));
  const Eigen::Vector2d flat = p.head<2>() / p.z();
  const double bent = 1.0 + hidden_number(s, "lens_distortion", "k1", 0.0) * flat.squaredNorm();
  return focal * hidden_number(s, "camera_focal", "factor", 1.0) * bent * flat + camera_centre;
}

std::string camera() {
  const Eigen::Quaterniond turn(camera_axes());
  return "cameras:\n  - {name: left, position: " + list(camera_place) +
         ", orientation: " + list(std::vector<double>{turn.x(), turn.y(), turn.z(), turn.w()}) +
         ", focal: " + list(std::vector<double>{focal, focal}) +
         ", centre: " + list(std::vector<double>{camera_centre.x(), camera_centre.y()}) +
         ", size: [1280, 720]}\n";
}

std::string markers(const Setting& s) {
  std::string text = "markers:\n";
  int m = 0;
  for (const auto& [curve, at] : markers_of(s))
    text += "  - {name: m" + std::to_string(m++) + ", plant: bush, curve: " + curve +
            ", at: " + list({at}) + "}\n";
  return text + "  - {name: nail, link: finger, offset: " + list(nail) + "}\n";
}

std::string experiment(const Setting& s, const std::vector<Drive>& drives) {
  std::string text =
      "format: pedicel-experiment\nversion: 1\ntitle: a finger " +
      std::string(s.truss ? "takes a fruit and pulls it off" : "pushes a stem and lets it go") +
      "\nscene: scene.yaml\n";
  if (!s.unseen) text += markers(s);
  if (s.camera) text += camera();
  text += "wrenches:\n  - {name: wrist, link: hand}\nnoise: {joint_std: " + list({joint_std}) +
          ", position_std: " + list({position_std}) +
          (s.camera ? ", pixel_std: " + list({pixel_std}) : "") +
          ", force_std: " + list({force_std}) + ", moment_std: " + list({moment_std}) +
          (s.torques ? ", torque_std: " + list({torque_std}) : "") + "}\ntrials:\n";
  for (const Drive& drive : drives)
    text += "  - {name: " + drive.name + ", folder: " + drive.name +
            (s.truss ? drive.check ? ", use: check" : ", use: fit" : "") +
            ", robot: {follows: " + (s.commands ? "commands" : "joints") + "}}\n";
  return text;
}

std::string answer(const Setting& s, const std::vector<Drive>& drives,
                   const std::vector<Run>& runs) {
  std::string text =
      "# What is hidden. The diagnosis does not read it.\nseed: " + std::to_string(s.seed) +
      "\nhidden:" + (s.hidden.empty() ? " []\n" : "\n");
  for (const Hidden& one : s.hidden) {
    text += "  - {name: " + one.name;
    for (const auto& [key, values] : one.numbers) text += ", " + key + ": " + list(values);
    text += "}\n";
  }
  for (std::size_t d = 0; d < drives.size(); ++d)
    if (const Outside& outside = runs[d].outside; outside.acts)
      text += "# In " + drives[d].name + " it acts from " + list({outside.from}) + " s on, at " +
              list(outside.place) + " m.\n";
  return text;
}

/// Rows of a table with noise, at its rate.
class Table {
 public:
  Table(const std::string& head, std::uint64_t seed)
      : text_("time," + head + "\n"), random_(seed) {}
  void row(double t) { add("%.4f", t), first_ = false; }
  void value(double v, double deviation) {
    text_ += ",";
    const double seen = v + deviation * normal_(random_);
    if (std::isfinite(seen)) add("%.9g", seen);
  }
  void end() { text_ += "\n", first_ = true; }
  const std::string& text() const { return text_; }

 private:
  void add(const char* form, double v) {
    char piece[40];
    std::snprintf(piece, sizeof piece, form, v);
    text_ += piece;
  }
  std::string text_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  bool first_ = true;
};

/// One trial's tables. Rows of wrenches and torques are means over half a sample to either side.
class Tables {
 public:
  Tables(const Setting& s, const Drive& drive, const Run& run, const std::filesystem::path& folder)
      : s_(s), drive_(drive), run_(run), folder_(folder) {}

  void write_all(std::uint64_t seed) {
    write_joints(seed);
    if (s_.commands) write_commands();
    if (s_.torques) write_torques(seed + 4);
    if (!s_.unseen) write_markers(seed + 1);
    write_wrench(seed + 2);
    if (s_.camera) write_pixels(seed + 3);
    if (s_.truss) write_events();
  }

 private:
  std::size_t step(double t) const { return run_.step(t); }

  void write_events() {
    std::string text = "time,event,what,by\n" + list({drive_.grasp}) + ",grasped,fruit,finger\n";
    if (run_.came_off) text += list({*run_.came_off}) + ",detached,fruit,finger\n";
    write(folder_ / "events.csv", text);
  }

  void write_joints(std::uint64_t seed) {
    // A row at t holds what was at t - delay.
    const double delay = hidden_number(s_, "robot_latency", "delay", 0.0);
    Table table("shoulder,elbow,lift", seed);
    for (int r = 0; r <= static_cast<int>(drive_.duration * joint_rate); ++r) {
      const double t = r / joint_rate;
      table.row(t);
      const Vec3 q = run_.joints[step(t - delay)];
      for (int j = 0; j < 3; ++j) table.value(q[j], joint_std);
      table.end();
    }
    write(folder_ / "joints.csv", table.text());
  }

  // What the controller was told is known to every digit.
  void write_commands() {
    Table table("shoulder,elbow,lift", 0);
    for (int r = 0; r <= static_cast<int>(drive_.duration * joint_rate); ++r) {
      const double t = r / joint_rate;
      table.row(t);
      const Vec3 q = drive_.at(t);
      for (int j = 0; j < 3; ++j) table.value(q[j], 0.0);
      table.end();
    }
    write(folder_ / "commands.csv", table.text());
  }

  void write_torques(std::uint64_t seed) {
    Table table("shoulder,elbow,lift", seed);
    for (int r = 0; r <= static_cast<int>(drive_.duration * joint_rate); ++r) {
      const double t = r / joint_rate;
      table.row(t);
      const Vec3 mean = run_.mean_effort(t, joint_rate);
      for (int j = 0; j < 3; ++j) table.value(mean[j], torque_std);
      table.end();
    }
    write(folder_ / "torques.csv", table.text());
  }

  void write_markers(std::uint64_t seed) {
    std::string head;
    for (std::size_t m = 0; m + 1 < run_.markers.front().size(); ++m)
      for (const char axis : {'x', 'y', 'z'}) head += "m" + std::to_string(m) + "." + axis + ",";
    Table table(head + "nail.x,nail.y,nail.z", seed);
    for (int r = 0; r <= static_cast<int>(drive_.duration * marker_rate); ++r) {
      const double t = r / marker_rate;
      table.row(t);
      for (const Vec3& place : run_.markers[step(t)])
        for (int a = 0; a < 3; ++a) table.value(place[a], position_std);
      table.end();
    }
    write(folder_ / "markers.csv", table.text());
  }

  void write_pixels(std::uint64_t seed) {
    std::string head;
    for (std::size_t m = 0; m + 1 < run_.markers.front().size(); ++m)
      for (const char axis : {'u', 'v'}) head += "m" + std::to_string(m) + "." + axis + ",";
    Table table(head + "nail.u,nail.v", seed);
    for (int r = 0; r <= static_cast<int>(drive_.duration * marker_rate); ++r) {
      const double t = r / marker_rate;
      table.row(t);
      for (const Vec3& place : run_.markers[step(t)]) {
        const Eigen::Vector2d point = seen(s_, place);
        for (int a = 0; a < 2; ++a) table.value(point[a], pixel_std);
      }
      table.end();
    }
    write(folder_ / "pixels_left.csv", table.text());
  }

  void write_wrench(std::uint64_t seed) {
    const double gain = hidden_number(s_, "wrench_gain", "gain", 1.0);
    Table table("fx,fy,fz,tx,ty,tz", seed);
    for (int r = 0; r <= static_cast<int>(drive_.duration * wrench_rate); ++r) {
      const double t = r / wrench_rate;
      const Eigen::Matrix<double, 6, 1> mean = gain * run_.mean_wrench(t, wrench_rate);
      table.row(t);
      for (std::size_t a = 0; a < 6; ++a)
        table.value(mean[static_cast<long>(a)] +
                        hidden_number(s_, "wrench_bias", a < 3 ? "force" : "moment", 0.0, a % 3),
                    a < 3 ? force_std : moment_std);
      table.end();
    }
    write(folder_ / "wrench_wrist.csv", table.text());
  }

  const Setting& s_;
  const Drive& drive_;
  const Run& run_;
  std::filesystem::path folder_;
};

}  // namespace

std::vector<Run> make_case(const std::filesystem::path& folder, const Setting& setting) {
  const std::vector<Drive> drives = drives_of(setting);
  write(folder / "reacher.urdf", urdf(setting));
  write(folder / "plant.yaml", plant(setting));
  write(folder / "scene.yaml", scene(setting, drives.front().joints.front()));
  write(folder / "experiment.yaml", experiment(setting, drives));
  std::vector<Run> runs;
  for (std::size_t d = 0; d < drives.size(); ++d) {
    runs.push_back(simulate(setting, drives[d]));
    Tables(setting, drives[d], runs.back(), folder / drives[d].name)
        .write_all(1000 * setting.seed + 10 * d);
  }
  write(folder / "answer.yaml", answer(setting, drives, runs));
  return runs;
}

std::vector<Outside> write_case(const std::filesystem::path& folder, const Setting& setting) {
  std::vector<Outside> outside;
  for (const Run& run : make_case(folder, setting)) outside.push_back(run.outside);
  return outside;
}

}  // namespace pedicel::scene_case
