#pragma once

#include "tests/app/desk.h"
#include "tests/app/words.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {

/// A desk on which nothing lies, and a folder to save into.
class EmptyDesk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.open_empty();
  }
  void run(const std::string& line) {
    const Result result = desk_.session().run_text(line);
    ASSERT_TRUE(result.ok) << result.text;
    desk_.settle();
  }
  /// Clicks on what a window shows with these words.
  void press(const std::string& window, const std::string& words) {
    const auto place = place_of(window, words);
    ASSERT_TRUE(place) << words;
    desk_.click(place->x, place->y);
    desk_.settle();
  }
  const world::Scene& scene() { return *desk_.session().document().scene; }
  Ui& ui() { return desk_.ui(); }
  static bool there(const std::filesystem::path& file) { return std::filesystem::exists(file); }

  TemporaryFolder folder_;
  Desk desk_;
};

}  // namespace pedicel::app
