// `pedicel pick` as it is called: answers on standard output, faults on standard error.
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/io/csv.h"
#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Pulled for 1.2 s to 12 N, which then go within `fall` s.
std::string record(double fall, const std::string& names = "time_s,force_x_N,force_z_N") {
  std::string text = names + "\n";
  for (int i = 0; i < 750; ++i) {
    const double t = 0.004 * i;
    const double pulled = 10.0 * std::clamp(t - 0.3, 0.0, 1.2);
    const double left = std::clamp(1.0 - (t - 1.5) / fall, 0.0, 1.0);
    const double noise = 0.02 * std::sin(7.1 * i);
    text += io::format_number(t, 9) + "," + io::format_number(0.6 * pulled * left + noise, 6) +
            "," + io::format_number(-5.0 + 0.8 * pulled * left - noise, 6) + "\n";
  }
  return text;
}

class PickProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("pick_1.csv", record(0.012));
    write("pick_2.csv", record(0.4));
    write("bad.csv", "time_s,force_x_N\n0,1\n0.1,much\n");
    write("bare.csv", record(0.012, "t,fx,fz"));
  }
};

TEST_F(PickProgram, TellsOneRecordAsTextAndAsAnObject) {
  EXPECT_EQ(run("pick " + path("pick_1.csv")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("The fruit came off at 1.50"));
  EXPECT_THAT(err_, IsEmpty());
  EXPECT_EQ(run("pick --json " + path("pick_2.csv")), 0) << err_;
  const auto json = nlohmann::json::parse(out_);
  EXPECT_EQ(json.at("outcome"), "failed");
  EXPECT_EQ(json.at("end"), "slipped");
  EXPECT_NEAR(json.at("peak_force_N").get<double>(), 12.0, 0.1);
}

TEST_F(PickProgram, TellsSeveralAsATableAndAsAnArray) {
  const std::string both = path("pick_1.csv") + " " + path("pick_2.csv");
  EXPECT_EQ(run("pick " + both + " --report " + path("picks.html")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("pick_1.csv  detached  came_off"));
  EXPECT_THAT(out_, HasSubstr("pick_2.csv    failed   slipped"));
  EXPECT_THAT(io::read_file(folder_ / "picks.html"), HasSubstr("<svg"));
  EXPECT_EQ(run("pick --json " + both), 0) << err_;
  EXPECT_EQ(nlohmann::json::parse(out_).size(), 2u);
  write("picks.csv", "pick,outcome\n1,detached\n2,slipped\n");
  EXPECT_EQ(run("pick " + both + " --labels " + path("picks.csv")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("labels: 2 of 2 right"));
}

TEST_F(PickProgram, JudgesTheOthersWhereOneHasAFault) {
  EXPECT_EQ(run("pick " + path("bad.csv") + " " + path("pick_1.csv")), 3);
  EXPECT_THAT(err_, HasSubstr("bad.csv:3:5: error: \"much\" is not a finite number"));
  EXPECT_THAT(out_, HasSubstr("pick_1.csv  detached"));
  EXPECT_EQ(run("pick " + path("none.csv")), 3);
  EXPECT_THAT(err_, HasSubstr("none.csv"));
  EXPECT_THAT(out_, IsEmpty());
}

TEST_F(PickProgram, AsksForUnitsThatNobodyStates) {
  EXPECT_EQ(run("pick " + path("bare.csv")), 2);
  EXPECT_THAT(err_, HasSubstr("column \"t\" has no unit, expected --time-unit"));
  EXPECT_THAT(err_, HasSubstr("column \"fx\" has no unit, expected --force-unit"));
  EXPECT_EQ(run("pick --time-unit s --force-unit N " + path("bare.csv")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("The fruit came off at 1.50"));
  EXPECT_EQ(run("pick --response 0 " + path("pick_1.csv")), 2);
  EXPECT_THAT(err_, HasSubstr("--response = 0 s: must be above 0"));
  EXPECT_EQ(run("pick --force-unit mm " + path("pick_1.csv")), 2);
  EXPECT_THAT(err_, HasSubstr("--force-unit \"mm\": expected N"));
}

}  // namespace
}  // namespace pedicel
