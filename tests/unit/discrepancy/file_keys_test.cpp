// Keys of experiments and verdicts are described once: what is described is read or written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/files/experiment_lists.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/select/verdict_keys.h"
#include "tests/support/described_keys.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

TEST(ExperimentKeys, EachThatIsDescribedIsRead) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "one");
  const auto drive = [](const std::string& kind) {
    return "trials: [{folder: one, drive: [{" + kind + "%}]}]";
  };
  const KeyPlaces places = {{"experiment", {"%"}},
                            {"marker", {"markers: [{%}]"}},
                            {"place", {"markers: [{%}]"}},
                            {"noise", {"noise: {%}"}},
                            {"trial", {"trials: [{%}]"}},
                            {"mass", {"trials: [{masses: [{%}]}]"}},
                            {"drive", {drive("kind: none, ")}},
                            {"hold", {drive("kind: hold, ")}},
                            {"load", {drive("kind: load, ")}},
                            {"base", {drive("kind: base, ")}}};
  expect_every_key_is_read(
      lists_without(experiment_keys(), {"camera", "wrench", "follows", "moved"}), places,
      [&](const std::string&, const std::string& text) {
        io::write_file_atomically(folder / "experiment.yaml",
                                  "format: pedicel-experiment\nversion: 1\n" + text);
        Diagnostics diagnostics;
        read_experiment(folder / "experiment.yaml", diagnostics);
        return diagnostics.text();
      });
}

/// With every key that a verdict may have.
Verdict with_everything() {
  Verdict verdict;
  verdict.outcome = Outcome::unknown;
  NamedCause cause;
  cause.name = "marker_offset";
  cause.parameters["offset"] = {{1.0, 0.9, 1.1, "m"}};
  cause.change = {0.1, 0.2, 0.3, 0.4};
  cause.against = "It has another shape.";
  cause.instead_of = "latency";
  verdict.nearest = {cause};
  verdict.parameters["density"] = {700, 690, 710, "kg/m3"};
  verdict.competing = {{"gust", 3.0}};
  verdict.left.channels = {{"position", 1.1, 0.02}};
  verdict.detectable_limits = {{"extra_mass", "mass", 0.004, "kg"}};
  SymptomNumber symptom;
  symptom.name = "touch";
  verdict.symptoms = {symptom};
  verdict.unknown = OutsideAction{};
  verdict.extended_scene = "extended.scene.yaml";
  verdict.partial = true;
  return verdict;
}

TEST(VerdictKeys, EachThatIsDescribedIsWritten) {
  const auto json = nlohmann::json::parse(to_json(with_everything()));
  const auto& cause = json.at("nearest").at(0);
  const std::map<std::string, nlohmann::json> written = {
      {"verdict", json},
      {"cause", cause},
      {"share", cause.at("share")},
      {"change", cause.at("change")},
      {"size", cause.at("change").at("marker")},
      {"number", json.at("parameters").at("density")},
      {"outside", json.at("unknown")},
      {"symptom", json.at("symptoms").at(0)},
      {"competing_model", json.at("competing").at(0)},
      {"misfits", json.at("error")},
      {"misfit", json.at("error").at("check")},
      {"left", json.at("left")},
      {"channel", json.at("left").at("channels").at(0)},
      {"detectable_limit", json.at("detectable_limits").at(0)}};
  for (const io::KeyList* list : verdict_keys()) {
    ASSERT_TRUE(written.contains(list->name)) << list->name;
    std::vector<std::string> keys, described;
    for (const auto& [key, value] : written.at(list->name).items()) keys.push_back(key);
    for (const io::Key& key : list->keys) described.push_back(key.name);
    EXPECT_THAT(keys, testing::UnorderedElementsAreArray(described)) << list->name;
  }
}

}  // namespace
}  // namespace pedicel::discrepancy
