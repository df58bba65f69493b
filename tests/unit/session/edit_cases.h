#pragma once

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "engine/core/check.h"
#include "plugins/plant/plant_edit.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {

/// The plant of session_cases.h as a document that lines of text change.
class EditCase : public ::testing::Test {
 protected:
  EditCase() : document(empty_document()) {
    for (const char* line : draw_lines) run(line);
  }
  void run(const std::string& line) {
    Diagnostics diagnostics;
    const auto command = parse_command(line, {}, diagnostics);
    ASSERT_TRUE(command.has_value()) << diagnostics.text();
    apply_command(document, *command);
  }
  std::string refusal(const std::string& line) {
    const std::uint64_t before = document.state_hash();
    try {
      run(line);
    } catch (const UsageError& fault) {
      EXPECT_EQ(document.state_hash(), before);
      return fault.what();
    }
    ADD_FAILURE() << "taken: " << line;
    return {};
  }
  const plant::PlantFile& plant() const { return document.plant("p"); }
  const plant::PlantCurve& curve(const std::string& name) const {
    return plant().curves[plant::find_stem(plant(), name)];
  }

  Document document;
};

}  // namespace pedicel::app
