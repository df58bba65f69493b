// Options of a run: tables, states, comparisons, the scene that is run.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ProgramOptions : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    // Pulled at its top, so that it moves, and a fruit comes off half-way.
    write("fruit.plant.yaml", std::string(bent_stem_text) +
                                  "fruits:\n  - {name: f, curve: stem, at: 1.0, radius: 0.01, "
                                  "density: 900, detach: {force: 0.8}}\n");
    write("pull.scene.yaml", R"(format: pedicel-scene
version: 1
purpose: a fruit is pulled off
see: it comes off
duration: 0.5   # s
plants:
  - {name: p, file: fruit.plant.yaml, set: {material.density: 700}}
loads:
  - {fruit: p/f, force: [3, 0, 1.5], from: 0, to: 1, ramp: true}
ground: {}
cameras:
  - {name: front, eye: [1, 0, 0.2]}
expect:
  - {quantity: detached_count, above: -1}
)");
  }
  /// The state hash that a run of it ends with.
  std::string hash(const std::string& options, const std::string& scene = "pull.scene.yaml") {
    EXPECT_EQ(run("--headless " + path(scene) + " --out " + path("out") + " --no-pictures --json " +
                  options),
              0)
        << options << "\n"
        << err_;
    return out_.empty() ? "" : nlohmann::json::parse(out_).at("state_hash").get<std::string>();
  }
  /// Refused with these words, exit code 2.
  void expect_refused(const std::string& options, const std::string& words, int code = 2) {
    EXPECT_EQ(run("--headless " + path("pull.scene.yaml") + " --out " + path("out") +
                  " --no-pictures " + options),
              code)
        << options;
    EXPECT_THAT(err_, HasSubstr(words)) << options;
  }
};

TEST_F(ProgramOptions, AForgottenNameAndOneNameForTwoFilesAreRefused) {
  expect_refused("--log --json", "--log: found the option --json, expected a name");
  expect_refused("--log " + path("t.csv") + " --events " + path("t.csv"),
                 "--log and --events: both are ");
}

TEST_F(ProgramOptions, ASweepOverAnUnknownKeyIsRefusedBeforeTheFirstRun) {
  EXPECT_EQ(run("sweep " + path("pull.scene.yaml") + " --set nokey=1,2 --no-pictures --out " +
                path("swept")),
            2);
  EXPECT_THAT(err_, HasSubstr("--set nokey: expected "));
  EXPECT_FALSE(std::filesystem::exists(path("swept")));
}

// Numbers are read once, as they are typed.
TEST_F(ProgramOptions, AnOptionAndItsKeyAreTheSameRun) {
  const std::string dt = "0.0041666666666666667";
  EXPECT_EQ(hash("--dt " + dt), hash("--set dt=" + dt));
  EXPECT_EQ(hash("--dt 0.00123456789012345"), hash("--set dt=0.00123456789012345"));
  EXPECT_NE(hash("--dt 0.00123456789012345"), hash("--dt 0.00123456789"));
}

TEST_F(ProgramOptions, StepsAreDoneInPlaceOfTheDuration) {
  hash("--steps 7");
  EXPECT_EQ(nlohmann::json::parse(out_).at("steps"), 7);
  EXPECT_EQ(hash("--steps 48"), hash("--duration 0.2"));
  hash("--steps 0");
  EXPECT_EQ(nlohmann::json::parse(out_).at("steps"), 0);
}

