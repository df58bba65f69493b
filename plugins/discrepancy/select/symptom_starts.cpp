#include "plugins/discrepancy/select/symptom_starts.h"

#include <algorithm>
#include <numeric>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Of one name the symptom that shows most clearly; null where none shows.
const Symptom* clearest(const std::vector<Symptom>& symptoms, const std::string& name) {
  const Symptom* best = nullptr;
  for (const Symptom& symptom : symptoms)
    if (symptom.name == name && symptom.shows() &&
        (!best || symptom.significance() > best->significance()))
      best = &symptom;
  return best;
}

bool is_about(const effects::Sign& sign, const Hypothesis& start) {
  return sign.word.empty() ||
         std::ranges::any_of(start.effects.front().words,
                             [&](const auto& word) { return word.second == sign.word; });
}

// The cause's own starts with the size that the symptom gives. Nothing where that is none which the
// effect can have: a lag of less than nothing. Whether there are any.
bool add_starts(Cause& cause, const effects::Sign& sign, double value) {
  const std::size_t before = cause.led.size();
  for (Hypothesis start : cause.starts) {
    const auto free = std::ranges::find(start.free, sign.parameter, &FreeParameter::name);
    if (!is_about(sign, start) || free == start.free.end()) continue;
    // A number within the bounds is asked for, and not one that was cut to them: a start at a bound
    // has nowhere to go.
    if (!(value > free->low && value < free->high)) continue;
    start.set_value(static_cast<int>(free - start.free.begin()), value);
    // Starts that differed in that size alone are one.
    const Eigen::VectorXd unknowns = start.unknowns();
    const bool known = std::ranges::any_of(cause.led, [&](const Hypothesis& other) {
      return other.effects.front().words == start.effects.front().words &&
             other.unknowns() == unknowns;
    });
    if (!known) cause.led.push_back(std::move(start));
  }
  return cause.led.size() > before;
}

}  // namespace

std::string lead(std::vector<Cause>& causes, const std::vector<Symptom>& symptoms,
                 const effects::StartContext& context) {
  std::string told;
  for (Cause& cause : causes) {
    cause.led.clear();
    cause.spoken_for = 0.0;
    const effects::EffectDefinition* known = effects::find_effect(cause.name);
    if (!known) continue;
    for (const effects::Sign& sign : known->speaks_for) {
      const Symptom* symptom = clearest(symptoms, sign.symptom);
      if (!symptom) continue;
      cause.spoken_for = std::max(cause.spoken_for, symptom->significance() / sign.rank);
      if (!sign.value) continue;
      const double value = sign.value(symptom->value, context);
      if (add_starts(cause, sign, value))
        told += (told.empty() ? "" : ", ") + cause.name + " " + sign.parameter +
                text(" %.3g by ", value) + sign.symptom;
    }
  }
  return told;
}

std::vector<int> symptoms_first(const std::vector<Cause>& causes,
                                const std::vector<double>& score) {
  std::vector<int> order(causes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) {
    if (causes[a].spoken_for != causes[b].spoken_for)
      return causes[a].spoken_for > causes[b].spoken_for;
    return score[a] > score[b];
  });
  return order;
}

}  // namespace pedicel::discrepancy
