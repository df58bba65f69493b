#include "app/session/commands/command_table.h"
#include "app/session/document/file_texts.h"
#include "app/session/document/plant_import.h"
#include "app/session/session.h"
#include "app/session/session_files.h"
#include "app/session/session_robot.h"

/// Files: open, save, import, export.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

double unit_of(const Command& c) {
  return unit_of_text(c.word_or("unit", ""), "unit");
}

/// What the session has just said about a file that cannot be read.
Result bad_file(Session& session) {
  return {false, session.messages().all().back().sentence, true};
}

Result save_script(Session& session, const Command& c) {
  const std::filesystem::path file = c.word("file");
  write_with_backup(file, session.files().script());
  return {true, std::to_string(session.log().size()) + " commands in " + file.string()};
}

}  // namespace

std::vector<CommandDescription> file_commands() {
  const ArgumentDescription file{"file", Kind::text, true, "path"};
  return {
      {"open",
       {file, {"unit", Kind::word, false, "of the lengths in a skeleton: m, cm, mm or metres"}},
       "Opens a scene or a plant.",
       [](Session& session, const Command& c) {
         return session.files().open(c.word("file"), unit_of(c)) ? Result{} : bad_file(session);
       }},
      {"new",
       {},
       "Opens an empty scene.",
       [](Session& session, const Command&) { session.files().open_empty(); }},
      {"reload",
       {},
       "Reads the files anew.",
       [](Session& session, const Command&) {
         return session.files().reload() ? Result{} : bad_file(session);
       }},
      {"save",
       {{"file", Kind::text, false,
         "*.scene.yaml: the scene with everything; *.plant.yaml: one plant (where it came from)"},
        {"plant", Kind::word, false, "which, for a *.plant.yaml (the only one)"},
        {"overwrite", Kind::whole, false,
         "1: over a file that is there, or that another program has changed (0: refused)"}},
       "Writes what has changed.",
       [](Session& session, const Command& c) {
         return session.files().save(c.word_or("file", ""),
                                     {c.word_or("plant", ""), c.whole_or("overwrite", 0) != 0});
       }},
      {"save script",
       {file},
       "Writes what was done since the document was opened as a script that does it again.",
       save_script},
      {"import",
       {file,
        {"plant", Kind::word, false, "name in the scene"},
        {"unit", Kind::word, false, "of the lengths in a skeleton: m, cm, mm or metres"}},
       "Adds the plant of a file (*.plant.yaml, *.csv, *.mtg, *.ply, *.xml).",
       [](Session& session, const Command& c) {
         return session.files().import_plant(c.word("file"), c.word_or("plant", ""), unit_of(c));
       }},
      {"export",
       {{"plant", Kind::word, true, "name in the scene"}, file},
       "Writes a plant as *.plant.yaml, *.csv, *.obj or *.ply.",
       [](Session& session, const Command& c) {
         return session.files().export_plant(c.word("plant"), c.word("file"));
       }},
      {"save waypoints",
       {file},
       "Writes the recorded waypoints as a table time_s,JOINT,...",
       [](Session& session, const Command& c) {
         return session.robot().save_waypoints(c.word("file"));
       }},
      {"load waypoints",
       {file},
       "Takes the rows of such a table as the recorded waypoints.",
       [](Session& session, const Command& c) {
         return session.robot().load_waypoints(c.word("file"));
       }},
  };
}

}  // namespace pedicel::app
