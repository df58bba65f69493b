#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pedicel::stress {

/// What became of one seed.
struct SeedResult {
  int seed = 0;
  bool passed = true;
  std::string text;             ///< the case and what went wrong, for people
  std::vector<double> figures;  ///< what the program tells the worst of
};

/// A program that runs seeds.
struct SeedProgram {
  std::string name, help;
  int count = 1000;          ///< seeds, where none are asked for
  int seeds_of_a_case = 20;  ///< that a task of --cluster does in one go
  std::function<SeedResult(int seed)> run;
  std::function<void(const std::vector<SeedResult>&)> tell;  ///< the worst figures, on stdout
};

/// NAME [COUNT [FIRST]]: runs the seeds on every core, or as tasks with --cluster. Prints those
/// that fail, the worst figures and how many passed; exit code 1 where one failed.
int seeds_main(int argc, char** argv, const SeedProgram& program);

/// "what 0.93 (seed 17)", of the largest one.
void print_worst(const std::vector<SeedResult>& results, const char* what, std::size_t figure);

}  // namespace pedicel::stress
