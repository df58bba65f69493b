// What another solver's junctions may give. A joint has half a segment of its branch below it,
// l/2EI of compliance; a solver that takes the branch's whole segment, l'/EI on its own mesh l',
// adds l'/2EI: a share l'/l of that, the same at all junctions.
#include <gtest/gtest.h>

#include "plugins/discrepancy/fit/causes.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy {
namespace {

using testing::Beam;

Experiment branched(int branches) {
  Experiment experiment = testing::experiment_of({}, 0.1);
  for (int b = 0; b < branches; ++b) {
    plant::PlantCurve branch = experiment.plant().curves[0];
    branch.name = "branch" + std::to_string(b);
    branch.points = {Vec3(0, 0, 0.12 + 0.12 * b), Vec3(0.1, 0, 0.12 + 0.12 * b)};
    experiment.plant().curves.push_back(branch);
  }
  return experiment;
}

struct Give {
  double share, error;  // of l/2EI
};

// Fits that found such shares.
bool by_convention(const std::vector<Give>& found) {
  const Experiment experiment = branched(static_cast<int>(found.size()));
  const Beam beam;
  FitSummary fit;
  fit.hypothesis = junction_nuisance(experiment, {});
  fit.standard_error.resize(fit.hypothesis.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double half = experiment.plant().distance / (2.0 * beam.stiffness());
    fit.hypothesis.set_value(static_cast<int>(i), 1.0 / (found[i].share * half));
    fit.standard_error[i] = found[i].error / found[i].share;  // of its logarithm
  }
  return is_discretisation(fit, static_cast<int>(found.size()), {});
}

TEST(Junctions, AStemWithoutBranchesHasNone) {
  EXPECT_EQ(junction_nuisance(branched(0), {}).size(), 0);
  EXPECT_EQ(junction_nuisance(branched(2), {}).size(), 2);
}

TEST(Junctions, AFinerMeshIsAConvention) {
  EXPECT_TRUE(by_convention({{0.5, 0.02}}));
  EXPECT_TRUE(by_convention({{0.25, 0.05}, {0.3, 0.05}}));
  EXPECT_TRUE(by_convention({{0.42, 0.07}, {0.52, 0.11}}));
}

TEST(Junctions, MoreThanHalfTheFilesSpacingIsAFinding) {
  EXPECT_FALSE(by_convention({{0.74, 0.04}}));
  EXPECT_TRUE(by_convention({{0.74, 0.15}}));  // may still be half
  EXPECT_FALSE(by_convention({{0.7, 0.05}, {0.7, 0.05}}));
}

TEST(Junctions, OneOfSeveralIsAFinding) {
  EXPECT_FALSE(by_convention({{0.5, 0.05}, {0.05, 0.05}}));
  EXPECT_TRUE(by_convention({{0.5, 0.3}, {0.05, 0.05}}));  // may be the same
  EXPECT_FALSE(by_convention({{0.05, 0.05}, {0.05, 0.05}, {0.5, 0.05}}));
}

}  // namespace
}  // namespace pedicel::discrepancy