TEST_F(ProgramOptions, WhatDoesNotFitIsRefusedInWords) {
  expect_refused("--steps 5 --duration 1", "--steps: the duration is given, too");
  expect_refused("--steps 5 --set duration=1", "--steps: the duration is given, too");
  expect_refused("--dt 0.01 --set dt=0.02", "dt is given by its own option, too");
  expect_refused("--steps -5", "expected a whole number from 0 on");
  expect_refused("--steps 1000000000000000", "expected at most 1000000 s");
  expect_refused("--duration nan", "--duration = \"nan\": must be a number between");
  expect_refused("--duration -1", "--duration = \"-1\": must be a number between");
  expect_refused("--log-rate 0", "--log_rate = \"0\": must be a number between");
  expect_refused("--seed 1.5", "must be a whole number between");
  expect_refused("--fps 1000", "--fps 1000: expected a number between 1 and 240 Hz");
  expect_refused("--compare x.csv", "--compare and --tolerance: expected both or none");
  expect_refused("--tolerance 1", "--compare and --tolerance: expected both or none");
  expect_refused("--compare x.csv --tolerance -1", "expected a number from 0 on");
  expect_refused("--compare x.csv --tolerance nan", "expected a finite number");
  expect_refused("--camera side",
                 "--camera side: the scene has none of that name, expected one of: front");
  expect_refused("--trajectory t.csv", "the scene has no robot");
  expect_refused("--quiet -v 3", "--quiet and -v: expected one of them");
  expect_refused("-v 5", "");
  expect_refused("--param-sweep a.csv --log b.csv", "--log: is of one run");
  EXPECT_EQ(run(path("pull.scene.yaml") + " --screenshot " + path("a.png") + " --steps 3"), 2);
  EXPECT_THAT(err_, HasSubstr("--steps: is of a run off screen"));
}

TEST_F(ProgramOptions, TablesAreCopiedWhereTheyAreWanted) {
  hash("--log " + path("a/log.csv") + " --events " + path("a/events.csv") + " --log-rate 20");
  EXPECT_EQ(io::read_file(folder_ / "a/log.csv"), io::read_file(folder_ / "out/log.csv"));
  EXPECT_THAT(io::read_file(folder_ / "a/events.csv"), HasSubstr("p/f"));
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(folder_ / "a/log.csv", {true, true}, diagnostics);
  EXPECT_NEAR(static_cast<double>(log.rows.size()), 10.0, 1.0);
}

TEST_F(ProgramOptions, ComparesWithMeasuredValues) {
  hash("");
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(folder_ / "out/log.csv", {true, true}, diagnostics);
  const int column = log.column("energy_kinetic_J");
  ASSERT_GE(column, 0);
  std::string measured = "time_s,energy_kinetic_J,unheard_of_1\n";
  double most = 0.0;
  for (const auto& row : log.rows) {
    measured += io::exact_number(row[0]) + "," + io::exact_number(row[column] + 0.25) + ",1\n";
    most = std::max(most, row[column]);
  }
  ASSERT_GT(most, 0.0) << "it moves";
  write("measured.csv", measured);
  const std::string compare = "--compare " + path("measured.csv") + " --tolerance ";
  hash(compare + "0.2501");
  EXPECT_THAT(err_, HasSubstr("within  energy_kinetic_J: largest 0.25"));
  EXPECT_THAT(err_, HasSubstr("unheard_of_1: not in the log"));
  const auto json = nlohmann::json::parse(out_).at("comparison");
  EXPECT_TRUE(json.at("within"));
  EXPECT_NEAR(json.at("columns").at(0).at("largest"), 0.25, 1e-6);
  expect_refused(compare + "0.2499", "BEYOND  energy_kinetic_J: largest 0.25", 5);
  write("measured.csv", "time_s,unheard_of_1\n0,1\n");
  expect_refused(compare + "1", "measured.csv:1:1: error: no column of it is in the log", 3);
  write("measured.csv", "time_s,energy_kinetic_J\n100,1\n");
  expect_refused(compare + "1", "no value of it is at a time of the run", 3);
  write("measured.csv", "t,energy_kinetic_J\n0,1\n");
  expect_refused(compare + "1", "expected time_s", 3);
  expect_refused("--compare " + path("none.csv") + " --tolerance 1", "none.csv", 3);
}

