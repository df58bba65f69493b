// Loads. A plant that rests leaves its place when a load changes, at once and the way of the
// change, and by about as much as the nominal plant says. Rest, answer and rest again: what swings
// all the time, or is blown about, is not judged.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/admission/load_answers.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double near = 0.3;         // of the way from the root to the load, along the plant
constexpr double least_shift = 0.5;  // s: a latency of 0.3 s, and 0.2 s
// What the size of a change makes of when it is seen. Each answer is seen up to a sample late, so
// that a drift of a sample is none.
constexpr double least_drift = 0.03, drift_samples = 1.5;  // s
constexpr double of_rise = 0.2;
constexpr double least_rate = 0.1;  // of a rate, where not all answers are seen
constexpr double on_a_line = 0.25;  // of the drift, by which it may leave a steady one
constexpr double most_off = 30.0;   // a modulus ten times off, and what is not linear
constexpr double explains = 0.8;    // of the motion
// A marker goes straight or it goes across; in between a plant may lead it.
constexpr double askew = 0.2, straight = 0.8;  // cosines
constexpr double most_way = 0.3;               // of the reach: what is linear ends before

const std::string expected = ": expected seconds since the trial began, the same in all its tables";

// A clock that is neither late nor early, but runs at another rate or was stopped. Where not all
// answers are seen, which one is missing is not known: then it is a rate or nothing.
std::optional<Fault> other_clock(const std::vector<LoadAnswer>& answers, const Marker& marker,
                                 double sample, bool complete) {
  // What is late by the same every time is a latency, which is a finding. Only what grows is a
  // clock.
  const auto late = [&](std::size_t i) { return answers[i].seen - answers[i].changed; };
  const std::size_t last = answers.size() - 1;
  // A marker that goes against its load is another mistake, and times of such answers mean nothing.
  if (std::ranges::any_of(answers, [](const LoadAnswer& a) { return a.with <= 0.0; }))
    return std::nullopt;
  // From the first to the last: what happens in between is judged by the line.
  const double drift = late(last) - late(0);
  double slowest = 0.0;
  // A slow answer leaves the noise later the smaller it is. So loads of different sizes seem to
  // drift by a part of the rise.
  for (const LoadAnswer& answer : answers) slowest = std::max(slowest, answer.rise);
  if (std::abs(drift) < std::max(least_drift + drift_samples * sample, of_rise * slowest))
    return std::nullopt;
  const double time = answers[last].changed - answers[0].changed;
  double from_line = 0.0;
  for (std::size_t i = 1; i < last; ++i)
    from_line = std::max(
        from_line,
        std::abs(late(i) - late(0) - drift * (answers[i].changed - answers[0].changed) / time));
  const std::string said =
      "has " + marker.name + " answer the load at " +
      text("%.4g s after %.3g s, ", answers[0].changed, late(0)) +
      text("and that at %.4g s after %.3g s", answers[last].changed, late(last));
  // A rate makes a straight line of delays; a pause of the clock makes a step.
  const bool is_rate = from_line <= on_a_line * std::abs(drift);
  if (!complete && (last < 2 || !is_rate)) return std::nullopt;
  if (last > 1 && !is_rate)
    return Fault{"markers.csv", said + expected + "; frames dropped, and the clock counted on?"};
  return Fault{"markers.csv",
               said + text(": a clock that runs %.4g times as fast", 1.0 + drift / time) +
                   expected + "; another rate of frames?"};
}

// Where more or fewer answers are seen than loads change within the record: a record that ticks
// much faster or slower, so that every answer stands at the same multiple of its time.
std::optional<Fault> other_rate(const std::vector<LoadAnswer>& answers, const Marker& marker,
                                double sample) {
  double product = 0.0, square = 0.0;
  for (const LoadAnswer& answer : answers) {
    if (answer.with <= 0.0) return std::nullopt;
    product += answer.seen * answer.changed;
    square += answer.changed * answer.changed;
  }
  // A line through time 0, because both clocks begin there.
  const double rate = product / square;
  // Near to the right rate missing answers have other reasons.
  if (std::abs(std::log(rate)) < least_rate) return std::nullopt;
  for (const LoadAnswer& answer : answers)
    // All of them must stand on that line. Where one answer is missing the others are paired with
    // wrong changes, and do not.
    if (std::abs(answer.seen - rate * answer.changed) > least_drift + drift_samples * sample)
      return std::nullopt;
  return Fault{"markers.csv", "has " + marker.name +
                                  text(" answer the load at %.4g s at %.4g s",
                                       answers.front().changed, answers.front().seen) +
                                  text(" and that at %.4g s at %.4g s", answers.back().changed,
                                       answers.back().seen) +
                                  text(": a clock that runs %.3g times as fast", rate) + expected +
                                  "; another rate of frames?"};
}

