#include "engine/cluster/survey.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "engine/cluster/case_run.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

namespace fs = std::filesystem;

// Looking for one case asks the file system once: so many a look are no load.
constexpr int most_looked_for = 2000;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  return files;
}

/// What two records would have to agree in.
std::string setting_of(const CaseRecord& r) {
  std::string text = "instruction set " + r.instruction_set + ", C library for " + r.math +
                     ", program " + r.program.version + " (" + r.program.git_hash + ", build " +
                     r.program.build.substr(0, 8) + ")";
  return text;
}

}  // namespace

Surveyor::Surveyor(RunFolder folder, const TaskFile& tasks)
    : folder_(std::move(folder)), tasks_(tasks), records_(tasks.cases.size()) {
  first_.assign(static_cast<std::size_t>(tasks.head.blocks) + 1,
                static_cast<int>(tasks.cases.size()));
  for (auto one = tasks.cases.rbegin(); one != tasks.cases.rend(); ++one)
    first_[one->block] = one->number;
}

void Surveyor::take_blocks() {
  for (const fs::path& file : files_in(folder_.blocks(tasks_.head.run))) {
    const int block = std::atoi(file.stem().c_str());
    if (block < 0 || block >= tasks_.head.blocks || !blocks_.insert(block).second) continue;
    std::istringstream lines(io::read_file(file));
    int number = first_[block];
    for (std::string line; std::getline(lines, line) && number < first_[block + 1]; ++number)
      records_[number] = parse_record(line, file.string());
  }
}

void Surveyor::take_cases(bool thorough) {
  int looked = 0;
  for (const Case& one : tasks_.cases) {
    if (records_[one.number]) {
      // A summary is no result: somebody may have taken the folder away.
      std::error_code error;
      if (thorough && !fs::exists(folder_.result(one.id) / "record.json", error))
        records_[one.number].reset();
      continue;
    }
    if (!thorough && ++looked > most_looked_for) return;
    records_[one.number] = finished(folder_, one.id);
  }
}

Survey Surveyor::look(bool thorough) {
  take_blocks();
  take_cases(thorough);
  Survey survey;
  survey.records = records_;
  std::set<std::string> open;
  for (const Case& one : tasks_.cases) {
    if (records_[one.number]) {
      survey.seconds += records_[one.number]->seconds;
    } else {
      survey.missing.push_back(one.number);
      open.insert(one.id);
    }
  }
  for (const fs::path& file : files_in(folder_.failure("x").parent_path()))
    if (open.contains(file.stem().string()))
      survey.failures.push_back(parse_record(io::read_file(file), file.string()));
  return survey;
}

std::string mixture(const Survey& survey) {
  const CaseRecord* first = nullptr;
  for (const auto& record : survey.records) {
    if (!record) continue;
    if (!first) first = &*record;
    if (setting_of(*record) != setting_of(*first))
      return "the results are a mixture: " + first->name + " of " + first->host + " has " +
             setting_of(*first) + "; " + record->name + " of " + record->host + " has " +
             setting_of(*record) +
             ". Expected one of each: --instruction-set names one that all nodes have, and a "
             "constraint of the profile keeps to like nodes";
  }
  return {};
}

std::vector<int> missing_blocks(const Survey& survey, const TaskFile& tasks) {
  std::set<int> blocks;
  for (const int number : survey.missing) blocks.insert(tasks.cases[number].block);
  return {blocks.begin(), blocks.end()};
}

}  // namespace pedicel::cluster
