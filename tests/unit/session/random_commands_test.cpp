// 200 random commands by seed, undone one by one, restore every state hash on the way; redone, they
// give the same again; and their texts, replayed, too.
#include <set>

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "app/session/history.h"
#include "engine/core/check.h"
#include "engine/core/random.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

Vec3 random_point(Random& random) {
  return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.0, 0.4)};
}

std::vector<Vec3> random_points(Random& random) {
  std::vector<Vec3> points;
  for (int i = random.integer(2, 6); i > 0; --i) points.push_back(random_point(random));
  return points;
}

template <typename Items>
std::string some(Random& random, const Items& items) {
  if (items.empty()) return "nothing";
  return items[random.integer(0, static_cast<int>(items.size()) - 1)].name;
}

/// A command that may well be impossible: what there is is hit mostly, not always.
Command random_command(Random& random, const Document& document, int number) {
  const plant::PlantFile& plant = document.plant("p");
  const std::string stem = some(random, plant.curves), fruit = some(random, plant.fruits);
  const std::string fresh = "x" + std::to_string(number);
  const Value p = "p";
  switch (random.integer(0, 20)) {
    case 0:
    case 1:
      return {"draw stem",
              {{"plant", p},
               {"stem", fresh},
               {"points", random_points(random)},
               {"radius", std::vector<double>{random.uniform(0.001, 0.01)}}}};
    case 2:
      return {"delete stem", {{"plant", p}, {"stem", stem}}};
    case 3:
      return {"rename", {{"plant", p}, {"name", stem}, {"new_name", fresh}}};
    case 4:
    case 5:
      return {"move point",
              {{"plant", p},
               {"stem", stem},
               {"point", random.integer(0, 3)},
               {"to", random_point(random)}}};
    case 6:
      return {"insert point", {{"plant", p}, {"stem", stem}, {"at", random.uniform()}}};
    case 7:
      return {"delete point", {{"plant", p}, {"stem", stem}, {"point", random.integer(0, 4)}}};
    case 8:
      return {"smooth points", {{"plant", p}, {"stem", stem}, {"share", random.uniform(0.1, 1)}}};
    case 9:
      return {"set radius",
              {{"plant", p},
               {"stem", stem},
               {"radius", random.uniform(0.001, 0.01)},
               {"point", random.integer(-1, 3)}}};
    case 10:
      return {"taper", {{"plant", p}, {"stem", stem}, {"from", 0.005}, {"to", 0.002}}};
    case 11:
      return {"mirror stem", {{"plant", p}, {"stem", stem}}};
    case 12:
    case 13:
      return {"add fruit",
              {{"plant", p},
               {"name", fresh},
               {"stem", stem},
               {"at", random.uniform()},
               {"radius", 0.01}}};
    case 14:
      return {"move organ",
              {{"plant", p}, {"name", fruit}, {"stem", stem}, {"at", random.uniform()}}};
    case 15:
      return {"set organ",
              {{"plant", p}, {"name", fruit}, {"key", "bend"}, {"value", random.uniform()}}};
    case 16:
      return {"set", {{"key", "coupling.friction"}, {"value", std::to_string(random.uniform())}}};
    case 17:
      return {"trim stem", {{"plant", p}, {"stem", stem}, {"at", random.uniform(0.5, 1.0)}}};
    case 18:
    case 19: {
      const char* const kinds[] = {"corner", "linear", "smooth"};
      return {"set point kind",
              {{"plant", p},
               {"stem", stem},
               {"point", random.integer(0, 3)},
               {"kind", kinds[random.integer(0, 2)]}}};
    }
    default:
      return {"set length", {{"plant", p}, {"stem", stem}, {"length", random.uniform(0.05, 0.5)}}};
  }
}

class RandomCommands : public ::testing::TestWithParam<int> {};

TEST_P(RandomCommands, UndoneOneByOneRestoreEveryState) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  Document document = empty_document();
  apply_command(document, Command("new plant", {{"plant", "p"}}));
  History history;
  std::vector<std::uint64_t> hashes = {document.state_hash()};
  std::vector<std::string> lines;
  std::set<std::string> verbs;
  int refused = 0;
  for (int number = 0; lines.size() < 200; ++number) {
    ASSERT_LT(number, 2000) << "nearly everything is refused";
    const Command command = random_command(random, document, number);
    const Document before = document;
    try {
      apply_command(document, command);
    } catch (const UsageError&) {
      ++refused;
      ASSERT_EQ(document.state_hash(), before.state_hash()) << "refused, yet: " << command.text();
      continue;
    }
    history.add({{command}, before, document});
    lines.push_back(command.text());
    verbs.insert(command.verb());
    hashes.push_back(document.state_hash());
  }
  EXPECT_GT(verbs.size(), 14u);
  EXPECT_GT(std::set<std::uint64_t>(hashes.begin(), hashes.end()).size(), 180u);

  for (std::size_t i = 200; i > 0; --i) {
    ASSERT_TRUE(history.can_undo());
    document = history.undo();
    ASSERT_EQ(document.state_hash(), hashes[i - 1]) << "undoing " << lines[i - 1];
  }
  EXPECT_FALSE(history.can_undo());
  for (std::size_t i = 0; i < 200; ++i) {
    document = history.redo();
    ASSERT_EQ(document.state_hash(), hashes[i + 1]) << "redoing " << lines[i];
  }
  EXPECT_FALSE(history.can_redo());

  Document replayed = empty_document();
  apply_command(replayed, Command("new plant", {{"plant", "p"}}));
  for (std::size_t i = 0; i < 200; ++i) {
    Diagnostics diagnostics;
    const auto command = parse_command(lines[i], {}, diagnostics);
    ASSERT_TRUE(command.has_value()) << lines[i] << diagnostics.text();
    apply_command(replayed, *command);
    ASSERT_EQ(replayed.state_hash(), hashes[i + 1]) << lines[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCommands, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace pedicel::app
