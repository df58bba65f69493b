// The panel of measured data: an experiment opened, looked through, diagnosed, accepted.
#include "app/session/measured/measured_data.h"
#include "app/session/measured/scene_instant.h"
#include "app/session/session_measured.h"
#include "app/view/measured_marks.h"
#include "app/window/measured_image.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene/camera.h"
#include "tests/app/cut_text.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"
#include "tests/support/measured_push.h"
#include "tests/support/measured_stem.h"
#include "tests/support/slow_file.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

class DataPanelTest : public ::testing::Test {
 protected:
  DataPanelTest() : desk_(1280, 900) {
    pedicel::testing::MeasuredStem stem;
    stem.effects = {pedicel::testing::soft_root(0.1)};
    stem.write(folder_ / "stem");
  }
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.ui().view.automatic_quality = false;
    desk_.ui().view.quality = 2;
    desk_.ui().preferences.right_width = 330;
    desk_.show("Data");
  }
  void open() {
    desk_.open(folder_ / "stem");
    if (desk_.session().measured().reading()) desk_.session().measured().finish_reading();
    desk_.session().measured().data().wait();
    desk_.settle();
  }
  std::string keep(const std::string& name) {
    const std::string path = ::testing::TempDir() + "/data_panel_" + name + ".png";
    render::write_png(path, desk_.picture());
    return "picture: " + path;
  }
  /// Fails where words are cut or the panel is empty.
  void check(const std::string& name) {
    const std::string where = keep(name);
    const auto cut = cut_letters();
    EXPECT_TRUE(cut.empty()) << name << ": " << describe(cut) << where;
    for (const auto& [window, px] : overflowing())
      ADD_FAILURE() << window << " is too narrow by " << px << " px\n" << where;
    const ImGuiWindow* window = panel_window("right", "Data");
    ASSERT_NE(window, nullptr);
    EXPECT_GT(drawn_share(desk_.picture(), window->InnerRect), 0.02) << where;
  }
  void must_run(const std::string& line) {
    const Result result = desk_.session().run_text(line);
    EXPECT_TRUE(result.ok) << result.text;
  }
  /// To the end of the panel.
  void scroll_down() {
    const ImGuiWindow* window = panel_window("right", "Data");
    ASSERT_NE(window, nullptr);
    desk_.move(window->InnerRect.GetCenter().x, window->InnerRect.Min.y + 60);
    for (int i = 0; i < 60; ++i) desk_.wheel(-1);
  }
  /// Pixels of the scene that are near to a hue, as a share.
  double share_of(const render::Colour& colour) {
    const render::Image image = desk_.picture();
    const SceneFrame& scene = desk_.desktop().scene().frame();
    long found = 0, all = 0;
    for (int y = static_cast<int>(scene.low.y); y < scene.low.y + scene.size.y; ++y)
      for (int x = static_cast<int>(scene.low.x); x < scene.low.x + scene.size.x; ++x, ++all) {
        const std::uint8_t* p = image.at(x, y);
        const double length = std::hypot(p[0], p[1], p[2]) + 1.0;
        const double own = std::hypot(colour.r, colour.g, colour.b);
        const double same = (p[0] * colour.r + p[1] * colour.g + p[2] * colour.b) / length / own;
        found += same > 0.985 && length > 120.0;
      }
    return static_cast<double>(found) / static_cast<double>(all);
  }

  TemporaryFolder folder_;
  Desk desk_;
};

TEST_F(DataPanelTest, ShowsTheMarkersOverThePlant) {
  const double before = share_of(measured_colour);
  open();
  desk_.ui().view.measured.time = 0.2;
  desk_.frames(4);
  check("opened");
  EXPECT_GT(share_of(measured_colour), before + 1e-4) << keep("opened");
  EXPECT_EQ(desk_.ui().view.hidden_plant, 0) << "the model's shape stands for the plant";

  // Without marks nothing orange is left.
  desk_.ui().view.measured.markers = desk_.ui().view.measured.errors = false;
  desk_.frames(3);
  EXPECT_LT(share_of(measured_colour), before + 1e-4);
}

