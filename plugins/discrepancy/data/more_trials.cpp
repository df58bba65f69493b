#include "plugins/discrepancy/data/more_trials.h"

#include <algorithm>
#include <limits>

#include "engine/core/check.h"

namespace pedicel::discrepancy {

namespace {

constexpr const char* changed = "is not what it was before, expected the same or another name";

[[noreturn]] void refuse(const Experiment& more, const std::string& why) {
  throw UsageError(more.folder.string() + ": " + why);
}

/// Where each of `own` stands in `theirs`, by name; -1 where it does not. Refuses what `theirs`
/// alone has, and, with the words of `differs`, what has one name and is not alike. `what`: a thing
/// of the lists, for the sentence.
template <class Item, class Alike>
std::vector<int> order_of(const Experiment& more, const std::string& what,
                          const std::vector<Item>& own, const std::vector<Item>& theirs,
                          const Alike& alike, const std::string& differs) {
  std::vector<int> order;
  for (const Item& one : own) {
    const auto found = std::ranges::find(theirs, one.name, &Item::name);
    order.push_back(found == theirs.end() ? -1 : static_cast<int>(found - theirs.begin()));
    if (found != theirs.end() && !alike(one, *found))
      refuse(more,
             std::string(what).append(" ").append(in_quotes(one.name)).append(" ").append(differs));
  }
  for (const Item& one : theirs)
    if (std::ranges::find(own, one.name, &Item::name) == own.end())
      refuse(more, what + " \"" + one.name + "\" is not among those before");
  return order;
}

/// A table with its things, of so many columns `each`, in another order; NaN where `order` is -1.
Samples in_order(const Samples& samples, const std::vector<int>& order, int each) {
  Samples sorted;
  // A table that was not measured has no columns to sort.
  if (samples.value.cols() == 0) return sorted;
  sorted.time = samples.time;
  sorted.value.setConstant(samples.size(), each * static_cast<Eigen::Index>(order.size()),
                           std::numeric_limits<double>::quiet_NaN());
  for (std::size_t m = 0; m < order.size(); ++m)
    if (order[m] >= 0)
      sorted.value.middleCols(each * static_cast<Eigen::Index>(m), each) =
          samples.value.middleCols(each * order[m], each);
  return sorted;
}

// A file has six digits or seventeen.
bool near(const Vec3& a, const Vec3& b) {
  return (a - b).norm() < 1.0e-6;
}
bool near(const Pose& a, const Pose& b) {
  return near(a.position, b.position) && a.rotation.angularDistance(b.rotation) < 1.0e-6;
}

bool drawn_alike(const ExperimentPlant& a, const ExperimentPlant& b) {
  return near(a.pose, b.pose) && a.file.root == b.file.root &&
         std::ranges::equal(a.file.curves, b.file.curves, {}, &plant::PlantCurve::points,
                            &plant::PlantCurve::points) &&
         std::ranges::equal(a.file.curves, b.file.curves, {}, &plant::PlantCurve::name,
                            &plant::PlantCurve::name);
}

std::vector<Samples> of_instruments(const std::vector<Samples>& tables,
                                    const std::vector<int>& order) {
  std::vector<Samples> sorted;
  sorted.reserve(order.size());
  for (const int at : order)
    sorted.push_back(at < 0 ? Samples{} : tables[static_cast<std::size_t>(at)]);
  return sorted;
}

void check_models(const Experiment& more, const Experiment& experiment) {
  const std::string before = experiment.folder.string();
  if (more.has_robot() != experiment.has_robot())
    refuse(more, "one of it and " + before + " has a robot, expected both or none");
  if (!experiment.has_robot()) {
    if (!(more.plant() == experiment.plant()))
      refuse(more, "its plant is not that of " + before + ", expected the same plant file");
    return;
  }
  if (joint_names(more.robot) != joint_names(experiment.robot))
    refuse(more, "its robot has other joints than that of " + before + ", expected the same robot");
  if (!std::ranges::equal(more.plants, experiment.plants, {}, &ExperimentPlant::name,
                          &ExperimentPlant::name))
    refuse(more,
           "its plants are not those of " + before + ", expected the same ones in the same order");
  order_of(more, "plant", experiment.plants, more.plants, drawn_alike, changed);
}

// Refuses a name that is there already.
void join(const Experiment& more, Trial trial, Experiment& experiment) {
  if (std::ranges::find(experiment.trials, trial.name, &Trial::name) != experiment.trials.end())
    refuse(more, "trial \"" + trial.name + "\" is there already, expected another name");
  // What is known of its instruments was said once for all of its trials.
  trial.effects.insert(trial.effects.begin(), more.effects.begin(), more.effects.end());
  for (const plant::Effect& known : experiment.effects)
    std::erase(trial.effects, known);  // it holds here already
  experiment.trials.push_back(std::move(trial));
}

}  // namespace

void add_trials(const Experiment& more, Experiment& experiment) {
  check_models(more, experiment);
  const std::vector<int> markers = order_of(
      more, "marker", experiment.markers, more.markers,
      [](const Marker& a, const Marker& b) {
        return a.plant == b.plant && a.fruit == b.fruit && a.link == b.link && a.place == b.place &&
               near(a.offset_L, b.offset_L);
      },
      "sits elsewhere than before, expected the same place or another name");
  const std::vector<int> cameras = order_of(
      more, "camera", experiment.cameras, more.cameras,
      [](const Camera& a, const Camera& b) {
        return near(a.X_WC, b.X_WC) && a.focal.isApprox(b.focal) && a.centre.isApprox(b.centre);
      },
      changed);
  const std::vector<int> wrenches = order_of(
      more, "wrench", experiment.wrenches, more.wrenches,
      [](const WrenchSensor& a, const WrenchSensor& b) {
        return a.link == b.link && a.tared == b.tared;
      },
      changed);
  for (const Trial& trial : more.trials) {
    Trial added = trial;
    added.markers = in_order(trial.markers, markers, 3);
    for (Samples& pixels : added.pixels) pixels = in_order(pixels, markers, 2);
    added.pixels = of_instruments(added.pixels, cameras);
    added.wrenches = of_instruments(added.wrenches, wrenches);
    join(more, std::move(added), experiment);
  }
}

}  // namespace pedicel::discrepancy
