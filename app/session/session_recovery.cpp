#include "app/session/session_recovery.h"

#include <chrono>
#include <ctime>
#include <utility>

#include "app/session/session.h"
#include "app/session/session_files.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

std::string time_text(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto written = std::filesystem::last_write_time(file, ignored);
  const auto instant = std::chrono::file_clock::to_sys(written);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(instant));
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &utc);
  return text;
}

}  // namespace

std::vector<LostDocument> SessionRecovery::lost_documents() const {
  std::vector<LostDocument> lost;
  if (core_.options.autosave.empty()) return lost;
  for (const std::filesystem::path& file : lost_journals(core_.options.autosave)) {
    try {
      const JournalContent content = read_journal(file);
      if (content.commands.empty()) continue;
      lost.push_back(
          {file, content.document, static_cast<int>(content.commands.size()), time_text(file)});
    } catch (const InvalidFile&) {
      continue;  // of another program
    }
  }
  return lost;
}

bool SessionRecovery::recover(const LostDocument& lost) {
  SessionFiles& files = session_.files();
  JournalContent content;
  try {
    content = read_journal(lost.file);
  } catch (const InvalidFile& fault) {
    core_.messages.say(fault.all(), false);
    return false;
  }
  if (content.document.empty() || !files.open(content.document)) files.open_empty();
  // The lines say themselves what was taken back: nothing is to be judged in between.
  const bool waits = std::exchange(core_.options.waits, false);
  const auto do_line = [this](const std::string& line) {
    Diagnostics diagnostics;
    const auto command = parse_command(line, {"journal", 1, 1}, diagnostics);
    const Result result = command ? session_.run(*command) : Result{false, diagnostics.text()};
    if (!result)
      core_.messages.say(Severity::warning, "not recovered: " + line + ": " + result.text);
  };
  const Document& document = core_.editor.document();
  const std::uint64_t on_disk = content.document.empty() ? 0 : files.saved_hash();
  for (const JournalContent::Line& line : content.base) do_line(line.command);
  core_.editor.forget_history();
  if (is_scene(document.path)) files.set_saved_settings(document.settings);
  for (const JournalContent::Line& line : content.commands) do_line(line.command);
  core_.options.waits = waits;
  session_.finish({});
  files.set_saved_hash(on_disk);
  const auto wanted = content.commands.empty() ? std::nullopt : content.commands.back().hash;
  if (wanted && *wanted != document.state_hash())
    core_.messages.say(Severity::warning, "what was recovered is not exactly what was lost");
  forget(lost);
  return true;
}

void SessionRecovery::forget(const LostDocument& lost) {
  std::error_code ignored;
  std::filesystem::remove(lost.file, ignored);
}

}  // namespace pedicel::app
