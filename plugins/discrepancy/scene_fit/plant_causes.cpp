#include "plugins/discrepancy/scene_fit/plant_causes.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "engine/core/check.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/discrepancy/scene/arm.h"
#include "plugins/discrepancy/simulate/scales.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

namespace {

constexpr double near_arm = 0.05;    // m: what stands farther from every link is not touched
constexpr int looks = 40;            // rows of a trial at which the arm is looked at
constexpr double usual_bend = 0.05;  // of its length: how far a plant is moved that nobody saw

/// A ball about a shape that may touch.
struct Ball {
  int link = 0;
  Vec3 centre_L = Vec3::Zero();  // m
  double radius = 0.0;           // m
};

std::vector<Ball> balls_of(const robot::RobotDescription& robot) {
  std::vector<Ball> balls;
  for (std::size_t l = 0; l < robot.links.size(); ++l)
    for (const robot::Collision& shape : robot.links[l].collisions) {
      const robot::Geometry& g = shape.geometry;
      double radius = g.kind == robot::Geometry::Kind::box
                          ? 0.5 * g.size.norm()
                          : std::hypot(g.radius, 0.5 * g.length + g.radius);
      if (g.mesh)
        for (const Vec3& vertex : g.mesh->vertices) radius = std::max(radius, vertex.norm());
      balls.push_back({static_cast<int>(l), shape.X_LC.position, radius});
    }
  return balls;
}

// Where balls are, as readings or commands say: what is off about them is less than the margin.
std::vector<std::pair<Vec3, double>> ways_of(const Experiment& experiment, const Trial& trial) {
  const Arm arm(experiment, nominal_state(experiment));
  const Samples& table = trial.follows_commands ? trial.commands : trial.joints;
  const std::vector<int>& columns =
      trial.follows_commands ? trial.command_columns : trial.joint_columns;
  const std::vector<Ball> balls = balls_of(experiment.robot);
  std::vector<std::pair<Vec3, double>> all;
  std::vector<Pose> links;
  Eigen::VectorXd q = arm.start();
  for (int i = 0; i < looks; ++i) {
    const long row = static_cast<long>(table.size() - 1) * i / (looks - 1);
    for (std::size_t c = 0; c < columns.size() && table.size() > 0; ++c)
      if (const double value = table.value(row, static_cast<long>(c)); std::isfinite(value))
        q[columns[c]] = value;
    arm.model().link_poses(q, links);
    for (const Ball& ball : balls)
      all.emplace_back(links[static_cast<std::size_t>(ball.link)] * ball.centre_L, ball.radius);
    if (table.size() == 0) break;
  }
  return all;
}

/// One plant of an experiment as it is drawn, and which of its curves are looked at.
class Looked {
 public:
  Looked(const Experiment& experiment, int plant)
      : experiment_(experiment),
        plant_(plant),
        own_(experiment.plants[static_cast<std::size_t>(plant)]),
        maker_(own_.file, own_.file.distance, options()),
        shown_(own_.file.curves.size(), 0) {
    for (const Marker& marker : experiment.markers)
      if (marker.plant == plant) show(curve_of(marker));
    for (const Trial& trial : experiment.trials) show_what_is_near(trial);
  }

  bool any() const { return std::ranges::find(shown_, 1) != shown_.end(); }
  bool shows(const plant::CurvePlace& place) const {
    const int c = own_.file.curve_index(place.curve);
    return c >= 0 && shown_[static_cast<std::size_t>(c)];
  }
  // With all that is known of it, and with what a model has already.
  bool can_be_made(const std::vector<plant::Effect>& beside, const plant::Effect& added) const {
    std::vector<plant::Effect> all;
    for (const auto* list : {&experiment_.scene_effects, &experiment_.effects, &beside})
      for (const plant::Effect& effect : *list)
        if (is_own(effect)) all.push_back(effect);
    all.push_back(added);
    try {
      maker_.make({}, all);
    } catch (const UsageError&) {
      return false;
    }
    return true;
  }

  effects::StartContext context() const {
    effects::StartContext context{own_.file, scales(), 0.0, {}, {}, false};
    double first = 1e300, last = -1e300;
    for (const Trial& trial : experiment_.trials) {
      first = std::min(first, trial.clock);
      last = std::max(last, trial.clock + trial.duration());
    }
    context.clock_span = last - first;
    for (const Marker& marker : experiment_.markers)
      if (marker.plant == plant_) context.markers.push_back(marker.name);
    return context;
  }

 private:
  plant::BuildOptions options() const {
    plant::BuildOptions how;
    how.gravity = experiment_.scene.gravity;
    how.leaf_folders.push_back(own_.path.parent_path());
    return how;
  }

