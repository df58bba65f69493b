// From the log of a run to an experiment that `validate` accepts, and whose model says what the run
// did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/verbs/import_log.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/mcap/writer.h"
#include "engine/ros_messages/cdr.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene_predict/scene_data.h"
#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

discrepancy::Experiment experiment_of(const std::filesystem::path& folder) {
  Diagnostics diagnostics;
  auto read = discrepancy::read_experiment(folder, diagnostics);
  EXPECT_TRUE(read) << diagnostics.text();
  return read.value_or(discrepancy::Experiment{});
}

ImportArguments arguments(const LoggedRun& run) {
  ImportArguments a;
  a.files = {run.log_file().string()};
  a.scene = run.path("scene.yaml").string();
  a.out = run.path("experiment").string();
  a.quiet = true;
  return a;
}

TEST(LogImport, AProposedMapMakesAnExperimentOfARun) {
  const LoggedRun run;
  const ImportArguments a = arguments(run);
  ASSERT_TRUE(are_logs(a));
  ASSERT_EQ(import_verb(a), 0);
  EXPECT_THAT(
      io::read_file(run.path("experiment/map.yaml")),
      AllOf(HasSubstr("joints: {topic: \"/joint_states\"}\n"),
            HasSubstr("commands: {topic: \"/joint_commands\"}\n"),
            HasSubstr("{name: stem, frame: \"bush/stem\", plant: bush, curve: stem, at: 1}"),
            HasSubstr("{name: wrist, topic: \"/wrist/wrench\", link: arm, tared: false}")));
  const discrepancy::Experiment experiment = experiment_of(a.out);
  ASSERT_EQ(experiment.trials.size(), 1U);
  const discrepancy::Trial& trial = experiment.trials.front();
  EXPECT_EQ(trial.name, "run");
  EXPECT_EQ(trial.joints.size(), 1201);
  EXPECT_EQ(trial.joints.time.front(), 0.0);
  EXPECT_NEAR(trial.joints.value(trial.joints.size() - 1, 0), run.joint(1.2), 2e-3);
  EXPECT_EQ(trial.markers.size(), 121);
  EXPECT_EQ(trial.wrenches.front().size(), 1200);
}

// The table that leads the robot goes along with the scene that names it.
TEST(LogImport, ATrajectoryOfTheSceneGoesAlong) {
  const LoggedRun run("0.03", 0.1);
  std::string scene = io::read_file(run.path("scene.yaml"));
  scene.insert(scene.find("tool: finger") + 12, ", trajectory: path.csv");
  std::ofstream(run.path("scene.yaml")) << scene;
  const ImportArguments a = arguments(run);
  ASSERT_EQ(import_verb(a), 0);
  EXPECT_EQ(io::read_file(run.path("experiment/model/path.csv")),
            io::read_file(run.path("path.csv")));
}

// The run's own scene explains the run: what is left is the difference of two ways to simulate it.
TEST(LogImport, TheModelSaysWhatTheRunDid) {
  const LoggedRun run;
  const ImportArguments a = arguments(run);
  ASSERT_EQ(import_verb(a), 0);
  const discrepancy::Experiment experiment = experiment_of(a.out);
  const discrepancy::SceneReadings readings = discrepancy::readings_of(experiment);
  const discrepancy::Samples& seen = experiment.trials.front().markers;
  double farthest = 0.0, way = 0.0;
  for (int r = 0; r < seen.size(); ++r) {
    farthest = std::max(farthest, (readings.markers.row(r) - seen.value.row(r)).norm());
    way = std::max(way, (seen.value.row(r) - seen.value.row(0)).norm());
  }
  EXPECT_GT(way, 0.02) << "the stem is pushed";
  EXPECT_LT(farthest, 0.05 * way) << "of " << way << " m";
}

