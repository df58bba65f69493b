#include "pedicel/discrepancy/scene/more_scene_trials.h"

#include <algorithm>
#include <limits>

#include "pedicel/core/check.h"

namespace pedicel::discrepancy {

namespace {

[[noreturn]] void refuse(const SceneExperiment& more, const std::string& why) {
  throw UsageError(more.folder.string() + ": " + why);
}

/// Where each of the first list stands in the second; -1 where it does not. Refuses what only the
/// second has, and what is not alike.
template <class Item, class Alike>
std::vector<int> order_of(const SceneExperiment& more, const std::string& what,
                          const std::vector<Item>& own, const std::vector<Item>& theirs,
                          const Alike& alike) {
  std::vector<int> order;
  for (const Item& one : own) {
    const auto found = std::ranges::find(theirs, one.name, &Item::name);
    order.push_back(found == theirs.end() ? -1 : static_cast<int>(found - theirs.begin()));
    if (found != theirs.end() && !alike(one, *found))
      refuse(more, what + " \"" + one.name +
                       "\" is not what it was before, expected the same or another name");
  }
  for (const Item& one : theirs)
    if (std::ranges::find(own, one.name, &Item::name) == own.end())
      refuse(more, what + " \"" + one.name + "\" is not among those before");
  return order;
}

// A file has six digits or seventeen.
bool near(const Vec3& a, const Vec3& b) {
  return (a - b).norm() < 1.0e-6;
}
bool near(const Pose& a, const Pose& b) {
  return near(a.position, b.position) && a.rotation.angularDistance(b.rotation) < 1.0e-6;
}

bool drawn_alike(const ScenePlantFile& a, const ScenePlantFile& b) {
  return near(a.pose, b.pose) && a.file.root == b.file.root &&
         std::ranges::equal(a.file.curves, b.file.curves, {}, &plant::PlantCurve::points,
                            &plant::PlantCurve::points) &&
         std::ranges::equal(a.file.curves, b.file.curves, {}, &plant::PlantCurve::name,
                            &plant::PlantCurve::name);
}

Samples in_order(const Samples& samples, const std::vector<int>& order, long each) {
  Samples sorted;
  if (samples.size() == 0) return sorted;
  sorted.time = samples.time;
  sorted.value.setConstant(samples.size(), each * static_cast<long>(order.size()),
                           std::numeric_limits<double>::quiet_NaN());
  for (std::size_t m = 0; m < order.size(); ++m)
    if (order[m] >= 0)
      sorted.value.middleCols(each * static_cast<long>(m), each) =
          samples.value.middleCols(each * order[m], each);
  return sorted;
}

std::vector<Samples> of_instruments(const std::vector<Samples>& tables,
                                    const std::vector<int>& order) {
  std::vector<Samples> sorted;
  for (const int at : order)
    sorted.push_back(at < 0 ? Samples{} : tables[static_cast<std::size_t>(at)]);
  return sorted;
}

}  // namespace

void add_trials(const SceneExperiment& more, SceneExperiment& experiment) {
  if (joint_names(more.robot) != joint_names(experiment.robot))
    refuse(more, "its robot has other joints than that of " + experiment.folder.string() +
                     ", expected the same robot");
  if (!std::ranges::equal(more.plants, experiment.plants, {}, &ScenePlantFile::name,
                          &ScenePlantFile::name))
    refuse(more, "its plants are not those of " + experiment.folder.string() +
                     ", expected the same ones in the same order");
  order_of(more, "plant", experiment.plants, more.plants, drawn_alike);
  const std::vector<int> markers = order_of(more, "marker", experiment.markers, more.markers,
                                            [](const SceneMarker& a, const SceneMarker& b) {
                                              return a.plant == b.plant && a.fruit == b.fruit &&
                                                     a.link == b.link && a.place == b.place &&
                                                     near(a.offset_L, b.offset_L);
                                            });
  const std::vector<int> cameras = order_of(
      more, "camera", experiment.cameras, more.cameras, [](const Camera& a, const Camera& b) {
        return near(a.X_WC, b.X_WC) && a.focal.isApprox(b.focal) && a.centre.isApprox(b.centre);
      });
  const std::vector<int> wrenches = order_of(more, "wrench", experiment.wrenches, more.wrenches,
                                             [](const WrenchSensor& a, const WrenchSensor& b) {
                                               return a.link == b.link && a.tared == b.tared;
                                             });
  for (const SceneTrial& trial : more.trials) {
    if (std::ranges::find(experiment.trials, trial.name, &SceneTrial::name) !=
        experiment.trials.end())
      refuse(more, "trial \"" + trial.name + "\" is there already, expected another name");
    SceneTrial added = trial;
    added.markers = in_order(trial.markers, markers, 3);
    for (Samples& pixels : added.pixels) pixels = in_order(pixels, markers, 2);
    added.pixels = of_instruments(added.pixels, cameras);
    added.wrenches = of_instruments(added.wrenches, wrenches);
    // What is known of its instruments was said once for all of its trials.
    added.effects.insert(added.effects.begin(), more.effects.begin(), more.effects.end());
    for (const plant::Effect& known : experiment.effects)
      std::erase(added.effects, known);  // it holds here already
    experiment.trials.push_back(std::move(added));
  }
}

}  // namespace pedicel::discrepancy