TEST_F(ProgramOptions, ALoadedStateGoesOnToTheSameBits) {
  const std::string whole = hash("");
  const std::string state = path("state.yaml");
  for (const std::string steps : {"1", "50", "110"}) {
    hash("--steps " + steps + " --save-state " + state);
    EXPECT_EQ(hash("--load-state " + state), whole) << steps;
  }
  // From one state to the next, with other threads, and what came off before is no event again.
  hash("--load-state " + state + " --steps 5 --save-state " + path("later.yaml"));
  EXPECT_EQ(hash("--threads 2 --load-state " + path("later.yaml")), whole);
  EXPECT_EQ(nlohmann::json::parse(out_).at("events").size(), 0u);
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(folder_ / "out/log.csv", {true, true}, diagnostics);
  EXPECT_GT(log.rows.front()[0], 115.0 / 240.0 - 1e-6);
}

TEST_F(ProgramOptions, AStateThatDoesNotFitIsRefused) {
  const std::string state = path("state.yaml");
  hash("--steps 10 --save-state " + state);
  const std::string load = "--load-state " + state;
  expect_refused(load + " --set material.youngs_modulus=2e8", "with other plants or settings", 3);
  expect_refused(load + " --dt 0.002", "with other plants or settings", 3);
  const std::string text = io::read_file(state);
  write("state.yaml", text.substr(0, text.size() - 5));
  expect_refused(load, "state.yaml:9", 3);
  write("state.yaml", text.substr(0, text.find("steps")));
  expect_refused(load, "missing key \"steps\"", 3);
  write("state.yaml", with(text, "version: 1", "version: 2"));
  expect_refused(load, "version", 3);
  write("state.yaml", with(text, "steps: 10", "steps: 11"));
  expect_refused(load, "sum: does not agree with the other numbers", 3);
  // As programs wrote it that knew no sum.
  const std::string older = text.substr(0, text.find("sum:"));
  write("state.yaml", with(older, "steps: 10", "steps: 11"));
  expect_refused(load, "the run does not come to this state again", 3);
  write("state.yaml", older);
  EXPECT_EQ(hash(load + " --steps 0"), hash("--steps 10"));
  write("state.yaml", io::read_file(folder_ / "pull.scene.yaml"));
  expect_refused(load, "pedicel-state", 3);
  expect_refused("--load-state " + path("none.yaml"), "none.yaml", 3);
}

TEST_F(ProgramOptions, ThePrintedSceneIsTheSameRun) {
  const std::string options =
      "--dt 0.003 --set rods.newton_iterations=3 --set material.youngs_modulus=1.23456789012e8 "
      "--set plants.p.detach.force=0.7 --set coupling.direction=two_way --seed 5 --duration 0.4";
  const std::string expected = hash(options);
  ASSERT_EQ(run("--print-scene " + path("pull.scene.yaml") + " " + options), 0) << err_;
  for (const char* said : {"dt: 0.003", "newton_iterations: 3", "friction: ", "tolerance: ",
                           "direction: two_way", "seed: 5", "duration: 0.4   # s", "log_rate: 100"})
    EXPECT_THAT(out_, HasSubstr(said));
  write("elsewhere/printed.scene.yaml", out_);
  EXPECT_EQ(hash("", "elsewhere/printed.scene.yaml"), expected);
  EXPECT_FALSE(std::filesystem::exists("out/pull"));
}

TEST_F(ProgramOptions, ThePrintedSceneOfALonePlantIsTheSameRun) {
  const std::string expected = hash("--duration 0.2", "stem.plant.yaml");
  ASSERT_EQ(run("--print-scene " + path("stem.plant.yaml") + " --duration 0.2"), 0) << err_;
  write("printed.scene.yaml", out_);
  EXPECT_EQ(hash("", "printed.scene.yaml"), expected);
}

TEST_F(ProgramOptions, ATableOfParametersRunsEveryRow) {
  write("rows.csv", "material.density,dt\n400,0.004\n800,0.002\n");
  hash("--param-sweep " + path("rows.csv"));
  Diagnostics diagnostics;
  const io::CsvTable sweep = io::read_csv(folder_ / "out/sweep.csv", {true, false}, diagnostics);
  ASSERT_EQ(sweep.rows.size(), 2u) << diagnostics.text();
  EXPECT_EQ(sweep.columns[2], "material.density");
  EXPECT_EQ(sweep.rows[1][2], 800.0);
  EXPECT_EQ(sweep.rows[1][sweep.column("detached_count")], 1.0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/run_002/report.html") ||
              std::filesystem::exists(folder_ / "out/run_002/log.csv"));
  write("rows.csv", "no_such_key\n1\n");
  expect_refused("--param-sweep " + path("rows.csv"), "no_such_key");
  write("rows.csv", "dt\nfast\n");
  expect_refused("--param-sweep " + path("rows.csv"), "\"fast\" is not a finite number", 3);
}

