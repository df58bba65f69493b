#include "engine/world/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/world/sim_world.h"

namespace pedicel::world {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::filesystem::path folder(const std::string& name) {
  const auto path = std::filesystem::path(::testing::TempDir()) / ("recorder_" + name);
  std::filesystem::remove_all(path);
  return path;
}

TEST(Recorder, WritesAtItsRateAndIsReadableBeforeItEnds) {
  const auto out = folder("rate");
  SimWorld world({});
  Recorder recorder(out, 60.0);
  recorder.add_channel("twice_time_s", [&] { return 2.0 * world.time(); });
  recorder.open();
  world.set_recorder(&recorder);
  for (int i = 0; i < 240; ++i) world.step();
  // Still open here: the file must be whole up to the last row.
  Diagnostics diagnostics;
  const io::CsvTable table = io::read_csv(out / "log.csv", {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  ASSERT_EQ(table.columns, (std::vector<std::string>{"time_s", "twice_time_s"}));
  EXPECT_NEAR(static_cast<double>(table.rows.size()), 60.0, 1.0);
  EXPECT_DOUBLE_EQ(table.rows.back()[0], 1.0);
  EXPECT_DOUBLE_EQ(table.rows.back()[1], 2.0);
}

TEST(Recorder, WritesAnEventAtOnce) {
  const auto out = folder("event");
  Recorder recorder(out, 100.0);
  recorder.open();
  Event event;
  event.time = 1.25;
  event.organ = "truss/fruit_3";
  event.cause = "stretch";
  event.stretch = 0.151;
  recorder.add_event(event);
  const std::string text = io::read_file(out / "events.csv");
  EXPECT_THAT(text, StartsWith("time_s,organ,cause,stretch_1,bend_rad,force_N"));
  EXPECT_THAT(text, HasSubstr("1.25,truss/fruit_3,stretch,0.151,"));
}

TEST(Recorder, KeepsTheRecordInMemoryWithoutAFolder) {
  SimWorld world({});
  Recorder recorder({}, 240.0);
  recorder.add_channel("one_1", [] { return 1.0; });
  recorder.open();
  world.set_recorder(&recorder);
  for (int i = 0; i < 10; ++i) world.step();
  EXPECT_EQ(recorder.values("one_1").size(), 10u);
  EXPECT_TRUE(recorder.values("none").empty());
}

TEST(Recorder, RefusesWhatItCannotDo) {
  EXPECT_THROW(Recorder({}, 0.0), UsageError);
  Recorder recorder(folder("late"), 100.0);
  recorder.open();
  EXPECT_THROW(recorder.add_channel("late_1", [] { return 0.0; }), UsageError);
}

TEST(Recorder, SaysWhereItCannotWrite) {
  Recorder recorder("/proc/nowhere", 100.0);
  try {
    recorder.open();
    FAIL() << "expected WriteError";
  } catch (const io::WriteError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/proc/nowhere/log.csv: cannot be written"));
  }
}

}  // namespace
}  // namespace pedicel::world
