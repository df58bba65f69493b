#include <sstream>

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "engine/core/check.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

/// Every line that is a command reads back as the same, and document commands are done or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  app::Document document = app::empty_document();
  std::istringstream text(fuzz::text_of(data, size));
  int number = 0;
  for (std::string line; std::getline(text, line) && number < 40;) {
    Diagnostics diagnostics;
    const auto command = app::parse_command(line, {"script", ++number, 1}, diagnostics);
    fuzz::require_answer(command, diagnostics);
    if (!command) continue;
    Diagnostics again;
    const auto read = app::parse_command(command->text(), {"again", number, 1}, again);
    fuzz::require(read && *read == *command, "a command's text reads back as the command");
    if (app::find_command(command->verb())->scope != app::Scope::document) continue;
    const std::uint64_t before = document.state_hash();
    try {
      app::apply_command(document, *command);
    } catch (const UsageError&) {
      fuzz::require(document.state_hash() == before, "a command that is refused changes nothing");
    }
  }
  return 0;
}
