// A profile of a cluster, and what the command line says over it.
#include <CLI/CLI.hpp>

#include "engine/cluster/cluster_profile.h"
#include "tests/unit/cluster/cluster_site.h"

namespace pedicel::cluster {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* profile_text = R"(format: pedicel-cluster
version: 1
cluster: slurm
partition: short
account: plants
time: "20:00"
memory: 2G
jobs: 200
block_seconds: 40
scratch: $TMPDIR
on_interrupt: cancel
sbatch: [--constraint=avx2]
before: [module load pedicel]
)";

TEST_F(Site, AProfileFillsWhatTheCommandLineLeavesOpen) {
  io::write_file_atomically("site.yaml", profile_text);
  ClusterOptions given;
  given.profile = "site.yaml";
  given.partition = "long";
  const ClusterOptions options = with_profile(given);
  EXPECT_EQ(options.mode, "slurm");
  EXPECT_EQ(options.partition, "long");
  EXPECT_EQ(options.account, "plants");
  EXPECT_EQ(options.jobs, 200);
  EXPECT_EQ(options.block_seconds, 40.0);
  EXPECT_THAT(options.sbatch, ElementsAre("--constraint=avx2"));
  EXPECT_THAT(options.before, ElementsAre("module load pedicel"));
}

TEST_F(Site, AProfileIsReadWithPlaces) {
  Diagnostics diagnostics;
  parse_profile("format: pedicel-cluster\nversion: 1\njobs: 0\nqueue: x\n", "site.yaml",
                diagnostics);
  EXPECT_THAT(diagnostics.text(), HasSubstr("site.yaml:3:7: error: jobs"));
  EXPECT_THAT(diagnostics.text(), HasSubstr("site.yaml:4:1: error: "));
}

TEST_F(Site, OptionsWithoutAClusterAreRefused) {
  ClusterOptions given;
  given.jobs = 2;
  EXPECT_THROW(with_profile(given), UsageError);
  given.mode = "local";
  EXPECT_EQ(with_profile(given).block_seconds, 30.0);
  given.partition = "short";
  EXPECT_THROW(with_profile(given), UsageError);
}

TEST_F(Site, OptionsOfSlurmAreRefusedWithALocalProfile) {
  io::write_file_atomically(
      "site.yaml", "format: pedicel-cluster\nversion: 1\ncluster: local\npartition: short\n");
  ClusterOptions given;
  given.profile = "site.yaml";
  EXPECT_EQ(with_profile(given).mode, "local");
  given.no_wait = true;
  EXPECT_THROW(with_profile(given), UsageError);
  given.mode = "slurm";
  EXPECT_TRUE(with_profile(given).no_wait);
}

TEST_F(Site, ScratchMayBeAVariableOfTheNode) {
  ClusterOptions given;
  given.mode = "local";
  ::setenv("SITE_SCRATCH", "/some where", 1);
  given.scratch = "$SITE_SCRATCH/a";
  EXPECT_EQ(with_profile(given).scratch, "/some where/a");
  given.scratch = "$SITE_UNSET/a";
  EXPECT_THROW(with_profile(given), UsageError);
  given.mode = "slurm";
  EXPECT_EQ(with_profile(given).scratch, "$SITE_UNSET/a");
}

TEST(Words, OfACallAreItsOwn) {
  CLI::App app;
  CLI::App* verb = app.add_subcommand("sweep", "");
  std::string scene, out;
  std::vector<std::string> set;
  bool quiet = false;
  ClusterOptions options;
  verb->add_option("scene", scene)->required();
  verb->add_option("--out", out);
  verb->add_option("--set", set)->allow_extra_args(false);
  verb->add_flag("--quiet", quiet);
  add_cluster_options(*verb, options);
  app.parse(
      "sweep --set a=1 --set b=-2,3 --out x --cluster local --jobs 3 --quiet --collect-only s");
  EXPECT_THAT(words_of(*verb, {"--out"}),
              ElementsAre("sweep", "--set=a=1", "--set=b=-2,3", "--quiet", "s"));
  EXPECT_THAT(words_of_same_call(*verb),
              ElementsAre("sweep", "--out=x", "--set=a=1", "--set=b=-2,3", "--quiet",
                          "--cluster=local", "--jobs=3", "s"));
}

}  // namespace
}  // namespace pedicel::cluster
