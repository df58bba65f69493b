// A diagnosis beside the session: progress, cancel, card, acceptance.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "app/session/measured/diagnosis_card.h"
#include "app/session/measured/measured_data.h"
#include "app/session/session_measured.h"
#include "tests/support/measured_stem.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using discrepancy::Outcome;
using std::chrono::steady_clock;
using ::testing::HasSubstr;

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

class DiagnosisInSession : public ::testing::Test {
 protected:
  void open(Session& session, const pedicel::testing::MeasuredStem& stem) {
    must(session.run(Command("open experiment", {{"folder", stem.write(folder_ / "e").string()}})));
    if (session.measured().reading()) must(session.measured().finish_reading());
  }
  static pedicel::testing::MeasuredStem soft() {
    pedicel::testing::MeasuredStem stem;
    stem.effects = {pedicel::testing::soft_root(0.1)};
    return stem;
  }

  TemporaryFolder folder_;
};

TEST_F(DiagnosisInSession, RunsBesideAndIsCancelled) {
  Session session;
  open(session, soft());
  session.measured().data().wait();
  const auto start = steady_clock::now();
  must(session.run_text("diagnose threads=1"));
  EXPECT_LT(seconds_since(start), 0.5) << "the caller must not wait";
  EXPECT_FALSE(session.run_text("diagnose").ok) << "one at a time";
  while (session.measured().data().is_diagnosing() &&
         session.measured().data().progress().doing.empty() && seconds_since(start) < 60.0)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(session.measured().data().progress().doing.empty());
  must(session.run_text("cancel diagnosis"));
  EXPECT_TRUE(session.measured().data().is_cancelling());
  session.measured().data().wait();
  EXPECT_FALSE(session.measured().data().is_diagnosing());
  EXPECT_EQ(session.measured().data().diagnosis(), nullptr);
  EXPECT_FALSE(session.run_text("accept diagnosis").ok);
}

TEST_F(DiagnosisInSession, AnotherExperimentWaitsForIt) {
  Session session;
  open(session, soft());
  must(session.run_text("diagnose threads=1"));
  EXPECT_FALSE(session.measured().open(folder_ / "e").ok);
  must(session.run_text("cancel diagnosis"));
  session.measured().data().wait();
  must(session.measured().open(folder_ / "e"));
}

TEST_F(DiagnosisInSession, FindsTheSoftRootAndItIsAccepted) {
  Session session(waiting());
  open(session, soft());
  const Result result = session.run_text("diagnose threads=2");
  must(result);
  const discrepancy::Diagnosis* found = session.measured().data().diagnosis();
  ASSERT_NE(found, nullptr);
  ASSERT_FALSE(found->verdict.causes.empty()) << result.text;
  EXPECT_EQ(found->verdict.causes.front().name, "base_compliance") << result.text;

  const DiagnosisCard card = card_of(*found);
  EXPECT_EQ(card.headline, result.text);
  EXPECT_THAT(card.causes.front().numbers, HasSubstr("stiffness"));
  EXPECT_THAT(card.causes.front().numbers, HasSubstr("N m/rad"));
  EXPECT_EQ(card.causes.front().place, "the root");
  EXPECT_FALSE(card.competing_models.empty());
  EXPECT_FALSE(card.next.empty());

  // The three models: the extended one is near the noise where the nominal one is far off.
  const auto rms = [&](discrepancy::Model m) { return session.measured().data().path(m, 1)->rms; };
  EXPECT_GT(rms(discrepancy::nominal), 4.0 * rms(discrepancy::extended));
  EXPECT_FALSE(session.measured().data().path(discrepancy::extended, 0)->shape.size() == 0);

  const std::uint64_t before = session.document().state_hash();
  must(session.run_text("accept diagnosis"));
  bool soft_root = false;
  for (const plant::Effect& effect : session.document().plants[0].file->effects)
    if (effect.name == "base_compliance") {
      soft_root = true;
      EXPECT_NEAR(effect.number("stiffness"), 0.1, 0.02);
    }
  EXPECT_TRUE(soft_root);
  EXPECT_EQ(session.history().undo_name(), "set effects");
  must(session.undo());
  EXPECT_EQ(session.document().state_hash(), before);
  must(session.run(Command("write report", {{"folder", (folder_ / "report").string()}})));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / "report.html"));
}

TEST_F(DiagnosisInSession, BadDataSaySo) {
  discrepancy::Experiment e = pedicel::testing::MeasuredStem().experiment();
  for (auto& trial : e.trials) trial.markers.value *= 1000.0;  // millimetres
  MeasuredData data;
  data.open(e);
  data.wait();
  data.start_diagnosis(1);
  EXPECT_EQ(data.wait(), std::vector<std::string>{});
  ASSERT_NE(data.diagnosis(), nullptr);
  EXPECT_EQ(data.diagnosis()->verdict.outcome, Outcome::bad_data);
  const DiagnosisCard card = card_of(*data.diagnosis());
  EXPECT_FALSE(card.good);
  EXPECT_THAT(card.next, HasSubstr("Mend the data"));
  EXPECT_FALSE(data.extended_plant());
}

}  // namespace
}  // namespace pedicel::app
