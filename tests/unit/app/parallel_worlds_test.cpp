// Worlds of one scene read the same meshes and fields and still do not influence each other.
#include "app/bench/parallel_worlds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "plugins/simulation/scene_assets.h"
#include "tests/support/stem_plants.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

// A load bends the stem against a link of the robot until its fruit comes off and falls: worlds
// with contact, with a plant that changes and with one rigid body more.
const char* const scene_text = R"(format: pedicel-scene
version: 1
purpose: a stem is pulled against a robot
see: the fruit comes off
duration: 0.2
plants:
  - {name: stem, file: stem.plant.yaml}
robot: {name: arm, file: arm.urdf, joints: {slide: 0.1}}
loads:
  - {fruit: stem/tip, force: [4, 0, 0], from: 0, to: 0.15, ramp: true}
ground: {height: 0}
)";

const std::string plant_text = bent_stem_text + R"(fruits:
  - {name: tip, curve: stem, at: 1.0, radius: 0.01, density: 900, detach: {force: 2}}
)";

// Two links, each with a block that the stem leans on, of one mesh.
const char* const robot_text = R"(<robot name='arm'>
<link name='base'>
  <collision><origin xyz='0.04 0 0.02'/><geometry><mesh filename='block.obj'/></geometry></collision>
</link>
<link name='slider'>
  <inertial><mass value='1'/>
    <inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>
  <collision><origin xyz='0.04 0 0'/><geometry><mesh filename='block.obj'/></geometry></collision>
</link>
<joint name='slide' type='prismatic'>
  <parent link='base'/><child link='slider'/><axis xyz='0 0 1'/>
  <limit lower='0' upper='1' effort='100' velocity='1'/>
</joint>
</robot>
)";

const char* const block_text = R"(v -0.02 -0.02 -0.02
v  0.02 -0.02 -0.02
v -0.02  0.02 -0.02
v  0.02  0.02 -0.02
v -0.02 -0.02  0.02
v  0.02 -0.02  0.02
v -0.02  0.02  0.02
v  0.02  0.02  0.02
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
)";

class SceneWorlds : public ::testing::Test {
 protected:
  SceneWorlds() {
    ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    io::write_file_atomically(folder_ / "stem.plant.yaml", plant_text);
    io::write_file_atomically(folder_ / "arm.urdf", robot_text);
    io::write_file_atomically(folder_ / "block.obj", block_text);
    io::write_file_atomically(folder_ / "pulled.scene.yaml", scene_text);
    Diagnostics diagnostics;
    scene_ = world::read_scene(folder_ / "pulled.scene.yaml", diagnostics);
    if (!scene_) throw InvalidFile(diagnostics);
  }
  ~SceneWorlds() override { ::unsetenv("XDG_CACHE_HOME"); }

  std::shared_ptr<const simulation::SceneAssets> assets() const {
    return std::make_shared<const simulation::SceneAssets>(*scene_,
                                                           simulation::SimulationOptions{});
  }

  TemporaryFolder folder_;
  std::optional<world::Scene> scene_;
};

/// Steps to the scene's end; the hash then.
std::uint64_t finish(simulation::Simulation& simulation) {
  while (simulation.world().time() < simulation.scene().duration - 0.5 * simulation.world().dt())
    simulation.step();
  return simulation.state_hash();
}

TEST_F(SceneWorlds, TheSecondWorldHoldsTheSameFieldsMeshesAndPlantDescriptions) {
  const auto shared = assets();
  const simulation::Simulation first(shared), second(shared);
  EXPECT_EQ(shared.use_count(), 3);  // no world has assets of its own
  EXPECT_EQ(&first.plants(), &second.plants());
  int fields = 0;
  ASSERT_EQ(first.colliders().size(), second.colliders().size());
  for (int c = 0; c < first.colliders().size(); ++c) {
    if (first.colliders().collider(c).body != simulation::robot_body) continue;
    EXPECT_EQ(first.colliders().collider(c).shape, second.colliders().collider(c).shape);
    EXPECT_EQ(first.colliders().collider(c).shape, shared->robot_fields.at(0).at(0));  // one mesh
    ++fields;
  }
  EXPECT_EQ(fields, 2);
  for (const simulation::Simulation* world : {&first, &second})
    for (const robot::Link& link : world->robot()->description().links)
      EXPECT_EQ(link.collisions.at(0).geometry.mesh,
                shared->robot->links.at(0).collisions.at(0).geometry.mesh);
}

