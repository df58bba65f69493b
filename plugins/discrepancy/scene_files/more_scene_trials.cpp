#include "plugins/discrepancy/scene_files/more_scene_trials.h"

#include <algorithm>

#include "plugins/discrepancy/data/joined_trials.h"

namespace pedicel::discrepancy {

namespace {

constexpr const char* differs = "is not what it was before, expected the same or another name";

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
    refuse_to_join(more, "its robot has other joints than that of " + experiment.folder.string() +
                             ", expected the same robot");
  if (!std::ranges::equal(more.plants, experiment.plants, {}, &ScenePlantFile::name,
                          &ScenePlantFile::name))
    refuse_to_join(more, "its plants are not those of " + experiment.folder.string() +
                             ", expected the same ones in the same order");
  order_of(more, "plant", experiment.plants, more.plants, drawn_alike, differs);
  const std::vector<int> markers = order_of(
      more, "marker", experiment.markers, more.markers,
      [](const SceneMarker& a, const SceneMarker& b) {
        return a.plant == b.plant && a.fruit == b.fruit && a.link == b.link && a.place == b.place &&
               near(a.offset_L, b.offset_L);
      },
      differs);
  const std::vector<int> cameras = order_of(
      more, "camera", experiment.cameras, more.cameras,
      [](const Camera& a, const Camera& b) {
        return near(a.X_WC, b.X_WC) && a.focal.isApprox(b.focal) && a.centre.isApprox(b.centre);
      },
      differs);
  const std::vector<int> wrenches = order_of(
      more, "wrench", experiment.wrenches, more.wrenches,
      [](const WrenchSensor& a, const WrenchSensor& b) {
        return a.link == b.link && a.tared == b.tared;
      },
      differs);
  for (const SceneTrial& trial : more.trials) {
    SceneTrial added = trial;
    added.markers = in_order(trial.markers, markers, 3);
    for (Samples& pixels : added.pixels) pixels = in_order(pixels, markers, 2);
    added.pixels = of_instruments(added.pixels, cameras);
    added.wrenches = of_instruments(added.wrenches, wrenches);
    join_trial(more, std::move(added), experiment);
  }
}

}  // namespace pedicel::discrepancy
