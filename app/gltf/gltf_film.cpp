#include "app/gltf/gltf_film.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <span>

#include "app/draw/drawing.h"
#include "app/gltf/gltf_surfaces.h"
#include "app/report/version.h"
#include "engine/core/check.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

namespace {

using Json = nlohmann::ordered_json;

/// Something that moves: where it was in every frame.
struct Track {
  std::string name;
  int mesh = -1;
  std::function<std::optional<Pose>()> look;  // nothing: it is not there
  std::vector<float> places, turns, sizes;    // m; x, y, z, w; 0 or 1 three times
};

// Each frame is the one before, turned by the shortest way: the tube between two has no twist.
Pose pose_along(std::span<const Vec3> places, std::size_t index) {
  Vec3 axis = Vec3::UnitZ();
  Quat turn = Quat::Identity();
  for (std::size_t i = 0; i <= index; ++i) {
    const std::size_t next = std::min(i + 1, places.size() - 1);
    const Vec3 way = places[next] - places[next - 1];
    if (!(way.norm() > 0.0)) continue;  // a clip
    turn = Quat::FromTwoVectors(axis, way.normalized()) * turn;
    axis = way.normalized();
  }
  return {places[index], turn};
}

class GltfFilm : public RunWatcher {
 public:
  GltfFilm(simulation::Simulation& simulation, std::filesystem::path file)
      : simulation_(simulation), file_(std::move(file)) {
    int elements = 0;
    for (int p = 0; p < simulation.rods().size(); ++p)
      elements += simulation.rods().model(p).size();
    if (elements > gltf_most_elements)
      throw UsageError("--gltf: the scene has " + std::to_string(elements) +
                       " rod elements, expected at most " + std::to_string(gltf_most_elements));
    add_robot();
    for (int p = 0; p < simulation.rods().size(); ++p) add_plant(p);
    add_strings();
    check_size();
  }

  void begin() override { take_frame(); }
  void after_step() override {
    const double fps = simulation_.scene().video.fps;
    const long due = std::lround(std::floor(simulation_.world().time() * fps + 1e-9));
    if (due != last_due_) last_due_ = due, take_frame();
  }
  void end() override { write(); }

 private:
  /// All frames are kept until the end, and what the file says of its own size ends at 4 GB.
  void check_size() const {
    constexpr double most = 1.0e9, bytes = sizeof(float) * 10;  // of a track in a frame
    const world::Scene& scene = simulation_.scene();
    const double frames = scene.duration * scene.video.fps;
    const double size = frames * bytes * static_cast<double>(tracks_.size());
    if (size <= most) return;
    char text[200];
    std::snprintf(text, sizeof text,
                  "--gltf: %.3g frames of %zu moving parts take %.3g GB, expected at most 1 GB (a "
                  "lower --fps or a shorter --duration)",
                  frames, tracks_.size(), 1.0e-9 * size);
    throw UsageError(text);
  }

  void add(const std::string& name, const render::DrawList& shape,
           std::function<std::optional<Pose>()> look) {
    const std::vector<GltfSurface> surfaces = surfaces_of(shape);
    if (surfaces.empty()) return;
    tracks_.push_back({name, gltf_.mesh(name, surfaces), std::move(look), {}, {}, {}});
  }

  void add_robot() {
    const simulation::RobotControl* robot = simulation_.robot();
    if (!robot) return;
    const std::vector<render::DrawList> shapes = robot_shapes(robot->description());
    for (std::size_t l = 0; l < shapes.size(); ++l)
      add(robot->description().links[l].name, shapes[l],
          [robot, l] { return std::optional(robot->link_pose(static_cast<int>(l))); });
  }

