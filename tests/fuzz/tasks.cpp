#include "engine/cluster/task_file.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  Diagnostics diagnostics;
  const cluster::TaskFile tasks =
      cluster::parse_task_file(fuzz::text_of(data, size), "tasks.jsonl", diagnostics);
  if (diagnostics.has_errors()) return 0;
  // What is read is written, and read again as the same.
  const std::filesystem::path file = folder.write("tasks.jsonl", "");
  cluster::write_task_file(file, tasks);
  const cluster::TaskFile again = cluster::read_task_file(file);
  fuzz::require(again.cases.size() == tasks.cases.size(), "as many cases again");
  for (std::size_t i = 0; i < tasks.cases.size(); ++i)
    fuzz::require(again.cases[i].arguments == tasks.cases[i].arguments, "the same arguments");
  return 0;
}
