// Strings are seen wherever a run is seen: in pictures, in moving scenes, in markers and logs.
#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "app/draw/scene_view.h"
#include "app/gltf/gltf_film.h"
#include "app/playback/log_film.h"
#include "app/topics/mcap_log.h"
#include "tests/unit/app/contact_cases.h"

namespace pedicel::app {
namespace {

constexpr int steps = 120;

/// A stem that a slack string holds at a post, a taut one that pulls it to another stem, and one
/// at a twig that is cut off half way.
class StringsSeen : public testing::Test {
 protected:
  void SetUp() override {
    files_.write("stem.plant.yaml", stem_file("[0, 0, 0]", "[0, 0, 0.5]", 0.003, 1.0e8));
    sim_ = files_.simulation(
        "plants:\n"
        "  - {name: one, file: stem.plant.yaml}\n"
        "  - {name: two, file: stem.plant.yaml, position: [0.3, 0, 0]}\n"
        "  - {name: three, file: stem.plant.yaml, position: [0.6, 0, 0]}\n"
        "ties:\n"
        "  - {organ: one/stem, at: 0.9, to: [-0.3, 0, 0.6], length: 0.4}\n"
        "  - {organ: one/stem, at: 0.8, to_organ: two/stem, to_at: 0.8, length: 0.28, stiffness: "
        "200}\n"
        "  - {organ: three/stem, at: 1, to: [0.9, 0, 0.6]}\n"
        "cuts:\n  - {organ: three/stem, at: 0.5, time: 0.25}\n");
    ASSERT_EQ(sim_->ties().all().size(), 3u);
  }
  /// Where a string begins and ends now.
  std::optional<std::pair<Vec3, Vec3>> ends(std::size_t tie) const {
    const auto course = sim_->ties().course(sim_->ties().all()[tie]);
    if (!course) return {};
    return std::pair(course->from_W, course->to_W);
  }
  void run(RunWatcher& watcher) const {
    watcher.begin();
    for (int i = 0; i < steps; ++i) {
      sim_->step();
      watcher.after_step();
    }
    watcher.end();
    ASSERT_FALSE(ends(2)) << "what it held was cut off";
  }

