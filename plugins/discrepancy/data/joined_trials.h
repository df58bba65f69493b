#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "plugins/discrepancy/data/experiment.h"

/// What adding the trials of a later experiment takes, of plants and of scenes alike.
namespace pedicel::discrepancy {

template <class Experiment>
[[noreturn]] void refuse_to_join(const Experiment& more, const std::string& why) {
  throw UsageError(more.folder.string() + ": " + why);
}

/// Where each of `own` stands in `theirs`, by name; -1 where it does not. Refuses what `theirs`
/// alone has, and, with the words of `differs`, what has one name and is not alike. `what`: a thing
/// of the lists, for the sentence.
template <class Experiment, class Item, class Alike>
std::vector<int> order_of(const Experiment& more, const std::string& what,
                          const std::vector<Item>& own, const std::vector<Item>& theirs,
                          const Alike& alike, const std::string& differs) {
  std::vector<int> order;
  for (const Item& one : own) {
    const auto found = std::ranges::find(theirs, one.name, &Item::name);
    order.push_back(found == theirs.end() ? -1 : static_cast<int>(found - theirs.begin()));
    if (found != theirs.end() && !alike(one, *found))
      refuse_to_join(more, what + " \"" + one.name + "\" " + differs);
  }
  for (const Item& one : theirs)
    if (std::ranges::find(own, one.name, &Item::name) == own.end())
      refuse_to_join(more, what + " \"" + one.name + "\" is not among those before");
  return order;
}

/// A table with its things, of so many columns `each`, in another order; NaN where `order` is -1.
Samples in_order(const Samples& samples, const std::vector<int>& order, int each);

/// Adds a trial of `more` whose tables are in order. Refuses a name that is there already.
template <class Experiment, class OneTrial>
void join_trial(const Experiment& more, OneTrial trial, Experiment& experiment) {
  if (std::ranges::find(experiment.trials, trial.name, &OneTrial::name) != experiment.trials.end())
    refuse_to_join(more, "trial \"" + trial.name + "\" is there already, expected another name");
  // What is known of its instruments was said once for all of its trials.
  trial.effects.insert(trial.effects.begin(), more.effects.begin(), more.effects.end());
  for (const plant::Effect& known : experiment.effects)
    std::erase(trial.effects, known);  // it holds here already
  experiment.trials.push_back(std::move(trial));
}

}  // namespace pedicel::discrepancy
