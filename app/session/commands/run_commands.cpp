#include <cmath>

#include "app/session/commands/command_table.h"
#include "app/session/live/organ_place.h"
#include "app/session/live/pull.h"
#include "app/session/session.h"
#include "app/session/session_films.h"
#include "engine/io/thing_bounds.h"
#include "engine/world/settings.h"

/// The simulation: its time, its speed, pulls by command.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

Result step_back(Session& session, const Command& c) {
  const long steps = c.whole_or("count", 1), now = session.snapshot()->step;
  if (steps > now)
    return {false, "step back: " + std::to_string(steps) + " from step " + std::to_string(now) +
                       (now == 0 ? ", expected a run that has begun"
                                 : ", expected at most as many as were done")};
  session.control().step_back(steps);
  return {};
}

Result go_to(Session& session, const Command& c) {
  const double time = c.number("time");
  const auto now = session.snapshot();
  if (!now->assets) return {false, "go to: nothing is simulated yet"};
  session.control().go_to_step(std::lround(time / now->assets->scene.dt));
  return {};
}

Result pull_organ(Session& session, const Command& c) {
  const auto now = session.snapshot();
  const std::optional<PullPlace> found = find_organ(*now, c.word("organ"), c.number_or("at", 1.0));
  if (!found)
    return {false, "pull: no organ \"" + c.word("organ") +
                       "\" in the simulation, expected one of: " + organ_names(*now)};
  PullPlace place = *found;
  place.stiffness = c.number_or("stiffness", place.stiffness);
  session.begin_pull(place, c.point("to"), true);
  return {};
}

Result cut_organ(Session& session, const Command& c) {
  const std::string organ = c.word("organ");
  const double at = c.number_or("at", 0.0);
  const auto now = session.snapshot();
  const std::optional<PullPlace> place = find_organ(*now, organ, at);
  if (!place)
    return {false, "cut: no organ \"" + organ +
                       "\" in the simulation, expected one of: " + organ_names(*now)};
  if (!now->plants[static_cast<std::size_t>(place->plant)].state.alive[place->element])
    return {false, "cut: \"" + organ + "\" has come off there already"};
  session.cut(organ, at);
  return {};
}

}  // namespace

std::vector<CommandDescription> run_commands() {
  const io::Bounds times{0.0, world::scene_bounds("duration").maximum};
  return {
      {"play",
       {},
       "Lets the simulation run.",
       [](Session& session, const Command&) { session.control().play(); }},
      {"pause",
       {},
       "Holds it.",
       [](Session& session, const Command&) { session.control().pause(); }},
      {"step",
       {{"count", Kind::whole, false, "steps (1)", {1.0}}},
       "So many steps on, then holds.",
       [](Session& session, const Command& c) { session.films().advance(c.whole_or("count", 1)); }},
      {"step back",
       {{"count", Kind::whole, false, "steps (1)", {1.0}}},
       "So many steps back, exactly.",
       step_back},
      {"go to",
       {{"time", Kind::number, true, "s, of the run", times}},
       "To a time of the run, back or forward, exactly, then holds.",
       go_to},
      {"run",
       {{"duration", Kind::number, true, "s, simulated", times}},
       "Lets so much time pass, then holds.",
       [](Session& session, const Command& c) { session.films().run_for(c.number("duration")); }},
      {"reset",
       {},
       "Back to time 0; edits stay.",
       [](Session& session, const Command&) { session.control().reset(); }},
      {"speed",
       {{"value", Kind::number, true, "simulated s a wall s; 0: as fast as it goes",
         io::not_negative}},
       "Sets the speed.",
       [](Session& session, const Command& c) { session.control().set_speed(c.number("value")); }},
      {"pull",
       {{"organ", Kind::word, true, "PLANT/FRUIT, or PLANT/STEM with at"},
        {"to", Kind::point, true, "m, in the world: the spring's far end", io::place_bounds},
        {"at", Kind::number, false, "fraction of the organ, from its foot (1)", io::fraction},
        {"stiffness", Kind::number, false, "N/m, of the spring (50)", io::positive}},
       "Pulls a place of a plant with a spring until release.",
       pull_organ},
      {"release",
       {},
       "Ends the pull.",
       [](Session& session, const Command&) { session.control().end_pull(); }},
      {"cut",
       {{"organ", Kind::word, true, "PLANT/STEM, or PLANT/FRUIT for its stalk"},
        {"at", Kind::number, false, "fraction of the stem, from its foot (0)", io::fraction}},
       "Cuts a stem of the running plant; what it carried falls as one body.",
       cut_organ},
      {"watch",
       {{"organ", Kind::word, true, "PLANT/STEM"}},
       "Keeps the load history of an organ from now on.",
       [](Session& session, const Command& c) { session.control().log().watch(c.word("organ")); }},
  };
}

}  // namespace pedicel::app
