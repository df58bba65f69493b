#include <cmath>

#include "app/session/commands/command_table.h"
#include "app/session/live/organ_place.h"
#include "app/session/live/pull.h"
#include "app/session/session.h"
#include "app/session/session_films.h"
#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/world/settings.h"

/// The simulation: its time, its speed, pulls by command.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

int steps_of(const Command& c) {
  const int count = c.whole_or("count", 1);
  if (count < 1) throw UsageError("count " + std::to_string(count) + ", expected 1 or more");
  return count;
}

double at_least_0(const Command& c, const char* argument, const char* unit) {
  const double value = c.number(argument);
  if (value < 0.0)
    throw UsageError(std::string(argument) + " " + io::format_number(value) + ", expected " + unit +
                     " from 0 on");
  return value;
}

/// s of simulated time, no longer than a scene may last.
double time_of(const Command& c, const char* argument) {
  const double time = at_least_0(c, argument, "s");
  const double most = world::scene_bounds("duration").maximum;
  if (time > most)
    throw UsageError(std::string(argument) + " " + io::format_number(time) +
                     ", expected s of at most " + io::format_number(most));
  return time;
}

Result play_run(Session& session, const Command&) {
  session.control().play();
  return {};
}

Result pause_run(Session& session, const Command&) {
  session.control().pause();
  return {};
}

Result step_on(Session& session, const Command& c) {
  session.films().advance(steps_of(c));
  return {};
}

Result step_back(Session& session, const Command& c) {
  const long steps = steps_of(c), now = session.snapshot()->step;
  if (steps > now)
    return {false, "step back: " + std::to_string(steps) + " from step " + std::to_string(now) +
                       (now == 0 ? ", expected a run that has begun"
                                 : ", expected at most as many as were done")};
  session.control().step_back(steps);
  return {};
}

Result go_to(Session& session, const Command& c) {
  const double time = time_of(c, "time");
  const auto now = session.snapshot();
  if (!now->assets) return {false, "go to: nothing is simulated yet"};
  session.control().go_to_step(std::lround(time / now->assets->scene.dt));
  return {};
}

Result run_on(Session& session, const Command& c) {
  session.films().run_for(time_of(c, "duration"));
  return {};
}

Result reset_run(Session& session, const Command&) {
  session.control().reset();
  return {};
}

Result set_speed(Session& session, const Command& c) {
  session.control().set_speed(at_least_0(c, "value", "simulated s a wall s"));
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
  if (!(place.stiffness > 0.0)) return {false, "pull: stiffness, expected N/m above 0"};
  session.begin_pull(place, c.point("to"), true);
  return {};
}

Result end_pull(Session& session, const Command&) {
  session.control().end_pull();
  return {};
}

Result cut_organ(Session& session, const Command& c) {
  const std::string organ = c.word("organ");
  const double at = c.number_or("at", 0.0);
  const auto now = session.snapshot();
  if (!(at >= 0.0 && at <= 1.0)) return {false, "cut: at, expected a fraction from 0 to 1"};
  const std::optional<PullPlace> place = find_organ(*now, organ, at);
  if (!place)
    return {false, "cut: no organ \"" + organ +
                       "\" in the simulation, expected one of: " + organ_names(*now)};
  if (!now->plants[static_cast<std::size_t>(place->plant)].state.alive[place->element])
    return {false, "cut: \"" + organ + "\" has come off there already"};
  session.cut(organ, at);
  return {};
}

Result watch_organ(Session& session, const Command& c) {
  session.control().log().watch(c.word("organ"));
  return {};
}

}  // namespace

std::vector<CommandDescription> run_commands() {
  const Scope r = Scope::run;
  return {
      {"play", r, {}, "Lets the simulation run.", play_run},
      {"pause", r, {}, "Holds it.", pause_run},
      {"step",
       r,
       {{"count", Kind::whole, false, "steps (1)"}},
       "So many steps on, then holds.",
       step_on},
      {"step back",
       r,
       {{"count", Kind::whole, false, "steps (1)"}},
       "So many steps back, exactly.",
       step_back},
      {"go to",
       r,
       {{"time", Kind::number, true, "s, of the run"}},
       "To a time of the run, back or forward, exactly, then holds.",
       go_to},
      {"run",
       r,
       {{"duration", Kind::number, true, "s, simulated"}},
       "Lets so much time pass, then holds.",
       run_on},
      {"reset", r, {}, "Back to time 0; edits stay.", reset_run},
      {"speed",
       r,
       {{"value", Kind::number, true, "simulated s a wall s; 0: as fast as it goes"}},
       "Sets the speed.",
       set_speed},
      {"pull",
       r,
       {{"organ", Kind::word, true, "PLANT/FRUIT, or PLANT/STEM with at"},
        {"to", Kind::point, true, "m, in the world: the spring's far end"},
        {"at", Kind::number, false, "fraction of the organ, from its foot (1)"},
        {"stiffness", Kind::number, false, "N/m, of the spring (50)"}},
       "Pulls a place of a plant with a spring until release.",
       pull_organ},
      {"release", r, {}, "Ends the pull.", end_pull},
      {"cut",
       r,
       {{"organ", Kind::word, true, "PLANT/STEM, or PLANT/FRUIT for its stalk"},
        {"at", Kind::number, false, "fraction of the stem, from its foot (0)"}},
       "Cuts a stem of the running plant; what it carried falls as one body.",
       cut_organ},
      {"watch",
       r,
       {{"organ", Kind::word, true, "PLANT/STEM"}},
       "Keeps the load history of an organ from now on.",
       watch_organ},
  };
}

}  // namespace pedicel::app