// Beads that lie within a thick stem cannot be seen.
TEST_F(DataPanelTest, MarkersStandOutOfThickStems) {
  discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  for (plant::PlantCurve& curve : e.plant().curves) curve.radius = {0.02};
  discrepancy::write_experiment(folder_ / "stem", e);
  open();
  MeasuredMarks marks;
  marks.update(desk_.ui().view, desk_.session(), *desk_.snapshot());
  render::DrawList list;
  marks.add_to(list);
  ASSERT_FALSE(list.spheres.empty());
  for (const auto& bead : list.spheres) EXPECT_GT(bead.radius, 0.022);
}

TEST_F(DataPanelTest, SaysWhatIsOpenAndHasNoLegendOfAHiddenPlant) {
  open();
  EXPECT_TRUE(place_of("right", "/stem")) << keep("path");
  desk_.ui().view.colours = ColourMap::margin;
  desk_.frames(3);
  EXPECT_FALSE(place_of("##Foreground", "used of the threshold")) << keep("legend");
  desk_.ui().view.measured.shape = false;
  desk_.frames(3);
  EXPECT_TRUE(place_of("##Foreground", "used of the threshold")) << keep("legend");
}

TEST_F(DataPanelTest, PlaysThroughTheTrial) {
  open();
  desk_.ui().view.measured.playing = true;
  desk_.frames(4);
  EXPECT_GT(desk_.ui().view.measured.time, 0.0);
  desk_.ui().view.measured.playing = false;
  const double time = desk_.ui().view.measured.time;
  desk_.frames(4);
  EXPECT_EQ(desk_.ui().view.measured.time, time);
}

TEST_F(DataPanelTest, ResidualColoursTheStem) {
  open();
  desk_.ui().view.measured.time = 0.2;
  desk_.ui().view.measured.errors = desk_.ui().view.measured.markers = false;
  desk_.frames(3);
  const render::Image plain = desk_.picture();
  desk_.ui().view.colours = ColourMap::residual;
  desk_.frames(3);
  check("residual");
  const render::Image mapped = desk_.picture();
  long changed = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i)
    changed += std::abs(plain.rgb[i] - mapped.rgb[i]) > 30;
  EXPECT_GT(changed, 200);
  // The running plant has its elements' residuals, too: more at its tip than at its foot.
  const std::vector<double>& residual = desk_.ui().view.residual;
  ASSERT_EQ(residual.size(), desk_.snapshot()->plants[0].model->elements.size());
  EXPECT_GT(residual.back(), residual.front());
}

TEST_F(DataPanelTest, TheMeasuredForceIsPlottedBesideTheModels) {
  discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  discrepancy::Samples& force = e.trials[0].force;
  force.time = e.trials[0].markers.time;
  force.value = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(force.time.size()), 3, 0.05);
  discrepancy::write_experiment(folder_ / "stem", e);
  desk_.show("Plots");
  EXPECT_FALSE(place_of("bottom", "trial: force_N")) << "no experiment, no force";
  open();
  desk_.frames(4);
  EXPECT_TRUE(place_of("bottom", "trial: force_x_N")) << keep("force");
  EXPECT_TRUE(place_of("bottom", "measured force_N")) << keep("force");
  EXPECT_TRUE(place_of("bottom", "nominal force_N")) << keep("force");
  const auto cut = cut_letters();
  EXPECT_TRUE(cut.empty()) << describe(cut) << keep("force");
}

TEST_F(DataPanelTest, AFolderIsReadBesideAndCancelledByAButton) {
  SlowFile table(folder_ / "stem" / "along_y" / "markers.csv");
  ASSERT_TRUE(table.made());
  desk_.session().run(Command("open experiment", {{"folder", (folder_ / "stem").string()}}));
  for (int i = 0; i < 500 && !place_of("right", "trial 2 of 2"); ++i) desk_.frames(1);
  EXPECT_TRUE(place_of("right", "trial 2 of 2")) << keep("reading");
  check("reading");
  const auto button = place_of("right", "Cancel");
  ASSERT_TRUE(button) << keep("reading");
  desk_.click(button->x, button->y);
  EXPECT_EQ(desk_.session().measured().reading(), nullptr) << keep("reading");
  EXPECT_EQ(desk_.session().measured().data().experiment(), nullptr);
}

