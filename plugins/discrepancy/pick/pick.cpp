#include "plugins/discrepancy/pick/pick.h"

#include <cmath>
#include <utility>

#include "engine/core/check.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double least_peak = 8.0;  // noise units: so far chance alone does not come
// With it a logistic and a normal curve of equal spread are compared.
constexpr double odds_spread = 1.81380;  // pi / sqrt 3, standard deviation of the logistic

// Of samples, for people: it is what a table of such a record says. Nothing is judged by it but
// whether there is any force.
void find_peak(const PickForce& course, Pick& pick) {
  for (int i = 0; i < course.size(); ++i)
    if (const double size = course.force(i).norm(); size > pick.peak_force) {
      pick.peak_force = size;
      pick.peak_time = course.time(i);
    }
}

Pick unclear(Pick pick, const std::string& why) {
  pick.end = Pick::End::unclear;
  pick.why = why;
  return pick;
}

/// The share of the largest load that a fall must begin with, to be one of the load.
constexpr double least_load = 0.25;

Pick with_probability(Pick pick, const PickForce& course, const PickSettings& s) {
  // Only a load that went gets a probability. Of one that stayed there is nothing to part.
  Fall& fall = *pick.fall;
  // What is faster than arm, sampling or averaging can follow looks as slow as these are. In
  // squares, since each smears the fall on its own. So a slow record comes out less sure, and not
  // wrong.
  pick.limit = std::hypot(s.response, pick.interval, 0.5 * fall.smoothing);
  // A fall without a half is slower than what was looked at.
  const double half = fall.half.value_or(s.settle + 2.0 * s.level);
  pick.probability = probability_of_break(half, fall.half_error, pick.limit, s.sharpness);
  // The likelier one. The probability is told beside it, so that a user can ask for more.
  pick.end = *pick.probability >= 0.5 ? Pick::End::came_off : Pick::End::slipped;
  // A break has a moment, a slip has a beginning: it is told by another rule.
  if (pick.end == Pick::End::slipped) {
    const Beginning beginning = beginning_of(course, fall, s);
    fall.onset = beginning.time;
    fall.onset_error = beginning.error;
  }
  return pick;
}

}  // namespace

double probability_of_break(double half, double error, double limit, double sharpness) {
  // A logistic curve blurred by a normal one is nearly a wider logistic curve, with added
  // variances. The odds go by the logarithm of the time, whose error is the relative one.
  const double blur = sharpness * (half > 0.0 ? error / half : 1.0) / odds_spread;
  const double power = sharpness / std::sqrt(1.0 + blur * blur);
  return 1.0 / (1.0 + std::pow(half / limit, power));
}

Pick judge_pick(const PickRecord& record, const PickSettings& settings) {
  // Settings out of range are a mistake of the caller, and no answer about a record.
  if (const std::string fault = check(settings); !fault.empty()) throw UsageError(fault);
  // Above its zero. With a hand's weight in it, even a load that went entirely would be but a part
  // of the force.
  const PickForce course(record, settings.rest);
  Pick pick;
  // Every refusal below is an answer and no error: a program that reads thousands of records goes
  // on.
  if (course.size() < 3) return unclear(pick, "fewer than three samples have all their values");
  pick.noise = course.noise();
  pick.interval = course.interval();
  find_peak(course, pick);
  // A record of noise has a largest fall, too, and would get a probability.
  if (pick.peak_force <= least_peak * pick.noise)
    return unclear(pick, "the force stays within its noise");
  pick.fall = find_fall(course, settings);
  if (!pick.fall)
    return unclear(pick, "the record is too short for a level of the force before and after");
  const LargestLoad load = largest_load(course, settings);
  // A fall of a small load happens on the way, when a leaf gives way. It is not the pick's.
  if (pick.fall->share >= settings.share && pick.fall->before >= least_load * load.force)
    return with_probability(std::move(pick), course, settings);
  // No fall that lasts within the levels. Then it went slowly or not at all, and only the ends can
  // say which.
  pick.fall = whole_fall(course, load, settings);
  // Somebody has stopped the recorder at the break. What it was cannot be known.
  if (ends_in_a_fall(course, load, settings))
    return unclear(std::move(pick), "the record ends while the force falls");
  if (pick.fall->share >= settings.share)
    return with_probability(std::move(pick), course, settings);
  // A fruit that is still pulled at the end has not come off, and nothing has let go of it.
  pick.end = Pick::End::held;
  return pick;
}

std::optional<double> Pick::time() const {
  if (!fall || (end != End::came_off && end != End::slipped)) return std::nullopt;
  // Where it was held, or nothing can be told, no point of time is a finding.
  return fall->onset;
}

std::string Pick::outcome() const {
  if (end == End::unclear) return "unclear";
  // The words of public data sets, so that tables can be compared.
  return end == End::came_off ? "detached" : "failed";
}

std::string Pick::sentence() const {
  const auto lost = [this] {
    return fall->half ? text("half of %.3g N went within %.3g ms", fall->before - fall->after,
                             1e3 * *fall->half)
                      : text("%.3g N went slowly", fall->before - fall->after);
  };
  switch (end) {
    case End::came_off:
      // Two deviations: people read plus and minus as what is nearly sure.
      return text("The fruit came off at %.3f s (+- %.3f s): ", fall->onset,
                  2.0 * fall->onset_error) +
             lost() + text(" (probability %.2f).", *probability);
    case End::slipped:
      return text("The fruit did not come off; the hand slipped from %.2f s (+- %.2f s) on: ",
                  fall->onset, 2.0 * fall->onset_error) +
             // Of what the sentence says, not of a break.
             lost() + text(" (probability %.2f).", 1.0 - *probability);
    case End::held:
      return text("The fruit did not come off; at the end %.0f %% of the load was still there.",
                  100.0 * (1.0 - fall->share));
    case End::unclear:
      break;
  }
  return "How the pick ended cannot be told: " + why + ".";
}

}  // namespace pedicel::discrepancy
