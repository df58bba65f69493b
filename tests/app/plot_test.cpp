// Plots: their numbers, and the mouse in them by real input events off screen.
#include "app/ui/plot.h"

#include <algorithm>
#include <charconv>
#include <fstream>

#include "engine/io/csv.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"

namespace pedicel::app {
namespace {

TEST(PlotTicks, HaveTheDigitsThatTellThemApart) {
  const auto texts = [](double low, double high) {
    const std::vector<double> all = ticks(low, high, 4);
    std::vector<std::string> shown;
    for (const double one : all) shown.push_back(tick_text(one, all[1] - all[0]));
    return shown;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(texts(0.1094, 0.1101), ElementsAre("0.1094", "0.1096", "0.1098", "0.1100"));
  EXPECT_THAT(texts(0.0, 2.0), ElementsAre("0", "0.5", "1.0", "1.5", "2.0"));
  EXPECT_THAT(texts(-20.0, 20.0), ElementsAre("-20", "-10", "0", "10", "20"));
  EXPECT_THAT(texts(0.0, 4e-7), ElementsAre("0", "1e-07", "2e-07", "3e-07", "4e-07"));
}

class Plots : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.draw_coarsely();
    desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
    desk_.session().control().run_for(1.0);
    desk_.settle();
    desk_.show("Plots");
    middle_ = ImVec2(0.6f * 1280, 0.86f * 720);
  }

  /// The numbers under the time axis, from left to right.
  std::vector<double> times() {
    desk_.move(0.5 * 1280, 0.3 * 720);  // no tooltip
    desk_.frames(2);
    float lowest = 0.0f;
    const std::vector<SeenLetter> seen = seen_letters("bottom");
    for (const SeenLetter& one : seen)
      if (one.letter == 's' && one.low.x > middle_.x) lowest = std::max(lowest, one.high.y);
    std::vector<double> found;
    std::string number;
    float end = 0.0f;
    const auto finish = [&] {
      double value = 0.0;
      const auto [last, error] =
          std::from_chars(number.data(), number.data() + number.size(), value);
      if (error == std::errc{} && last == number.data() + number.size()) found.push_back(value);
      number.clear();
    };
    for (const SeenLetter& one : seen) {
      if (std::abs(one.high.y - lowest) > 6.0f || one.letter == 's') continue;
      if (!number.empty() && std::abs(one.low.x - end) > 6.0f) finish();
      number += one.letter;
      end = one.high.x;
    }
    finish();
    return found;
  }

  Desk desk_;
  ImVec2 middle_;
};

TEST_F(Plots, ZoomPanAndShowAllAgain) {
  const std::vector<double> all = times();
  ASSERT_GE(all.size(), 3u);
  EXPECT_NEAR(all.front(), 0.0, 0.21);
  EXPECT_NEAR(all.back(), 1.0, 0.21);
  const auto span = [](const std::vector<double>& ticks) { return ticks.back() - ticks.front(); };
  desk_.move(middle_.x, middle_.y);
  desk_.wheel(8);  // 0.85 to the power of 8: about a quarter
  const std::vector<double> near = times();
  ASSERT_GE(near.size(), 2u);
  EXPECT_LT(span(near), 0.5 * span(all));
  EXPECT_GT(near.front(), all.front());
  desk_.drag({middle_, ImVec2(middle_.x + 120, middle_.y)});
  const std::vector<double> earlier = times();
  ASSERT_GE(earlier.size(), 2u);
  EXPECT_LT(earlier.front(), near.front()) << "what is dragged goes with the mouse";
  EXPECT_NEAR(span(earlier), span(near), 0.1);
  desk_.move(middle_.x, middle_.y);
  for (int i = 0; i < 2; ++i) {
    desk_.send(InputEvent::press(0, true));
    desk_.send(InputEvent::press(0, false));
  }
  desk_.drain();
  EXPECT_EQ(times(), all);
}

TEST_F(Plots, WriteWhatTheyShow) {
  const std::filesystem::path before = std::filesystem::current_path();
  const auto folder = std::filesystem::path(::testing::TempDir()) / "plot_csv";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto button = place_of("bottom", "CSV");
  ASSERT_TRUE(button);
  std::filesystem::current_path(folder);
  desk_.click(button->x, button->y);
  std::filesystem::current_path(before);
  const std::string name = desk_.ui().output_stem().filename().string();
  std::ifstream file(folder / (name + "_plot_001.csv"));
  ASSERT_TRUE(file);
  std::string header, line;
  std::getline(file, header);
  ASSERT_TRUE(header.starts_with("time_s,")) << header;
  const RunLog::Series series =
      desk_.session().control().log().series(header.substr(header.find(',') + 1));
  std::vector<std::string> rows;
  while (std::getline(file, line)) rows.push_back(line);
  ASSERT_EQ(rows.size(), series.time.size());
  ASSERT_GT(rows.size(), 10u);
  EXPECT_EQ(rows.back(),
            io::format_number(series.time.back()) + "," + io::format_number(series.value.back()));
}

}  // namespace
}  // namespace pedicel::app
