#include "engine/cluster/task_run.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "engine/cluster/build_id.h"
#include "engine/cluster/case_run.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

void check_program(const TaskHead& head, const ProgramAbout& about) {
  const ProgramIdentity here = about.identity();
  if (here == head.program) return;
  const auto told = [](const ProgramIdentity& program) {
    return program.version + " (" + program.git_hash + ", build " + program.build.substr(0, 8) +
           ")";
  };
  throw UsageError("this program is " + told(here) + ", expected " + told(head.program) +
                   ", which wrote the task file: the same call again writes a new one");
}

}  // namespace

ProgramIdentity ProgramAbout::identity() const {
  return {version, git_hash, build_id()};
}

int run_task(const std::filesystem::path& folder, int block, const std::filesystem::path& scratch,
             const ProgramAbout& about) {
  stop_in_good_order();
  const RunFolder run(folder);
  const TaskFile tasks = read_block(run.tasks(), block);
  check_program(tasks.head, about);
  const CaseRunOptions options{run, scratch, about.instruction_set(tasks.head.instruction_set)};
  InputCheck inputs(tasks.head);
  std::string summary;
  int failed = 0;
  for (const Case& one : tasks.cases) {
    throw_if_stopped();
    const CaseRecord record = run_case(tasks.head, one, inputs, options);
    if (!record.reason.empty()) {
      ++failed;
      std::fprintf(stderr, "%s: %s\n", one.name.c_str(), record.reason.c_str());
    }
    summary += to_json(record) + "\n";
  }
  if (failed == 0) io::write_file_atomically(run.block(tasks.head.run, block), summary);
  return failed > 0 ? 1 : 0;
}

std::optional<int> run_as_task(int argc, char** argv, const ProgramAbout& about) {
  if (argc < 5 || std::strcmp(argv[1], "cluster") != 0 || std::strcmp(argv[2], "task") != 0)
    return std::nullopt;
  const bool has_scratch = argc == 7 && std::strcmp(argv[5], "--scratch") == 0;
  try {
    return run_task(argv[3], std::atoi(argv[4]), has_scratch ? argv[6] : "", about);
  } catch (const Stopped&) {
    return stop_exit_code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

}  // namespace pedicel::cluster