TEST_F(ProgramOptions, SaysAsMuchAsIsWanted) {
  hash("-v 0");
  EXPECT_THAT(err_, IsEmpty());
  EXPECT_EQ(run("-v 0 --headless " + path("none.scene.yaml")), 3);
  EXPECT_THAT(err_, IsEmpty());
  hash("-v 2");
  EXPECT_THAT(err_, Not(HasSubstr("steps,")));
  EXPECT_THAT(err_, HasSubstr("replaces the run"));
  hash("-v 3");
  EXPECT_THAT(err_, HasSubstr("steps,"));
  hash("-v 4");
  EXPECT_THAT(err_, HasSubstr("p/f comes off (force)"));
}

TEST_F(ProgramOptions, NumbersInFilesHaveTheBoundsOfTheCommandLine) {
  const std::string scene = io::read_file(folder_ / "pull.scene.yaml");
  const auto refused = [&](const std::string& line, const std::string& words) {
    write("bad.scene.yaml", with(scene, "duration: 0.5   # s", line));
    EXPECT_EQ(run("validate " + path("bad.scene.yaml")), 3) << line;
    EXPECT_THAT(err_, HasSubstr(words)) << line;
  };
  refused("duration: 2.0e6", "duration is \"2.0e6\", expected a number between 1e-06 and 1000000");
  refused("duration: 1\nlog_rate: 1e7", "log_rate is \"1e7\", expected a number between 0.001 and");
  refused("duration: 1\ndt: 1e-8", "dt is \"1e-8\", expected a number between 1e-07 and 1");
  refused("duration: 1\ngravity: [0, 0, -981]", "gravity: expected three numbers between");
  expect_refused("--set material.poisson_ratio=0.6", "expected a number > -1 and at most 0.5", 3);
  expect_refused("--set material.youngs_modulus=0", "expected a number > 0", 3);
}

// A grid whose plants differ, each by its own draw.
class Grid : public ProgramOptions {
 protected:
  void SetUp() override {
    ProgramOptions::SetUp();
    write_grid(
        3,
        "place.turn: {low: -3, high: 3}, place.lean: {low: 0.1, high: 0.3}, "
        "place.towards: {low: -3, high: 3}, shape.scale: {low: 0.8, high: 1.2}, "
        "fruits.share: {distribution: choice, values: [0, 1]}, "
        "material.youngs_modulus: {distribution: lognormal, mean: 1.0e+9, deviation: 2.0e+8}");
  }
  std::string read(const std::string& name) { return io::read_file(path(name)); }
  void write_grid(int count, const std::string& vary) {
    write("grid.scene.yaml",
          "format: pedicel-scene\nversion: 1\nname: field\npurpose: plants that differ\nsee: they "
          "do\nduration: 0.05\nplants:\n  - {name: p, file: fruit.plant.yaml, position: [0, 0, "
          "0.1], repeat: {count: [" +
              std::to_string(count) + ", 2], spacing: [0.5, 0.6], vary: {" + vary +
              "}}}\nground: {}\ncameras:\n  - {name: front, eye: [3, 0, 0.5]}\nexpect:\n  - "
              "{quantity: detached_count, above: -1}\n");
  }
};

TEST_F(Grid, DiffersFromSeedToSeedAndStaysForOne) {
  const std::string once = hash("", "grid.scene.yaml");
  EXPECT_EQ(hash("", "grid.scene.yaml"), once);
  EXPECT_NE(hash("--seed 5", "grid.scene.yaml"), once);
}

