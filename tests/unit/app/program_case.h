#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "engine/io/atomic_file.h"
#include "tests/support/stem_plants.h"

namespace pedicel {

inline const char* const quick_scene = R"(format: pedicel-scene
version: 1
purpose: a stem that stands
see: nothing moves
duration: 0.1
plants:
  - {name: stem, file: stem.plant.yaml}
expect:
  - {quantity: detached_count, is: 0}
)";

inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ("program_" + std::string(test->name()));
    std::filesystem::remove_all(folder_);
    write("stem.plant.yaml", bent_stem_text);
    write("quick.scene.yaml", quick_scene);
  }
  void write(const std::string& name, const std::string& text) {
    io::write_file_atomically(folder_ / name, text);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// The exit code; what it printed is then in out_ and err_.
  int run(const std::string& arguments) {
    const std::string command = std::string(PEDICEL_PROGRAM) + " " + arguments + " >" +
                                path("stdout") + " 2>" + path("stderr");
    const int status = std::system(command.c_str());
    out_ = io::read_file(folder_ / "stdout");
    err_ = io::read_file(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int run_scene(const std::string& more = {}, const std::string& scene = "quick.scene.yaml") {
    return run("--headless " + path(scene) + " --out " + path("out") + " --no-pictures " + more);
  }

  /// Starts it and comes back; its output goes nowhere.
  pid_t start(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {PEDICEL_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> words;
    for (std::string& word : all) words.push_back(word.data());
    words.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stdout);
      std::freopen(path("stderr").c_str(), "w", stderr);
      ::execv(words[0], words.data());
      ::_exit(127);
    }
    return child;
  }
  /// Waits until a file is there, with so many bytes; for 60 s at most.
  bool wait_for(const std::string& name, std::uintmax_t bytes = 0) const {
    std::error_code none;
    for (int i = 0; i < 1200; ++i) {
      if (std::filesystem::exists(folder_ / name) &&
          std::filesystem::file_size(folder_ / name, none) >= bytes)
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  /// The exit code of a child, and how long it took, s; -1 where a signal ended it.
  static int exit_code_of(pid_t child, double* seconds = nullptr) {
    const auto begin = std::chrono::steady_clock::now();
    int status = 0;
    ::waitpid(child, &status, 0);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (seconds) *seconds = passed.count();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder_;
  std::string out_, err_;
};

}  // namespace pedicel
