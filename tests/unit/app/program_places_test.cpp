// Places that are written to: looked at before anything is touched.
#include <fstream>

#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ProgramPlaces : public Program {};

/// A folder of the kernel's, in which nobody can make a file.
const char* const nowhere = "/proc/no_place";

TEST_F(ProgramPlaces, AnOutputThatCannotBeTakesNothingAway) {
  ASSERT_EQ(run_scene(), 0) << err_;
  const std::string earlier = io::read_file(folder_ / "out/log.csv");
  for (const std::string option : {"--log", "--events", "--save-state"})
    for (const std::string end : {".csv", "/deep/x.csv"}) {
      EXPECT_EQ(run_scene(option + " " + nowhere + end), 6) << option;
      EXPECT_THAT(err_, HasSubstr(std::string(nowhere) + end + ": cannot be written: "));
      EXPECT_EQ(io::read_file(folder_ / "out/log.csv"), earlier) << option;
    }
  for (const std::string outputs : {"--log /proc/x.mcap", "--gltf /proc/x.glb", "--log /dev/null"})
    EXPECT_EQ(run_scene(outputs), 6) << err_;
  EXPECT_EQ(run_scene("--log " + path("out")), 2) << err_;
  fs::create_directories(folder_ / "folder");
  EXPECT_EQ(run_scene("--save-state " + path("folder")), 6) << err_;
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
}

TEST_F(ProgramPlaces, AnInputIsNoOutput) {
  EXPECT_EQ(run_scene("--log " + path("quick.scene.yaml")), 2);
  EXPECT_THAT(err_, HasSubstr("is the file of the scene, expected another name"));
  EXPECT_EQ(io::read_file(folder_ / "quick.scene.yaml"), quick_scene);
  EXPECT_EQ(run_scene("--save-state " + path("out/report.html")), 2);
  EXPECT_THAT(err_, HasSubstr("the run writes a file of its own there"));
  EXPECT_EQ(run_scene("--log " + path("out/log.csv")), 0) << "it is that already: " << err_;
}

TEST_F(ProgramPlaces, OnlyAnEarlierOutputOfItsKindIsReplaced) {
  write("other.scene.yaml", quick_scene);
  write("way.csv", "time_s,joint1\n0,0\n1,0\n");
  for (const std::string option : {"--log", "--events", "--save-state"})
    for (const std::string file : {"other.scene.yaml", "stem.plant.yaml", "way.csv"}) {
      const std::string earlier = io::read_file(folder_ / file);
      EXPECT_EQ(run_scene(option + " " + path(file)), 6) << option << " " << file;
      EXPECT_THAT(err_, HasSubstr(file + ": is there, and is not "));
      EXPECT_EQ(io::read_file(folder_ / file), earlier);
    }
  const std::string mine =
      "--log " + path("l.csv") + " --events " + path("e.csv") + " --save-state " + path("s.yaml");
  EXPECT_EQ(run_scene(mine), 0) << err_;
  EXPECT_EQ(run_scene(mine), 0) << "its own outputs of before: " << err_;
  EXPECT_EQ(run_scene("--events " + path("l.csv")), 6) << "a log is no table of events";
  // Another run's log, which the list of its folder names.
  ASSERT_TRUE(fs::exists(folder_ / "out/log.csv"));
  EXPECT_EQ(run("--headless " + path("quick.scene.yaml") + " --no-pictures --out " + path("two") +
                " --log " + path("out/log.csv")),
            6);
  EXPECT_THAT(err_, HasSubstr("is of the run in its folder, expected another name"));
  for (const std::string option : {"--gltf ", "--log "}) {
    const std::string name = option == "--gltf " ? "note.glb" : "note.mcap";
    write(name, "mine");
    EXPECT_EQ(run_scene(option + path(name)), 6) << err_;
    EXPECT_EQ(io::read_file(folder_ / name), "mine");
  }
}

TEST_F(ProgramPlaces, WhatTakesLongLooksAtItsFolderFirst) {
  // The experiment is not even read.
  EXPECT_EQ(run("diagnose " + path("nothing") + " --out " + nowhere), 6) << err_;
  EXPECT_EQ(run("fit " + path("nothing") + " density --out " + nowhere), 6) << err_;
  write("mine/verdict.json", "mine");
  EXPECT_EQ(run("diagnose " + path("nothing") + " --out " + path("mine")), 6);
  EXPECT_THAT(err_, HasSubstr("verdict.json: is there, and no list says that a run wrote it"));
}

