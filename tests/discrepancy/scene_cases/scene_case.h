#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Measured runs of an arm at a plant, made by MuJoCo: another solver, contact, step and mesh than
/// the diagnosis has, with something hidden in them that its scene does not say.
namespace pedicel::scene_case {

using Vec3 = Eigen::Vector3d;

/// One thing that is hidden. `numbers` as the effect's parameters say, in their units.
struct Hidden {
  std::string name;  ///< an effect's, or "post", or "string"
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
};

/// "NAME KEY=V[,V,V] ...", as a command line gives it. Throws std::invalid_argument.
Hidden hidden_of(const std::string& text);

/// A straight stalk on the stem, with a fruit at its end.
struct Truss {
  double from = 0.3;                      ///< m, height of its foot
  Vec3 direction = {1.0, 0.0, 0.0};       ///< unit, W
  double length = 0.06, radius = 0.0018;  ///< m
  double fruit_radius = 0.014;            ///< m; its centre is the stalk's end
  double fruit_density = 950.0;           ///< kg/m3
  double strength = 2.4;                  ///< N, of the stalk next to the fruit
};

/// An upright stem, and an arm of three joints that holds a level finger: two turn
/// about the vertical, one lifts.
struct Setting {
  std::uint64_t seed = 1;  ///< of sizes, and of the noise
  int trials = 2;          ///< 1 to 4: push, from the other side, higher, slide
  bool camera = false;     ///< a camera beside the plant has seen the markers
  bool unseen = false;     ///< there are no markers: the robot's own sensors are all
  /// The arm's controller is told where to go; what its encoders read is one more observation.
  bool commands = false;
  bool torques = false;  ///< the motors' torques were measured
  std::vector<Hidden> hidden;

  // Drawn from the seed.
  double height = 0.4, radius = 0.004;      ///< m, of the stem
  double modulus = 4.0e8, density = 800.0;  ///< Pa, kg/m3
  double damping_time = 0.006;              ///< s
  Vec3 root = {0.5, 0.0, 0.0};              ///< m, W
  double friction = 0.7;                    ///< 1

  std::optional<Truss> truss;  ///< with one the case is a harvest (harvest_case.h)
};

/// Numbers of a setting that differ from seed to seed.
void draw(Setting& setting);

/// What an effect of the setting has hidden, by its parameter; `otherwise` where it is not hidden.
double hidden_number(const Setting& setting, const std::string& name, const std::string& parameter,
                     double otherwise, std::size_t axis = 0);
bool is_hidden(const Setting& setting, const std::string& name);

/// Where and when something from outside first acts on the stem in a trial.
struct Outside {
  bool acts = false;
  double from = 0.0;          ///< s
  Vec3 place = Vec3::Zero();  ///< m, W, on the stem
};

/// One trial as it is driven: joints (rad, rad, m) at a time.
struct Drive {
  std::string name;
  double duration = 0.0;  ///< s
  std::vector<double> time;
  std::vector<Vec3> joints;  ///< at `time`, moved evenly in jerk between
  double grasp = std::numeric_limits<double>::infinity();  ///< s, when the finger takes the fruit
  bool check = false;                                      ///< held out
  Vec3 at(double t) const;
};
std::vector<Drive> drives_of(const Setting& setting);

/// Joints that put a place of the finger (`along`: share of its length) above a point of the ground
/// at a height (m): the fore arm and the finger lie along one line.
Vec3 reaching(const Vec3& place, double height, double along = 0.6);

/// What MuJoCo's world did in a trial, every step.
struct Run {
  double dt = 0.0;                                  ///< s
  std::vector<Vec3> joints;                         ///< of the encoders, exact
  std::vector<std::vector<Vec3>> markers;           ///< m, W: of the plant, then of the finger
  std::vector<Eigen::Matrix<double, 6, 1>> wrench;  ///< N, N m: of the hand, its frame
  std::vector<Vec3> efforts;              ///< N m, N m, N: of the motors, where they are measured
  std::vector<std::vector<Vec3>> points;  ///< m, W: of the plant, points_of()
  std::optional<double> came_off;         ///< s, the fruit
  /// m, along the stem from its foot: where the finger pushes it; NaN where it does not.
  std::vector<double> pushed;
  Outside outside;

  std::size_t step(double t) const;  ///< the one nearest to a time
  /// What a sensor reports that takes means over half a sample to either side; `rate` in Hz.
  Eigen::Matrix<double, 6, 1> mean_wrench(double t, double rate) const;
  Vec3 mean_effort(double t, double rate) const;
};
Run simulate(const Setting& setting, const Drive& drive);

/// Writes the experiment, and answer.yaml with what is hidden. Returns what really happened, by
/// trial. Throws std::runtime_error where MuJoCo fails.
std::vector<Run> make_case(const std::filesystem::path& folder, const Setting& setting);
/// The same; what acts from outside, by trial.
std::vector<Outside> write_case(const std::filesystem::path& folder, const Setting& setting);

using Place = std::pair<std::string, double>;  ///< curve, and the fraction of its length
std::vector<Place> markers_of(const Setting& setting);
/// Places of a harvest's plant that no instrument sees, for its shape.
std::vector<Place> points_of(const Setting& setting);

// The arm, as the URDF says it.
inline constexpr double shoulder_height = 0.15, upper_length = 0.25, fore_length = 0.2;  // m
inline constexpr double finger_radius = 0.006, finger_length = 0.14;                     // m
inline constexpr double hand_mass = 0.15, finger_mass = 0.05;                            // kg
inline constexpr double wrench_rate = 250.0, marker_rate = 100.0;                        // Hz
inline const Vec3 nail = {0.1, 0.0, 0.01};  // m, the finger's marker, in its link

}  // namespace pedicel::scene_case