TEST(LogImport, AChangedMapCounts) {
  const LoggedRun run;
  ImportArguments a = arguments(run);
  a.names = {run.path("map.yaml").string()};
  a.scene.clear();
  io::write_file_atomically(run.path("map.yaml"), R"(format: pedicel-log-map
version: 1
title: the second half
scene: scene.yaml
joints: {topic: /joint_states}
follows: joints
markers:
  - {name: nail, frame: finger, link: finger}
wrenches:
  - {name: wrist, topic: /wrist/wrench, link: arm, tared: true, reversed: true}
noise: {position_std: 0.0005}
trials:
  - {log: run.mcap, name: late, from: 0.5, to: 1.0, use: check, clock: 3}
)");
  ASSERT_EQ(import_verb(a), 0);
  const discrepancy::Experiment experiment = experiment_of(a.out);
  EXPECT_EQ(experiment.title, "the second half");
  EXPECT_EQ(experiment.noise.position_std, 0.0005);
  const discrepancy::Trial& trial = experiment.trials.front();
  EXPECT_EQ(trial.name, "late");
  EXPECT_EQ(trial.clock, 3.0);
  EXPECT_EQ(trial.use, discrepancy::Trial::Use::check);
  EXPECT_EQ(trial.joints.size(), 501);
  EXPECT_NEAR(trial.joints.value(0, 0), run.joint(0.5), 2e-3);
  EXPECT_TRUE(trial.commands.time.empty());
  EXPECT_GT(trial.wrenches.front().value(0, 2), 3.0) << "turned round";
  EXPECT_NEAR(trial.markers.value(0, 0), 0.4 * std::cos(run.joint(0.5)), 1e-3);
}

/// What the import says of a map that is wrong.
std::string refusal(const LoggedRun& run, const std::string& from, const std::string& to) {
  std::string map =
      "format: pedicel-log-map\nversion: 1\nscene: scene.yaml\njoints: {topic: /joint_states}\n"
      "markers:\n  - {name: m1, frame: bush/stem, curve: stem, at: 1}\n";
  map.replace(map.find(from), from.size(), to);
  io::write_file_atomically(run.path("wrong.yaml"), map);
  ImportArguments a = arguments(run);
  a.names = {run.path("wrong.yaml").string()};
  a.scene.clear();
  try {
    import_verb(a);
  } catch (const InvalidFile& fault) {
    return fault.what();
  }
  return "";
}

TEST(LogImport, SaysWhatIsNotInTheLog) {
  const LoggedRun run("0.03", 0.1);
  EXPECT_THAT(refusal(run, "/joint_states", "/joints"),
              HasSubstr("wrong.yaml:4:9: error: topic \"/joints\" of sensor_msgs/msg/JointState is "
                        "not in run.mcap, expected one of: /joint_"));
  EXPECT_THAT(refusal(run, "frame: bush/stem", "frame: leaf"),
              HasSubstr("wrong.yaml:6:5: error: frame \"leaf\" is not in run.mcap as one that "
                        "moves"));
  EXPECT_THAT(refusal(run, "frame: bush/stem", "topic: /tracks"),
              HasSubstr("topic \"/tracks\" of geometry_msgs/msg/PoseStamped is not in run.mcap"));
  EXPECT_THAT(refusal(run, "scene: scene.yaml", "scene: scene.yaml\nframe: map"),
              HasSubstr("\"bush/stem\" has no way to the frame \"map\""));
  EXPECT_THAT(refusal(run, "{topic: /joint_states}", "{topic: /joint_states, names: {turn: t1}}"),
              HasSubstr("names: \"t1\" is no joint that moves by itself"));
  EXPECT_THAT(
      refusal(run, "scene: scene.yaml", "scene: scene.yaml\ntrials: [{name: a, from: 5, to: 6}]"),
      HasSubstr("no message of /joint_states between from and to"));
}

TEST(LogImport, WhatIsNotInTheSceneIsToldAndNothingIsWritten) {
  const LoggedRun run("0.03", 0.1);
  EXPECT_THAT(refusal(run, "curve: stem", "curve: twig"),
              HasSubstr("wrong.yaml:6:5: error: curve \"twig\" is no curve of the plant \"bush\", "
                        "expected one of: stem"));
  EXPECT_THAT(refusal(run, "curve: stem, at: 1", "link: elbow"),
              HasSubstr("link \"elbow\" is no link of the robot, expected one of: "));
  EXPECT_THAT(refusal(run, "curve: stem, at: 1", "fruit: f9"),
              HasSubstr("fruit \"f9\" is no fruit"));
  EXPECT_THAT(refusal(run, "curve: stem", "plant: tree, curve: stem"),
              HasSubstr("plant \"tree\" is no plant of the scene, expected one of: bush"));
  EXPECT_THAT(refusal(run, "markers:",
                      "wrenches: [{name: w, topic: /wrist/wrench, link: hand9}]\nmarkers:"),
              HasSubstr("link \"hand9\" is no link of the robot"));
  // Of what only the experiment's own reader judges.
  EXPECT_THAT(refusal(run, "scene: scene.yaml", "scene: scene.yaml\nnoise: {position: 3}"),
              HasSubstr("(it is not written)"));
  EXPECT_FALSE(std::filesystem::exists(run.path("experiment")));
}

