#include "app/ui/bindings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

TEST(Bindings, NoKeyDoesTwoThings) {
  std::map<std::tuple<Key, bool, bool>, Action> seen;
  for (const Binding& b : bindings()) {
    const auto [at, fresh] = seen.insert({{b.key, b.control, b.shift}, b.action});
    EXPECT_TRUE(fresh) << key_text(b);
  }
}

TEST(Bindings, EveryActionSaysOneThing) {
  std::map<Action, std::string> sentences;
  for (const Binding& b : bindings()) {
    EXPECT_STRNE(b.sentence, "");
    const auto [at, fresh] = sentences.insert({b.action, b.sentence});
    EXPECT_EQ(at->second, b.sentence);
  }
}

TEST(Bindings, TheHabitsOfTheField) {
  EXPECT_EQ(keys_of(Action::play_pause), "Space");
  EXPECT_EQ(keys_of(Action::reload), "Ctrl+R, Ctrl+L");
  EXPECT_EQ(keys_of(Action::redo), "Ctrl+Shift+Z, Ctrl+Y");
  EXPECT_THAT(keys_of(Action::faster), HasSubstr("+"));
  EXPECT_EQ(keys_of(Action::cancel), "Esc");
  EXPECT_EQ(keys_of(Action::quit), "Ctrl+Q");
}

}  // namespace
}  // namespace pedicel::app