  std::string curve_of(const Marker& marker) const {
    return marker.fruit < 0 ? marker.place.curve
                            : own_.file.fruits[static_cast<std::size_t>(marker.fruit)].place.curve;
  }
  void show(const std::string& curve) {
    if (const int c = own_.file.curve_index(curve); c >= 0) shown_[static_cast<std::size_t>(c)] = 1;
  }

  void show_what_is_near(const Trial& trial) {
    const cosserat::RodState drawn = cosserat::drawn_state(maker_.nominal().model);
    const auto moved = trial.poses.find(plant_);
    const Pose& pose = moved == trial.poses.end() ? own_.pose : moved->second;
    const auto balls = ways_of(experiment_, trial);
    for (const plant::RodPlaces::Span& span : maker_.nominal().spans) {
      char& shown = shown_[static_cast<std::size_t>(span.curve)];
      const Vec3 place = pose * drawn.position[static_cast<std::size_t>(span.element)];
      shown = shown || std::ranges::any_of(balls, [&](const auto& ball) {
                return (place - ball.first).norm() < ball.second + span.length + near_arm;
              });
    }
  }

  bool is_own(const plant::Effect& effect) const {
    const effects::EffectDefinition* known = effects::find_effect(effect.name);
    if (!known || known->file != effects::EffectFile::plant) return false;
    const auto named = effect.words.find("plant");
    return named == effect.words.end() || named->second == own_.name;
  }

  effects::Scales scales() const {
    std::vector<Samples> seen;
    for (const Trial& trial : experiment_.trials) seen.push_back(markers_in(trial));
    std::vector<TrialScales> trials;
    for (std::size_t t = 0; t < seen.size(); ++t)
      trials.push_back({seen[t], experiment_.trials[t].duration(), false});
    effects::Scales scales = scales_of(maker_.nominal(), trials);
    // Seen by cameras, or felt alone: how far it moved nobody measured in metres.
    if (std::ranges::all_of(seen, [](const Samples& one) { return one.value.cols() == 0; }))
      scales.curvature = 3.0 * usual_bend / scales.length;
    return scales;
  }

  // The columns of this plant's markers.
  Samples markers_in(const Trial& trial) const {
    Samples own;
    own.time = trial.markers.time;
    std::vector<long> columns;
    for (std::size_t m = 0; m < experiment_.markers.size(); ++m)
      if (experiment_.markers[m].plant == plant_ &&
          3 * static_cast<long>(m) + 3 <= trial.markers.value.cols())
        for (long a = 0; a < 3; ++a) columns.push_back(3 * static_cast<long>(m) + a);
    own.value.resize(trial.markers.value.rows(), static_cast<long>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c)
      own.value.col(static_cast<long>(c)) = trial.markers.value.col(columns[c]);
    return own;
  }

  const Experiment& experiment_;
  int plant_;
  const ExperimentPlant& own_;
  PlantMaker maker_;
  std::vector<char> shown_;  // by curve
};

// What a scene's own effects are not about: its contact, arm and instruments stand among those.
bool is_tried(const effects::EffectDefinition& one) {
  using effects::Home;
  return one.starts && one.is_candidate && one.file == effects::EffectFile::plant &&
         one.home != Home::material && one.home != Home::grip && one.home != Home::sensor;
}

}  // namespace

std::vector<SceneFit> plant_starts(const Experiment& experiment,
                                   const std::vector<plant::Effect>& beside) {
  std::vector<SceneFit> all;
  std::deque<Looked> plants;
  std::deque<effects::StartContext> contexts;
  for (std::size_t p = 0; p < experiment.plants.size(); ++p)
    plants.emplace_back(experiment, static_cast<int>(p));
  for (const Looked& one : plants) contexts.push_back(one.context());
  for (const effects::EffectDefinition& definition : effects::effect_definitions()) {
    if (!is_tried(definition)) continue;
    for (std::size_t p = 0; p < plants.size(); ++p) {
      if (!plants[p].any()) continue;
      for (const effects::Start& start : definition.starts(contexts[p])) {
        // Of a plant of many curves only those that somebody saw, or that the arm comes near: on
        // the others nothing shows, and each place is a simulation of every trial.
        if (start.effect().place && !plants[p].shows(*start.effect().place)) continue;
        SceneFit fit{start.effect(), start.free()};
        if (!plants[p].can_be_made(beside, fit.effect)) continue;
        if (plants.size() > 1) fit.effect.words["plant"] = experiment.plants[p].name;
        all.push_back(std::move(fit));
      }
    }
  }
  return all;
}

}  // namespace pedicel::discrepancy
