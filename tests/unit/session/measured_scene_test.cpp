// A measured run of a robot at plants beside the document: opening, models, time, diagnosis.
#include <gmock/gmock.h>

#include <cmath>

#include "app/session/measured/diagnosis_card.h"
#include "app/session/measured/scene_instant.h"
#include "app/session/session_files.h"
#include "app/session/session_measured.h"
#include "tests/support/measured_push.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using discrepancy::nominal;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class MeasuredRun : public ::testing::Test {
 protected:
  std::string push(const std::vector<std::string>& effects = {}) {
    pedicel::testing::MeasuredPush of;
    of.effects = effects;
    return of.write(folder_ / "push").string();
  }
  static void open(Session& session, const std::string& path) {
    must(session.run(Command("open experiment", {{"folder", path}})));
  }

  TemporaryFolder folder_;
};

TEST_F(MeasuredRun, OpensTheSceneWithoutItsFiles) {
  Session session(waiting());
  open(session, push());
  const MeasuredScene& scene = session.measured().scene();
  ASSERT_NE(scene.experiment(), nullptr);
  EXPECT_EQ(session.measured().data().experiment(), nullptr);
  EXPECT_TRUE(session.measured().has_scene());
  EXPECT_TRUE(session.files().path().empty()) << "saving must not touch the experiment";
  EXPECT_TRUE(session.document().plants.at(0).entry.file.empty());
  EXPECT_FALSE(session.files().dirty());
  ASSERT_TRUE(session.document().scene->robot);
}

// What made the data predicts them, so each instrument is off by its noise.
TEST_F(MeasuredRun, EveryInstrumentHasItsOwnError) {
  Session session(waiting());
  open(session, push());
  const MeasuredScene& scene = session.measured().scene();
  const auto list = instruments_of(*scene.experiment(), 0);
  ASSERT_THAT(list, SizeIs(5));
  const ScenePath* path = scene.path(nominal, 0);
  ASSERT_NE(path, nullptr);
  ASSERT_THAT(path->rms, SizeIs(5));
  EXPECT_EQ(list[0].name, "markers");
  EXPECT_NEAR(path->rms[0], 0.3, 0.05) << "mm";
  EXPECT_EQ(list[1].name, "camera left");
  EXPECT_NEAR(path->rms[1], 0.4, 0.06) << "px";
  EXPECT_EQ(list[2].name, "force at wrist");
  EXPECT_NEAR(path->rms[2], 0.03, 0.01) << "N";
  EXPECT_EQ(list[4].columns, std::vector<std::string>{"turn"});

  const MeasuredSeries series = scene_series_of(scene, 0, list[0], 3);  // middle.x, mm
  ASSERT_EQ(series.time.size(), series.measured.size());
  EXPECT_NEAR(series.measured[10], 400.0, 3.0);
  EXPECT_NEAR(series.models[0][10], series.measured[10], 3.0);
}

TEST_F(MeasuredRun, ThePlantAndTheArmAreWhereTheTrialHasThem) {
  Session session(waiting());
  open(session, push());
  const MeasuredScene& scene = session.measured().scene();
  const double late = 1.0;
  const SceneInstant instant = scene_instant_of(scene, 0, nominal, late);
  ASSERT_THAT(instant.markers, SizeIs(3));
  EXPECT_LT(instant.markers[0].error().norm(), 2e-3);
  // The stem's last point is the marker at its tip; its first one stands at the root.
  ASSERT_FALSE(instant.shape.empty());
  const ShapeCurve& stem = scene.shapes().at(0).curves.at(0);
  const Vec3 tip = instant.shape[static_cast<std::size_t>(stem.first) + stem.at.size() - 1];
  EXPECT_LT((tip - instant.markers[0].simulated).norm(), 1e-9);
  EXPECT_LT((instant.shape[static_cast<std::size_t>(stem.first)] - Vec3(0.4, 0.03, 0)).norm(),
            1e-9);
  EXPECT_GT((tip - Vec3(0.4, 0.03, 0.6)).norm(), 0.01) << "it was not pushed";
  // The finger's origin lies 0.4 m from the joint's axis, at the joint's angle.
  std::vector<Pose> links;
  scene.arm_at(0, late, links);
  ASSERT_THAT(links, SizeIs(3));
  const double angle = discrepancy::ArmAtStem().joint(late);
  EXPECT_LT((links[2].position - Vec3(0.4 * std::cos(angle), 0.4 * std::sin(angle), 0.3)).norm(),
            1e-4);
}

TEST_F(MeasuredRun, ACameraSawTheMarkersWhereTheModelHasThem) {
  Session session(waiting());
  open(session, push());
  const MeasuredScene& scene = session.measured().scene();
  const auto image = image_instant_of(scene, 0, nominal, 0, 0.5);
  ASSERT_THAT(image, SizeIs(3));
  for (const ImageInstant& one : image) EXPECT_LT((one.measured - one.simulated).norm(), 3.0);
  EXPECT_TRUE(image_instant_of(scene, 0, nominal, 1, 0.5).empty()) << "there is no such camera";
}

