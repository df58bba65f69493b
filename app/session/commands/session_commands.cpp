#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/session.h"
#include "app/session/session_tuning.h"
#include "engine/io/csv.h"

/// History, settings, and what is asked of a session.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

std::string help_text(const std::string& verb) {
  std::string text;
  for (const CommandDescription& one : command_table()) {
    if (!verb.empty() && one.verb.rfind(verb, 0) != 0) continue;
    text += one.usage() + "\n    " + one.sentence + "\n";
    if (verb.empty()) continue;
    for (const ArgumentDescription& argument : one.arguments)
      text += "    " + argument.name + ": " + argument.sentence + "\n";
  }
  return text;
}

int count_curves(const Document& document) {
  int count = 0;
  for (const DocumentPlant& one : document.plants)
    if (one.file) count += static_cast<int>(one.file->curves.size());
  return count;
}

int count_fruits(const Document& document) {
  int count = 0;
  for (const DocumentPlant& one : document.plants)
    if (one.file) count += static_cast<int>(one.file->fruits.size());
  return count;
}

/// At the step that is shown, which may be one before the last.
std::optional<double> value_at(const RunLog::Series& series, double time) {
  constexpr double same = 1.0e-9;  // s
  const auto after = std::upper_bound(series.time.begin(), series.time.end(), time + same);
  if (after == series.time.begin()) return std::nullopt;
  return series.value[static_cast<std::size_t>(after - series.time.begin()) - 1];
}

double breaks_until(const Snapshot& now) {
  if (!now.events) return 0.0;
  return static_cast<double>(std::ranges::count_if(
      *now.events, [&](const world::Event& event) { return event.time <= now.time + 1.0e-9; }));
}

/// Nothing where there is no such quantity.
std::optional<double> measure(const std::string& name, const Document& document,
                              const Snapshot& now, const RunLog& log) {
  if (name == "time_s") return now.time;
  if (name == "breaks") return breaks_until(now);
  if (name == "plants") return static_cast<double>(document.plants.size());
  if (name == "stems") return count_curves(document);
  if (name == "fruits") return count_fruits(document);
  if (name == "pull_N") return now.pull.force_W.norm();
  if (name == "strain_1") return now.largest_strain;
  const auto series = log.series(name);
  return value_at(series, now.time);
}

Result expect_quantity(Session& session, const Command& c) {
  const std::string& name = c.word("quantity");
  const auto value =
      measure(name, session.document(), *session.snapshot(), session.control().log());
  if (!value)
    return {false, "expect: no quantity \"" + name +
                       "\", expected time_s, breaks, plants, stems, fruits, pull_N, strain_1 or a "
                       "column of log.csv"};
  const bool met = (!c.has("above") || *value > c.number("above")) &&
                   (!c.has("below") || *value < c.number("below")) &&
                   (!c.has("is") || *value == c.number("is"));
  const std::string text = name + " is " + io::format_number(*value);
  return {met, met ? text : text + ", not as expected: " + c.text()};
}

Result tell_commands(Session&, const Command& c) {
  return {true, help_text(c.word_or("verb", ""))};
}

}  // namespace

std::vector<CommandDescription> history_commands() {
  return {
      {"undo",
       {},
       "Takes back the last change.",
       [](Session& session, const Command&) { return session.undo(); }},
      {"redo",
       {},
       "Does it again.",
       [](Session& session, const Command&) { return session.redo(); }},
  };
}

std::vector<CommandDescription> setting_commands() {
  return {
      {"keep",
       {},
       "Writes changed plant parameters into the plants.",
       [](Session& session, const Command&) { return session.tuning().keep(); }},
      {"discard",
       {},
       "Sets changed parameters back.",
       [](Session& session, const Command&) { return session.tuning().discard(); }},
  };
}

std::vector<CommandDescription> query_commands() {
  return {
      {"expect",
       {{"quantity", Kind::word, true, "of the run, or time_s, breaks, stems, fruits"},
        {"above", Kind::number, false, "least"},
        {"below", Kind::number, false, "most"},
        {"is", Kind::number, false, "exactly"}},
       "Fails where a quantity is not as said.",
       expect_quantity},
      {"help",
       {{"verb", Kind::text, false, "of a command"}},
       "Says what commands there are.",
       tell_commands},
  };
}

}  // namespace pedicel::app
