#include "plugins/discrepancy/scene_next/arm_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr double plant_spacing = 5.0e-3;            // m, between points that stand for a plant
constexpr double stand_off = 2.0e-3;                // m, from plants, where a motion begins
constexpr double off_ground = 5.0e-3;               // m
constexpr double finest = 2.0e-3, coarsest = 0.05;  // s
constexpr double rounding = 1.0e-9;

double median_step(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  if (steps.empty()) return 0.01;
  std::ranges::nth_element(steps, steps.begin() + static_cast<long>(steps.size() / 2));
  return std::clamp(steps[steps.size() / 2], finest, coarsest);
}

Eigen::VectorXd start_of(const Experiment& experiment) {
  return Arm(experiment, nominal_state(experiment)).start();
}

/// call(corner in the link's frame) for the boxes around a link's shapes
template <class Call>
void each_corner(const robot::Link& link,
                 const std::vector<std::shared_ptr<const geometry::SignedDistance>>& fields,
                 const Call& call) {
  for (std::size_t c = 0; c < fields.size(); ++c) {
    const geometry::Aabb box = fields[c]->bounds();
    for (int corner = 0; corner < 8; ++corner)
      call(Vec3(link.collisions[c].X_LC *
                box.corner(static_cast<geometry::Aabb::CornerType>(corner))));
  }
}

}  // namespace

Eigen::VectorXd ArmWay::at(double t) const {
  const double place = std::clamp(t / step, 0.0, static_cast<double>(q.size() - 1));
  const auto before = std::min(static_cast<std::size_t>(place), q.size() - 1);
  const std::size_t after = std::min(before + 1, q.size() - 1);
  return q[before] + (place - static_cast<double>(before)) * (q[after] - q[before]);
}

Eigen::VectorXd ArmWay::fastest() const {
  Eigen::VectorXd most = Eigen::VectorXd::Zero(q.front().size());
  for (std::size_t i = 1; i < q.size(); ++i)
    most = most.cwiseMax((q[i] - q[i - 1]).cwiseAbs() / step);
  return most;
}

ArmWay measured_way(const Experiment& experiment, const Trial& trial) {
  const Samples& log = trial.follows_commands ? trial.commands : trial.joints;
  ArmWay way;
  way.step = median_step(log.time);
  const double end = log.time.empty() ? 0.0 : log.time.back();
  const auto steps = static_cast<int>(std::ceil(end / way.step - rounding));
  if (!trial.follows_commands) {
    const JointPath path = path_of(experiment, trial);
    for (int i = 0; i <= steps; ++i) way.q.push_back(path.at(i * way.step).q);
    return way;
  }
  Eigen::VectorXd told = start_of(experiment);
  int row = 0;
  // As the controller reads them: what a row leaves out stays as it was told before.
  for (int i = 0; i <= steps; ++i) {
    for (; row < log.size() &&
           (row == 0 || log.time[static_cast<std::size_t>(row)] <= i * way.step + rounding);
         ++row)
      for (std::size_t c = 0; c < trial.command_columns.size(); ++c)
        if (const double value = log.value(row, static_cast<long>(c)); std::isfinite(value))
          told[trial.command_columns[c]] = value;
    way.q.push_back(told);
  }
  return way;
}

WayCheck::WayCheck(const Experiment& experiment, const Trial& trial, const ArmWay& measured)
    : arm_(experiment, nominal_state(experiment)),
      fields_(simulation::exact_fields_of(arm_.description())) {
  add_plants(experiment, trial);
  const robot::KinematicModel& model = arm_.model();
  lower_ = model.lower();
  upper_ = model.upper();
  speed_ = model.velocity_limits();
  // A URDF whose limit is zero states none.
  for (long j = 0; j < speed_.size(); ++j)
    if (!(speed_[j] > 0.0)) speed_[j] = std::numeric_limits<double>::infinity();
  speed_ = speed_.cwiseMax(measured.fastest());
  floor_.setConstant(model.links(), experiment.scene.ground
                                        ? experiment.scene.ground->height + off_ground
                                        : -std::numeric_limits<double>::infinity());
  for (const world::BodyDescription& body : experiment.scene.bodies) {
    const auto [low, high] = world::bounds_of(body);
    bodies_.push_back({body.pose, low, high});
  }
  for (const Eigen::VectorXd& q : measured.q) {
    lower_ = lower_.cwiseMin(q);
    upper_ = upper_.cwiseMax(q);
    floor_ = floor_.cwiseMin(lowest(q));
    // An arm may stand on a table, and its tool may work in a tray.
    std::erase_if(bodies_, [&](const Box& body) { return is_in(body, q); });
  }
  start_clearance_ = std::min(stand_off, clearance(measured.q.front()));
}

