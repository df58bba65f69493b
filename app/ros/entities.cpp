#include "pedicel/app/ros/entities.h"

#include <regex.h>

#include <algorithm>
#include <set>

#include "pedicel/app/topics/topic_source.h"

namespace pedicel::app {

namespace {

constexpr std::size_t longest_expression = 200;

/// The C library's regular expressions: they take time linear in the name.
class Expression {
 public:
  explicit Expression(const std::string& text)
      : good_(::regcomp(&own_, text.c_str(), REG_EXTENDED | REG_NOSUB) == 0) {}
  ~Expression() {
    if (good_) ::regfree(&own_);
  }
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;
  bool good() const { return good_; }
  bool matches(const std::string& name) const {
    return ::regexec(&own_, name.c_str(), 0, nullptr, 0) == 0;
  }

 private:
  regex_t own_{};
  bool good_;
};

ros::EntityState state_of(double time, const Pose& pose, const Vec3& velocity,
                          const Vec3& angular) {
  ros::EntityState state;
  state.header = {ros::stamp_of(time), world_frame};
  state.pose = pose_of(pose);
  state.twist = {vector_of(velocity), vector_of(angular)};
  return state;
}

void add_plants(const Simulation& simulation, std::vector<Entity>& all) {
  const double time = simulation.world().time();
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const cosserat::RodState& state = simulation.rods().state(p);
    all.push_back({model.name, ros::EntityCategory::object,
                   state_of(time, state.root, Vec3::Zero(), Vec3::Zero())});
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      const cosserat::Fruit& fruit = model.fruits[static_cast<std::size_t>(f)];
      const auto e = static_cast<std::size_t>(fruit.element);
      if (state.fruit_gone[static_cast<std::size_t>(f)] || !state.alive[e]) continue;
      const Pose pose{point_on(model, state, fruit.element, fruit.back), state.orientation[e]};
      all.push_back({fruit_name(model, f), ros::EntityCategory::dynamic_object,
                     state_of(time, pose, velocity_on(model, state, fruit.element, fruit.back),
                              pose.rotation * state.angular_velocity[e])});
    }
  }
}

}  // namespace

std::vector<Entity> entities_of(const Simulation& simulation) {
  std::vector<Entity> all;
  const world::SimWorld& world = simulation.world();
  if (const RobotControl* robot = simulation.robot())
    all.push_back(
        {robot->name(), ros::EntityCategory::robot,
         state_of(world.time(),
                  robot->link_poses()[static_cast<std::size_t>(robot->description().root)],
                  Vec3::Zero(), Vec3::Zero())});
  add_plants(simulation, all);
  for (int b = 0; b < world.body_count(); ++b) {
    const bool moves = world.body(b).mass > 0.0;
    all.push_back({world.body(b).name,
                   moves ? ros::EntityCategory::dynamic_object : ros::EntityCategory::static_object,
                   state_of(world.time(), world.body_pose(b),
                            moves ? world.body_velocity(b) : Vec3(Vec3::Zero()),
                            moves ? world.body_angular_velocity(b) : Vec3(Vec3::Zero()))});
  }
  return all;
}

std::optional<std::vector<Entity>> filtered(std::vector<Entity> all,
                                            const ros::EntityFilters& filters,
                                            ros::SimulationResult& result) {
  const auto refuse = [&](std::uint8_t code, const char* why) {
    result = {code, why};
    return std::nullopt;
  };
  if (filters.bounds.type != 0)
    return refuse(ros::SimulationResult::unsupported, "filters by bounds are not supported");
  if (!filters.tags.tags.empty())
    return refuse(ros::SimulationResult::unsupported, "filters by tags are not supported");
  if (filters.filter.size() > longest_expression)
    return refuse(ros::SimulationResult::operation_failed, "the filter is longer than 200 bytes");
  const Expression expression("^(" + (filters.filter.empty() ? ".*" : filters.filter) + ")$");
  if (!expression.good())
    return refuse(ros::SimulationResult::operation_failed,
                  "the filter is no regular expression (POSIX extended)");
  std::set<std::uint8_t> categories;
  for (const ros::EntityCategory& one : filters.categories) categories.insert(one.category);
  std::erase_if(all, [&](const Entity& entity) {
    return !expression.matches(entity.name) ||
           (!categories.empty() && !categories.contains(entity.category));
  });
  return all;
}

}  // namespace pedicel::app
