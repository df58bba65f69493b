#include "engine/cluster/cluster_profile.h"

#include "engine/io/yaml.h"

namespace pedicel::cluster {

namespace {

std::vector<std::string> texts(io::YamlMap& map, const std::string& key) {
  std::vector<std::string> all;
  for (const io::YamlNode& one : map.list(key)) all.push_back(one.text(key));
  return all;
}

ClusterOptions profile_of(const io::YamlNode& node) {
  ClusterOptions o;
  io::YamlMap map(node, "a cluster profile");
  if (!io::check_format(map, "pedicel-cluster", 1)) return o;
  o.mode = map.choice("cluster", {"slurm", "local"}, "");
  o.partition = map.text("partition", "");
  o.account = map.text("account", "");
  o.time = map.text("time", "");
  o.memory = map.text("memory", "");
  o.jobs = map.integer("jobs", 1, 100000, 0);
  o.block_seconds = map.number("block_seconds", {0.1, 1.0e6}, 0.0);
  o.case_seconds = map.number("case_seconds", {1.0e-3, 1.0e6}, 0.0);
  o.scratch = map.text("scratch", "");
  o.on_interrupt = map.choice("on_interrupt", {"leave", "cancel"}, "");
  o.sbatch = texts(map, "sbatch");
  o.before = texts(map, "before");
  map.finish();
  return o;
}

template <class T>
void fill(T& given, const T& profile) {
  if (given == T{}) given = profile;
}

}  // namespace

ClusterOptions read_profile(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  ClusterOptions options = profile_of(io::load_yaml(path, diagnostics));
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return options;
}

ClusterOptions parse_profile(const std::string& text, const std::string& name,
                             Diagnostics& diagnostics) {
  return profile_of(io::parse_yaml(text, name, diagnostics));
}

void take_profile(const ClusterOptions& profile, ClusterOptions& given) {
  fill(given.mode, profile.mode);
  fill(given.partition, profile.partition);
  fill(given.account, profile.account);
  fill(given.time, profile.time);
  fill(given.memory, profile.memory);
  fill(given.jobs, profile.jobs);
  fill(given.block_seconds, profile.block_seconds);
  fill(given.case_seconds, profile.case_seconds);
  fill(given.scratch, profile.scratch);
  fill(given.on_interrupt, profile.on_interrupt);
  given.sbatch = profile.sbatch;
  given.before = profile.before;
}

}  // namespace pedicel::cluster