  SceneCase files_;
  TemporaryFolder folder_;
  std::unique_ptr<simulation::Simulation> sim_;
};

TEST_F(StringsSeen, InPicturesAndFilms) {
  SceneView view(*sim_);
  const auto shown = [&](const Vec3& from, const Vec3& to) {
    Frame frame;
    view.fill(frame);
    bool begins = false, ends = false;
    double lowest = 1.0;
    for (const render::Capsule& part : frame.list.capsules) {
      if (part.r0 != string_radius) continue;
      begins = begins || (part.p0 - from).norm() < 1e-9;
      ends = ends || (part.p1 - to).norm() < 1e-9;
      if (part.p1.x() < -0.01) lowest = std::min(lowest, part.p1.z());
    }
    EXPECT_LT(lowest, 0.43) << "the slack one sags below both of its ends";
    return begins && ends;
  };
  const auto last = ends(2);
  for (std::size_t tie = 0; tie < 3; ++tie) EXPECT_TRUE(shown(ends(tie)->first, ends(tie)->second));
  for (int i = 0; i < steps; ++i) sim_->step();
  for (std::size_t tie = 0; tie < 2; ++tie) EXPECT_TRUE(shown(ends(tie)->first, ends(tie)->second));
  EXPECT_FALSE(shown(last->first, last->second));
}

TEST_F(StringsSeen, InMarkersAndInAPlayedLog) {
  const auto first = ends(0), gone = ends(2);
  const auto file = folder_ / "run.mcap";
  run(*mcap_log(file)(*sim_, nullptr));
  const LogFilm film(file, {});
  const auto shown = [&](double time, const Vec3& from, const Vec3& to) {
    render::DrawList list;
    film.fill(time, list);
    bool begins = false, ends = false;
    for (const render::TubeSegment& part : list.tubes) {
      if (std::abs(part.r0 - string_radius) > 1e-6) continue;  // a float
      begins = begins || (part.p0 - from).norm() < 1e-6;
      ends = ends || (part.p1 - to).norm() < 1e-6;
    }
    return begins && ends;
  };
  EXPECT_TRUE(shown(0.0, first->first, first->second));
  EXPECT_TRUE(shown(0.0, gone->first, gone->second));
  EXPECT_NEAR(film.end(), 0.5, 1e-6);
  for (std::size_t tie = 0; tie < 2; ++tie)
    EXPECT_TRUE(shown(film.end(), ends(tie)->first, ends(tie)->second)) << tie;
  EXPECT_GT((ends(0)->first - first->first).norm(), 1e-3) << "it has moved";
  EXPECT_FALSE(shown(film.end(), gone->first, gone->second));
}

/// A GLB's JSON, and the numbers of its accessors.
struct Gltf {
  explicit Gltf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string all(std::istreambuf_iterator<char>(in), {});
    std::uint32_t length = 0;
    std::memcpy(&length, all.data() + 12, 4);
    json = nlohmann::json::parse(all.substr(20, length));
    bytes = all.substr(20 + length + 8);
  }
  std::vector<float> floats(int accessor, std::size_t width) const {
    const auto& one = json["accessors"][accessor];
    const auto& view = json["bufferViews"][one["bufferView"].get<int>()];
    std::vector<float> values(one["count"].get<std::size_t>() * width);
    std::memcpy(values.data(), bytes.data() + view["byteOffset"].get<std::size_t>(),
                values.size() * sizeof(float));
    return values;
  }
  /// Three of what a channel says in its last frame; what the node says where nothing changes.
  Vec3 last(int node, const std::string& path) const {
    const auto& run = json["animations"][0];
    std::vector<float> values = json["nodes"][node][path].get<std::vector<float>>();
    for (const auto& channel : run["channels"])
      if (channel["target"]["node"] == node && channel["target"]["path"] == path)
        values = floats(run["samplers"][channel["sampler"].get<int>()]["output"].get<int>(), 3);
    const std::size_t n = values.size();
    return {values[n - 3], values[n - 2], values[n - 1]};
  }
  nlohmann::json json;
  std::string bytes;
};

TEST_F(StringsSeen, InMovingScenes) {
  const auto file = folder_ / "run.glb";
  run(*gltf_film(file)(*sim_, nullptr));
  const Gltf gltf(file);
  int strings = 0;
  for (const auto& skin : gltf.json["skins"]) {
    if (!skin["name"].get<std::string>().starts_with("tie_")) continue;
    const auto joints = skin["joints"].get<std::vector<int>>();
    ASSERT_EQ(joints.size(), static_cast<std::size_t>(string_parts + 1));
    const auto now = ends(static_cast<std::size_t>(strings++));
    const Vec3 size = gltf.last(joints.front(), "scale");
    EXPECT_EQ(size, now ? Vec3(Vec3::Ones()) : Vec3(Vec3::Zero())) << skin["name"];
    if (!now) continue;
    EXPECT_LT((gltf.last(joints.front(), "translation") - now->first).norm(), 1e-5);
    EXPECT_LT((gltf.last(joints.back(), "translation") - now->second).norm(), 1e-5);
  }
  EXPECT_EQ(strings, 3);
  // Its surface is as wide as it is drawn, and hangs on all of its joints.
  for (const auto& mesh : gltf.json["meshes"]) {
    if (mesh["name"] != "tie_1") continue;
    const auto places = gltf.floats(mesh["primitives"][0]["attributes"]["POSITION"].get<int>(), 3);
    for (std::size_t v = 0; v < places.size(); v += 3) {
      EXPECT_NEAR(std::hypot(places[v], places[v + 1]), string_radius, 1e-7);
      EXPECT_EQ(places[v + 2], 0.0F);
    }
    EXPECT_EQ(places.size(), 3u * 8u * (string_parts + 1));
  }
}

}  // namespace
}  // namespace pedicel::app