TEST(LogImport, TwoLogsOfOneNameAreNoTwoTrials) {
  const LoggedRun run("0.03", 0.1);
  ImportArguments a = arguments(run);
  a.files.push_back(a.files.front());
  EXPECT_THROW(import_verb(a), UsageError);
  EXPECT_FALSE(std::filesystem::exists(run.path("experiment")));
}

TEST(LogImport, AMapThatWasChangedIsNotReplacedByAProposal) {
  const LoggedRun run("0.03", 0.1);
  ImportArguments a = arguments(run);
  ASSERT_EQ(import_verb(a), 0);
  ASSERT_EQ(import_verb(a), 0) << "as it was proposed";
  const std::string changed = io::read_file(run.path("experiment/map.yaml")) + "# mine\n";
  io::write_file_atomically(run.path("experiment/map.yaml"), changed);
  EXPECT_THROW(import_verb(a), io::WriteError);
  EXPECT_EQ(io::read_file(run.path("experiment/map.yaml")), changed);
  a.names = {run.path("experiment/map.yaml").string()};
  a.scene.clear();
  EXPECT_EQ(import_verb(a), 0);
  EXPECT_EQ(io::read_file(run.path("experiment/map.yaml")), changed);
}

TEST(LogImport, NeedsAScene) {
  const LoggedRun run("0.03", 0.1);
  ImportArguments a = arguments(run);
  a.scene.clear();
  EXPECT_THROW(import_verb(a), UsageError);
  a.plant = "stem.plant.yaml";
  EXPECT_THROW(import_verb(a), UsageError);
}

// A log as another program writes it: another clock, other names, a malformed message, poses,
// events.
TEST(LogImport, TakesTheLogsOfOthers) {
  const LoggedRun run("0.03", 0.1);
  const std::filesystem::path file = run.path("other.mcap");
  {
    mcap::Writer writer(file, {});
    const auto channel = [&]<class M>(const char* topic, const M&) {
      return writer.add_channel(topic,
                                {M::name, "ros2msg", ros::schema_text(ros::definitions_of<M>())});
    };
    const auto joints = channel("/arm/joint_states", ros::JointState{});
    const auto poses = channel("/tip", ros::PoseStamped{});
    const auto events = channel("/events", ros::String{});
    for (int i = 0; i <= 20; ++i) {
      const double wall = 1.7e9 + 0.01 * i;
      ros::JointState state{
          {ros::stamp_of(wall), ""}, {"other", "shoulder"}, {0.0, 0.005 * i}, {}, {}};
      if (i == 3) std::swap(state.names[0], state.names[1]);
      writer.write(joints, static_cast<std::uint64_t>(wall * 1e9) + 5000000, ros::to_cdr(state));
      ros::PoseStamped pose{{ros::stamp_of(wall), "camera"}, {}};
      pose.pose.position = {0.0, 0.0, 0.001 * i};
      writer.write(poses, static_cast<std::uint64_t>(wall * 1e9), ros::to_cdr(pose));
    }
    writer.write(joints, 1700000001000000000, "no message");
    writer.write(
        events, 1700000000100000000,
        ros::to_cdr(ros::String{R"({"event": "slipped", "what": "bush/stem", "by": "finger"})"}));
    writer.write(events, 1700000000100000000, ros::to_cdr(ros::String{"{not json"}));
  }
  io::write_file_atomically(run.path("map.yaml"), R"(format: pedicel-log-map
version: 1
scene: scene.yaml
frame: {name: camera, position: [0.4, 0.03, 0.5]}
joints: {topic: /arm/joint_states, names: {shoulder: turn}}
events: {topic: /events}
markers:
  - {name: tip, topic: /tip, curve: stem, at: 1}
)");
  ImportArguments a = arguments(run);
  a.files = {file.string()};
  a.scene.clear();
  a.names = {run.path("map.yaml").string()};
  ::testing::internal::CaptureStderr();
  a.quiet = false;
  ASSERT_EQ(import_verb(a), 0);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("/arm/joint_states: 1 of 22 messages are no "
                              "sensor_msgs/msg/JointState; left out"),
                    HasSubstr("/arm/joint_states: 1 messages with other joints"),
                    HasSubstr("/events: 1 texts are no events")));
  const discrepancy::Experiment experiment = experiment_of(a.out);
  const discrepancy::Trial& trial = experiment.trials.front();
  EXPECT_EQ(trial.joints.size(), 20);
  EXPECT_NEAR(trial.joints.time.back(), 0.2, 1e-6);
  EXPECT_NEAR(trial.joints.value(19, 0), 0.1, 1e-12);
  EXPECT_LT((trial.markers.value.row(20).transpose() - Vec3(0.4, 0.03, 0.52)).norm(), 1e-9);
  ASSERT_EQ(trial.events.size(), 1U);
  EXPECT_NEAR(trial.events[0].time, 0.1, 1e-6);
  EXPECT_EQ(trial.events[0].what, "stem");
}

