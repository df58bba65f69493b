// A file that is changed place by place keeps its comments and its layout.
#include "engine/io/yaml_text.h"

#include <gmock/gmock.h>

#include "engine/core/check.h"

namespace pedicel::io {
namespace {

using ::testing::HasSubstr;

const char* const scene = R"(format: pedicel-scene   # the first key
version: 1
dt: 0.004      # s
# what the solver does
rods:
  iterations: 3   # enough
  tolerance: 1e-6

plants:
  # the left one
  - {name: a, file: "a, b.yaml", set: {detach.stretch: 0.1}}  # of the paper
  - name: b
    file: b.yaml
    position: [0, 0, 1]

cameras: [{name: front, eye: [1, 2, 3]}]
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = scene;
  const std::size_t at = text.find(from);
  return text.replace(at, from.size(), to);
}

TEST(YamlText, AValueIsReplacedWhereItStands) {
  YamlText text(scene);
  text.set({"dt"}, "0.002");
  EXPECT_EQ(text.text(), changed("dt: 0.004      # s", "dt: 0.002      # s"));
  text = YamlText(scene);
  text.set({"plants", "0", "set", "detach.stretch"}, "0.25");
  EXPECT_EQ(text.text(), changed("detach.stretch: 0.1}", "detach.stretch: 0.25}"));
  text = YamlText(scene);
  text.set({"plants", "0", "file"}, "c.yaml");
  EXPECT_EQ(text.text(), changed("\"a, b.yaml\"", "c.yaml"));
  text = YamlText(scene);
  text.set({"plants", "1", "position"}, "[1, 0, 0]");
  EXPECT_EQ(text.text(), changed("[0, 0, 1]", "[1, 0, 0]"));
}

TEST(YamlText, AKeyIsAddedAtTheEndOfItsMap) {
  YamlText text(scene);
  text.set({"rods", "solver"}, "direct");
  EXPECT_EQ(text.text(), changed("  tolerance: 1e-6\n", "  tolerance: 1e-6\n  solver: direct\n"));
  text = YamlText(scene);
  text.set({"plants", "0", "set", "material.density"}, "800");
  EXPECT_EQ(text.text(),
            changed("detach.stretch: 0.1}", "detach.stretch: 0.1, material.density: 800}"));
  text = YamlText(scene);
  text.set({"plants", "1", "set", "detach.bend"}, "0.2");
  EXPECT_EQ(text.text(), changed("    position: [0, 0, 1]\n",
                                 "    position: [0, 0, 1]\n    set: {detach.bend: 0.2}\n"));
  text = YamlText(scene);
  text.set({"coupling", "friction"}, "0.5");
  EXPECT_EQ(text.text(), scene + std::string("coupling: {friction: 0.5}\n"));
}

TEST(YamlText, WhatWasAddedIsTakenOutAgain) {
  YamlText text(scene);
  text.set({"rods", "solver"}, "direct");
  text.set({"plants", "0", "set", "material.density"}, "800");
  text.remove({"rods", "solver"});
  text.remove({"plants", "0", "set", "material.density"});
  text.remove({"plants", "0", "set", "nothing"});
  EXPECT_EQ(text.text(), scene);
  text.remove({"plants", "0", "name"});
  EXPECT_EQ(text.text(), changed("{name: a, file", "{file"));
  text = YamlText(scene);
  text.remove({"plants", "0", "set", "detach.stretch"});
  EXPECT_EQ(text.text(), changed("{detach.stretch: 0.1}", "{}"));
  text.set({"plants", "0", "set", "detach.bend"}, "0.3");
  EXPECT_EQ(text.text(), changed("{detach.stretch: 0.1}", "{detach.bend: 0.3}"));
  text = YamlText(scene);
  text.remove({"rods", "iterations"});
  EXPECT_EQ(text.text(), changed("  iterations: 3   # enough\n", ""));
}

TEST(YamlText, EntriesComeAndGo) {
  YamlText text(scene);
  text.append({"plants"}, "{name: c, file: c.yaml}");
  EXPECT_EQ(text.text(), changed("    position: [0, 0, 1]\n",
                                 "    position: [0, 0, 1]\n  - {name: c, file: c.yaml}\n"));
  text.erase({"plants"}, 2);
  EXPECT_EQ(text.text(), scene);
  text.erase({"plants"}, 1);
  EXPECT_EQ(text.text(), changed("  - name: b\n    file: b.yaml\n    position: [0, 0, 1]\n", ""));
  text.erase({"plants"}, 0);
  EXPECT_THAT(text.text(), HasSubstr("plants: []"));
  text.append({"plants"}, "{name: d, file: d.yaml}");
  EXPECT_THAT(text.text(), HasSubstr("plants: [{name: d, file: d.yaml}]"));
  text = YamlText(scene);
  text.append({"cameras"}, "{name: back}");
  text.erase({"cameras"}, 0);
  EXPECT_THAT(text.text(), HasSubstr("cameras: [{name: back}]"));
}

TEST(YamlText, AFileWithoutALastLineEnd) {
  YamlText text("a: 1\nb: {c: 2}");
  text.set({"d"}, "3");
  EXPECT_EQ(text.text(), "a: 1\nb: {c: 2}\nd: 3\n");
}

TEST(YamlText, WhatCannotBeChangedSoIsRefused) {
  YamlText text(scene);
  const auto refusal = [&](const YamlText::Path& path, const std::string& value) {
    try {
      text.set(path, value);
    } catch (const UsageError& fault) {
      EXPECT_EQ(text.text(), scene);
      return std::string(fault.what());
    }
    return std::string("taken");
  };
  EXPECT_THAT(refusal({"dt", "more"}, "1"), HasSubstr("dt.more: goes through a value"));
  EXPECT_THAT(refusal({"plants", "7", "file"}, "x"), HasSubstr("no such entry"));
  EXPECT_THROW(YamlText("a: [1"), UsageError);
}

}  // namespace
}  // namespace pedicel::io
