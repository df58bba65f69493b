// What is beside a held point goes where that goes.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/axes.h"
#include "plugins/discrepancy/admission/beside.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// To accuse another trial it takes nearly all of the motion; to clear this one, half of it.
constexpr double agrees = 0.9;
// As beside a drive: fewer rows are explained by anything.
constexpr int least_rows = 8;
constexpr double visible = 10.0;     // times the noise, of what moves
constexpr double contradicts = 0.5;  // of the motion is not what is done
constexpr double least_way = 0.02;   // of the reach, rms: of less a plant may make anything
constexpr double seen = 30.0;        // times the noise, of what leads a marker
constexpr double rests = 0.03;       // of the way of the point beside it

std::string percent(double share) {
  return text("%.2g %%", 100.0 * share);
}

// Another trial whose path the marker follows.
const Trial* follows_that_of(const Beside& beside) {
  const Experiment& experiment = beside.view().experiment;
  for (const Trial& other : experiment.trials) {
    // A table that was copied from another trial follows that one's path.
    if (&other == &beside.view().trial) continue;
    // The other trial's drives beside this one's marker, as it would be if the tables had been put
    // into each other's folders.
    const TrialView view{experiment, other, beside.view().nominal_plant};
    for (const Drive& drive : drives_of(view))
      // The likeliest reason, and the only one that can be proved: these markers do what was done
      // there.
      if (drive.kind == beside.drive().kind && beside.explained_by(drive) > agrees) return &other;
  }
  return nullptr;
}

std::string other_axes_of(const Following& f) {
  const Axes* best = nullptr;
  // As far along as 37 degrees: any of the 47 other readings must point clearly that way.
  double most = 0.8 * f.gain.norm();
  for (const Axes& axes : other_axes()) {
    const double along = (axes.read * f.along).dot(f.gain);
    // They come with the commonest mistake first, which a rarer one has to beat.
    if (along <= (best ? 1.05 * most : most)) continue;
    most = along;
    best = &axes;
  }
  return best ? "; its axes are as (x, y, z) read as " + as_read(best->read) + ": " + best->what +
                    "?"
              : "";
}

std::string likely(const Beside& beside, const Following& f) {
  if (const Trial* other = follows_that_of(beside))
    return "; the markers of trial " + other->name + "?";
  // Read otherwise it must be the same motion, all of it.
  if (f.explained() > agrees) {
    const std::string axes = other_axes_of(f);
    if (!axes.empty()) return axes;
  }
  return "; another trial's table, another clock or frame?";
}

std::optional<Fault> goes_elsewhere(const Beside& beside) {
  // A load has no way that a marker could miss.
  if (!beside.drive().path) return std::nullopt;
  const Following f = beside.follow();
  const double reach = beside.view().nominal_plant->reach();
  if (f.rows < least_rows) return std::nullopt;
  // Of little a plant may make anything, and noise does the rest.
  if (f.driven < std::max(least_way * reach, seen * beside.noise())) return std::nullopt;
  // It rests while its neighbour is led: another marker's column, or another trial's. By motion,
  // not by what is explained: of what rests nothing is, and a limp plant beside a soft grip still
  // goes along a little.
  if (f.moved < rests * f.driven)
    return Fault{"markers.csv",
                 "has " + beside.marker() +
                     text(" within %.3g mm rms of one place, while ", 1e3 * f.moved) +
                     beside.what() +
                     text(" leads the plant beside it by %.3g mm: expected it to "
                          "go along",
                          1e3 * f.driven) +
                     likely(beside, f)};
  // Half of the motion, since a fast drive shakes the plant in its own ways besides.
  if (f.moved < visible * beside.noise() || beside.explained() > contradicts) return std::nullopt;
  return Fault{"markers.csv", "has " + beside.marker() + " go another way than " + beside.what() +
                                  " leads the plant beside it, which explains " +
                                  percent(beside.explained()) +
                                  " of its motion: expected it to go "
                                  "along" +
                                  likely(beside, f)};
}

}  // namespace

std::optional<Fault> check_paths(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  // After the clocks: a marker with a wrong clock goes another way as well, and the clock is the
  // better reason.
  for (const Beside& beside : Beside::all_of(view))
    if (auto fault = goes_elsewhere(beside)) return fault;
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