  void add_plant(int p) {
    const cosserat::RodModel& model = simulation_.rods().model(p);
    skins_.push_back({model.name, tracks_.size(), static_cast<std::size_t>(model.size()),
                      gltf_.mesh(model.name, surfaces_of(model, simulation_.plants()[p]))});
    for (int e = 0; e < model.size(); ++e) {
      const auto at = static_cast<std::size_t>(e);
      tracks_.push_back({model.organs[static_cast<std::size_t>(model.elements[at].organ)],
                         -1,
                         [this, p, at]() -> std::optional<Pose> {
                           const cosserat::RodState& state = simulation_.rods().state(p);
                           if (!state.alive[at]) return std::nullopt;
                           return Pose{state.position[at], state.orientation[at]};
                         },
                         {},
                         {},
                         {}});
    }
    const FruitLook look = FruitLook::of(simulation_.plants()[p].look);
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
      add(simulation::fruit_name(model, f), fruit_shape(look, f, model.fruits[f].radius),
          [this, p, f]() -> std::optional<Pose> {
            const cosserat::RodModel& own = simulation_.rods().model(p);
            const cosserat::RodState& state = simulation_.rods().state(p);
            const cosserat::Fruit& fruit = own.fruits[f];
            if (state.fruit_gone[f] || !state.alive[fruit.element]) return std::nullopt;
            return Pose{point_on(own, state, fruit.element, fruit.back),
                        state.orientation[fruit.element]};
          });
  }

  // A string is a skin on the places along it.
  void add_strings() {
    for (const simulation::SceneTies::One& tie : simulation_.ties().all()) {
      constexpr int places = string_parts + 1;
      skins_.push_back(
          {tie.name, tracks_.size(), places, gltf_.mesh(tie.name, {string_surface(places)})});
      for (std::size_t i = 0; i < places; ++i)
        tracks_.push_back({tie.name,
                           -1,
                           [this, &tie, i]() -> std::optional<Pose> {
                             const auto course = simulation_.ties().course(tie);
                             if (!course) return std::nullopt;
                             return pose_along(
                                 string_course(course->from_W, course->to_W, course->length), i);
                           },
                           {},
                           {},
                           {}});
    }
  }

  // Fruits that came off are bodies that were not there before.
  void add_bodies() {
    const world::SimWorld& world = simulation_.world();
    for (; bodies_ < world.body_count(); ++bodies_) {
      const int b = bodies_;
      render::DrawList shape = body_shape(world.body(b));
      for (const simulation::Detached& fallen : simulation_.plant_step().detached())
        if (fallen.body == b)
          shape = fruit_shape(
              FruitLook::of(simulation_.plants()[fallen.plant].look), fallen.event.fruit,
              simulation_.rods().model(fallen.plant).fruits[fallen.event.fruit].radius,
              fallen.event.stub_length, fallen.event.stub_radius);
      const std::size_t before = tracks_.size();
      add(world.body(b).name, shape, [&world, b] { return std::optional(world.body_pose(b)); });
      if (tracks_.size() > before) hide_until_now(tracks_.back());
    }
  }

  void hide_until_now(Track& track) const {
    const Pose now = track.look().value_or(Pose{});
    for (std::size_t i = 0; i < times_.size(); ++i) put(track, now, false);
  }

  static void put(Track& track, const Pose& pose, bool there) {
    for (int i = 0; i < 3; ++i) track.places.push_back(static_cast<float>(pose.position[i]));
    Eigen::Vector4f turn = pose.rotation.normalized().coeffs().cast<float>();
    // The same side as before, so that what is between two frames is between them.
    if (const std::size_t n = track.turns.size(); n >= 4)
      if (turn.dot(Eigen::Map<const Eigen::Vector4f>(track.turns.data() + n - 4)) < 0.0F)
        turn = -turn;
    for (int i = 0; i < 4; ++i) track.turns.push_back(turn[i]);
    for (int i = 0; i < 3; ++i) track.sizes.push_back(there ? 1.0F : 0.0F);
  }

  void take_frame() {
    add_bodies();
    times_.push_back(static_cast<float>(simulation_.world().time()));
    for (Track& track : tracks_) {
      const std::optional<Pose> pose = track.look();
      if (pose) {
        put(track, *pose, true);
        continue;
      }
      Pose last;
      if (const std::size_t n = track.places.size(); n >= 3) {
        const float* place = track.places.data() + n - 3;
        const float* turn = track.turns.data() + track.turns.size() - 4;
        last = {{place[0], place[1], place[2]}, Quat(turn[3], turn[0], turn[1], turn[2])};
      }
      put(track, last, false);
    }
  }

