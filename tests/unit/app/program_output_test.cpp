// What runs write, where, and what they leave when they are stopped, killed, or the disk is full.
#include <fstream>

#include "engine/io/csv.h"
#include "engine/render/video.h"
#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class ProgramOutput : public Program {
 protected:
  /// Runs in the test's folder, without --out: what is written by default.
  int run_there(const std::string& arguments) {
    const std::string command = "cd '" + folder_.string() + "' && " + PEDICEL_PROGRAM + " " +
                                arguments + " >stdout 2>stderr";
    const int status = std::system(command.c_str());
    err_ = io::read_file(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  io::CsvTable log(const std::string& out = "out") const {
    Diagnostics diagnostics;
    io::CsvTable table = io::read_csv(folder_ / out / "log.csv", {true, true}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.text();
    return table;
  }
};

TEST_F(ProgramOutput, NamesKeepTheirDots) {
  write("pull_0.1.scene.yaml", quick_scene);
  write("pull_0.2.scene.yaml", quick_scene);
  EXPECT_EQ(run_there("--headless pull_0.1.scene.yaml --no-pictures"), 0) << err_;
  EXPECT_EQ(run_there("--headless pull_0.2.scene.yaml --no-pictures"), 0) << err_;
  EXPECT_THAT(err_, HasSubstr("written to out/pull_0.2"));
  EXPECT_TRUE(fs::exists(folder_ / "out/pull_0.1/log.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "out/pull_0.2/log.csv"));
}

TEST_F(ProgramOutput, NamesOfDotsStayBelowOut) {
  for (const std::string name : {"...scene.yaml", "..scene.yaml"}) {
    write(name, quick_scene);
    EXPECT_EQ(run_there("--headless ./" + name + " --no-pictures"), 0) << err_;
    EXPECT_TRUE(fs::exists(folder_ / "out" / fs::path(name).stem() / "log.csv")) << name << err_;
  }
  EXPECT_FALSE(fs::exists(folder_ / "log.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/log.csv"));
}

TEST_F(ProgramOutput, NamesMayHoldCommasAndQuotes) {
  write("names.scene.yaml",
        std::string(quick_scene) +
            "bodies: [{name: 'a,b', sphere: {radius: 0.05}, position: [2, 0, 0]}, "
            "{name: 'f,1\"', sphere: {radius: 0.05}, position: [1, 0, 0]}]\n");
  EXPECT_EQ(run_scene("", "names.scene.yaml"), 0) << err_;
  const io::CsvTable table = log();
  EXPECT_GE(table.column("contact_a,b_normal_N"), 0);
  EXPECT_GE(table.column("contact_f,1\"_normal_N"), 0);
  EXPECT_GT(table.rows.size(), 1u);
}

TEST_F(ProgramOutput, ATerminalObeysNoNames) {
  write("e\033[31msc\a.scene.yaml", quick_scene);
  EXPECT_EQ(run_there("--headless \"$(printf 'e\\033[31msc\\007.scene.yaml')\" --no-pictures"), 0)
      << err_;
  EXPECT_THAT(err_, HasSubstr("scene e\\x1B[31msc\\x07, seed"));
  EXPECT_THAT(err_, Not(HasSubstr("\033")));
  EXPECT_THAT(err_, Not(HasSubstr("\a")));
}

TEST_F(ProgramOutput, ASecondRunReplacesTheFirstAsAWholeAndSaysSo) {
  EXPECT_EQ(run("sweep " + path("quick.scene.yaml") + " --out " + path("out") +
                " --no-pictures --set material.density=400,800"),
            0)
      << err_;
  EXPECT_TRUE(fs::exists(folder_ / "out/sweep_material.density=400/log.csv"));
  write("out/notes.txt", "mine");
  EXPECT_EQ(run_scene(), 0);
  EXPECT_THAT(err_, HasSubstr("out: replaces the run of "));
  EXPECT_FALSE(fs::exists(folder_ / "out/sweep.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "out/sweep_material.density=400"));
  EXPECT_EQ(io::read_file(folder_ / "out/notes.txt"), "mine");
}

TEST_F(ProgramOutput, ARunThatCannotBeginTakesNothingAway) {
  ASSERT_EQ(run_scene(), 0);
  EXPECT_EQ(run_scene("--set detach.strech=0.1"), 3);
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
}

TEST_F(ProgramOutput, FilesOfSomebodyElseAreNotReplaced) {
  write("out/log.csv", "mine");
  EXPECT_EQ(run_scene(), 6);
  EXPECT_THAT(err_, HasSubstr("out/log.csv: is there, and no list says that a run wrote it"));
  EXPECT_EQ(io::read_file(folder_ / "out/log.csv"), "mine");
}

TEST_F(ProgramOutput, TwoAtOnceIntoOneFolderDoNotMix) {
  write("long.scene.yaml", with(quick_scene, "duration: 0.1", "duration: 100000"));
  const pid_t first = start(
      {"--headless", path("long.scene.yaml"), "--out", path("out"), "--no-pictures", "--quiet"});
  ASSERT_TRUE(wait_for("out/log.csv", 1000));
  EXPECT_EQ(run_scene(), 6);
  EXPECT_THAT(err_, HasSubstr("another run is writing there"));
  ::kill(first, SIGTERM);
  EXPECT_EQ(exit_code_of(first), 143);
  EXPECT_GT(log().rows.size(), 1u);
  EXPECT_EQ(run_scene(), 0) << "the folder is free again: " << err_;
}

TEST_F(ProgramOutput, SaysTheSystemsReason) {
  write("file", "x");
  EXPECT_EQ(run("--headless " + path("quick.scene.yaml") + " --out " + path("file")), 6);
  EXPECT_THAT(err_, HasSubstr("file: cannot be created: Not a directory"));
}

TEST_F(ProgramOutput, AFullDiskLeavesWholeRowsAndNoBrokenFilm) {
  write("long.scene.yaml",
        with(quick_scene, "duration: 0.1", "duration: 60") + "video: {fps: 30, size: [64, 48]}\n");
  const std::string limited = "sh -c 'ulimit -f 40; exec \"$0\" \"$@\"' ";  // blocks of 512 bytes
  const std::string command = limited + PEDICEL_PROGRAM + " --headless " + path("long.scene.yaml") +
                              " --out " + path("out") + " 2>" + path("stderr");
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "no OpenGL";
  err_ = io::read_file(folder_ / "stderr");
  EXPECT_EQ(WEXITSTATUS(status), 6) << err_;
  EXPECT_THAT(err_, HasSubstr("File too large"));
  EXPECT_GT(log().rows.size(), 1u);
  for (const auto& entry : fs::directory_iterator(folder_ / "out"))
    EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr(".part")));
  EXPECT_FALSE(fs::exists(folder_ / "out/report.html"));
}

class ProgramStop : public ProgramOutput, public ::testing::WithParamInterface<int> {
 protected:
  void write_long_scene() {
    write("long.scene.yaml", with(quick_scene, "duration: 0.1", "duration: 100000"));
  }
  /// Until it has a handler of SIGTERM.
  static bool wait_until_it_hears(pid_t child) {
    for (int i = 0; i < 600; ++i) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigCgt:") &&
            (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1))
          return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  static constexpr double at_once = 2.0;  // s; a second, on a machine that does other things too
};
INSTANTIATE_TEST_SUITE_P(Signals, ProgramStop, ::testing::Values(SIGINT, SIGTERM, SIGHUP, SIGXCPU));

TEST_P(ProgramStop, ARunLeavesTablesReportAndState) {
  write_long_scene();
  const pid_t child = start({"--headless", path("long.scene.yaml"), "--out", path("out"),
                             "--no-pictures", "--quiet", "--save-state", path("state.yaml")});
  ASSERT_TRUE(wait_for("out/log.csv", 1000));
  ::kill(child, GetParam());
  double seconds = 0.0;
  EXPECT_EQ(exit_code_of(child, &seconds), 128 + GetParam());
  EXPECT_LT(seconds, at_once);
  EXPECT_GT(log().rows.size(), 1u);
  for (const char* file : {"out/report.html", "out/log.meta.json", "state.yaml"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
}

// Ten thousand plants are built for a minute or so.
TEST_P(ProgramStop, LoadingIsStoppedAtOnce) {
  write("many.scene.yaml",
        with(quick_scene, "file: stem.plant.yaml}",
             "file: stem.plant.yaml, repeat: {count: [100, 100], spacing: [1, 1]}}"));
  const pid_t child =
      start({"--headless", path("many.scene.yaml"), "--out", path("out"), "--no-pictures"});
  ASSERT_TRUE(wait_until_it_hears(child));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, GetParam());
  double seconds = 0.0;
  EXPECT_EQ(exit_code_of(child, &seconds), 128 + GetParam());
  EXPECT_LT(seconds, at_once);
  EXPECT_FALSE(fs::exists(folder_ / "out/log.csv"));
}

TEST_P(ProgramStop, ASweepStillWritesItsReport) {
  write_long_scene();
  write("sweep.scene.yaml",
        std::string(quick_scene) + "sweep: {set: duration, values: [100000, 200000]}\n");
  const pid_t child = start(
      {"--headless", path("sweep.scene.yaml"), "--out", path("out"), "--no-pictures", "--quiet"});
  ASSERT_TRUE(wait_for("out/sweep_duration=100000/log.csv", 1000));
  ::kill(child, GetParam());
  double seconds = 0.0;
  EXPECT_EQ(exit_code_of(child, &seconds), 128 + GetParam());
  EXPECT_LT(seconds, at_once);
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "out/sweep.csv"));
}

/// Frames of a film, by ffprobe; -1 where it cannot be read.
int frames_of(const fs::path& film) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames "
      "-of csv=p=0 '" +
      film.string() + "' 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  int frames = -1;
  if (pipe && std::fscanf(pipe, "%d", &frames) != 1) frames = -1;
  if (pipe) ::pclose(pipe);
  return frames;
}

TEST_F(ProgramOutput, AFilmIsReadableAfterAStopAndAfterAKill) {
  if (!render::ffmpeg_encodes()) GTEST_SKIP() << "no ffmpeg that encodes H.264";
  write("film.scene.yaml", with(quick_scene, "duration: 0.1", "duration: 100000") +
                               "video: {fps: 30, size: [64, 48]}\n");
  for (const int signal : {SIGTERM, SIGKILL}) {
    const std::string out = "out_" + std::to_string(signal);
    const pid_t child =
        start({"--headless", path("film.scene.yaml"), "--out", path(out), "--quiet"});
    ASSERT_TRUE(wait_for(out + "/log.csv", 5000));
    std::this_thread::sleep_for(std::chrono::seconds(3));
    ::kill(child, signal);
    EXPECT_EQ(exit_code_of(child), signal == SIGKILL ? -1 : 143);
    std::this_thread::sleep_for(std::chrono::seconds(1));  // the encoder ends by itself
    const fs::path film = folder_ / out / (signal == SIGKILL ? "run.mp4.part" : "run.mp4");
    if (!fs::exists(film)) GTEST_SKIP() << "no OpenGL";
    EXPECT_GT(frames_of(film), 10);
    EXPECT_GT(log(out).rows.size(), 1u);
  }
}

TEST_F(ProgramOutput, AReaderThatGoesAwayEndsItWith141) {
  const std::string command =
      std::string("(") + PEDICEL_PROGRAM + " --headless " + path("quick.scene.yaml") + " --out " +
      path("out") + " --no-pictures --json; echo $? > " + path("code") + ") 2>/dev/null | true";
  EXPECT_NE(std::system(command.c_str()), -1);
  EXPECT_THAT(io::read_file(folder_ / "code"), ::testing::AnyOf("141\n", "0\n"));
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
}

// `ulimit -t` sets the limit at which the kernel kills, too: the program hears of it before.
TEST_F(ProgramOutput, TheEndOfItsComputingTimeIsHeard) {
  write("long.scene.yaml", with(quick_scene, "duration: 0.1", "duration: 100000"));
  const std::string command = std::string("sh -c 'ulimit -t 3; exec \"$0\" \"$@\"' ") +
                              PEDICEL_PROGRAM + " --headless " + path("long.scene.yaml") +
                              " --out " + path("out") + " --no-pictures --quiet 2>/dev/null";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 152);
  EXPECT_TRUE(fs::exists(folder_ / "out/report.html"));
}

}  // namespace
}  // namespace pedicel
