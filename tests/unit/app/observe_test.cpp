#include "app/verbs/observe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "app/verbs/validate.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Observe : public ::testing::Test {
 protected:
  Observe() {
    discrepancy::Experiment like = discrepancy::testing::experiment_of({}, 0.2);
    like.trials[0].holds = {{discrepancy::testing::on_stem(1.0),
                             discrepancy::testing::resting_at(Vec3(0.001, 0, 0.4)), 0.1, 50.0}};
    like.trials[0].markers.value.row(3).head<3>().setConstant(NAN);
    discrepancy::write_experiment(folder_ / "like", like);
    arguments_.model = arguments_.like = (folder_ / "like").string();
    arguments_.distance = 0.02;
    arguments_.dt = 1.0 / 480;
  }

  discrepancy::Experiment observe(const std::string& out) {
    arguments_.out = (folder_ / out).string();
    EXPECT_EQ(observe_verb(arguments_), 0);
    Diagnostics diagnostics;
    const auto read = discrepancy::read_experiment(folder_ / out, diagnostics);
    EXPECT_TRUE(read) << diagnostics.text();
    return read.value_or(discrepancy::Experiment{});
  }

  TemporaryFolder folder_;
  ObserveArguments arguments_;
};

TEST_F(Observe, WritesWhatTheInstrumentsWouldReport) {
  const auto found = observe("out");
  const discrepancy::Trial& trial = found.trials.at(0);
  EXPECT_EQ(trial.holds.at(0).release, 0.1);
  // Two springs in series (so little that the spring does not stretch the stem: at 10 mm it holds
  // the tip up and stiffens it by 4 %); a gap stays one.
  const discrepancy::testing::Beam beam;
  const double series = 1.0 / (1.0 / 50.0 + 1.0 / beam.tip_stiffness());
  EXPECT_NEAR(trial.force.value(0, 0) / (series * 0.001), 1.0, 1e-2);
  EXPECT_TRUE(trial.markers.value.row(3).head<3>().array().isNaN().all());
  EXPECT_FALSE(found.noise.position_std);
  std::ostringstream said;
  EXPECT_EQ(validate_files({arguments_.out, arguments_.out + "/experiment.yaml"}, {}, said), 0);
  EXPECT_THAT(said.str(), HasSubstr("experiment, good; 1 trials, 2 markers, 21 samples"));
}

TEST_F(Observe, SetEffectsAreSimulatedAndNotWritten) {
  const auto plain = observe("plain");
  arguments_.set = {"{name: base_compliance, stiffness: 0.05}"};
  const auto soft = observe("soft");
  EXPECT_TRUE(soft.plant().effects.empty());
  EXPECT_LT(soft.trials[0].force.value(0, 0), 0.9 * plain.trials[0].force.value(0, 0));
}

// A scene's plant, as the scene changes it: twice the modulus makes it twice as stiff, in series
// with the spring that holds it.
TEST_F(Observe, TakesAPlantOfAScene) {
  plant::PlantFile stem = discrepancy::testing::plant_of({});
  const double modulus = stem.material.youngs_modulus.value();
  plant::write_plant_file(folder_ / "stem.plant.yaml", stem);
  const auto write_scene = [&](const std::string& plants) {
    io::write_file_atomically(folder_ / "a.scene.yaml",
                              "format: pedicel-scene\nversion: 1\nname: a\npurpose: p\nsee: s\n"
                              "duration: 1\nplants:\n" +
                                  plants);
    arguments_.model = (folder_ / "a.scene.yaml").string();
  };
  const std::string plain = "  - {name: plain, file: stem.plant.yaml}\n";
  const std::string stiff =
      "  - {name: stiff, file: stem.plant.yaml, position: [1, 0, 0], "
      "set: {material.youngs_modulus: " +
      io::format_number(2.0 * modulus) + "}}\n";
  write_scene(plain);
  const auto soft = observe("soft");
  write_scene(plain + stiff);
  EXPECT_THROW(observe_verb(arguments_), UsageError);
  arguments_.plant = "other";
  EXPECT_THROW(observe_verb(arguments_), UsageError);
  arguments_.plant = "stiff";
  const auto found = observe("stiff");
  EXPECT_EQ(found.plant().material.youngs_modulus, 2.0 * modulus);
  const auto force = [](const discrepancy::Experiment& e) { return e.trials[0].force.value(0, 0); };
  const double k = discrepancy::testing::Beam().tip_stiffness();
  const auto series = [](double stiffness) { return 1.0 / (1.0 / 50.0 + 1.0 / stiffness); };
  EXPECT_NEAR(force(found) / force(soft), series(2.0 * k) / series(k), 0.01);
  // An absent optional file gives way to its fallback, as in a run.
  const std::string absent = "  - {name: stiff, file: none.plant.yaml, optional: true";
  write_scene(absent + ", fallback: stem.plant.yaml}\n");
  EXPECT_EQ(observe("fallback").plant().material.youngs_modulus, modulus);
  write_scene(absent + "}\n");
  EXPECT_THROW(observe_verb(arguments_), UsageError);
  arguments_.model = (folder_ / "stem.plant.yaml").string();
  EXPECT_THROW(observe_verb(arguments_), UsageError);  // --plant without a scene
}

TEST_F(Observe, RefusesWhatItCannotTake) {
  arguments_.out = (folder_ / "out").string();
  for (const char* set : {"{name: magic}", "base_compliance", "{name: base_compliance}"}) {
    arguments_.set = {set};
    EXPECT_THROW(observe_verb(arguments_), UsageError) << set;
  }
  arguments_.set.clear();
  plant::PlantFile other = discrepancy::testing::plant_of({});
  other.curves[0].name = "twig";
  plant::write_plant_file(folder_ / "twig.plant.yaml", other);
  arguments_.model = (folder_ / "twig.plant.yaml").string();
  EXPECT_THROW(observe_verb(arguments_), UsageError);  // the experiment's stem is not there
  arguments_.model = (folder_ / "none").string();
  EXPECT_THROW(observe_verb(arguments_), InvalidFile);
}

// Of 20,000 samples: the standard deviation within 3 sigma of it (0.5 % white, 1.5 % coloured), the
// correlation of neighbours within 0.02; another seed is another noise.
TEST(Noise, HasItsDeviationAndColour) {
  for (const double colour : {0.0, 0.8}) {
    discrepancy::Samples samples = discrepancy::testing::empty_samples(19999.0, 1.0, 2);
    add_noise(samples, 0.3, colour, 7);
    const Eigen::VectorXd e = samples.value.col(0);
    const double variance = e.squaredNorm() / e.size();
    EXPECT_NEAR(std::sqrt(variance) / 0.3, 1.0, colour > 0 ? 0.033 : 0.015);
    const double neighbours = e.head(e.size() - 1).dot(e.tail(e.size() - 1)) / e.size();
    EXPECT_NEAR(neighbours / variance, colour, 0.025);
    EXPECT_NEAR(e.dot(samples.value.col(1)) / e.size() / variance, 0.0, colour > 0 ? 0.05 : 0.025);
    discrepancy::Samples other = discrepancy::testing::empty_samples(19999.0, 1.0, 2);
    add_noise(other, 0.3, colour, 8);
    EXPECT_NE(other.value(0, 0), samples.value(0, 0));
  }
}

}  // namespace
}  // namespace pedicel::app