  /// Whether all frames of a track have the same values.
  static bool is_fixed(const std::vector<float>& values, std::size_t width) {
    for (std::size_t i = width; i < values.size(); ++i)
      if (values[i] != values[i % width]) return false;
    return true;
  }

  void add_channel(Json& animation, int node, const char* path, const std::vector<float>& values,
                   const char* type, const char* between, int times) {
    animation["samplers"].push_back(
        {{"input", times}, {"output", gltf_.floats(values, type)}, {"interpolation", between}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", path}}}});
  }

  Json node_of(const Track& track, int number, int times, Json& animation) {
    Json node = {{"name", track.name}};
    if (track.mesh >= 0) node["mesh"] = track.mesh;
    node["translation"] = std::vector<float>(track.places.begin(), track.places.begin() + 3);
    node["rotation"] = std::vector<float>(track.turns.begin(), track.turns.begin() + 4);
    node["scale"] = std::vector<float>(track.sizes.begin(), track.sizes.begin() + 3);
    if (!is_fixed(track.places, 3))
      add_channel(animation, number, "translation", track.places, "VEC3", "LINEAR", times);
    if (!is_fixed(track.turns, 4))
      add_channel(animation, number, "rotation", track.turns, "VEC4", "LINEAR", times);
    if (!is_fixed(track.sizes, 3))
      add_channel(animation, number, "scale", track.sizes, "VEC3", "STEP", times);
    return node;
  }

  void write() {
    Json& json = gltf_.json();
    json["asset"] = {{"version", "2.0"}, {"generator", "pedicel " + version()}};
    json["scene"] = 0;
    Json animation = {{"name", "run"}, {"samplers", Json::array()}, {"channels", Json::array()}};
    const int times = gltf_.floats(times_, "SCALAR", true);
    // glTF's Y is up, ours is Z: a quarter turn about X.
    const double half = std::sqrt(0.5);
    Json nodes = Json::array(), children = Json::array(), roots = {0};
    nodes.push_back({{"name", simulation_.scene().name}, {"rotation", {-half, 0.0, 0.0, half}}});
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const int number = static_cast<int>(t) + 1;
      nodes.push_back(node_of(tracks_[t], number, times, animation));
      children.push_back(number);
    }
    if (!children.empty()) nodes[0]["children"] = children;
    for (const Skin& skin : skins_) {
      Json joints = Json::array();
      for (std::size_t j = 0; j < skin.joints; ++j) joints.push_back(skin.first + j + 1);
      json["skins"].push_back({{"name", skin.name}, {"skeleton", 0}, {"joints", joints}});
      roots.push_back(nodes.size());
      nodes.push_back(
          {{"name", skin.name}, {"mesh", skin.mesh}, {"skin", json["skins"].size() - 1}});
    }
    json["nodes"] = nodes;
    json["scenes"] = Json::array();
    json["scenes"].push_back({{"name", simulation_.scene().name}, {"nodes", roots}});
    if (!animation["channels"].empty()) json["animations"].push_back(animation);
    gltf_.write(file_);
  }

  struct Skin {
    std::string name;
    std::size_t first = 0, joints = 0;  // tracks
    int mesh = 0;
  };
  simulation::Simulation& simulation_;
  std::filesystem::path file_;
  GltfFile gltf_;
  std::vector<Track> tracks_;
  std::vector<Skin> skins_;
  std::vector<float> times_;  // s
  int bodies_ = 0;
  long last_due_ = 0;
};

}  // namespace

MakeWatcher gltf_film(const std::filesystem::path& file) {
  return [file](simulation::Simulation& simulation, PictureTaker*) {
    return std::make_unique<GltfFilm>(simulation, file);
  };
}

}  // namespace pedicel::app