void WayCheck::add_plants(const Experiment& experiment, const Trial& trial) {
  for (std::size_t p = 0; p < experiment.plants.size(); ++p) {
    const ExperimentPlant& plant = experiment.plants[p];
    const auto moved = trial.poses.find(static_cast<int>(p));
    const Pose& X_WP = moved != trial.poses.end() ? moved->second : plant.pose;
    for (const plant::PlantCurve& curve : plant.file.curves)
      for (std::size_t i = 1; i < curve.points.size(); ++i) {
        const Vec3 from = curve.points[i - 1], to = curve.points[i];
        const int pieces =
            std::max(1, static_cast<int>(std::ceil((to - from).norm() / plant_spacing)));
        const double radius = curve.radius.empty() ? 0.0 : *std::ranges::max_element(curve.radius);
        for (int k = 0; k <= pieces; ++k)
          plants_.push_back({X_WP * Vec3(from + (to - from) * k / pieces), radius});
      }
  }
}

Eigen::VectorXd WayCheck::lowest(const Eigen::VectorXd& q) const {
  std::vector<Pose> links;
  arm_.model().link_poses(q, links);
  Eigen::VectorXd low = Eigen::VectorXd::Constant(static_cast<long>(links.size()),
                                                  std::numeric_limits<double>::infinity());
  for (std::size_t l = 0; l < links.size(); ++l)
    each_corner(arm_.description().links[l], fields_[l], [&](const Vec3& corner_L) {
      double& own = low[static_cast<long>(l)];
      own = std::min(own, (links[l] * corner_L).z());
    });
  return low;
}

bool WayCheck::is_in(const Box& body, const Eigen::VectorXd& q) const {
  std::vector<Pose> links;
  arm_.model().link_poses(q, links);
  const Pose X_BW = body.X_WB.inverse();
  bool inside = false;
  for (std::size_t l = 0; l < links.size(); ++l)
    each_corner(arm_.description().links[l], fields_[l], [&](const Vec3& corner_L) {
      const Vec3 corner = X_BW * (links[l] * corner_L);
      inside = inside || ((corner.array() > body.low.array()).all() &&
                          (corner.array() < body.high.array()).all());
    });
  return inside;
}

std::pair<double, std::size_t> WayCheck::nearest(const Eigen::VectorXd& q) const {
  std::vector<Pose> links;
  arm_.model().link_poses(q, links);
  std::pair<double, std::size_t> best{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t l = 0; l < links.size(); ++l)
    for (std::size_t c = 0; c < fields_[l].size(); ++c) {
      const Pose X_CW = (links[l] * arm_.description().links[l].collisions[c].X_LC).inverse();
      for (std::size_t p = 0; p < plants_.size(); ++p) {
        const double gap = fields_[l][c]->distance(X_CW * plants_[p].position) - plants_[p].radius;
        if (gap < best.first) best = {gap, p};
      }
    }
  return best;
}

double WayCheck::clearance(const Eigen::VectorXd& q) const {
  return nearest(q).first;
}

Vec3 WayCheck::nearest_plant(const Eigen::VectorXd& q) const {
  return plants_[nearest(q).second].position;
}

bool WayCheck::allows(const ArmWay& way) const {
  if ((way.fastest().array() > speed_.array() + rounding).any()) return false;
  for (const Eigen::VectorXd& q : way.q) {
    if (!q.allFinite() || (q.array() < lower_.array() - rounding).any() ||
        (q.array() > upper_.array() + rounding).any() ||
        (lowest(q).array() < floor_.array() - rounding).any() ||
        std::ranges::any_of(bodies_, [&](const Box& body) { return is_in(body, q); }))
      return false;
  }
  return clearance(way.q.front()) >= start_clearance_ - rounding;
}

}  // namespace pedicel::discrepancy