TEST_F(DataPanelTest, DiagnosisIsStartedCancelledShownAndAccepted) {
  open();
  must_run("diagnose threads=1");
  desk_.frames(4);
  check("running");
  must_run("cancel diagnosis");
  desk_.session().measured().data().wait();

  must_run("diagnose threads=2");
  desk_.session().measured().data().wait();
  ASSERT_NE(desk_.session().measured().data().diagnosis(), nullptr);
  desk_.ui().view.measured.side_by_side = true;
  desk_.ui().view.measured.model = discrepancy::extended;
  desk_.ui().view.measured.time = 0.2;
  desk_.ui().ask(Action::frame_all);
  desk_.frames(6);
  check("diagnosed");
  must_run("accept diagnosis");
  desk_.settle();
  scroll_down();
  check("accepted");
}

/// A robot at a plant in place of a plant alone.
class SceneDataPanelTest : public DataPanelTest {
 protected:
  void open_push(double k1 = 0.0) {
    pedicel::testing::MeasuredPush push;
    discrepancy::Experiment e = push.experiment();
    e.cameras.at(0).distortion[0] = k1;
    discrepancy::write_experiment(folder_ / "push", e);
    desk_.open(folder_ / "push");
    if (desk_.session().measured().reading()) desk_.session().measured().finish_reading();
    desk_.session().measured().scene().wait();
    desk_.settle();
  }
};

TEST_F(SceneDataPanelTest, ShowsTheRunOfARobotAtPlants) {
  open_push();
  desk_.ui().view.measured.time = 1.0;
  desk_.frames(4);
  check("scene");
  EXPECT_TRUE(desk_.ui().view.hides_plants) << "the model's shape stands for the plants";
  ASSERT_EQ(desk_.ui().view.links.size(), 3u);
  const double angle = discrepancy::ArmAtStem().joint(1.0);
  EXPECT_NEAR(desk_.ui().view.links[2].position.y(), 0.4 * std::sin(angle), 1e-4);
  EXPECT_TRUE(place_of("right", "force at wrist")) << keep("scene");
  desk_.ui().view.measured.shape = false;
  desk_.frames(3);
  EXPECT_FALSE(desk_.ui().view.hides_plants);
  EXPECT_TRUE(desk_.ui().view.links.empty());
  scroll_down();
  check("scene_end");
}

// A point's picture by the renderer lies where the measured camera's picture of it is drawn.
TEST_F(SceneDataPanelTest, AMeasuredCameraIsLookedThrough) {
  open_push(-0.2);
  desk_.ui().view.measured.time = 0.5;
  desk_.ui().view.measured.camera = 0;
  desk_.frames(3);
  const discrepancy::Camera* camera = looked_through(desk_.ui());
  ASSERT_NE(camera, nullptr);
  const SceneFrame& frame = desk_.desktop().scene().frame();
  for (const Vec3& point : {Vec3(0.4, 0.03, 0.0), Vec3(0.4, 0.03, 0.6), Vec3(0.1, 0.3, 0.5)}) {
    const auto drawn = frame.project(point);
    ASSERT_TRUE(drawn);
    const ImVec2 seen = image_place(*camera, frame, discrepancy::image_of(*camera, point));
    EXPECT_NEAR(seen.x, drawn->x, 0.01);
    EXPECT_NEAR(seen.y, drawn->y, 0.01);
  }
  // A ring about each measured marker: orange at its radius.
  const render::Image image = desk_.picture();
  const auto points = image_instant_of(desk_.session().measured().scene(), 0, discrepancy::nominal,
                                       0, desk_.ui().view.measured.time);
  ASSERT_EQ(points.size(), 3u);
  for (const ImageInstant& one : points) {
    const ImVec2 at = image_place(*camera, frame, one.measured);
    int found = 0;
    for (int i = 0; i < 60; ++i) {
      const double angle = 2.0 * M_PI * i / 60.0;
      const std::uint8_t* p = image.at(static_cast<int>(at.x + 6.0 * std::cos(angle)),
                                       static_cast<int>(at.y + 6.0 * std::sin(angle)));
      found += p[0] > 180 && p[2] < 120;
    }
    EXPECT_GT(found, 30) << keep("camera");
  }
  // Whoever turns the picture leaves the camera.
  desk_.move(frame.low.x + 0.5f * frame.size.x, frame.low.y + 0.5f * frame.size.y);
  desk_.wheel(1);
  desk_.frames(2);
  EXPECT_EQ(looked_through(desk_.ui()), nullptr);
}

}  // namespace
}  // namespace pedicel::app