TEST_F(ProgramPlaces, ASettingThatNoPlantHasIsFoundBeforeTheFirstRun) {
  const std::string sweep =
      "sweep " + path("quick.scene.yaml") + " --no-pictures --out " + path("swept") + " --set ";
  for (const std::string set : {"detach.strech=0.1,0.2", "material.density=100,-1",
                                "rods.nokey=1,2", "coupling.friction=0.1,nan"}) {
    EXPECT_NE(run(sweep + set), 0) << set;
    EXPECT_FALSE(fs::exists(path("swept"))) << set;
  }
  write("table.csv", "material.density,detach.strech\n400,0.1\n");
  EXPECT_EQ(run("sweep " + path("quick.scene.yaml") + " --no-pictures --out " + path("swept") +
                " --param-sweep " + path("table.csv")),
            3)
      << err_;
  EXPECT_FALSE(fs::exists(path("swept")));
  write("table.csv", "dt,dt\n0.001,0.002\n");
  EXPECT_EQ(run("sweep " + path("quick.scene.yaml") + " --no-pictures --out " + path("swept") +
                " --param-sweep " + path("table.csv")),
            3);
  EXPECT_THAT(err_, HasSubstr("column \"dt\" appears twice, expected each key once"));
  write("own.scene.yaml", std::string(quick_scene) + "sweep: {set: detach.strech, values: [1]}\n");
  EXPECT_EQ(run_scene("", "own.scene.yaml"), 3) << err_;
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(ProgramPlaces, WhatIsNoNumberIsNoOption) {
  for (const std::string& call : std::vector<std::string>{
           "sweep " + path("quick.scene.yaml") + " --set dt=0.001,0.002 --case-seconds nan",
           "bench cantilever --dt nan", "diagnose x --time-limit nan", "pick x --rest inf"}) {
    EXPECT_EQ(run(call), 2) << call;
    EXPECT_THAT(err_, HasSubstr("expected a finite number")) << call;
  }
}

TEST_F(ProgramPlaces, AStateWhoseStepsWereChangedIsRefusedAtOnce) {
  ASSERT_EQ(run_scene("--save-state " + path("state.yaml")), 0) << err_;
  const std::string state = io::read_file(folder_ / "state.yaml");
  const std::size_t at = state.find("steps: ") + 7;
  const std::string steps = state.substr(at, state.find('\n', at) - at);
  write("state.yaml", with(state, "steps: " + steps, "steps: 90000000"));
  EXPECT_EQ(run_scene("--load-state " + path("state.yaml")), 3);
  EXPECT_THAT(err_, HasSubstr("sum: does not agree with the other numbers"));
  write("state.yaml", with(state, "steps: " + steps, "steps: 900000000000"));
  EXPECT_EQ(run_scene("--load-state " + path("state.yaml")), 3);
  EXPECT_THAT(err_, HasSubstr("expected at most 1000000 s"));
}

TEST_F(ProgramPlaces, ACameraThatFollowsWhatIsNotThereIsRefused) {
  write("follow.scene.yaml",
        std::string(quick_scene) +
            "cameras: [{name: c, eye: [1, 0, 0], follow: {fruit: stem/nix}}]\n");
  EXPECT_EQ(run_scene("", "follow.scene.yaml"), 3);
  EXPECT_THAT(err_, HasSubstr("camera \"c\" follows \"stem/nix\", which is not there"));
}

TEST_F(ProgramPlaces, WhatVariesIsNamedByItsPlace) {
  write("vary.scene.yaml",
        std::string(quick_scene) + "vary:\n  detach.strech: {low: 1, high: 2}\n");
  EXPECT_EQ(run_scene("", "vary.scene.yaml"), 3);
  EXPECT_THAT(err_, HasSubstr("vary.scene.yaml:11:18: error: "));
}

TEST_F(ProgramPlaces, ADataSetIsMadeByOneAtATimeAndGoesOnWithoutADrawThatCannotStand) {
  write("vary.yaml",
        "format: pedicel-variation\nversion: 1\nvary:\n"
        "  material.density: {distribution: choice, values: [400, 800, -1]}\n");
  write("view.scene.yaml", std::string(quick_scene) + "cameras: [{name: c, eye: [1, 0, 0.1]}]\n");
  const std::string call = "dataset " + path("view.scene.yaml") + " --out " + path("set") +
                           " --size 64x48 --at 0 --randomise " + path("vary.yaml") + " --count ";
  const int code = run(call + "12");
  if (code == 77) GTEST_SKIP() << "no OpenGL";
  EXPECT_EQ(code, 0) << err_;
  EXPECT_THAT(err_, HasSubstr("is left out: "));
  EXPECT_THAT(err_, HasSubstr("of 12 pictures are left out; labels/NUMBER.json says why"));
  EXPECT_EQ(run(call + "12"), 0) << "it goes on: " << err_;
  const fs::path picture = fs::directory_iterator(folder_ / "set/images")->path();
  fs::remove(picture);
  EXPECT_EQ(run(call + "12"), 0) << err_;
  EXPECT_TRUE(fs::exists(picture)) << "what was taken away is made anew";
  const pid_t first =
      start({"dataset", path("view.scene.yaml"), "--out", path("set"), "--size", "64x48", "--at",
             "0", "--randomise", path("vary.yaml"), "--count", "100000"});
  ASSERT_TRUE(wait_for("set/labels/000014.json"));
  EXPECT_EQ(run(call + "12"), 6);
  EXPECT_THAT(err_, HasSubstr("another run is writing there"));
  ::kill(first, SIGTERM);
  EXPECT_EQ(exit_code_of(first), 143);
}

}  // namespace
}  // namespace pedicel
