#include "app/session/script.h"

#include <sstream>

#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

constexpr int ok = 0, failed = 1, invalid = 3, unstable = 4, unmet = 5;

bool is_empty(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

int exit_code(const Command& command, const Result& result, const Snapshot& now) {
  if (result.bad_file) return invalid;
  if (now.mode == RunMode::unstable) return unstable;
  return command.verb() == "expect" ? unmet : failed;
}

}  // namespace

int run_script(const std::filesystem::path& file, Session& session, std::ostream& out,
               std::ostream& errors) {
  std::istringstream text(io::read_file(file));
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (is_empty(line)) continue;
    Diagnostics diagnostics;
    const SourcePosition where{file.string(), number, 1};
    const auto command = parse_command(line, where, diagnostics);
    if (!command) {
      errors << diagnostics.text() << '\n';
      return invalid;
    }
    Result result = session.run(*command);
    if (stop_requested) return stop_exit_code();
    if (result.ok && session.snapshot()->mode == RunMode::unstable)
      result = {false, session.snapshot()->error};
    if (!result.ok) {
      errors << to_string(Diagnostic{Severity::error, where, result.text}) << '\n';
      return exit_code(*command, result, *session.snapshot());
    }
    if (!result.text.empty()) out << result.text << '\n';
  }
  return ok;
}

}  // namespace pedicel::app
