#include "app/ros/entities.h"

#include <regex.h>

#include <algorithm>
#include <set>

#include "app/topics/topic_source.h"

namespace pedicel::app {

namespace {

constexpr std::size_t longest_expression = 200;
constexpr double most_parts = 2000.0;  // of an expression, written out

/// How many parts the C library makes of an expression. It writes "+" and "{n,m}" out: nested, 200
/// bytes would take all memory. At least as many as it makes.
double parts_of(const std::string& text) {
  std::vector<double> outer;     // of the groups around
  double sum = 0.0, last = 0.0;  // of the group, but for the last part; of the last part
  const auto add = [&](double parts) { sum += last, last = parts; };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
      add(1.0);
    } else if (c == '[') {
      // What stands first in brackets closes none.
      i += i + 1 < text.size() && text[i + 1] == '^' ? 2 : 1;
      i = std::min(text.find(']', i + 1), text.size());
      add(1.0);
    } else if (c == '(') {
      add(0.0);
      outer.push_back(sum);
      sum = 0.0;
    } else if (c == ')' && !outer.empty()) {
      const double inner = sum + last + 1.0;
      sum = outer.back();
      last = inner;
      outer.pop_back();
    } else if (c == '+') {
      last *= 2.0;
    } else if (c == '{') {
      double most = 0.0, number = 0.0;
      for (; i < text.size() && text[i] != '}'; ++i) {
        const bool digit = text[i] >= '0' && text[i] <= '9';
        number = digit ? 10.0 * number + (text[i] - '0') : 0.0;
        most = std::max(most, number);
      }
      last *= most + 1.0;
    } else {
      add(1.0);
    }
  }
  for (const double one : outer) sum += one;
  return sum + last;
}

/// Whether an expression looks for what it found before ("\\1"), which may take for ever.
bool looks_back(const std::string& text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\\') {
      ++i;
      if (text[i] >= '1' && text[i] <= '9') return true;
    }
  return false;
}

/// The C library's regular expressions: without looking back they take time linear in the name.
class Expression {
 public:
  explicit Expression(const std::string& text)
      : good_(!looks_back(text) && parts_of(text) <= most_parts &&
              ::regcomp(&own_, text.c_str(), REG_EXTENDED | REG_NOSUB) == 0) {}
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

void add_plants(const simulation::Simulation& simulation, std::vector<Entity>& all) {
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
      all.push_back({simulation::fruit_name(model, f), ros::EntityCategory::dynamic_object,
                     state_of(time, pose, velocity_on(model, state, fruit.element, fruit.back),
                              pose.rotation * state.angular_velocity[e])});
    }
  }
}

}  // namespace

std::vector<Entity> entities_of(const simulation::Simulation& simulation) {
  std::vector<Entity> all;
  const world::SimWorld& world = simulation.world();
  if (const simulation::RobotControl* robot = simulation.robot())
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
                  "the filter is no regular expression (POSIX extended, without \\1, and at most "
                  "2000 parts where repetitions are written out)");
  std::set<std::uint8_t> categories;
  for (const ros::EntityCategory& one : filters.categories) categories.insert(one.category);
  std::erase_if(all, [&](const Entity& entity) {
    return !expression.matches(entity.name) ||
           (!categories.empty() && !categories.contains(entity.category));
  });
  return all;
}

}  // namespace pedicel::app