// Names of a log may hold anything, and are no keys of the map that is proposed.
TEST(LogImport, NamesOfALogAreNoLinesOfItsMap) {
  const LoggedRun run("0.03", 0.1);
  const std::filesystem::path file = run.path("odd.mcap");
  {
    mcap::Writer writer(file, {});
    const auto channel = [&]<class M>(const std::string& topic, const M&) {
      return writer.add_channel(topic,
                                {M::name, "ros2msg", ros::schema_text(ros::definitions_of<M>())});
    };
    const std::string break_out = "\nfollows: commands\nframe: nowhere\nx";
    const auto joints = channel("/joint_states", ros::JointState{});
    const auto wrench = channel("/w" + break_out, ros::WrenchStamped{});
    const auto poses = channel("/tip" + break_out, ros::PoseStamped{});
    const auto clock = channel("/clock" + break_out, ros::Clock{});
    for (const char* name : {"/events", "/more/events"})
      writer.write(channel(name, ros::String{}), 0, ros::to_cdr(ros::String{"{}"}));
    for (int i = 0; i <= 20; ++i) {
      const auto time = static_cast<std::uint64_t>(i) * 10000000;
      const ros::Header header{ros::stamp_of(0.01 * i), "hand" + break_out};
      writer.write(joints, time, ros::to_cdr(ros::JointState{header, {"turn"}, {0.0}, {}, {}}));
      writer.write(wrench, time, ros::to_cdr(ros::WrenchStamped{header, {}}));
      writer.write(poses, time, ros::to_cdr(ros::PoseStamped{header, {}}));
      writer.write(clock, time, ros::to_cdr(ros::Clock{}));
    }
  }
  ImportArguments a = arguments(run);
  a.files = {file.string()};
  import_verb(a);
  const std::string map = io::read_file(run.path("experiment/map.yaml"));
  EXPECT_THAT(map, AllOf(HasSubstr("\nevents: {topic: \"/events\"}\n"),
                         HasSubstr("\n# events: {topic: \"/more/events\"}\n"),
                         HasSubstr("#   /clock\\nfollows"), HasSubstr("\nframe: world ")));
  EXPECT_EQ(map.find("\nfollows"), std::string::npos);
}

// As of a run that was reset: a frame has one place at a time.
TEST(LogImport, FramesWhoseTimesGoBackAreLeftOutAndCounted) {
  const LoggedRun run("0.03", 0.1);
  const std::filesystem::path file = run.path("reset.mcap");
  {
    mcap::Writer writer(file, {});
    const auto channel = [&]<class M>(const std::string& topic, const M&) {
      return writer.add_channel(topic,
                                {M::name, "ros2msg", ros::schema_text(ros::definitions_of<M>())});
    };
    const auto joints = channel("/joint_states", ros::JointState{});
    const auto frames = channel("/tf", ros::TFMessage{});
    for (const int first : {0, 1})
      for (int i = 0; i <= 20; ++i) {
        const ros::Header header{ros::stamp_of(0.01 * i), "world"};
        const auto time = static_cast<std::uint64_t>(21 * first + i) * 10000000;
        writer.write(joints, time, ros::to_cdr(ros::JointState{header, {"turn"}, {0.0}, {}, {}}));
        ros::TransformStamped place{header, "bush/stem", {}};
        place.transform.translation = {0.4, 0.03, 0.6 - 0.001 * i - 0.1 * first};
        writer.write(frames, time, ros::to_cdr(ros::TFMessage{{place}}));
      }
  }
  ImportArguments a = arguments(run);
  a.files = {file.string()};
  a.quiet = false;
  ::testing::internal::CaptureStderr();
  import_verb(a);
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              AllOf(HasSubstr("/tf: 20 places of frames whose times go back; left out"),
                    HasSubstr("/joint_states: 21 messages with other joints, without values or not "
                              "in the order of time; left out")));
  const discrepancy::Experiment experiment = experiment_of(a.out);
  ASSERT_EQ(experiment.trials.size(), 1U);
  const discrepancy::Samples& markers = experiment.trials.front().markers;
  ASSERT_EQ(markers.size(), 21);
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(markers.value(i, 2), 0.6 - 0.001 * i, 1e-9) << i;
}

}  // namespace
}  // namespace pedicel::app
