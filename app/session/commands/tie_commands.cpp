#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "engine/core/check.h"
#include "engine/io/thing_bounds.h"

/// Strings of a scene (its `ties`) as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;
using world::SceneTie;

/// Ties have no names: they are counted from 1, as in the log.
SceneTie& tie_of(Document& document, const Command& c) {
  const int number = c.whole("tie"), count = static_cast<int>(document.scene->ties.size());
  if (number < 1 || number > count)
    throw UsageError(
        "tie " + std::to_string(number) + ", expected " +
        (count == 0 ? "one to be added before" : "a number from 1 to " + std::to_string(count)));
  return document.edit_scene().ties[static_cast<std::size_t>(number - 1)];
}

void check_tied_organ(const Document& document, const std::string& organ) {
  if (!has_organ(document, organ))
    throw UsageError("no organ " + in_quotes(organ) + ", expected PLANT/STEM or PLANT/FRUIT");
}

void set_tie_number(SceneTie& tie, const std::string& key, double value) {
  if (key == "to_at" && tie.to_organ.empty())
    throw UsageError("to_at of a tie that ends at a point, expected one that ends on a stem");
  if (key == "at")
    tie.at = value;
  else if (key == "to_at")
    tie.to_at = value;
  else if (key == "length")
    tie.length = value;
  else if (key == "stiffness")
    tie.stiffness = value;
  else
    throw UsageError(in_quotes(key) + ", expected one of: at, to_at, length, stiffness");
  check_within(key, value, argument_of("tie", key, true));
}

/// The other end; false: the command does not say it.
bool set_tie_end(const Document& document, SceneTie& tie, const Command& c) {
  const int ends = c.has("to") + c.has("offset") + c.has("to_organ");
  if (ends > 1) throw UsageError("several ends, expected one of to, offset and to_organ");
  if (c.has("to_organ")) {
    check_tied_organ(document, c.word("to_organ"));
    tie.to_organ = c.word("to_organ");
    tie.to_at.reset();
    tie.is_offset = false;
    tie.to.setZero();
  } else if (ends == 1) {
    tie.is_offset = c.has("offset");
    tie.to = c.point(tie.is_offset ? "offset" : "to");
    tie.to_organ.clear();
    tie.to_at.reset();
  }
  if (c.has("to_at")) set_tie_number(tie, "to_at", c.number("to_at"));
  return ends == 1 || c.has("to_at");
}

void add_tie(Document& document, const Command& c) {
  check_tied_organ(document, c.word("organ"));
  SceneTie tie;
  tie.organ = c.word("organ");
  for (const char* key : {"at", "length", "stiffness"})
    if (c.has(key)) set_tie_number(tie, key, c.number(key));
  if (!set_tie_end(document, tie, c))
    throw UsageError("a tie without an end, expected to, offset or to_organ");
  document.edit_scene().ties.push_back(tie);
}

void move_tie(Document& document, const Command& c) {
  SceneTie tie = tie_of(document, c);
  if (c.has("organ")) {
    check_tied_organ(document, c.word("organ"));
    tie.organ = c.word("organ");
  }
  if (c.has("at")) set_tie_number(tie, "at", c.number("at"));
  const bool end = set_tie_end(document, tie, c);
  if (!end && !c.has("organ") && !c.has("at"))
    throw UsageError("nothing to move, expected organ, at, to, offset, to_organ or to_at");
  tie_of(document, c) = tie;
}

void delete_tie(Document& document, const Command& c) {
  tie_of(document, c);
  auto& ties = document.edit_scene().ties;
  ties.erase(ties.begin() + (c.whole("tie") - 1));
}

}  // namespace

std::vector<CommandDescription> tie_commands() {
  const ArgumentDescription tie{"tie", Kind::whole, true, "number of the tie, from 1"};
  const ArgumentDescription to{"to", Kind::point, false, "m, in the world: where it ends",
                               io::place_bounds};
  const ArgumentDescription offset{"offset", Kind::point, false,
                                   "m, from the tied place as drawn, in place of to",
                                   io::place_bounds};
  const ArgumentDescription to_organ{"to_organ", Kind::word, false,
                                     "PLANT/STEM or PLANT/FRUIT where it ends, in place of to"};
  const ArgumentDescription to_at{"to_at", Kind::number, false,
                                  "as at, of to_organ (nearest to the tied place)", io::fraction};
  return {
      {"add tie",
       {{"organ", Kind::word, true, "PLANT/STEM or PLANT/FRUIT; the name of a grid: each of it"},
        to,
        offset,
        to_organ,
        to_at,
        argument_of("tie", "at", false),
        argument_of("tie", "length", false),
        argument_of("tie", "stiffness", false)},
       "Ties a place of a plant by a string.",
       add_tie},
      {"move tie",
       {tie,
        {"organ", Kind::word, false, "PLANT/STEM or PLANT/FRUIT (the same)"},
        {"at", Kind::number, false, "fraction of the stem's length, from its foot (the same)",
         io::fraction},
        to,
        offset,
        to_organ,
        to_at},
       "Puts one end of a tie elsewhere, or both.",
       move_tie},
      {"set tie",
       {tie,
        {"key", Kind::word, true, "at (1), to_at (1), length (m), stiffness (N/m)"},
        {"value", Kind::number, true, "of the key"}},
       "Sets a number of a tie.",
       [](Document& document, const Command& c) {
         set_tie_number(tie_of(document, c), c.word("key"), c.number("value"));
       }},
      {"tauten tie",
       {tie},
       "Gives a tie the length that it has as drawn.",
       [](Document& document, const Command& c) { tie_of(document, c).length.reset(); }},
      {"delete tie", {tie}, "Takes a tie away.", delete_tie},
  };
}

}  // namespace pedicel::app
