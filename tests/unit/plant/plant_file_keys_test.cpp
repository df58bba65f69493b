// Keys of plant files are described once: what is described is read.
#include "plugins/plant/plant_file_keys.h"

#include <gtest/gtest.h>

#include "plugins/plant/plant_file.h"
#include "tests/support/described_keys.h"

namespace pedicel::plant {
namespace {

TEST(PlantFileKeys, EachThatIsDescribedIsRead) {
  const KeyPlaces places = {
      {"plant", {"%"}},
      {"sampling", {"sampling: {%}"}},
      {"material", {"material: {%}"}},
      {"known_to", {"material: {known_to: {%}}"}},
      {"curve", {"curves: [{%}]"}},
      {"section",
       {"curves: [{section: {kind: ellipse, %}}]", "curves: [{section: {kind: rectangle, %}}]"}},
      {"place", {"supports: [{%}]"}},
      {"fruit", {"fruits: [{%}]"}},
      {"detach", {"fruits: [{detach: {%}}]"}},
      {"leaf", {"leaves: [{%}]"}},
      {"mass", {"masses: [{%}]"}}};
  expect_every_key_is_read(
      plant_file_keys(), places, [](const std::string&, const std::string& text) {
        Diagnostics diagnostics;
        parse_plant("format: pedicel-plant\nversion: 1\n" + text, "p.plant.yaml", diagnostics);
        return diagnostics.text();
      });
}

}  // namespace
}  // namespace pedicel::plant
