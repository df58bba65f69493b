#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "engine/io/yaml_piece.h"
#include "engine/world/bodies.h"
#include "engine/world/expectation.h"
#include "engine/world/sensors.h"
#include "engine/world/variation.h"

namespace pedicel::world {

/// A key of a settings section or a `set:` map. The scene does not know what plugins it feeds: it
/// keeps the text with its place, and whoever owns the parameter reads it (world/settings.h).
struct Setting {
  std::string key;
  std::string text;
  SourcePosition where;
};

/// A thing that a place is given relative to. It is looked up when the world is built, so that a
/// scene stays right when its plant is edited.
struct Anchor {
  enum class Kind { none, fruit, body, plant, tool };
  Kind kind = Kind::none;
  std::string name;  ///< "truss/fruit_3" for a fruit
  SourcePosition where;
};

/// A plant, or a grid of equal plants.
struct ScenePlant {
  enum class Source { file, mtg, built_in };
  std::string name;
  Source source = Source::file;
  std::filesystem::path file;  ///< plant or MTG file
  double unit = 0.0;           ///< m, of the lengths in an MTG or a table; 0: as the file says
  std::string built_in;        ///< name of a plant that is made by the program ("forest")
  bool optional = false;       ///< a missing file skips the scene (or takes the fallback)
  std::filesystem::path
      fallback;  ///< plant file taken where an optional one is absent; may be empty
  Pose pose;     ///< X_WP
  std::array<int, 2> repeat{1, 1};    ///< plants along X and Y
  Eigen::Vector2d spacing{0.5, 0.5};  ///< m
  std::vector<VariedNumber> vary;     ///< in what the plants of a grid differ
  std::vector<Setting> set;           ///< e.g. detach.stretch
  SourcePosition where;
};

/// Where the tool is to be at a time.
struct SceneWaypoint {
  double time = 0.0;  ///< s
  Anchor at;
  Vec3 position = Vec3::Zero();     ///< m, W; added to the anchor's place where there is one
  std::optional<Quat> orientation;  ///< tool to W; absent: as at the waypoint before
  std::optional<double> gripper;    ///< opening, m; absent: as before
  SourcePosition where;
};

/// Joint positions at a time, recorded by hand: kept in the scene to be played when asked for.
struct RecordedPose {
  double time = 0.0;           ///< s, after the program's start
  std::vector<double> joints;  ///< rad or m, one a degree of freedom
  bool operator==(const RecordedPose&) const = default;
};

inline constexpr double largest_gripper_force = 1.0e6;  ///< N (or N m)

struct SceneRobot {
  std::string name = "robot";
  std::filesystem::path file;
  std::vector<std::pair<std::string, std::filesystem::path>> packages;
  Pose base;                             ///< X_W
  std::map<std::string, double> joints;  ///< start values, rad or m
  std::map<std::string, SourcePosition> joints_where;
  std::string control = "position";  ///< position | velocity | torque
  std::string tool;                  ///< link that waypoints move; empty: the robot's own choice
  Vec3 tool_offset = Vec3::Zero();   ///< m, in the tool link
  std::string gripper;               ///< joint that `gripper:` moves; empty: none
  /// N (or N m), at most largest_gripper_force: what the gripper's joint may press with, where that
  /// is less than its own effort; 0: its own.
  double gripper_force = 0.0;
  std::filesystem::path trajectory;  ///< CSV of joint positions; empty: none
  std::vector<SceneWaypoint> waypoints;
  std::vector<RecordedPose> recorded;  ///< times from 0 s on that increase; not played by itself
  SourcePosition where;
};

/// A force on a fruit or an organ's end in the world frame.
struct SceneLoad {
  std::string target;           ///< "truss/fruit_3"
  Vec3 force = Vec3::Zero();    ///< N
  double from = 0.0, to = 0.0;  ///< s, acts for from <= t < to
  bool ramp = false;            ///< grows linearly from 0 at `from` to the whole force at `to`
  SourcePosition where;
};

/// A string that ties a place of a plant to a fixed point, or to a place of a plant, which it pulls
/// as hard: it bears no pressure.
struct SceneTie {
  std::string organ;       ///< "PLANT/CURVE" or "PLANT/FRUIT"; each plant of a grid
  double at = 1.0;         ///< fraction of the curve's length, from its foot
  Vec3 to = Vec3::Zero();  ///< m, W; from the tied place as drawn where `is_offset`
  bool is_offset = false;
  std::string to_organ;          ///< in place of `to`: where it ends; empty: at a point
  std::optional<double> to_at;   ///< 1, as `at`; absent: nearest to the tied place as drawn
  std::optional<double> length;  ///< m, where it becomes taut; absent: as drawn
  double stiffness = 1.0e4;      ///< N/m
  SourcePosition where;
};

/// A cut through a stem: at a time, or by the tool as soon as it is near enough.
struct SceneCut {
  std::string organ;           ///< "PLANT/CURVE"
  double at = 0.0;             ///< fraction of the curve's length, from its foot
  std::optional<double> time;  ///< s; absent: by the tool
  double reach = 0.01;         ///< m, from the tool's point to the stem's axis
  SourcePosition where;
};

/// Wind over the whole scene.
struct SceneWind {
  Vec3 velocity = Vec3::Zero();  ///< m/s, W, the mean at `height`
  double height = 2.0;           ///< m
  double roughness = 0.0;  ///< m, of the ground: the mean grows with ln(z / roughness); 0: not
  double intensity = 0.0;  ///< 1, rms of the gusts over the mean
  double length = 3.0;     ///< m, of the gusts
  double rise = 0.5;       ///< s, over which it sets in
  bool shelter = true;     ///< plants take wind from those behind them
};

struct SceneCamera {
  std::string name;
  Vec3 eye = Vec3(1.5, -1.5, 1.0), target = Vec3::Zero();  ///< m, W; relative to `follow` if given
  Vec3 up = Vec3::UnitZ();                                 ///< W, towards the upper edge
  double field_of_view = 0.7;                              ///< rad, vertical
  Anchor follow;
  std::array<int, 2> size{640, 480};  ///< px, of what its sensors write
  double rate = 10.0;                 ///< Hz, of its sensors
  std::vector<Sensor> sensors;        ///< what a run writes of it; empty: nothing
  CameraNoise noise;
};

/// An instrument on a link of the robot, or on a plant. Each kind has some of the keys.
struct SceneInstrument {
  explicit SceneInstrument(const InstrumentKind& of) : noise(of) {}
  const InstrumentKind& kind() const { return *noise.kind; }

