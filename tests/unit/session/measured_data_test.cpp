// Measured data beside the document: opening, models, time.
#include <gmock/gmock.h>

#include <cmath>
#include <thread>

#include "app/session/measured/experiment_reading.h"
#include "app/session/measured/measured_instant.h"
#include "app/session/session_files.h"
#include "app/session/session_measured.h"
#include "engine/core/timer.h"
#include "engine/io/atomic_file.h"
#include "tests/support/measured_stem.h"
#include "tests/support/slow_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using discrepancy::nominal;
using ::testing::HasSubstr;

class Measured : public ::testing::Test {
 protected:
  std::string stem(const std::string& name, const pedicel::testing::MeasuredStem& of = {}) {
    return of.write(folder_ / name).string();
  }
  /// Opened to the end, with what came of it.
  static Result open(Session& session, const std::string& path) {
    const Result begun = session.run(Command("open experiment", {{"folder", path}}));
    return begun.ok && session.measured().reading() ? session.measured().finish_reading() : begun;
  }

  TemporaryFolder folder_;
};

TEST_F(Measured, OpensAndSimulatesWithoutWaiting) {
  Session session;
  must(open(session, stem("a")));
  ASSERT_NE(session.measured().data().experiment(), nullptr);
  EXPECT_EQ(session.measured().plant(), 0);
  EXPECT_TRUE(session.files().path().empty()) << "saving must not touch the experiment's plant";
  EXPECT_FALSE(session.files().dirty());
  EXPECT_EQ(session.measured().data().wait(), std::vector<std::string>{});
  ASSERT_TRUE(session.measured().data().has(nominal));
  // Right but for the noise, of 3 coordinates.
  EXPECT_NEAR(session.measured().data().path(nominal, 0)->rms, 2e-4 * std::sqrt(3.0), 1e-4);
  EXPECT_FALSE(session.measured().data().has(discrepancy::extended));
}

TEST_F(Measured, ASoftRootShowsAsError) {
  pedicel::testing::MeasuredStem soft;
  soft.effects = {pedicel::testing::soft_root(0.1)};
  Session session(waiting());
  must(session.run(Command("open experiment", {{"folder", stem("soft", soft)}})));
  const TrialPath* path = session.measured().data().path(nominal, 0);
  ASSERT_NE(path, nullptr);
  EXPECT_GT(path->rms, 2e-3);
  // At the end of the stem after the release, not where it is held.
  const auto held = instant_of(session.measured().data(), 0, nominal, 0.0);
  const auto free = instant_of(session.measured().data(), 0, nominal, 0.2);
  ASSERT_TRUE(held && free);
  EXPECT_LT(held->markers[1].error().norm(), 1e-3);
  EXPECT_GT(free->rms, 2e-3);
}

TEST_F(Measured, AMomentIsBetweenItsSamplesAndGapsStay) {
  discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  e.trials[0].markers.value.row(5).head<3>().setConstant(NAN);
  MeasuredData data;
  data.open(e);
  data.wait();
  const double t = e.trials[0].markers.time[2];
  const auto here = instant_of(data, 0, nominal, t + 0.01);
  ASSERT_TRUE(here);
  const Vec3 middle = 0.5 * (e.trials[0].markers.value.block<1, 3>(2, 3) +
                             e.trials[0].markers.value.block<1, 3>(3, 3))
                                .transpose();
  EXPECT_LT((here->markers[1].measured - middle).norm(), 1e-9);
  const auto gap = instant_of(data, 0, nominal, e.trials[0].markers.time[5]);
  EXPECT_FALSE(gap->markers[0].measured.allFinite());
  EXPECT_TRUE(gap->markers[1].measured.allFinite());
  EXPECT_TRUE(std::isfinite(gap->rms));
  // Beyond the end it is the end; without such a trial nothing.
  EXPECT_EQ(instant_of(data, 0, nominal, 99.0)->time, e.trials[0].markers.time.back());
  EXPECT_FALSE(instant_of(data, 2, nominal, 0.0));
}

TEST_F(Measured, TheShapePassesThroughTheSimulatedMarkers) {
  MeasuredData data;
  data.open(pedicel::testing::MeasuredStem().experiment());
  data.wait();
  const auto now = instant_of(data, 0, nominal, 0.2);
  ASSERT_TRUE(now);
  ASSERT_EQ(now->shape.size(), data.shape().front().at.size());
  EXPECT_LT((now->shape.back() - now->markers[1].simulated).norm(), 1e-6);
  EXPECT_LT(now->shape.front().norm(), 1e-6);
}

TEST_F(Measured, ResidualIsCarriedAlongTheCurve) {
  const discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  const std::vector<double> rms{0.002, 0.004};  // at 0.5 and 1
  EXPECT_NEAR(residual_along(e, rms, "stem", 0.75), 0.003, 1e-12);
  EXPECT_NEAR(residual_along(e, rms, "stem", 0.1), 0.002, 1e-12);
  EXPECT_NEAR(residual_along(e, rms, "stem", 1.0), 0.004, 1e-12);
  EXPECT_TRUE(std::isnan(residual_along(e, rms, "branch", 0.5)));
}

