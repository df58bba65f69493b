// stalks [--out DIR] [--seed N] [--count N] [--threads N]
// Hidden stalks from the robot alone: joints and a wrist's wrench, and no marker. Writes
// DIR/stalks.md: where the tool is said to hold, where the stalk to be attached, its stiffness, and
// when the force broke off, each with its error.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/core/exit_code.h"
#include "engine/io/atomic_file.h"
#include "tests/discrepancy/harvest/hidden_stalk.h"

int main(int argc, char** argv) {
  using namespace pedicel;
  std::filesystem::path out = "out/stalks";
  std::uint64_t seed = 101;
  int count = 12, threads = 1;
  CLI::App app{"Where a tool holds a hidden stalk, from the robot's own sensors alone."};
  app.add_option("--out", out, "folder of everything")->capture_default_str();
  app.add_option("--seed", seed, "of the first stalk")->capture_default_str();
  app.add_option("--count", count, "stalks")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", threads)->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<harvest::StalkTold> stalks;
    for (int i = 0; i < count; ++i) {
      const std::uint64_t own = seed + static_cast<std::uint64_t>(i);
      const std::filesystem::path folder = out / ("stalk_" + std::to_string(own));
      stalks.push_back(harvest::look_at_stalk(folder, own, threads));
      io::write_file_atomically(folder / "findings.txt", stalks.back().findings);
      // After each, so that one that is cut short has told what it knows.
      io::write_file_atomically(out / "stalks.md", harvest::table(stalks));
    }
    std::printf("%s", harvest::table(stalks).c_str());
  } catch (const io::WriteError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_unwritable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_failure;
  }
  return exit_ok;
}