std::optional<Fault> against(const std::vector<LoadAnswer>& answers, const Marker& marker) {
  const auto with =
      std::ranges::count_if(answers, [](const LoadAnswer& a) { return a.with > 0.0; });
  for (const LoadAnswer& answer : answers)
    if (answer.with < 0.0)
      return Fault{"markers.csv",
                   "has " + marker.name +
                       text(" go %.3g mm against the change of the load at %.4g s",
                            -1e3 * answer.with, answer.changed) +
                       ": expected it to go along" +
                       // Some along and some against: the loads themselves may be right, and stand
                       // in another order.
                       (with > 0 ? "; loads in another order?" : "; a load of the other sign?")};
  return std::nullopt;
}

std::optional<Fault> other_way_or_size(const TrialView& view, const Drive& drive, int marker,
                                       const Following& f) {
  // The size is asked only where the motion is the load's: of a swing a gain says nothing.
  if (f.explained() < explains || f.driven <= 0.0) return std::nullopt;
  const Mat3 compliance = view.nominal_plant->compliance(drive.spot);
  if (!compliance.allFinite()) return std::nullopt;
  // The whole way and not the part along the load: the marker may be led askew by the plant's own
  // axes.
  const Vec3 nominal = compliance * f.along;
  const std::string& name = view.experiment.markers[marker].name;
  const double cosine = std::abs(f.gain.dot(f.along)) / f.gain.norm();
  // Only where this plant would go straight: on a slanted branch a load along gravity moves a
  // marker sideways.
  if (cosine < askew && nominal.dot(f.along) > straight * nominal.norm())
    return Fault{"markers.csv", "has " + name +
                                    " go across the load beside it: expected the way that it "
                                    "pulls; another axis, or a frame turned?"};
  // A plant that is as stiff as it may be goes no farther than this.
  const double most = most_off * most_way * view.nominal_plant->reach() / f.driven;
  const double usual = std::min(nominal.norm(), most), here = f.gain.norm();
  // The limits lie beyond a modulus that is ten times off, which is a finding.
  if (here < most_off * usual && here > usual / most_off) return std::nullopt;
  return Fault{"markers.csv", "has " + name +
                                  text(" go %.3g m for a newton of the load beside it, "
                                       "and the nominal plant goes %.3g m",
                                       here, nominal.norm()) +
                                  ": expected loads in newtons" +
                                  (here < usual ? "; in grams or millinewtons?" : "")};
}

std::optional<Fault> answers_of(const TrialView& view, const Track& track, int marker) {
  const auto [answers, complete] = load_answers(view.trial, track, noise_of_markers(view));
  if (answers.empty()) return std::nullopt;
  const Marker& seen = view.experiment.markers[marker];
  // The first two rows tell the rate. Rows that are uneven only make the limit another one.
  const double sample = track.time[1] - track.time[0];
  if (answers.size() > 1) {
    if (auto fault = other_clock(answers, seen, sample, complete)) return fault;
    if (!complete)
      if (auto fault = other_rate(answers, seen, sample)) return fault;
  }
  const bool on_time = std::ranges::all_of(answers, [](const LoadAnswer& answer) {
    return std::abs(answer.seen - answer.changed) < least_shift;
  });
  // The sign is asked last, and only where each answer belongs to its load without doubt.
  return complete && on_time ? against(answers, seen) : std::nullopt;
}

}  // namespace

std::optional<Fault> check_loads(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  for (const Drive& drive : drives_of(view)) {
    if (drive.kind != Drive::Kind::load) continue;
    const int marker = marker_near(*view.nominal_plant, drive.spot, near);
    if (marker < 0) continue;
    const Track track = track_of(view.trial, marker);
    // Times before sizes: answers that are paired with the wrong loads have wrong sizes as well.
    if (auto fault = answers_of(view, track, marker)) return fault;
    if (auto fault = other_way_or_size(view, drive, marker, following(track, drive))) return fault;
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
