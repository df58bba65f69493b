#include "engine/cluster/job_list.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

std::filesystem::path RunFolder::block(const std::string& run, int number) const {
  char name[32];
  std::snprintf(name, sizeof name, "%06d.json", number);
  return blocks(run) / name;
}

JobList read_jobs(const RunFolder& folder) {
  JobList list;
  std::error_code error;
  if (!std::filesystem::exists(folder.jobs(), error)) return list;
  const auto json = nlohmann::json::parse(io::read_file(folder.jobs()), nullptr, false);
  if (!json.is_object()) return list;
  if (json.contains("run") && json["run"].is_string()) list.run = json["run"];
  if (!json.contains("jobs") || !json["jobs"].is_array()) return list;
  for (const auto& job : json["jobs"])
    if (job.is_string()) list.jobs.push_back(job.get<std::string>());
  return list;
}

void write_jobs(const RunFolder& folder, const JobList& list) {
  const nlohmann::ordered_json json = {{"run", list.run}, {"jobs", list.jobs}};
  io::write_file_atomically(folder.jobs(), json.dump(2) + "\n");
}

std::string ranges_of(const std::vector<int>& sorted) {
  std::string text;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    while (end + 1 < sorted.size() && sorted[end + 1] == sorted[end] + 1) ++end;
    text += (text.empty() ? "" : ",") + std::to_string(sorted[i]);
    if (end > i) text += "-" + std::to_string(sorted[end]);
    i = end + 1;
  }
  return text;
}

}  // namespace pedicel::cluster