TEST_F(SceneWorlds, AFruitThatComesOffInOneWorldStaysOnInTheOthers) {
  simulation::Simulation alone(*scene_, {});
  const std::uint64_t expected = finish(alone);
  ASSERT_EQ(alone.plant_step().detached().size(), 1u);

  const auto shared = assets();
  simulation::Simulation first(shared), second(shared);
  bool touched = false;
  while (first.plant_step().detached().empty() && first.world().time() < scene_->duration)
    touched |= first.step().contacts > 0;
  EXPECT_TRUE(touched);
  simulation::Simulation third(shared);  // made of assets whose fruit the first world has lost
  EXPECT_FALSE(second.rods().state(0).fruit_gone.at(0));
  EXPECT_FALSE(third.rods().state(0).fruit_gone.at(0));
  EXPECT_EQ(finish(third), expected);
  EXPECT_EQ(finish(first), expected);
  EXPECT_EQ(finish(second), expected);
}

TEST_F(SceneWorlds, AnyNumberOfWorldsAndThreadsEndsInTheStateOfOneSimulation) {
  simulation::Simulation alone(*scene_, {});
  const std::uint64_t expected = finish(alone);
  WorldsOptions options;
  options.dt = scene_->dt;
  options.duration = scene_->duration - 10 * scene_->dt;  // 10 steps of warm-up
  for (const auto& [worlds, threads] : {std::pair(1, 1), {4, 1}, {4, 2}, {3, 2}, {2, 4}}) {
    options.worlds = worlds;
    options.threads = threads;
    EXPECT_EQ(run_worlds(scene_worlds(*scene_, {}), options).state_hash, expected)
        << worlds << " worlds, " << threads << " threads";
  }
}

TEST(RodWorlds, AnyNumberOfWorldsAndThreadsEndsInTheStateOfOneBench) {
  BenchOptions bench;
  bench.name = "row_1k";
  bench.duration = 0.02;
  bench.accuracy = false;
  const std::uint64_t expected = run_bench(bench).state_hash;
  for (const auto& [worlds, threads] : {std::pair(1, 1), {4, 1}, {4, 2}}) {
    const WorldsResult result =
        run_worlds(rod_worlds(bench), {worlds, threads, bench.dt, bench.duration});
    EXPECT_EQ(result.state_hash, expected) << worlds << " worlds, " << threads << " threads";
    EXPECT_EQ(result.worlds, worlds);
    EXPECT_EQ(result.threads, threads);
    EXPECT_GT(result.one_real_time_factor, 0.0);
    EXPECT_GT(result.real_time_factor, 0.0);
  }
}

/// A world whose state is a number that grows by `pace` with every step.
class Counter : public ParallelWorld {
 public:
  explicit Counter(std::uint64_t pace, std::string failure = {})
      : pace_(pace), failure_(std::move(failure)) {}
  void step() override { state_ += pace_; }
  std::uint64_t state_hash() const override { return state_; }
  std::string failure() const override { return failure_; }

 private:
  std::uint64_t pace_, state_ = 0;
  std::string failure_;
};

/// What run_worlds() throws for four worlds of this kind.
std::string refusal(const MakeWorld& make) {
  try {
    run_worlds(make, {4, 2, 0.1, 1.0});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(RunWorlds, EveryWorldTakesEveryStep) {
  const MakeWorld make = [] { return std::make_unique<Counter>(1); };
  EXPECT_EQ(run_worlds(make, {5, 2, 0.1, 1.0}).state_hash, 10u + 10u);  // warm-up and 1 s
}

TEST(RunWorlds, AWorldThatGoesItsOwnWayIsNamed) {
  int made = 0;  // the first is the one that is stepped alone
  EXPECT_EQ(refusal([&] { return std::make_unique<Counter>(++made == 4 ? 2 : 1); }),
            "world 3 ended in another state than one alone");
}

TEST(RunWorlds, AnUnstableWorldIsNoResult) {
  EXPECT_EQ(refusal([] { return std::make_unique<Counter>(1, "shorten the step"); }),
            "world 1 is unstable: shorten the step");
}

TEST(RunWorlds, NumbersBelow1AreRefused) {
  const MakeWorld make = [] { return std::make_unique<Counter>(1); };
  EXPECT_THROW(run_worlds(make, {0, 1, 0.1, 1.0}), UsageError);
  EXPECT_THROW(run_worlds(make, {1, 0, 0.1, 1.0}), UsageError);
}

}  // namespace
}  // namespace pedicel::app
