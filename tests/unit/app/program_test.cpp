// Runs the program itself: exit codes and what it says, as conventions for scripts need them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "engine/io/csv.h"
#include "plugins/cosserat/model/rod_model.h"
#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

using ::testing::HasSubstr;

TEST_F(Program, GoodRunEndsWith0AndLeavesItsFiles) {
  EXPECT_EQ(run_scene("--json"), 0) << err_;
  const auto json = nlohmann::json::parse(out_);
  EXPECT_EQ(json.at("exit_code"), 0);
  EXPECT_TRUE(json.at("expectations").at(0).at("met"));
  for (const char* file : {"log.csv", "events.csv", "log.meta.json", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
  EXPECT_THAT(err_, HasSubstr("seed 0"));
  EXPECT_THAT(err_, HasSubstr("24 steps"));
}

// The story of a first evening, off screen: draw, pull off, undo, save, and run what was saved.
TEST_F(Program, AScriptDrawsPullsAndSaves) {
  const std::string saved = path("drawn.plant.yaml");
  write("story.txt",
        "new plant p\n"
        "draw stem p stem 0,0,0;0,0,0.15;0,0,0.3 0.004\n"
        "draw stem p branch 0,0,0.15;0.05,0,0.16;0.1,0,0.15 0.0015\n"
        "add fruit p berry branch 1 0.01 force=2\n"
        "pull p/berry 0.4,0,0.1\nrun 1\nexpect breaks is=1\n"
        "undo\nexpect breaks is=0\nundo\nexpect fruits is=0\nredo\nsave " +
            saved + "\nreload\nexpect fruits is=1\n");
  EXPECT_EQ(run("--script " + path("story.txt")), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("breaks is 1"));
  EXPECT_EQ(run("validate " + saved), 0) << err_;
  write("more.txt", "set material.density 700\nrun 0.05\nexpect time_s above=0.04 below=0.06\n");
  EXPECT_EQ(run("--script " + path("more.txt") + " " + saved), 0) << err_;
  write("more.txt", "run 0.05\nexpect breaks is=1\n");
  EXPECT_EQ(run("--script " + path("more.txt") + " " + saved), 5);
  EXPECT_THAT(err_, HasSubstr("more.txt:2:1: error: breaks is 0, not as expected"));
  EXPECT_EQ(run("--script " + path("more.txt") + " " + path("none.plant.yaml")), 3);
  EXPECT_EQ(run("--script " + path("nothing.txt")), 3);
}

// As the window shows it: for ten seconds, or as long as is said.
TEST_F(Program, ALonePlantRunsOffScreen) {
  EXPECT_EQ(run_scene("--duration 0.1 --json", "stem.plant.yaml"), 0) << err_;
  EXPECT_EQ(nlohmann::json::parse(out_).at("exit_code"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "log.csv"));
  write("bad.plant.yaml", "format: pedicel-plant\n");
  EXPECT_EQ(run_scene("", "bad.plant.yaml"), 3);
  EXPECT_THAT(err_, HasSubstr("bad.plant.yaml:1:1: error: missing key"));
}

TEST_F(Program, HelpNamesTheExitCodes) {
  EXPECT_EQ(run("--help"), 0);
  EXPECT_THAT(out_, HasSubstr("Exit codes: 0 all is well"));
}

TEST_F(Program, UsageErrorsEndWith2) {
  EXPECT_EQ(run("--unheard-of"), 2);
  EXPECT_EQ(run_scene("--set dt=-1"), 2);
  EXPECT_THAT(err_, HasSubstr("must be a number between"));
  EXPECT_EQ(run_scene("--size big"), 2);
  EXPECT_EQ(run(path("quick.scene.yaml") + " --screenshot " + path("a.jpg")), 2);
  EXPECT_THAT(err_, HasSubstr("a.jpg: expected a name that ends in .png"));
  EXPECT_EQ(run("bench nothing"), 2);
  EXPECT_THAT(err_, HasSubstr("expected one of rods_2242, tree_2242, row_1k"));
  EXPECT_EQ(run("bench --set dt=1"), 2);
  EXPECT_THAT(err_, HasSubstr("expected rods.KEY=VALUE"));
  EXPECT_EQ(run("bench --set rods.iterations=0"), 2);
  EXPECT_THAT(err_, HasSubstr("rods.iterations = 0: must be between"));
}

TEST_F(Program, BenchSaysSpeedAndMemory) {
  ASSERT_EQ(run("bench row_1k --duration 0.01 --no-accuracy --self-contact --json"), 0) << err_;
  const auto json = nlohmann::json::parse(out_);
  EXPECT_EQ(json.at("rods"), 17 * 59);
  EXPECT_GT(json.at("real_time_factor"), 0.0);
  EXPECT_GT(json.at("bytes_per_element"), sizeof(cosserat::Element));
  EXPECT_TRUE(json.at("cantilever_error").is_null());
}

TEST_F(Program, BenchStepsWorldsOfRodsAndOfScenes) {
  const std::string rods = "bench row_1k --duration 0.01 --json --worlds ";
  std::vector<std::string> hashes;
  for (const std::string worlds : {"1", "3 --threads 2"}) {
    ASSERT_EQ(run(rods + worlds), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_EQ(json.at("worlds"), std::stoi(worlds));
    EXPECT_GT(json.at("one_real_time_factor"), 0.0);
    EXPECT_GT(json.at("real_time_factor"), 0.0);
    hashes.push_back(json.at("state_hash"));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  ASSERT_EQ(run("bench " + path("quick.scene.yaml") + " --worlds 2 --threads 1"), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("2 worlds, 1 thread, dt 1/240 s, 0.10 s each: "));
  EXPECT_THAT(out_, HasSubstr("state hash of every world and of one alone "));
  EXPECT_EQ(run("bench " + path("none.scene.yaml") + " --worlds 2"), 3);
  EXPECT_EQ(run("bench " + path("quick.scene.yaml") + " --self-contact"), 2);
  EXPECT_THAT(err_, HasSubstr("expected --set coupling.self_contact=1 for a scene"));
  EXPECT_EQ(run(rods + "0"), 2);
}

TEST_F(Program, BadFilesEndWith3AndSayWhere) {
  EXPECT_EQ(run_scene("", "none.scene.yaml"), 3);
  write("bad.scene.yaml", with(quick_scene, "duration: 0.1", "duration: soon"));
  EXPECT_EQ(run_scene("", "bad.scene.yaml"), 3);
  EXPECT_THAT(err_, HasSubstr("bad.scene.yaml:5:11: error: duration is \"soon\""));
  EXPECT_EQ(run_scene("--set rods.newton_iterations=0"), 3);
  EXPECT_EQ(run_scene("--set detach.strech=0.1"), 3);
  EXPECT_THAT(err_, HasSubstr("unknown key \"detach.strech\""));
}

// A kick of 1e9 N moves a stem of grams faster than anything may move.
TEST_F(Program, UnstableRunEndsWith4NamesTheOrganAndKeepsItsRecord) {
  write("stem.plant.yaml", std::string(bent_stem_text) +
                               "fruits:\n  - {name: fruit_1, curve: stem, at: 1.0, radius: 0.01, "
                               "density: 900, detach: {}}\n");
  write("wild.scene.yaml", with(quick_scene, "expect:",
                                "loads:\n  - {fruit: stem/fruit_1, force: [1.0e+9, 0, 0], "
                                "from: 0.05, to: 1}\nexpect:"));
  EXPECT_EQ(run_scene("", "wild.scene.yaml"), 4) << err_;
  EXPECT_THAT(err_, HasSubstr("stem/stem"));
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(folder_ / "out/log.csv", {true, true}, diagnostics);
  EXPECT_GE(log.rows.size(), 4u) << diagnostics.text();
  EXPECT_EQ(run("bench " + path("wild.scene.yaml") + " --worlds 2"), 4);
  EXPECT_THAT(err_, HasSubstr("world 1 is unstable: "));
}

TEST_F(Program, UnmetExpectationEndsWith5) {
  write("wrong.scene.yaml", with(quick_scene, "is: 0", "is: 1"));
  EXPECT_EQ(run_scene("", "wrong.scene.yaml"), 5);
  EXPECT_THAT(err_, HasSubstr("NOT MET detached_count is 1: 0"));
}

TEST_F(Program, OutputThatCannotBeWrittenEndsWith6) {
  EXPECT_EQ(run("--headless " + path("quick.scene.yaml") + " --out /proc/nowhere --no-pictures"),
            6);
  EXPECT_THAT(err_, HasSubstr("/proc/nowhere"));
}

TEST_F(Program, InterruptEndsWith130AndReadableFiles) {
  write("long.scene.yaml", with(quick_scene, "duration: 0.1", "duration: 100000"));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(PEDICEL_PROGRAM, PEDICEL_PROGRAM, "--headless", path("long.scene.yaml").c_str(), "--out",
          path("out").c_str(), "--no-pictures", "--quiet", nullptr);
    _exit(127);
  }
  for (int i = 0; i < 200 && !std::filesystem::exists(folder_ / "out/log.csv"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  Diagnostics diagnostics;
  const io::CsvTable log = io::read_csv(folder_ / "out/log.csv", {true, true}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/log.meta.json"));
}

TEST_F(Program, SweepRunsEveryValue) {
  EXPECT_EQ(run("sweep " + path("quick.scene.yaml") + " --out " + path("out") +
                " --no-pictures --quiet --set material.density=400,800"),
            0)
      << err_;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/sweep.csv"));
}

TEST_F(Program, ValidateSaysWhichFilesAreBad) {
  EXPECT_EQ(run("validate " + path("quick.scene.yaml") + " " + path("stem.plant.yaml")), 0) << err_;
  write("bad.scene.yaml", with(quick_scene, "duration: 0.1", "duration: soon"));
  EXPECT_EQ(run("validate " + path("bad.scene.yaml") + " " + path("stem.plant.yaml")), 3);
}

}  // namespace
}  // namespace pedicel
