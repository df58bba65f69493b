#include "engine/cluster/slurm_queue.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "engine/cluster/process.h"
#include "engine/core/joined.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

constexpr int default_array_size = 1001;  // Slurm's own

/// For /bin/sh.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// One more than the largest index that a task of an array may have.
int array_size() {
  std::istringstream lines(output_of({"scontrol", "show", "config"}));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (line.starts_with("MaxArraySize") && equals != std::string::npos)
      return std::max(2, std::atoi(line.c_str() + equals + 1));
  }
  return default_array_size;
}

/// "123" of sbatch --parsable's "123" or "123;cluster".
std::string job_number(const std::string& output) {
  const std::string line = last_line(output);
  return line.substr(0, line.find(';'));
}

}  // namespace

SlurmQueue::SlurmQueue(RunFolder folder, const TaskHead& head, const ClusterOptions& options)
    : folder_(std::move(folder)), head_(head), options_(options), jobs_(read_jobs(folder_)) {}

void SlurmQueue::write_script() const {
  std::string text = "#!/bin/sh\n# Written by pedicel: one task of a job array is one block of " +
                     folder_.tasks().filename().string() + ".\n";
  for (const std::string& line : options_.before) text += line + "\n";
  text += "exec " + quoted(head_.file.string()) + " cluster task " +
          quoted(folder_.path().string()) + " \"$((${1:-0} + SLURM_ARRAY_TASK_ID))\"";
  // Unquoted: $TMPDIR and the like are each node's own.
  if (!options_.scratch.empty()) text += " --scratch \"" + options_.scratch.string() + "\"";
  io::write_file_atomically(folder_.job_script(), text + "\n");
}

std::vector<std::string> SlurmQueue::command(const std::vector<int>& indices, int offset) const {
  std::string array = "--array=" + ranges_of(indices);
  if (options_.jobs > 0) array += "%" + std::to_string(options_.jobs);
  std::vector<std::string> words{"sbatch",
                                 "--parsable",
                                 "--requeue",
                                 "--ntasks=1",
                                 "--job-name=pedicel-" + head_.verb,
                                 "--cpus-per-task=" + std::to_string(head_.threads),
                                 "--chdir=" + head_.folder.string(),
                                 "--output=" + (folder_.logs() / "slurm_%A_%a.txt").string(),
                                 array};
  const std::pair<const char*, const std::string*> settings[] = {
      {"--partition=", &options_.partition},
      {"--account=", &options_.account},
      {"--time=", &options_.time},
      {"--mem=", &options_.memory}};
  for (const auto& [option, value] : settings)
    if (!value->empty()) words.push_back(option + *value);
  words.insert(words.end(), options_.sbatch.begin(), options_.sbatch.end());
  words.push_back(folder_.job_script().string());
  words.push_back(std::to_string(offset));
  return words;
}

void SlurmQueue::check() {
  try {
    output_of({"sbatch", "--version"});
    array_size();
  } catch (const std::runtime_error& fault) {
    throw_if_stopped();
    throw std::runtime_error(std::string("Slurm does not answer (") + fault.what() +
                             "), expected a node where sbatch works, or --cluster local");
  }
}

void SlurmQueue::submit(const std::vector<int>& blocks) {
  std::filesystem::create_directories(folder_.logs());
  write_script();
  const int size = array_size();
  if (jobs_.run != head_.run) jobs_ = {head_.run, {}};
  for (std::size_t i = 0; i < blocks.size();) {
    const int offset = blocks[i] / size * size;
    std::vector<int> indices;
    for (; i < blocks.size() && blocks[i] < offset + size; ++i)
      indices.push_back(blocks[i] - offset);
    const std::string job = job_number(output_of(command(indices, offset)));
    if (job.empty()) throw std::runtime_error("sbatch: gave no number of a job");
    jobs_.jobs.push_back(job);
    write_jobs(folder_, jobs_);
  }
}

Queue::State SlurmQueue::state() {
  State state;
  if (jobs_.jobs.empty()) return state;
  Process squeue(
      {"squeue", "--noheader", "--array", "--Format=JobArrayID:60,State:30,RestartCnt:20,Reason:60",
       "--jobs=" + joined(jobs_.jobs, {}, ",")},
      {});
  if (squeue.wait() != 0) {
    // Jobs that ended some minutes ago are forgotten, and are no jobs then.
    state.known = squeue.errors().find("Invalid job id") != std::string::npos;
    return state;
  }
  std::istringstream lines(squeue.output());
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string task, word, reason;
    int restarts = 0;
    if (!(words >> task >> word >> restarts >> reason)) continue;
    ++(word == "PENDING" ? state.waiting : state.running);
    if (word == "PENDING" && restarts > 0 && reason == "BeginTime") hurry(task);
  }
  return state;
}

// Slurm holds what it took back from a node that died for two minutes, in case the node was at
// fault for no reason. A case may be done twice, so there is nothing to wait for.
void SlurmQueue::hurry(const std::string& task) {
  if (!hurried_.insert(task).second) return;
  Process({"scontrol", "update", "JobId=" + task, "StartTime=now"}, {}).wait();
}

void SlurmQueue::cancel() {
  if (jobs_.jobs.empty()) return;
  std::vector<std::string> words{"scancel"};
  words.insert(words.end(), jobs_.jobs.begin(), jobs_.jobs.end());
  Process(words, {}).wait(true);  // also after Ctrl-C
}

std::string SlurmQueue::left() const {
  return jobs_.jobs.empty() ? "" : "job " + joined(jobs_.jobs, {}, ",");
}

}  // namespace pedicel::cluster
