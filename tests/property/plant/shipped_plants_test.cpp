#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/plant/plant_builder.h"
#include "tests/support/places.h"

// Every plant file that ships builds, and where it is drawn as it hangs, stays there: no node moves
// by more than 1 um in 5 s.
namespace pedicel::plant {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(pedicel::test::source_folder() / "plants"))
    if (entry.path().string().ends_with(".plant.yaml")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class ShippedPlant : public testing::TestWithParam<fs::path> {};

TEST_P(ShippedPlant, BuildsAndStandsAsDrawn) {
  Diagnostics diagnostics;
  const auto plant = read_plant_file(GetParam(), diagnostics);
  ASSERT_TRUE(plant) << diagnostics.text();
  BuildOptions options;
  options.leaf_folders = {pedicel::test::source_folder() / "assets/leaves"};
  const auto built = build_plant(*plant, options, diagnostics);
  ASSERT_TRUE(built) << diagnostics.text();
  EXPECT_EQ(diagnostics.text(), "");  // no warning either: stable
  ASSERT_EQ(built->residual.has_value(), plant->shape == Shape::drawn);
  if (plant->shape == Shape::rest) return;
  // Welds open by force / stiffness: no leaf weighs more than 0.1 N, and an edge gives way a
  // thousand times more than its weld, which leaves far less than a micrometre.
  EXPECT_TRUE(built->residual->settled);
  EXPECT_LT(built->residual->largest, 1.0e-6);
  EXPECT_LE(built->residual->rms, built->residual->largest);

  cosserat::DirectSolver solver({}, built->model);
  cosserat::RodState state = cosserat::drawn_state(built->model);
  cosserat::StepInput input;
  input.dt = 1.0 / 120.0;
  for (int i = 0; i < 600; ++i) solver.step(built->model, state, input);
  double farthest = 0.0;
  for (int e = 0; e < built->model.size(); ++e)
    farthest =
        std::max(farthest, (state.position[e] - built->model.elements[e].drawn_position).norm());
  EXPECT_LT(farthest, 1.0e-6);
}

INSTANTIATE_TEST_SUITE_P(Files, ShippedPlant, testing::ValuesIn(shipped()), [](const auto& file) {
  std::string name = file.param.filename().string();
  name = name.substr(0, name.find('.'));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace pedicel::plant
