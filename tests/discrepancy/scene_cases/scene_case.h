#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <filesystem>
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

/// An upright stem, and an arm of three joints that holds a level finger: two turn
/// about the vertical, one lifts.
struct Setting {
  std::uint64_t seed = 1;  ///< of sizes, and of the noise
  int trials = 2;          ///< 1 to 4: push, from the other side, higher, slide
  bool camera = false;     ///< a camera beside the plant has seen the markers
  std::vector<Hidden> hidden;

  // Drawn from the seed.
  double height = 0.4, radius = 0.004;      ///< m, of the stem
  double modulus = 4.0e8, density = 800.0;  ///< Pa, kg/m3
  double damping_time = 0.006;              ///< s
  Vec3 root = {0.5, 0.0, 0.0};              ///< m, W
  double friction = 0.7;                    ///< 1
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

/// Writes the experiment, and answer.yaml with what is hidden. Returns what acts from outside, by
/// trial. Throws std::runtime_error where MuJoCo fails.
std::vector<Outside> write_case(const std::filesystem::path& folder, const Setting& setting);

/// One trial as it is driven: joints (rad, rad, m) at a time.
struct Drive {
  std::string name;
  double duration = 0.0;  ///< s
  std::vector<double> time;
  std::vector<Vec3> joints;  ///< at `time`, moved evenly in jerk between
  Vec3 at(double t) const;
};
std::vector<Drive> drives_of(const Setting& setting);

/// What MuJoCo's world did in a trial, every step.
struct Run {
  double dt = 0.0;                                  ///< s
  std::vector<Vec3> joints;                         ///< of the encoders, exact
  std::vector<std::vector<Vec3>> markers;           ///< m, W: of the plant, then of the finger
  std::vector<Eigen::Matrix<double, 6, 1>> wrench;  ///< N, N m: of the hand, its frame
  Outside outside;
};
Run simulate(const Setting& setting, const Drive& drive);

/// Places of the markers: curve and the fraction of its length.
std::vector<std::pair<std::string, double>> markers_of(const Setting& setting);

// The arm, as the URDF says it.
inline constexpr double shoulder_height = 0.15, upper_length = 0.25, fore_length = 0.2;  // m
inline constexpr double finger_radius = 0.006, finger_length = 0.14;                     // m
inline constexpr double hand_mass = 0.15, finger_mass = 0.05;                            // kg
inline const Vec3 nail = {0.1, 0.0, 0.01};  // m, the finger's marker, in its link

}  // namespace pedicel::scene_case
