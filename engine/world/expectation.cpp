#include "engine/world/expectation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/csv.h"

namespace pedicel::world {

namespace {

constexpr std::array<MeasuredQuantity, 18> quantities = {{
    {"detached_count", "[plant]", "fruits that came off"},
    {"detached_by_stretch_count", "[fruit] [plant]", "fruits whose stretch passed its threshold"},
    {"detached_by_bend_count", "[fruit] [plant]", "fruits whose bend passed its threshold"},
    {"detach_time_s", "fruit", "when the fruit came off"},
    {"detach_strain_1", "fruit", "stretch strain of its stalk in the step in which it came off"},
    {"detach_bend_rad", "fruit", "bend of its stalk in the step in which it came off"},
    {"detach_force_N", "fruit", "force in its stalk in the step in which it came off"},
    {"fruit_in", "[fruit] body", "fruits that lie in the body at the end, of those that came off"},
    {"fruit_height_m", "fruit", "height of the fruit's centre at the end"},
    {"fruit_rise_m", "fruit", "highest place of the fruit's centre above its first one"},
    {"max_drift_m", "[plant]", "largest distance of a node from where it was drawn, over the run"},
    {"end_drop_m", "[plant]",
     "how far the ends hang below where they were drawn, mean, at the end"},
    {"max_stretch_1", "[plant]", "largest stretch strain of a segment over the run"},
    {"max_bend_rad", "[plant]", "largest bend of a joint over the run"},
    {"max_contact_force_N", "[link] [fruit]", "largest contact force of a link or on a fruit"},
    {"max_penetration_m", "", "deepest overlap of a plant and a body over the run"},
    {"kinetic_energy_J", "", "of all plants, at the end"},
    {"real_time_factor", "", "simulated seconds over wall seconds (this machine's)"},
}};

std::string number(double value) {
  return io::format_number(value, 6);
}

std::string test_text(const Expectation& e) {
  switch (e.test) {
    case Expectation::Test::is:
      return "is " + number(e.low);
    case Expectation::Test::between:
      return "between " + number(e.low) + " and " + number(e.high);
    case Expectation::Test::above:
      return "above " + number(e.low);
    case Expectation::Test::below:
      return "below " + number(e.low);
    case Expectation::Test::rises_with_sweep:
      return "rises with the sweep";
    case Expectation::Test::falls_with_sweep:
      return "falls with the sweep";
    case Expectation::Test::steady_over_sweep:
      return "within " + number(e.low) + " of its mean over the sweep";
  }
  return {};
}

bool holds(const Expectation& e, double value) {
  switch (e.test) {
    case Expectation::Test::is:
      return value == e.low;
    case Expectation::Test::between:
      return value >= e.low && value <= e.high;
    case Expectation::Test::above:
      return value > e.low;
    case Expectation::Test::below:
      return value < e.low;
    default:
      return false;
  }
}

// Both are written so that a NaN anywhere meets nothing.
bool is_steady(std::span<const double> values, double share) {
  const double mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return std::abs(value - mean) <= share * std::abs(mean);
  });
}

bool holds_over_sweep(const Expectation& e, std::span<const double> values) {
  if (e.test == Expectation::Test::steady_over_sweep) return is_steady(values, e.low);
  const double sign = e.test == Expectation::Test::rises_with_sweep ? 1.0 : -1.0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(sign * (values[i] - values[i - 1]) > 0.0)) return false;
  return true;
}

}  // namespace

std::span<const MeasuredQuantity> known_quantities() {
  return quantities;
}

std::string to_string(const Expectation& e) {
  std::string text = e.quantity;
  for (const std::string& subject : {e.fruit, e.plant, e.link})
    if (!subject.empty()) text += " of " + subject;
  if (!e.body.empty()) text += " " + e.body;
  return text + " " + test_text(e);
}

ExpectationResult judge(const Expectation& expectation, double measured) {
  PEDICEL_ASSERT(!expectation.over_sweep());
  return {expectation, {measured}, holds(expectation, measured)};
}

ExpectationResult judge_sweep(const Expectation& expectation, std::span<const double> measured) {
  PEDICEL_ASSERT(expectation.over_sweep());
  const bool met = measured.size() >= 2 && holds_over_sweep(expectation, measured);
  return {expectation, {measured.begin(), measured.end()}, met};
}

std::string to_string(const ExpectationResult& verdict) {
  const std::string values = joined(verdict.measured, [&](double value) {
    return std::isfinite(value) ? number(value) : "nothing";
  });
  return std::string(verdict.met ? "met    " : "NOT MET") + " " + to_string(verdict.expectation) +
         ": " + (values.empty() ? "not measured" : values);
}

}  // namespace pedicel::world
