// Clocks. A trial's tables share one, which begins with the trial. What another clock writes lies
// far outside of all that is done: since 1970, since a computer was started, since the session
// began.
#include <algorithm>

#include "plugins/discrepancy/admission/contradiction_checks.h"
#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/data/trial_clock.h"

namespace pedicel::discrepancy {

namespace {

// A recovery may be watched long after all is done, a creep longer still; but no one waits a
// hundred times as long as the record then lasts, and no trial lasts ten days.
constexpr double longest_pause = 60.0, pause_share = 100.0;  // s; of the table's own span
constexpr double longest_trial = 1.0e6;                      // s
// A pause within a table. Records of creep have rows ever farther apart, each about as far as all
// before it together, and a last look at the plant may come much later; a clock that was set anew
// ticks on as before.
constexpr double least_gap = 60.0, gap_share = 100.0;  // s; of the other rows' span
constexpr std::size_t rows_after = 3;

std::string seconds(double t) {
  return text("%.3g s", t);
}

// The same moment in some other clock's words; empty: none is known.
std::string likely_clock(double begins) {
  // Seconds since 1970 were 1e9 in 2001, and will be 3e9 in 2065: no stopwatch shows that by
  // itself.
  if (begins > 1.0e9 && begins < 3.0e9) return ", not since 1970";
  if (begins > 1.0e12 && begins < 3.0e12) return ", not milliseconds since 1970";
  if (begins > 1.0e15) return ", not micro- or nanoseconds since 1970";
  return ", not on another clock";
}

std::string others(const std::vector<TableClock>& clocks, const TableClock& but) {
  std::string list;
  for (const TableClock& clock : clocks)
    if (clock.file != but.file)
      list += (list.empty() ? " (" : "; ") + clock.file.string() + ": " +
              text("%.3g to %.3g s", clock.first, clock.last);
  return list.empty() ? list : list + ")";
}

bool begins_late(const TableClock& clock, const DriveTimes& drive) {
  // Where nothing ends, or nothing is done, the beginning of the trial is what a table can be late
  // of.
  const double done = drive.over && drive.any ? drive.last : 0.0;
  const double pause = std::max(longest_pause, pause_share * clock.span());
  if (drive.over && clock.first > done + pause) return true;
  return clock.first > std::max(longest_trial, clock.span());
}

// What is done, without what a path on a wrong clock says of it.
DriveTimes stated_times(const Trial& trial) {
  Trial without = trial;
  // Else a path on the same wrong clock would move the end of all that is done to where the tables
  // begin, and excuse them.
  for (Hold& hold : without.holds) hold.path = {};
  without.base.reset();
  return drive_times(without);
}

std::optional<Fault> gap_in(const TableClock& clock, const std::vector<double>& time) {
  for (std::size_t i = 1; i + rows_after < time.size(); ++i) {
    // Against the other rows, not against a rate: a record may be taken by hand, whenever there is
    // something to see.
    const double gap = time[i] - time[i - 1], rest = clock.span() - gap;
    if (gap < least_gap || gap < gap_share * rest) continue;
    return Fault{clock.file,
                 text("jumps by %.4g s at %.4g s", gap, time[i - 1]) +
                     text(", where its other rows last %.3g s in all: expected one clock that runs "
                          "on, not one that was set anew",
                          rest)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fault> check_clock(const TrialView& view) {
  const Trial& trial = view.trial;
  const std::vector<TableClock> clocks = clocks_of(trial);
  if (clocks.empty()) return std::nullopt;
  const DriveTimes stated = stated_times(trial);
  for (const TableClock& clock : clocks)
    // Every table by itself. They share one clock, and the others are told beside it: mostly one is
    // wrong.
    if (begins_late(clock, stated))
      return Fault{clock.file, "begins " + seconds(clock.first) + " after the trial" +
                                   others(clocks, clock) + ": expected seconds since it began" +
                                   likely_clock(clock.first)};
  for (const Hold& hold : trial.holds)
    // A path of one row is a place, which has no time to be late in.
    if (hold.path.time.size() > 1 && hold.release <= hold.path.time.front())
      return Fault{hold.path.file, "begins at " + seconds(hold.path.time.front()) +
                                       ", not before the release at " + seconds(hold.release) +
                                       " that experiment.yaml states: expected the way up to it"};
  // Last: a table that begins elsewhere is a coarser mistake than one that jumps within.
  return gap_in(clocks.front(), trial.markers.time);
}

}  // namespace pedicel::discrepancy