  std::string name;
  std::string link, organ;  ///< one of them: a link's name, or "PLANT/CURVE" or "PLANT/FRUIT"
  double at = 1.0;          ///< fraction of the curve's length, from its foot
  Pose pose;                ///< of its frame, in the link's or in the organ's, whose z is along it
  /// Of a wrench. False: what the link and all beyond it exert on what carries it (a wrist), weight
  /// and inertia included. True: only what plants and bodies exert on the link (a fingertip).
  bool touch = false;
  bool tared = false;   ///< less its mean over the first 0.2 s
  double rate = 100.0;  ///< Hz
  InstrumentNoise noise;
  SourcePosition where;
};

struct ScenePicture {
  enum class When { time, before_detachment, after_detachment, end };
  When when = When::time;
  double time = 0.0;    ///< s
  std::string camera;   ///< empty: the first
  bool strain = false;  ///< stems coloured by their strain
};

struct SceneVideo {
  double fps = 30.0;
  std::array<int, 2> size{1280, 720};
  std::string camera;
};

struct SceneSweep {
  std::string key;
  std::vector<double> values;
  SourcePosition where;
};

/// A scene file as it is written: plain data, nothing of it built yet.
struct Scene {
  std::filesystem::path file;
  std::string name, purpose, see;
  double duration = 1.0;    ///< s
  double dt = 1.0 / 240.0;  ///< s
  double log_rate = 100.0;  ///< Hz
  int seed = 0;
  int threads = 1;
  Vec3 gravity = Vec3(0, 0, -9.81);
  std::vector<Setting> rods, coupling;
  std::vector<ScenePlant> plants;
  std::optional<SceneRobot> robot;
  std::vector<BodyDescription> bodies;
  std::optional<GroundPlane> ground;
  std::vector<SceneLoad> loads;
  std::vector<SceneTie> ties;
  std::optional<SceneWind> wind;
  std::vector<SceneCut> cuts;
  /// What its robot, contacts, plants and instruments do beyond the plain model: read by whoever
  /// knows effects.
  std::vector<io::YamlPiece> effects;
  std::vector<SceneCamera> cameras;
  std::vector<SceneInstrument> instruments;  ///< kind by kind
  SceneLook look;
  std::vector<VariedNumber> vary;  ///< drawn from the seed where a run begins (drawn_scene())
  std::vector<ScenePicture> pictures;
  SceneVideo video;
  std::optional<SceneSweep> sweep;
  std::vector<Expectation> expectations;
};

/// The instruments of a kind, in the scene's order.
template <class AnyScene>  // Scene, const or not
auto of_kind(AnyScene& scene, const InstrumentKind& kind) {
  return scene.instruments |
         std::views::filter([&kind](const SceneInstrument& one) { return &one.kind() == &kind; });
}

}  // namespace pedicel::world
