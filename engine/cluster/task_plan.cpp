#include "engine/cluster/task_plan.h"

#include <algorithm>
#include <cmath>

#include "engine/cluster/build_id.h"
#include "engine/cluster/sha256.h"

namespace pedicel::cluster {

namespace {

namespace fs = std::filesystem;

/// From the folder where it is below it, so that the same tree elsewhere gives the same names.
std::string path_from(const fs::path& folder, const fs::path& file) {
  const fs::path whole = fs::weakly_canonical(folder / file);
  const fs::path inside = whole.lexically_relative(fs::weakly_canonical(folder));
  return inside.empty() || *inside.begin() == ".." ? whole.string() : inside.generic_string();
}

std::vector<Input> inputs_of(const Plan& plan, const fs::path& folder) {
  std::vector<Input> inputs;
  for (const fs::path& file : plan.inputs) inputs.push_back({path_from(folder, file), {}});
  std::ranges::sort(inputs, {}, &Input::path);
  const auto is_same = [](const Input& a, const Input& b) { return a.path == b.path; };
  inputs.erase(std::unique(inputs.begin(), inputs.end(), is_same), inputs.end());
  for (Input& input : inputs) input.sha256 = sha256_of_file(folder / input.path);
  return inputs;
}

}  // namespace

TaskFile tasks_of(const Plan& plan, const ProgramAbout& about) {
  TaskFile tasks;
  TaskHead& head = tasks.head;
  head.verb = plan.verb;
  head.file = program_file();
  head.program = about.identity();
  head.instruction_set = about.instruction_set(plan.instruction_set);
  head.folder = fs::current_path();
  head.common = plan.common;
  head.common.push_back("--instruction-set=" + head.instruction_set);
  head.again = plan.again;
  head.results = plan.results;
  head.inputs = inputs_of(plan, head.folder);
  head.threads = plan.threads;
  for (const PlannedCase& planned : plan.cases) {
    Case one;
    one.number = one.block = static_cast<int>(tasks.cases.size());
    one.name = planned.name;
    one.arguments = planned.arguments;
    one.id = case_id(head, one);
    tasks.cases.push_back(std::move(one));
  }
  head.cases = head.blocks = static_cast<int>(tasks.cases.size());
  head.run = run_id(tasks);
  return tasks;
}

void make_blocks(TaskFile& tasks, double block_seconds, double case_seconds) {
  const double fit = std::floor(block_seconds / std::max(case_seconds, 1.0e-3) + 0.5);
  const int most = static_cast<int>(std::clamp(fit, 1.0, static_cast<double>(most_cases)));
  TaskHead& head = tasks.head;
  head.blocks = (head.cases + most - 1) / most;
  // Of one size, or one less.
  for (Case& one : tasks.cases)
    one.block = static_cast<int>(static_cast<long>(one.number) * head.blocks / head.cases);
  head.block_seconds = block_seconds;
  head.case_seconds = case_seconds;
  head.run = run_id(tasks);
}

bool same_cases(const TaskFile& a, const TaskFile& b) {
  return a.head.verb == b.head.verb &&
         std::ranges::equal(a.cases, b.cases, {}, &Case::id, &Case::id) &&
         std::ranges::equal(a.cases, b.cases, {}, &Case::name, &Case::name);
}

}  // namespace pedicel::cluster
