#include "pedicel/app/session/commands/command_table.h"

/// What the run and the session take as commands; session_commands.cpp and session_run.cpp do them.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

std::vector<CommandDescription> control_commands() {
  const Scope r = Scope::run;
  return {
      {"play", r, {}, "Lets the simulation run.", nullptr},
      {"pause", r, {}, "Holds it.", nullptr},
      {"step",
       r,
       {{"count", Kind::whole, false, "steps (1)"}},
       "So many steps on, then holds.",
       nullptr},
      {"step back",
       r,
       {{"count", Kind::whole, false, "steps (1)"}},
       "So many steps back, exactly.",
       nullptr},
      {"go to",
       r,
       {{"time", Kind::number, true, "s, of the run"}},
       "To a time of the run, back or forward, exactly, then holds.",
       nullptr},
      {"run",
       r,
       {{"duration", Kind::number, true, "s, simulated"}},
       "Lets so much time pass, then holds.",
       nullptr},
      {"reset", r, {}, "Back to time 0; edits stay.", nullptr},
      {"speed",
       r,
       {{"value", Kind::number, true, "simulated s a wall s; 0: as fast as it goes"}},
       "Sets the speed.",
       nullptr},
      {"pull",
       r,
       {{"organ", Kind::word, true, "PLANT/FRUIT, or PLANT/STEM with at"},
        {"to", Kind::point, true, "m, in the world: the spring's far end"},
        {"at", Kind::number, false, "fraction of the organ, from its foot (1)"},
        {"stiffness", Kind::number, false, "N/m, of the spring (50)"}},
       "Pulls a place of a plant with a spring until release.",
       nullptr},
      {"release", r, {}, "Ends the pull.", nullptr},
      {"watch",
       r,
       {{"organ", Kind::word, true, "PLANT/STEM"}},
       "Keeps the load history of an organ from now on.",
       nullptr},
  };
}

std::vector<CommandDescription> robot_commands() {
  const Scope r = Scope::run;
  const ArgumentDescription loop{"loop", Kind::whole, false, "1: over and over until stopped (0)"};
  return {
      {"joint",
       r,
       {{"name", Kind::word, true, "of the joint"}, {"value", Kind::number, true, "rad or m"}},
       "Moves one joint.",
       nullptr},
      {"joints",
       r,
       {{"values", Kind::numbers, true, "rad or m, one a joint"}},
       "Moves all joints.",
       nullptr},
      {"jog",
       r,
       {{"shift", Kind::point, true, "m, in the world"},
        {"turn", Kind::point, false, "rad, a rotation vector in the world"}},
       "Moves the tool a little.",
       nullptr},
      {"tool",
       r,
       {{"to", Kind::point, true, "m, in the world"},
        {"turn", Kind::numbers, false, "x,y,z,w: its orientation (as it is to be now)"},
        {"near", Kind::whole, false, "1: as near as can be where it is out of reach (0: refused)"}},
       "Moves the tool to a place.",
       nullptr},
      {"gripper",
       r,
       {{"value", Kind::number, true, "m or rad, of the gripper's joint"}},
       "Opens or closes the gripper.",
       nullptr},
      {"pick",
       r,
       {{"organ", Kind::word, true, "PLANT/FRUIT"},
        {"pull", Kind::point, false,
         "m, where it is pulled to from there (up, as far as the arm comes)"}},
       "Leads the tool to a fruit, shuts the gripper on it and pulls.",
       nullptr},
      {"play trajectory",
       r,
       {{"file", Kind::text, true, "table time_s,JOINT,... in rad or m"}, loop},
       "Plays joint positions from a file, from now on.",
       nullptr},
      {"play waypoints", r, {loop}, "Plays the recorded waypoints from now on.", nullptr},
      {"home robot", r, {}, "Moves all joints to where they start.", nullptr},
      {"stop robot", r, {}, "Ends what the robot plays: it stays where it is.", nullptr},
  };
}

std::vector<CommandDescription> file_commands() {
  const Scope s = Scope::session;
  const ArgumentDescription file{"file", Kind::text, true, "path"};
  return {
      {"open",
       s,
       {file,
        {"unit", Kind::word, false, "of the lengths in a table or an MTG: m, cm, mm or metres"}},
       "Opens a scene or a plant.",
       nullptr},
      {"new", s, {}, "Opens an empty scene.", nullptr},
      {"reload", s, {}, "Reads the files anew.", nullptr},
      {"save",
       s,
       {{"file", Kind::text, false,
         "*.scene.yaml: the scene with everything; *.plant.yaml: one plant (where it came from)"},
        {"plant", Kind::word, false, "which, for a *.plant.yaml (the only one)"},
        {"overwrite", Kind::whole, false,
         "1: over a file that is there, or that another program has changed (0: refused)"}},
       "Writes what has changed.",
       nullptr},
      {"save script",
       s,
       {file},
       "Writes what was done since the document was opened as a script that does it again.",
       nullptr},
      {"import",
       s,
       {file,
        {"plant", Kind::word, false, "name in the scene"},
        {"unit", Kind::word, false, "of the lengths in a table or an MTG: m, cm, mm or metres"}},
       "Adds the plant of a file (*.plant.yaml, *.csv, *.mtg).",
       nullptr},
      {"export",
       s,
       {{"plant", Kind::word, true, "name in the scene"}, file},
       "Writes a plant as *.plant.yaml, *.csv, *.obj or *.ply.",
       nullptr},
      {"save waypoints",
       s,
       {file},
       "Writes the recorded waypoints as a table time_s,JOINT,...",
       nullptr},
      {"load waypoints",
       s,
       {file},
       "Takes the rows of such a table as the recorded waypoints.",
       nullptr},
      {"undo", s, {}, "Takes back the last change.", nullptr},
      {"redo", s, {}, "Does it again.", nullptr},
      {"record",
       s,
       {{"file", Kind::text, true, "*.mp4, or pictures: frame_%05d.png"},
        {"fps", Kind::number, false, "Hz, pictures a simulated second (30)"},
        {"size", Kind::word, false, "WxH, px (1280x720)"},
        {"camera", Kind::word, false, "of the scene's (the first)"},
        {"ui", Kind::whole, false, "1: the window with its panels (0: the scene alone)"}},
       "Begins a film of what is done from now on.",
       nullptr},
      {"stop recording", s, {}, "Ends the film.", nullptr},
      {"keep", s, {}, "Writes changed plant parameters into the plants.", nullptr},
      {"discard", s, {}, "Sets changed parameters back.", nullptr},
      {"expect",
       s,
       {{"quantity", Kind::word, true, "of the run, or time_s, breaks, stems, fruits"},
        {"above", Kind::number, false, "least"},
        {"below", Kind::number, false, "most"},
        {"is", Kind::number, false, "exactly"}},
       "Fails where a quantity is not as said.",
       nullptr},
      {"help",
       s,
       {{"verb", Kind::text, false, "of a command"}},
       "Says what commands there are.",
       nullptr},
  };
}

}  // namespace

std::vector<CommandDescription> run_commands() {
  std::vector<CommandDescription> table = control_commands();
  for (const auto& part : {robot_commands(), file_commands()})
    table.insert(table.end(), part.begin(), part.end());
  return table;
}

}  // namespace pedicel::app