TEST_F(Measured, FaultsAreToldWithTheirPlace) {
  const std::string path = stem("bad");
  const std::filesystem::path file = std::filesystem::path(path) / "experiment.yaml";
  std::string text = io::read_file(file);
  text.replace(text.find("use: fit"), 8, "use: fat");
  io::write_file_atomically(file, text);
  Session session;
  draw_plant(session);
  must(session.undo());
  const Result result = open(session, path);
  EXPECT_FALSE(result.ok);
  ASSERT_FALSE(session.messages().all().empty());
  EXPECT_THAT(session.messages().all().back().text, HasSubstr("experiment.yaml:"));
  EXPECT_THAT(session.messages().all().back().text, HasSubstr("fat"));
  EXPECT_EQ(session.measured().data().experiment(), nullptr);
  EXPECT_EQ(session.document().plants.size(), 1u) << "what was open stays";
}

TEST_F(Measured, IsReadBesideAndMayBeDropped) {
  const std::string slow = stem("slow"), quick = stem("quick");
  Session session;
  SlowFile table(std::filesystem::path(slow) / "along_y" / "markers.csv");
  ASSERT_TRUE(table.made());
  must(session.run(Command("open experiment", {{"folder", slow}})));
  ASSERT_NE(session.measured().reading(), nullptr) << "the caller does not wait";
  const Timer timer;
  while (session.measured().reading() && session.measured().reading()->trials_read() < 1 &&
         timer.seconds() < 60.0)
    session.update();
  ASSERT_NE(session.measured().reading(), nullptr);
  EXPECT_EQ(session.measured().reading()->trials(), 2);
  EXPECT_EQ(session.measured().data().experiment(), nullptr);
  // Another one takes its place, whatever becomes of the first.
  must(open(session, quick));
  ASSERT_NE(session.measured().data().experiment(), nullptr);
  EXPECT_EQ(session.measured().data().experiment()->folder, quick);
  must(session.run(Command("open experiment", {{"folder", slow}})));
  must(session.run_text("cancel reading"));
  EXPECT_EQ(session.measured().reading(), nullptr);
  table.let_go();
  session.update();
  EXPECT_EQ(session.measured().data().experiment()->folder, quick)
      << "what was dropped does not come";
  EXPECT_TRUE(session.messages().all().empty()) << session.messages().all().back().text;
}

TEST_F(Measured, TheForceIsPlottedBesideWhatTheModelsSay) {
  discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  EXPECT_FALSE(force_series_of(MeasuredData(), 0, 0));
  discrepancy::Samples& force = e.trials[0].force;
  force.time = {0.0, 0.01, 0.02};
  force.value.resize(3, 3);
  force.value << 3, 4, 0, 0, 0, 0, 0, 0, 0;
  MeasuredData data;
  data.open(e);
  EXPECT_EQ(data.wait(), std::vector<std::string>{});
  const auto size = force_series_of(data, 0, 3), x = force_series_of(data, 0, 0);
  ASSERT_TRUE(size && x);
  EXPECT_EQ(size->time, force.time);
  EXPECT_EQ(size->measured, (std::vector<double>{5, 0, 0})) << "its size";
  EXPECT_EQ(x->measured, (std::vector<double>{3, 0, 0}));
  ASSERT_EQ(x->models[nominal].size(), 3u);
  EXPECT_GT(std::abs(x->models[nominal][1]), 1e-3) << "N, what holds the bent stem";
  const auto y = force_series_of(data, 0, 1), z = force_series_of(data, 0, 2);
  EXPECT_NEAR(size->models[nominal][1],
              Vec3(x->models[nominal][1], y->models[nominal][1], z->models[nominal][1]).norm(),
              1e-12);
  EXPECT_TRUE(x->models[discrepancy::extended].empty());
  EXPECT_FALSE(force_series_of(data, 1, 0)) << "none was measured there";
}

TEST_F(Measured, DrawnWorkIsNotLost) {
  const std::string path = stem("a");
  Session session;
  draw_plant(session);
  const Result result = open(session, path);
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.text, HasSubstr("not saved"));
  EXPECT_EQ(session.document().plants.size(), 1u);
  // With its own plant open, changes and all, it is only laid over.
  must(session.run_text("new"));
  must(open(session, path));
  must(session.run_text("set effects beam \"[{name: mass_damping, rate: 2}]\""));
  EXPECT_TRUE(session.files().dirty());
  must(open(session, path));
  EXPECT_EQ(session.document().plants[0].file->effects.size(), 1u);
}

TEST_F(Measured, EffectsAreACommandThatIsUndone) {
  Session session(waiting());
  must(session.run(Command("open experiment", {{"folder", stem("a")}})));
  const std::uint64_t before = session.document().state_hash();
  must(session.run_text("set effects beam \"[{name: base_compliance, stiffness: 0.5}]\""));
  EXPECT_EQ(session.document().plants[0].file->effects,
            std::vector{pedicel::testing::soft_root(0.5)});
  must(session.undo());
  EXPECT_EQ(session.document().state_hash(), before);
  must(session.redo());
  EXPECT_NE(session.document().state_hash(), before);
  for (const char* wrong :
       {"[{name: base_compliance}]", "[{name: no_such, x: 1}]", "[", "[{name: latency, delay: 1}]",
        "[{name: extra_mass, mass: 0.01, where: {curve: leaf, at: 0.5}}]"})
    EXPECT_FALSE(session.run(Command("set effects", {{"plant", "beam"}, {"text", wrong}})).ok)
        << wrong;
}

}  // namespace
}  // namespace pedicel::app
