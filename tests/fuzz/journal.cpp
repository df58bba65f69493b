#include "app/session/journal.h"

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "engine/core/check.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

void apply(app::Document& document, const std::string& line) {
  Diagnostics diagnostics;
  const auto command = app::parse_command(line, {"journal", 1, 1}, diagnostics);
  if (!command || app::find_command(command->verb())->scope != app::Scope::document) return;
  try {
    app::apply_command(document, *command);
  } catch (const UsageError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::filesystem::path file = folder.write("fuzz.journal", fuzz::text_of(data, size));
  try {
    const app::JournalContent content = app::read_journal(file);
    app::Document document = app::empty_document();
    for (const auto& line : content.base) apply(document, line.command);
    for (const auto& line : content.commands) apply(document, line.command);
    fuzz::require(!app::state_commands(document).empty() || document.plants.empty(),
                  "a document's state in commands");
  } catch (const InvalidFile&) {
  }
  return 0;
}