// Without marks the plants are shown all the same.
TEST_F(MeasuredRun, ShapesNeedNoMarkers) {
  pedicel::testing::MeasuredPush of;
  of.at.sees_nothing = true;
  of.at.instruments =
      "wrenches:\n  - {name: wrist, link: finger}\nnoise: {force_std: 0.03, moment_std: 0.002, "
      "joint_std: 0.00002, torque_std: 0.05}\n";
  Session session(waiting());
  open(session, of.write(folder_ / "push").string());
  const MeasuredScene& scene = session.measured().scene();
  EXPECT_EQ(instruments_of(*scene.experiment(), 0).front().name, "force at wrist");
  EXPECT_FALSE(scene_instant_of(scene, 0, nominal, 0.5).shape.empty());
  EXPECT_TRUE(std::isfinite(scene.path(nominal, 0)->rms.at(0)));
}

TEST_F(MeasuredRun, LeavesWithItsPlants) {
  Session session(waiting());
  open(session, push());
  session.files().open_empty();
  EXPECT_EQ(session.measured().scene().experiment(), nullptr);
}

TEST_F(MeasuredRun, DoesNotTakeThePlaceOfEdits) {
  Session session(waiting());
  draw_plant(session);
  const Result result = session.run(Command("open experiment", {{"folder", push()}}));
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.text, HasSubstr("changes that are not saved"));
  EXPECT_EQ(session.measured().scene().experiment(), nullptr);
}

TEST_F(MeasuredRun, TakesThePlaceOfAnExperimentOfAPlant) {
  Session session(waiting());
  open(session, push());
  const auto number = session.measured().scene().number();
  must(session.run(Command("close experiment", {})));
  EXPECT_TRUE(session.measured().folder().empty());
  EXPECT_GT(session.measured().scene().number(), number);
}

TEST_F(MeasuredRun, SaysWhatIsWrongWithAFile) {
  const std::string path = push();
  std::filesystem::remove(std::filesystem::path(path) / "push" / "joints.csv");
  Session session(waiting());
  const Result result = session.run(Command("open experiment", {{"folder", path}}));
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.text, HasSubstr("joints.csv"));
}

// Found, accepted as one step, in the run from then on, and taken back.
TEST_F(MeasuredRun, ADiagnosisBecomesPartOfTheScene) {
  Session session(waiting());
  open(session, push({"{name: plant_pose, offset: [0.003, -0.004, 0]}"}));
  const std::uint64_t before = session.document().state_hash();
  EXPECT_FALSE(session.run_text("accept diagnosis").ok);
  const Result found = session.run_text("diagnose threads=1");
  ASSERT_TRUE(found.ok) << found.text;
  EXPECT_THAT(found.text, HasSubstr("plant_pose"));
  EXPECT_EQ(session.measured().diagnoses(), 1);
  const DiagnosisCard card = session.measured().card();
  EXPECT_TRUE(card.good);
  ASSERT_THAT(card.causes, SizeIs(1));
  EXPECT_FALSE(card.next.empty());
  EXPECT_TRUE(session.measured().scene().has(discrepancy::extended));
  EXPECT_LT(session.measured().scene().path(discrepancy::extended, 0)->rms.at(0),
            session.measured().scene().path(nominal, 0)->rms.at(0));

  using Acceptance = SessionMeasured::Acceptance;
  EXPECT_EQ(session.measured().acceptance(), Acceptance::possible);
  must(session.run_text("accept diagnosis"));
  EXPECT_EQ(session.measured().acceptance(), Acceptance::accepted);
  EXPECT_THAT(session.document().scene->effects,
              Contains(Field(&io::YamlPiece::text, HasSubstr("plant_pose"))));
  must(session.run_text("run 0.1"));
  EXPECT_GT(session.snapshot()->time, 0.05);
  must(session.run_text("undo"));
  EXPECT_EQ(session.document().state_hash(), before);
  EXPECT_EQ(session.measured().acceptance(), Acceptance::possible);

  must(session.run(Command("write report", {{"folder", (folder_ / "report").string()}})));
  for (const char* file : {"report.html", "verdict.json", "extended.scene.yaml"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / file)) << file;
}

TEST_F(MeasuredRun, EffectsOfASceneAreACommand) {
  Session session(waiting());
  open(session, push());
  must(session.run_text("set scene effects text=\"[{name: contact_friction, coefficient: 0.3}]\""));
  EXPECT_THAT(session.document().scene->effects, SizeIs(1));
  EXPECT_FALSE(session.run_text("set scene effects text=\"[{name: \"").ok);
  EXPECT_THAT(session.document().scene->effects, SizeIs(1));
}

}  // namespace
}  // namespace pedicel::app