TEST_F(Grid, IsSavedPlantByPlantAndRunsToTheSameState) {
  const std::string once = hash("", "grid.scene.yaml");
  const std::string save = path("grid.scene.yaml") + " --save-plants " + path("apart");
  ASSERT_EQ(run(save), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("6 plants and "));
  EXPECT_NE(read("apart/p_0.plant.yaml"), read("apart/p_5.plant.yaml"));
  EXPECT_EQ(hash("", "apart/grid.scene.yaml"), once);
  EXPECT_EQ(run(save), 2) << "what is there is not written over";
  EXPECT_THAT(err_, HasSubstr("p_0.plant.yaml is there already, expected a new name"));
  // What was drawn for one does not hang on how many there are.
  write_grid(2, "shape.scale: {low: 0.8, high: 1.2}");
  ASSERT_EQ(run(path("grid.scene.yaml") + " --save-plants " + path("few")), 0) << err_;
  write_grid(3, "shape.scale: {low: 0.8, high: 1.2}");
  ASSERT_EQ(run(path("grid.scene.yaml") + " --save-plants " + path("many")), 0) << err_;
  EXPECT_EQ(read("few/p_1.plant.yaml"), read("many/p_1.plant.yaml"));
  write_grid(9000, "shape.scale: {low: 0.8, high: 1.2}");
  EXPECT_EQ(run(path("grid.scene.yaml") + " --save-plants " + path("huge")), 3);
  EXPECT_THAT(err_, HasSubstr("makes 18000 files with those before it, expected at most 10000"));
}

TEST_F(Grid, TakesLeafTemplatesAlong) {
  write("own.leaf.yaml",
        "format: pedicel-leaf\nversion: 1\nname: own\nareal_density: 0.25\nmaterial: "
        "{youngs_modulus: 1.5e8, poisson_ratio: 0.35, density: 950, damping_time: "
        "0.01}\npetiole_radius: 0.0125\nvein_radius: 0.005\nvertices: [[0, 0], [0.5, 0], [1, 0], "
        "[0.6, 0.3]]\nedges:\n  - {ends: [0, 1]}\n  - {ends: [1, 2]}\n  - {ends: [1, "
        "3]}\ntriangles: [[1, 2, 3]]\n");
  write("fruit.plant.yaml",
        std::string(bent_stem_text) +
            "leaves:\n  - {name: l, curve: stem, at: 1.0, template: own, normal: [0, 0, 1], size: "
            "0.05}\n");
  const std::string once = hash("", "grid.scene.yaml");
  ASSERT_EQ(run(path("grid.scene.yaml") + " --save-plants " + path("apart")), 0) << err_;
  EXPECT_EQ(hash("", "apart/grid.scene.yaml"), once);
}

TEST_F(Grid, RefusesKeysAndValuesThatNoPlantHas) {
  const auto refused = [&](const std::string& vary, const std::string& words) {
    write_grid(2, vary);
    EXPECT_EQ(run("--headless " + path("grid.scene.yaml") + " --out " + path("out")), 3) << vary;
    EXPECT_THAT(err_, HasSubstr("grid.scene.yaml:8:")) << vary;
    EXPECT_THAT(err_, HasSubstr(words)) << vary;
  };
  refused("place.twist: {low: 0, high: 1}",
          "vary: unknown key \"place.twist\", expected one of: "
          "place.turn, place.lean");
  refused("shape.scale: {low: -2, high: -1}", "expected a number");
  refused("fruits.share: {distribution: choice, values: [many]}", "fruits.share is \"many\"");
  refused("material.density: {low: -2, high: -1}", "material.density is \"-1");
  refused("shape.scale: {low: 1}", "high");
}

TEST_F(ProgramOptions, HelpNamesThemAll) {
  ASSERT_EQ(run("--help"), 0);
  for (const char* option :
       {"--steps", "--log ", "--log-rate", "--events", "--trajectory", "--compare", "--tolerance",
        "--save-state", "--load-state", "--print-scene", "--save-plants", "-v ", "--param-sweep",
        "--seed", "--paused", "--camera", "143 SIGTERM"})
    EXPECT_THAT(out_, HasSubstr(option));
}

}  // namespace
}  // namespace pedicel
