#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/report/log_plots.h"
#include "app/report/run_report.h"
#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/render/image.h"

namespace pedicel::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ReportTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / "pedicel_report" / info->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  std::string written(const RunSummary& summary) const {
    write_run_report(summary, folder_ / "report.html");
    return io::read_file(folder_ / "report.html");
  }
  std::filesystem::path folder_;
};

/// Ten seconds of a truss whose fruit_b is pulled off at 6 s, with the columns of log.csv.
io::CsvTable truss_log() {
  io::CsvTable log;
  log.columns = {"time_s",
                 "tool_z_m",
                 "energy_kinetic_J",
                 "stretch_max_1",
                 "t/fruit_a_stretch_1",
                 "t/fruit_a_margin_used_1",
                 "t/fruit_b_stretch_1",
                 "t/fruit_b_margin_used_1",
                 "t/fruit_b_z_m",
                 "contact_finger_normal_N",
                 "contact_finger_tangential_N",
                 "contact_base_normal_N",
                 "contact_t/stem_normal_N"};
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.1 * i, pull = t < 6.0 ? t / 6.0 : 0.0, gone = t < 6.0 ? 0.1 * pull : NAN;
    log.rows.push_back({t, 0.3 + 0.01 * t, 0.0, 0.1 * pull, 0.01 * pull, 0.1 * pull, gone, pull,
                        0.3 + 0.01 * pull, 2.0 * pull, 0.7 * pull, 0.0, 2.0 * pull});
  }
  return log;
}

std::vector<std::string> titles(const std::vector<plots::LinePlot>& plots) {
  std::vector<std::string> all;
  for (const plots::LinePlot& plot : plots) all.push_back(plot.title);
  return all;
}

std::vector<std::string> labels(const plots::LinePlot& plot) {
  std::vector<std::string> all;
  for (const plots::PlotSeries& series : plot.series) all.push_back(series.label);
  return all;
}

TEST(LogPlots, ShowStrainAgainstItsLimitForcesAndHeights) {
  const auto plots = log_plots(truss_log(), {{"t/fruit_a", 0.1}, {"t/fruit_b", 0.1}},
                               {{6.0, "t/fruit_b comes off"}});
  EXPECT_THAT(titles(plots), ElementsAre("How near the fruits came to coming off",
                                         "Stretch and shear of the stalks",
                                         "Contact force on the plant", "Heights"));
  // The fruit that came nearest to its limit is first; equal limits are drawn once.
  EXPECT_THAT(labels(plots[1]), ElementsAre("t/fruit_b", "t/fruit_a", "C_s^max = 0.1"));
  EXPECT_THAT(plots[1].series[2].y, ElementsAre(0.1, 0.1));
  EXPECT_THAT(plots[1].series[2].x, ElementsAre(0.0, 10.0));
  // What touched nothing, and the organs' side of the same contacts, are left out.
  EXPECT_THAT(labels(plots[2]), ElementsAre("finger, normal", "finger, friction"));
  EXPECT_THAT(labels(plots[3]), ElementsAre("t/fruit_b", "tool"));
  for (const plots::LinePlot& plot : plots) EXPECT_EQ(plot.events.size(), 1u);
}

TEST(LogPlots, WithoutFruitsShowStrainAndEnergy) {
  io::CsvTable log = truss_log();
  log.columns.resize(4);
  for (auto& row : log.rows) row.resize(4);
  EXPECT_THAT(
      titles(log_plots(log, {}, {})),
      ElementsAre("Heights", "Largest strain of any segment", "Kinetic energy of the plants"));
  EXPECT_TRUE(log_plots({}, {}, {}).empty());
}

TEST(LogPlots, KeepToTheFruitsNearestToTheirLimits) {
  io::CsvTable log;
  log.columns = {"time_s"};
  for (int f = 0; f < 12; ++f) log.columns.push_back("f" + std::to_string(f) + "_margin_used_1");
  log.rows = {{0.0}};
  for (int f = 0; f < 12; ++f) log.rows[0].push_back(0.05 * f);
  const auto plots = log_plots(log, {}, {});
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_THAT(labels(plots[0]), ElementsAre("f11", "f10", "f9", "f8", "f7", "comes off"));
}

TEST_F(ReportTest, IsOnePageWithEverythingInside) {
  render::Image image(8, 4);
  render::write_png(folder_ / "end.png", image);
  RunSummary summary;
  summary.title = "cherry <tomato>";
  summary.purpose = "A fruit is pulled off.";
  summary.expectations = {{"detached_count is 1", "1", true}, {"time below 2", "2.5", false}};
  summary.video = "run.mp4";
  summary.pictures = {{folder_ / "end.png", "At the end"}};
  summary.events = {{"time (s)", "fruit"}, {{"1.25", "truss/fruit_3"}}};
  summary.plots = log_plots(truss_log(), {}, {});
  summary.sweep = {{"C_s^max", "time (s)"}, {{"0.05", "0.8"}, {"0.1", "1.2"}}};
  summary.sweep_plot = sweep_plot("C_s^max (1)", {0.05, 0.1}, "time to detach (s)", {0.8, 1.2});
  summary.solvers = {{"distance (m)", "direct", "position-based"}, {{"0.02", "0.0175", "0.335"}}};
  summary.solver_speeds = {{"solver", "error"}, {{"direct", "0.0004"}}};
  summary.solver_note = "Error: from what the direct solver finds.";
  summary.numbers = {{"real-time factor", "3.1"}};
  const std::string page = written(summary);
  EXPECT_THAT(page, HasSubstr("<h1>cherry &lt;tomato&gt;</h1>"));
  EXPECT_THAT(page, HasSubstr("1 of 2 expectations met."));
  EXPECT_THAT(page, HasSubstr("note bad"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("src=\"run.mp4\""));
  EXPECT_THAT(page, HasSubstr("truss/fruit_3"));
  EXPECT_THAT(page, HasSubstr("time to detach (s) over C_s^max (1)"));
  EXPECT_THAT(page, HasSubstr("<h2>The direct and the position-based solver</h2>"));
  EXPECT_THAT(page, HasSubstr("<h2>Their speed at equal error</h2>"));
  EXPECT_THAT(page, HasSubstr("Error: from what the direct solver finds."));
  EXPECT_THAT(page, HasSubstr("real-time factor"));
  EXPECT_THAT(page, Not(HasSubstr("<h2>Settings</h2>")));  // nothing was given
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));         // nothing from a network
}

TEST_F(ReportTest, SaysWhyARunEndedAndWhichPictureIsMissing) {
  RunSummary summary;
  summary.title = "scene";
  summary.error = "unstable at 0.3 s: truss/stem";
  summary.pictures = {{folder_ / "absent.png", "Before the break"}};
  const std::string page = written(summary);
  EXPECT_THAT(page, HasSubstr("The run ended early: unstable at 0.3 s: truss/stem"));
  EXPECT_THAT(page, HasSubstr("Before the break: "));
  EXPECT_THAT(page, HasSubstr("absent.png"));
}

TEST_F(ReportTest, AFolderThatCannotBeWrittenIsSaid) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THROW(write_run_report({}, folder_ / "file" / "report.html"), io::WriteError);
}

}  // namespace
}  // namespace pedicel::app
